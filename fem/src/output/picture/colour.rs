//! The colour map, and the bar that explains it.

use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts};

use super::Image;
use super::raster::bytes;

/// Viridis at steps of a tenth: N. Smith and S. van der Walt for matplotlib, CC0.
const VIRIDIS: [u32; 11] = [
    0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70, 0x7a_d1_51,
    0xbd_df_26, 0xfd_e7_25,
];

/// Colour of a share between 0 (dark violet) and 1 (yellow): red, green, blue from 0 to 1. Even in perceived lightness,
/// also for colour-blind eyes and in grey print.
pub fn viridis(share: f64) -> [f64; 3] {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let index = (place as usize).min(VIRIDIS.len() - 2);
    let (a, b) = (parts(VIRIDIS[index]), parts(VIRIDIS[index + 1]));
    let along = place - index as f64;
    [0, 1, 2].map(|k| a[k] + along * (b[k] - a[k]))
}

fn parts(hex: u32) -> [f64; 3] {
    [16, 8, 0].map(|shift| f64::from(hex >> shift & 0xff) / 255.0)
}

/// Pixels at the right that the bar needs.
pub(super) fn bar_width(height: usize) -> usize {
    LETTER_STEP * zoom(height) * LONGEST + 2 * zoom(height)
}

/// Draws the colour map at the right with its limits above and below.
pub(super) fn draw_bar(image: &mut Image, (low, high): (f64, f64)) {
    let zoom = zoom(image.height);
    let room = bar_width(image.height);
    let left = image.width.saturating_sub(room);
    let (top, bottom) = (image.height / 5, image.height - image.height / 5);
    for row in top..bottom {
        let colour = bytes(viridis((bottom - 1 - row) as f64 / (bottom - 1 - top).max(1) as f64));
        (left..left + 16 * zoom).for_each(|column| paint(image, row, column, colour));
    }
    let gap = 3 * zoom;
    write_text(image, top.saturating_sub(LETTER_ROWS * zoom + gap), left, zoom, &short(high));
    write_text(image, bottom + gap, left, zoom, &short(low));
}

/// Size of a dot of the letters.
fn zoom(height: usize) -> usize {
    (height / 400).max(1)
}

/// Four digits at most, as a person would write them.
fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (0.01..10_000.0).contains(&size) {
        let decimals = 2 - size.log10().floor().clamp(-2.0, 2.0) as i32;
        let text = format!("{value:.*}", decimals as usize);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{value:.1e}")
    }
}

/// Dots of a letter, rows and columns, as in the font.
const LETTER_ROWS: usize = 8;
const LETTER_STEP: usize = 8;
/// Letters in the longest text: -1.2e-300.
const LONGEST: usize = 8;

/// Writes the title at the top left.
pub(super) fn draw_title(image: &mut Image, title: &str) {
    let zoom = zoom(image.height);
    write_text(image, 4 * zoom, 4 * zoom, zoom, title);
}

fn write_text(image: &mut Image, top: usize, left: usize, zoom: usize, text: &str) {
    for (index, letter) in text.chars().enumerate() {
        let rows = BASIC_FONTS.get(letter).or_else(|| LATIN_FONTS.get(letter)).unwrap_or_default();
        for (row, dots) in rows.into_iter().enumerate() {
            for column in (0..8).filter(|column| dots >> column & 1 == 1) {
                for (i, j) in (0..zoom).flat_map(|i| (0..zoom).map(move |j| (i, j))) {
                    paint(image, top + row * zoom + i, left + (column + index * LETTER_STEP) * zoom + j, [40; 3]);
                }
            }
        }
    }
}

fn paint(image: &mut Image, row: usize, column: usize, colour: [u8; 3]) {
    if row < image.height && column < image.width {
        let at = 3 * (row * image.width + column);
        image.rgb[at..at + 3].copy_from_slice(&colour);
    }
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn limits_are_written_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-12.345, "-12.3"),
            (123.4, "123"),
            (9876.0, "9876"),
            (0.0123, "0.0123"),
            (1.2e7, "1.2e7"),
            (-3e-9, "-3.0e-9"),
        ] {
            assert_eq!(short(value), text);
            assert!(text.len() <= LONGEST);
        }
    }
}
