//! Triangles into pixels: the nearest one wins.

/// Pixels, row by row from the top left, red green blue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Image {
    pub width: usize,
    pub height: usize,
    pub rgb: Vec<u8>,
}

/// A corner on the canvas: pixels to the right and down, metres towards the viewer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub x: f64,
    pub y: f64,
    pub depth: f64,
}

/// Colours with depths, white and infinitely far at first.
pub(super) struct Canvas {
    width: usize,
    height: usize,
    depth: Vec<f64>,
    rgb: Vec<[u8; 3]>,
}

/// How much darker the outline of an element is than its middle.
const OUTLINE: f64 = 0.62;

impl Canvas {
    pub(super) fn new(width: usize, height: usize) -> Canvas {
        let count = width * height;
        Canvas { width, height, depth: vec![f64::NEG_INFINITY; count], rgb: vec![[255; 3]; count] }
    }

    /// Fills an element as a fan of triangles round its centre, one per side, with an outline `edge` pixels wide unless a
    /// side is shorter than `shortest` pixels.
    pub(super) fn element(&mut self, corners: &[Corner], rgb: [f64; 3], edge: f64, shortest: f64) {
        let count = corners.len();
        let mean = |of: fn(&Corner) -> f64| corners.iter().map(of).sum::<f64>() / count as f64;
        let centre = Corner { x: mean(|c| c.x), y: mean(|c| c.y), depth: mean(|c| c.depth) };
        let sides = || (0..count).map(|k| (corners[k], corners[(k + 1) % count]));
        let small = sides().any(|(a, b)| (a.x - b.x).hypot(a.y - b.y) < shortest);
        for (a, b) in sides() {
            self.triangle([a, b, centre], rgb, if small { 0.0 } else { edge });
        }
    }

    /// Fills a triangle; its side from the first to the second corner is the outline.
    fn triangle(&mut self, [a, b, c]: [Corner; 3], rgb: [f64; 3], edge: f64) {
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let (inside, outline) = (bytes(rgb), bytes(rgb.map(|v| v * OUTLINE)));
        let height = area.abs() / (b.x - a.x).hypot(b.y - a.y);
        let columns = pixels([a.x, b.x, c.x], self.width);
        for row in pixels([a.y, b.y, c.y], self.height) {
            let y = row as f64 + 0.5;
            for column in columns.clone() {
                let x = column as f64 + 0.5;
                let of_a = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
                let of_b = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
                let of_c = 1.0 - of_a - of_b;
                if of_a < 0.0 || of_b < 0.0 || of_c < 0.0 {
                    continue;
                }
                let depth = of_a * a.depth + of_b * b.depth + of_c * c.depth;
                let at = row * self.width + column;
                if depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.rgb[at] = if of_c * height < edge { outline } else { inside };
                }
            }
        }
    }

    /// The image, each pixel the mean of `fine` × `fine`.
    pub(super) fn averaged(&self, fine: usize) -> Image {
        let (width, height) = (self.width / fine, self.height / fine);
        let count = (fine * fine) as u32;
        let mut rgb = Vec::with_capacity(3 * width * height);
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
            let mut sum = [0_u32; 3];
            for (i, j) in (0..fine).flat_map(|i| (0..fine).map(move |j| (i, j))) {
                let pixel = self.rgb[(row * fine + i) * self.width + column * fine + j];
                (0..3).for_each(|k| sum[k] += u32::from(pixel[k]));
            }
            rgb.extend(sum.map(|total| ((total + count / 2) / count) as u8));
        }
        Image { width, height, rgb }
    }
}

/// Pixels whose centres may lie between the smallest and largest coordinate.
fn pixels(x: [f64; 3], count: usize) -> std::ops::Range<usize> {
    let low = x[0].min(x[1]).min(x[2]).floor().clamp(0.0, count as f64) as usize;
    let high = x[0].max(x[1]).max(x[2]).ceil().clamp(0.0, count as f64) as usize;
    low..high
}

pub(super) fn bytes(rgb: [f64; 3]) -> [u8; 3] {
    rgb.map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Viridis at steps of a tenth: N. Smith and S. van der Walt for matplotlib, CC0.
const VIRIDIS: [u32; 11] = [
    0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70, 0x7a_d1_51,
    0xbd_df_26, 0xfd_e7_25,
];

/// Colour of a share between 0 (dark violet) and 1 (yellow): red, green, blue from 0 to 1. Even in perceived lightness,
/// also for colour-blind eyes and in grey print.
pub(crate) fn viridis(share: f64) -> [f64; 3] {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let index = (place as usize).min(VIRIDIS.len() - 2);
    let (a, b) = (parts(VIRIDIS[index]), parts(VIRIDIS[index + 1]));
    let along = place - index as f64;
    [0, 1, 2].map(|k| a[k] + along * (b[k] - a[k]))
}

fn parts(hex: u32) -> [f64; 3] {
    [16, 8, 0].map(|shift| f64::from(hex >> shift & 0xff) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::super::raster::bytes;
    use super::*;

    #[test]
    fn the_colour_map_grows_lighter_from_end_to_end() {
        let lightness = |i: usize| {
            let [r, g, b] = viridis(i as f64 / 100.0).map(|v| v.powf(2.2));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..100).all(|i| lightness(i) < lightness(i + 1)));
        assert_eq!(bytes(viridis(0.0)), [0x44, 0x01, 0x54]);
        assert_eq!(bytes(viridis(2.0)), [0xfd, 0xe7, 0x25]);
        assert_eq!(bytes(viridis(0.5)), [0x21, 0x91, 0x8c]);
    }
}
