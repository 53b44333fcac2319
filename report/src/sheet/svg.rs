//! SVG in millimetres, whole or by pages.

use super::{PatternSheet, SheetText};
use crate::markup::escape;
use std::fmt::Write;

/// Papers of a printer: name as typed, width and height \[mm\].
pub const PAPERS: [(&str, [f64; 2]); 4] =
    [("a4", [210.0, 297.0]), ("a3", [297.0, 420.0]), ("letter", [215.9, 279.4]), ("tabloid", [279.4, 431.8])];

/// Margin that printers leave white on every side \[mm\].
const MARGIN: f64 = 10.0;
/// What neighbouring pages both show \[mm\].
const OVERLAP: f64 = 10.0;
/// Thickness of the lines in the drawing \[mm\].
const PEN: f64 = 0.3;
/// Ratio of the letters' height to the capitals'.
const FONT: f64 = 1.0 / 0.72;

/// The whole drawing on one sheet of the drawing's size.
pub fn svg(sheet: &PatternSheet) -> String {
    let window = [0.0, 0.0, sheet.size[0], sheet.size[1]];
    document(sheet, sheet.size, [0.0, 0.0], window, "")
}

/// The drawing cut into pages, row by row from the top: (row, column) from 1 and the SVG. Neighbours share a strip with a cross at
/// each of its ends, by which they are put together.
pub fn pages(sheet: &PatternSheet, paper: [f64; 2]) -> Vec<([usize; 2], String)> {
    let inner = paper.map(|side| side - 2.0 * MARGIN);
    let step = inner.map(|side| side - OVERLAP);
    let count = [0, 1].map(|i| (((sheet.size[i] - OVERLAP) / step[i] - 1e-9).ceil().max(1.0)) as usize);
    let [columns, rows] = count;
    let page = |row: usize, column: usize| {
        let corner = [column as f64 * step[0], row as f64 * step[1]];
        let window = [corner[0], corner[1], inner[0], inner[1]];
        let words = format!("{}: row {} of {rows}, column {} of {columns}", sheet.title, row + 1, column + 1);
        ([row + 1, column + 1], document(sheet, paper, [MARGIN; 2], window, &words))
    };
    (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).map(|(r, c)| page(r, c)).collect()
}

/// A paper that shows a window of the drawing, x, y from the top, width, height, from a corner on; a group for every pen.
fn document(sheet: &PatternSheet, paper: [f64; 2], corner: [f64; 2], window: [f64; 4], words: &str) -> String {
    let [width, height] = paper;
    let [x, y, w, h] = window;
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">
<!-- made by ibr -->
<title>{}</title>
"#,
        escape(&sheet.title)
    );
    if !words.is_empty() {
        let [dx, dy] = [corner[0] - x, corner[1] - y];
        out += &format!(
            r#"<clipPath id="page"><rect x="{x}" y="{y}" width="{w}" height="{h}"/></clipPath>
<g clip-path="url(#page)" transform="translate({dx} {dy})">
"#
        );
    }
    (0..sheet.layers.len()).for_each(|layer| group(sheet, layer, &mut out));
    if !words.is_empty() {
        out.push_str("</g>\n");
        crosses(corner, [w, h], &mut out);
        let words = SheetText { at: [corner[0] + 5.0, 3.0 - corner[1]], height: 2.5, text: words.into() };
        written(&words, 0.0, "#000000", &mut out);
    }
    out + "</svg>\n"
}

/// Crosses at the corners of the strips that neighbouring pages share.
fn crosses(corner: [f64; 2], inner: [f64; 2], out: &mut String) {
    for x in [0.0, OVERLAP, inner[0] - OVERLAP, inner[0]] {
        for y in [0.0, OVERLAP, inner[1] - OVERLAP, inner[1]] {
            let (x, y) = (corner[0] + x, corner[1] + y);
            let _ = writeln!(
                out,
                r##"<path d="M{} {y}h4M{x} {}v4" stroke="#999999" stroke-width="0.2"/>"##,
                x - 2.0,
                y - 2.0
            );
        }
    }
}

fn group(sheet: &PatternSheet, layer: usize, out: &mut String) {
    let pen = &sheet.layers[layer];
    let dashes: Vec<String> = pen.dashes.iter().map(f64::to_string).collect();
    let dashes = if dashes.is_empty() { String::new() } else { format!(r#" stroke-dasharray="{}""#, dashes.join(" ")) };
    let _ = writeln!(out, r#"<g id="{}" fill="none" stroke="{}" stroke-width="{PEN}"{dashes}>"#, pen.name, pen.colour);
    for line in sheet.lines.iter().filter(|line| line.layer == layer) {
        let place = |p: &[f64; 2]| format!("{:.3},{:.3}", p[0], sheet.size[1] - p[1]);
        let points: Vec<String> = line.points.iter().map(place).collect();
        let _ = writeln!(out, r#"<path d="M{}{}"/>"#, points.join(" "), if line.closed { "Z" } else { "" });
    }
    if layer + 1 == sheet.layers.len() {
        sheet.labels.iter().for_each(|label| written(label, sheet.size[1], pen.colour, out));
    }
    out.push_str("</g>\n");
}

fn written(label: &SheetText, height: f64, colour: &str, out: &mut String) {
    let [x, y] = label.at;
    let _ = writeln!(
        out,
        r#"<text x="{x:.3}" y="{:.3}" font-family="sans-serif" font-size="{:.2}" fill="{colour}" stroke="none">{}</text>"#,
        height - y,
        label.height * FONT,
        escape(&label.text)
    );
}
