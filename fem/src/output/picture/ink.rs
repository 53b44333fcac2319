//! Letters and lines on an image, with smooth edges.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use super::raster::Image;
use crate::vec3::V3;

/// DejaVu Sans, as in the plots: Latin, Greek, signs of mathematics.
const FONT: &[u8] = include_bytes!("../../../../assets/DejaVuSans-subset.ttf");
const INK: [f64; 3] = [0.16; 3];

/// Height of a font's em \[pixels\] that can be read on a picture of a height.
pub(super) fn letter_size(height: usize) -> f64 {
    (height as f64 / 40.0).max(10.0)
}

/// Writes a text from the left end of its base line.
pub(super) fn write(image: &mut Image, [left, base]: [f64; 2], size: f64, text: &str) {
    let Some((font, glyphs, _)) = lay_out(size, text) else { return };
    for mut glyph in glyphs {
        glyph.position.x += left as f32;
        glyph.position.y += base as f32;
        let Some(outline) = font.outline_glyph(glyph) else { continue };
        let corner = outline.px_bounds().min;
        outline.draw(|x, y, cover| {
            let (column, row) = (corner.x + x as f32, corner.y + y as f32);
            blend(image, column, row, f64::from(cover), INK);
        });
    }
}

pub(super) fn width(size: f64, text: &str) -> f64 {
    lay_out(size, text).map_or(0.0, |(_, _, advance)| advance)
}

/// The font, the letters along a base line from 0, and how far they go.
fn lay_out(size: f64, text: &str) -> Option<(FontRef<'static>, Vec<Glyph>, f64)> {
    let font = FontRef::try_from_slice(FONT).ok()?;
    // Fonts are scaled by their height.
    let scale = PxScale::from(size as f32 * font.height_unscaled() / font.units_per_em()?);
    let (scaled, mut pen) = (font.as_scaled(scale), 0.0);
    let place = |letter: char| {
        let id = scaled.glyph_id(letter);
        let at = point(pen, 0.0);
        pen += scaled.h_advance(id);
        id.with_scale_and_position(scale, at)
    };
    let glyphs = text.chars().filter(|c| !c.is_control()).map(place).collect();
    Some((font, glyphs, f64::from(pen)))
}

/// Draws a line between two points, some pixels wide.
pub(super) fn line(image: &mut Image, a: [f64; 2], b: [f64; 2], width: f64, rgb: V3) {
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = (way[0] * way[0] + way[1] * way[1]).max(f64::MIN_POSITIVE);
    let span = |k: usize| {
        let (low, high) = (a[k].min(b[k]) - width, a[k].max(b[k]) + width);
        (low.max(0.0) as usize)..(high.max(0.0) as usize + 1)
    };
    for row in span(1) {
        for column in span(0) {
            let from = [column as f64 + 0.5 - a[0], row as f64 + 0.5 - a[1]];
            let along = ((from[0] * way[0] + from[1] * way[1]) / square).clamp(0.0, 1.0);
            let off = (from[0] - along * way[0]).hypot(from[1] - along * way[1]);
            blend(image, column as f32, row as f32, (0.5 + 0.5 * width - off).clamp(0.0, 1.0), rgb);
        }
    }
}

/// A line in the colour of the letters.
pub(super) fn stroke(image: &mut Image, a: [f64; 2], b: [f64; 2], width: f64) {
    line(image, a, b, width, INK);
}

fn blend(image: &mut Image, column: f32, row: f32, cover: f64, rgb: V3) {
    if column < 0.0 || row < 0.0 || column as usize >= image.width || row as usize >= image.height {
        return;
    }
    let at = 3 * (row as usize * image.width + column as usize);
    for (pixel, ink) in image.rgb[at..at + 3].iter_mut().zip(rgb) {
        *pixel = (f64::from(*pixel) * (1.0 - cover) + 255.0 * ink * cover).round() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn white() -> Image {
        Image { width: 200, height: 60, rgb: vec![255; 3 * 200 * 60] }
    }

    /// Columns with any ink: first and last.
    fn inked(image: &Image) -> (usize, usize) {
        let dark = |x: &usize| (0..image.height).any(|y| image.rgb[3 * (y * image.width + x)] < 200);
        let columns: Vec<usize> = (0..image.width).filter(dark).collect();
        (columns[0], columns[columns.len() - 1])
    }

    #[test]
    fn a_text_is_as_wide_as_it_says_and_has_every_letter_it_may_need() {
        for text in ["von Mises [MPa], 10 kPa", "δ = ½·10⁻³ m² ≥ Größe"] {
            let mut image = white();
            write(&mut image, [5.0, 40.0], 14.0, text);
            let (first, last) = inked(&image);
            assert!(first >= 4 && (last as f64 - 5.0 - width(14.0, text)).abs() < 3.0, "{text}: {first} {last}");
        }
        let font = FontRef::try_from_slice(FONT).unwrap();
        assert!("xyz0123456789.-≥²äöüß".chars().all(|letter| font.glyph_id(letter).0 != 0));
    }

    #[test]
    fn what_lies_outside_is_left_out() {
        let mut image = white();
        write(&mut image, [-20.0, 5.0], 30.0, "outside");
        write(&mut image, [190.0, 70.0], 30.0, "outside");
        line(&mut image, [-50.0, -10.0], [300.0, 90.0], 3.0, [0.0; 3]);
        assert_eq!(image.rgb.len(), 3 * 200 * 60);
    }

    #[test]
    fn a_line_covers_its_length_times_its_width() {
        let mut image = white();
        line(&mut image, [20.0, 30.0], [120.0, 30.0], 3.0, [0.0; 3]);
        let ink: f64 = image.rgb.chunks(3).map(|p| 1.0 - f64::from(p[0]) / 255.0).sum();
        // Round ends.
        assert!((ink - (300.0 + 1.5 * 1.5 * std::f64::consts::PI)).abs() < 6.0, "{ink}");
        assert_eq!(inked(&image), (18, 121));
    }
}
