//! Puts a scene on the SVG and the bitmap backend of plotters, by one generic routine.

use crate::scene::{Anchor, Scene, SceneMark, ScenePoint};
use crate::{Drawn, ReportError, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// SVG coordinates are whole numbers: ten per design pixel keep curves smooth.
const SVG_SCALE: f64 = 10.0;
/// Pixels of the PNG per design pixel; tests draw hundreds of plots without optimisation, so theirs are small.
const PNG_SCALE: usize = if cfg!(test) { 1 } else { 3 };
/// The bitmap is painted this many times larger and averaged, for smooth edges.
const OVERSAMPLE: usize = 2;

struct DrawingSurface {
    scale: f64,
    /// plotters' font size for one em of one unit.
    size_per_em: f64,
    /// Baseline below the top anchor, in em.
    baseline_em: f64,
    /// Draw letter by letter: the bitmap backend drops the side bearing of a glyph.
    by_letter: bool,
}

/// Draws the scene as SVG text and PNG bytes; in a browser, which saves no files, without the PNG.
pub(crate) fn paint(scene: &Scene) -> Result<Drawn, ReportError> {
    text::font()?;
    let png = if cfg!(target_family = "wasm") { Vec::new() } else { png(scene)? };
    Ok(Drawn { svg: svg(scene)?, png })
}

fn svg(scene: &Scene) -> Result<String, ReportError> {
    let size = pixels(scene, SVG_SCALE);
    let surface = DrawingSurface { scale: SVG_SCALE, size_per_em: 1.24, baseline_em: 0.76, by_letter: false };
    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, size).into_drawing_area();
        marks(&root, scene, &surface)?;
        root.present().map_err(drawing)?;
    }
    let full = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let small = format!("width=\"{:.0}\" height=\"{:.0}\"", scene.width, scene.height);
    let family = format!("font-family=\"{}\"", text::FAMILY);
    // Blank-free text elements keep end-anchored labels in place in every viewer; round joins match the bitmap.
    Ok(out
        .replace('\n', "")
        .replacen(&full, &small, 1)
        .replace("/><", "/>\n<")
        .replace("</text><", "</text>\n<")
        .replace("<polyline ", "<polyline stroke-linejoin=\"round\" stroke-linecap=\"round\" ")
        .replace(&family, &format!("font-family=\"{}, Verdana, sans-serif\"", text::FAMILY)))
}

fn png(scene: &Scene) -> Result<Vec<u8>, ReportError> {
    let scale = (PNG_SCALE * OVERSAMPLE) as f64;
    let size = pixels(scene, scale);
    let height_per_em = text::height_per_em()?;
    let surface =
        DrawingSurface { scale, size_per_em: height_per_em, baseline_em: 0.5 * height_per_em, by_letter: true };
    let mut buffer = vec![255; 3 * size.0 as usize * size.1 as usize];
    {
        let root = BitMapBackend::with_buffer(&mut buffer, size).into_drawing_area();
        marks(&root, scene, &surface)?;
        root.present().map_err(drawing)?;
    }
    let (width, height) = (size.0 as usize / OVERSAMPLE, size.1 as usize / OVERSAMPLE);
    encode(&average(&buffer, size.0 as usize, width, height), width as u32, height as u32)
}

fn pixels(scene: &Scene, scale: f64) -> (u32, u32) {
    ((scene.width.round() * scale) as u32, (scene.height.round() * scale) as u32)
}

/// Mean of each block of `OVERSAMPLE`² pixels of an RGB image.
fn average(fine: &[u8], fine_width: usize, width: usize, height: usize) -> Vec<u8> {
    let n = (OVERSAMPLE * OVERSAMPLE) as u32;
    let mut out = Vec::with_capacity(3 * width * height);
    let mut sums = vec![0_u32; 3 * width];
    for rows in fine.chunks_exact(3 * fine_width * OVERSAMPLE) {
        sums.fill(n / 2);
        for row in rows.chunks_exact(3 * fine_width) {
            for (i, value) in row.iter().enumerate() {
                sums[3 * (i / (3 * OVERSAMPLE)) + i % 3] += u32::from(*value);
            }
        }
        out.extend(sums.iter().map(|sum| (sum / n) as u8));
    }
    out
}

fn encode(rgb: &[u8], width: u32, height: u32) -> Result<Vec<u8>, ReportError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(drawing)?;
    writer.write_image_data(rgb).map_err(drawing)?;
    writer.finish().map_err(drawing)?;
    Ok(out)
}

fn marks<DB: DrawingBackend>(
    root: &DrawingArea<DB, plotters::coord::Shift>,
    scene: &Scene,
    surface: &DrawingSurface,
) -> Result<(), ReportError> {
    root.fill(&WHITE).map_err(drawing)?;
    for mark in &scene.marks {
        match mark {
            SceneMark::Line { points, ink, width } => stroke(root, surface, points, ink.rgb(), *width)?,
            SceneMark::Fill { points, ink, alpha } => {
                let [r, g, b] = ink.rgb();
                let corners = surface.distinct(points);
                if corners.len() > 2 {
                    root.draw(&Polygon::new(corners, RGBColor(r, g, b).mix(*alpha).filled())).map_err(drawing)?;
                }
            }
            SceneMark::Disc { centre, radius, ink } => {
                let ([r, g, b], radius) = (ink.rgb(), (radius * surface.scale).round().max(1.0) as u32);
                let filled = RGBColor(r, g, b).filled();
                root.draw(&Circle::new(surface.whole(*centre), radius, filled)).map_err(drawing)?;
            }
            SceneMark::Text { .. } => letters(root, surface, mark)?,
        }
    }
    Ok(())
}

/// A line; on the bitmap segment by segment with round joins, which the backend does not know.
fn stroke<DB: DrawingBackend>(
    root: &DrawingArea<DB, plotters::coord::Shift>,
    surface: &DrawingSurface,
    points: &[ScenePoint],
    [r, g, b]: [u8; 3],
    width: f64,
) -> Result<(), ReportError> {
    let path = surface.distinct(points);
    let thick = (width * surface.scale).round().max(1.0) as u32;
    let style = RGBColor(r, g, b).stroke_width(thick);
    if !surface.by_letter {
        return if path.len() < 2 { Ok(()) } else { root.draw(&PathElement::new(path, style)).map_err(drawing) };
    }
    for pair in path.windows(2) {
        root.draw(&PathElement::new(pair.to_vec(), style)).map_err(drawing)?;
    }
    for joint in path.iter().skip(1).take(path.len().saturating_sub(2)) {
        root.draw(&Circle::new(*joint, thick / 2, RGBColor(r, g, b).filled())).map_err(drawing)?;
    }
    Ok(())
}

fn letters<DB: DrawingBackend>(
    root: &DrawingArea<DB, plotters::coord::Shift>,
    surface: &DrawingSurface,
    mark: &SceneMark,
) -> Result<(), ReportError> {
    let SceneMark::Text { at, text, size, ink, anchor } = mark else { return Ok(()) };
    let [r, g, b] = ink.rgb();
    let pixel_size = size * surface.size_per_em * surface.scale;
    let top = at[1] - size * surface.baseline_em;
    let horizontal = match anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let style = |h| (text::FAMILY, pixel_size).into_font().color(&RGBColor(r, g, b)).pos(Pos::new(h, VPos::Top));
    if !surface.by_letter {
        let element = Text::new(text.clone(), surface.whole([at[0], top]), style(horizontal));
        return root.draw(&element).map_err(drawing);
    }
    let (glyphs, advance) = text::lay_out(text)?;
    let start = at[0] - size * advance * [0.0, 0.5, 1.0][*anchor as usize];
    for (letter, x_em) in glyphs {
        let place = surface.whole([start + x_em * size, top]);
        root.draw(&Text::new(letter.to_string(), place, style(HPos::Left))).map_err(drawing)?;
    }
    Ok(())
}

impl DrawingSurface {
    fn whole(&self, [x, y]: ScenePoint) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }

    /// Whole-number points without repeats, which the bitmap backend would divide by.
    fn distinct(&self, points: &[ScenePoint]) -> Vec<(i32, i32)> {
        let mut path: Vec<_> = points.iter().map(|point| self.whole(*point)).collect();
        path.dedup();
        path
    }
}

fn drawing(error: impl std::fmt::Display) -> ReportError {
    ReportError::Drawing(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_keeps_colours_and_halves_the_size() {
        let fine = [[0, 10, 100], [4, 10, 101], [9, 9, 9], [9, 9, 9], [2, 10, 102], [6, 10, 103], [9, 9, 9], [9, 9, 9]];
        assert_eq!(average(&fine.concat(), 4, 2, 1), [3, 10, 102, 9, 9, 9]);
    }
}
