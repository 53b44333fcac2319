//! A cutting plan laid out as one drawing true to size.

use models::cutting::{CuttingPlan, MarkKind, PatternPiece};
use report::sheet::{PatternSheet, Pen};

const MM: f64 = 1e3;
/// White border on every side of the drawing \[mm\].
const BORDER: f64 = 10.0;
/// Between pieces \[mm\], for their names.
const GAP: f64 = 16.0;
/// Capitals of names, and of small words \[mm\].
const TEXT: [f64; 2] = [4.0, 2.8];
/// Height of a row of words \[mm\].
const ROW: f64 = 6.0;
/// A known length to check a print by \[mm\].
const SCALE_BAR: f64 = 100.0;
/// Half of a marker's cross, and length of the arrow of the fibres \[mm\].
const CROSS: f64 = 3.0;
const ARROW: f64 = 24.0;

/// The marks in the order in which they are drawn, areas first.
const KINDS: [MarkKind; 8] = [
    MarkKind::Lap,
    MarkKind::Tape,
    MarkKind::Glue,
    MarkKind::Weld,
    MarkKind::Place,
    MarkKind::Valley,
    MarkKind::Mountain,
    MarkKind::Marker,
];

/// Pens after the marks. Scale bar, legend and words are [`INFO`]: no work for a machine.
const CUT: usize = KINDS.len();
const WARP: usize = CUT + 1;
const INFO: usize = CUT + 2;

/// A colour for every purpose: programs of laser cutters sort by it.
fn pens() -> Vec<Pen> {
    let pen = |name, meaning, colour, aci, dashes| Pen { name, meaning, colour, aci, dashes };
    let of = |kind| match kind {
        MarkKind::Lap => {
            pen("LAP", "purple: overlap: roll up and join these edges on each other", "#7a5195", 200, &[][..])
        }
        MarkKind::Tape => pen("TAPE", "green: adhesive tape", "#2e8b57", 3, &[]),
        MarkKind::Glue => pen("GLUE", "orange: glue", "#e67e22", 30, &[]),
        MarkKind::Weld => pen("WELD", "red: weld", "#c0392b", 1, &[]),
        MarkKind::Place => pen("PLACE", "grey, dotted: place of another piece", "#777777", 8, &[1.0, 1.5]),
        MarkKind::Valley => pen("FOLD_VALLEY", "blue, dashed: fold, outer faces meet", "#1f5fbf", 5, &[5.0, 2.0]),
        MarkKind::Mountain => {
            pen("FOLD_MOUNTAIN", "cyan, dash-dotted: fold, inner faces meet", "#17a2b8", 4, &[7.0, 1.5, 1.0, 1.5])
        }
        MarkKind::Marker => pen("MARKER", "pink: marker", "#e83e8c", 6, &[]),
    };
    let others = [
        pen("CUT", "black: cut", "#000000", 7, &[]),
        pen("WARP", "yellow: direction of the warp", "#b8860b", 2, &[]),
        pen("INFO", "", "#555555", 9, &[]),
    ];
    KINDS.map(of).into_iter().chain(others).collect()
}

/// The plan as a drawing: pieces below each other, the legend and a known length under them. Cut lines are half of `kerf_m`, the width
/// that the cutter removes, outside the edges.
pub(crate) fn pattern_sheet(title: &str, plan: &CuttingPlan, notes: &[String], kerf_m: f64) -> PatternSheet {
    let mut sheet = PatternSheet { title: title.into(), layers: pens(), ..PatternSheet::default() };
    let mut y = BORDER;
    foot(&mut sheet, plan, notes, &mut y);
    for piece in plan.pieces.iter().rev() {
        placed(&mut sheet, piece, 0.5 * MM * kerf_m, &mut y);
    }
    sheet.word([BORDER, y], 1.5 * TEXT[0], title);
    y += 3.0 * TEXT[0];
    let right = sheet.lines.iter().flat_map(|l| &l.points).map(|p| p[0]).fold(0.0, f64::max);
    let words = sheet.labels.iter().map(|l| l.at[0] + 0.8 * l.height * l.text.chars().count() as f64);
    sheet.size = [words.fold(right, f64::max).ceil() + BORDER, y.ceil() + BORDER];
    sheet
}

/// Notes, the scale bar and the legend, from the bottom up.
fn foot(sheet: &mut PatternSheet, plan: &CuttingPlan, notes: &[String], y: &mut f64) {
    for text in notes.iter().rev() {
        sheet.word([BORDER, *y], TEXT[1], text);
        *y += ROW;
    }
    *y += ROW;
    let bar = [[0.0, 2.0], [0.0, 0.0], [SCALE_BAR, 0.0], [SCALE_BAR, 2.0]].map(|[dx, dy]| [BORDER + dx, *y + dy]);
    sheet.line(INFO, &bar, false);
    let text = format!("{SCALE_BAR} mm: measure this on the print");
    sheet.word([BORDER + SCALE_BAR + 5.0, *y], TEXT[1], text);
    *y += 1.5 * ROW;
    let is_used =
        |layer: usize| layer >= CUT || plan.pieces.iter().flat_map(|p| &p.marks).any(|m| order(m.kind) == layer);
    for layer in (0..INFO).rev().filter(|layer| is_used(*layer)) {
        let meaning = format!("{}, {}", sheet.layers[layer].name, sheet.layers[layer].meaning);
        sheet.word([BORDER, *y], TEXT[1], meaning);
        *y += ROW;
    }
    *y += GAP;
}

/// A piece with its name above, the base of the robot on the left.
fn placed(sheet: &mut PatternSheet, piece: &PatternPiece, beyond: f64, y: &mut f64) {
    let [x0, y0] = [BORDER - MM * piece.x_m[0], *y - MM * piece.y_m[0]];
    let moved = |x_m: [f64; 2], y_m: [f64; 2]| (x_m.map(|v| x0 + MM * v), y_m.map(|v| y0 + MM * v));
    for mark in &piece.marks {
        let (x, y) = moved(mark.x_m, mark.y_m);
        lines(sheet, order(mark.kind), x, y);
    }
    let (x, across) = moved(piece.x_m, piece.y_m);
    let wider = |[a, b]: [f64; 2]| [a - beyond, b + beyond];
    sheet.line(CUT, &rectangle(wider(x), wider(across)), true);
    arrow(sheet, piece.warp_rad, [x[1] - 0.7 * ARROW - 4.0, across[0] + 0.28 * (across[1] - across[0])], ARROW);
    let copies = if piece.copies > 1 { format!("{} × ", piece.copies) } else { String::new() };
    let size = [x[1] - x[0], across[1] - across[0]].map(|v| format!("{:.1}", v));
    let text = format!("{copies}{}, {}, {} × {} mm, base on the left", piece.name, piece.fabric, size[0], size[1]);
    sheet.word([BORDER, across[1] + 3.0], TEXT[0], text);
    *y = across[1] + GAP;
}

fn order(kind: MarkKind) -> usize {
    KINDS.iter().position(|known| *known == kind).unwrap_or(0)
}

fn rectangle(x: [f64; 2], y: [f64; 2]) -> [[f64; 2]; 4] {
    [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
}

fn lines(sheet: &mut PatternSheet, layer: usize, x: [f64; 2], y: [f64; 2]) {
    match (x[0] == x[1], y[0] == y[1]) {
        (true, true) => {
            sheet.line(layer, &[[x[0] - CROSS, y[0]], [x[0] + CROSS, y[0]]], false);
            sheet.line(layer, &[[x[0], y[0] - CROSS], [x[0], y[0] + CROSS]], false);
        }
        (false, false) => sheet.line(layer, &rectangle(x, y), true),
        _ => sheet.line(layer, &[[x[0], y[0]], [x[1], y[1]]], false),
    }
}

fn arrow(sheet: &mut PatternSheet, angle: f64, middle: [f64; 2], length: f64) {
    let at = |along: f64, aside: f64| {
        let (sin, cos) = angle.sin_cos();
        [middle[0] + along * cos - aside * sin, middle[1] + along * sin + aside * cos]
    };
    let half = 0.5 * length;
    for end in [-1.0, 1.0] {
        let tip = at(end * half, 0.0);
        sheet.line(WARP, &[at(0.0, 0.0), tip, at(end * (half - 3.0), 1.5)], false);
        sheet.line(WARP, &[tip, at(end * (half - 3.0), -1.5)], false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use models::Scenario;
    use models::cutting::Making;
    use report::sheet::PenLine;

    #[test]
    fn the_scale_bar_and_the_pieces_are_as_long_as_they_say_and_all_is_on_the_sheet() {
        for name in ["spam", "cpam", "epam", "fpam"] {
            let scenario = Scenario::parse(models::shipped(name).unwrap()).unwrap();
            let plan = CuttingPlan::new(&scenario, &Making { weld_m: 0.003, allowance_m: 0.01 }).unwrap();
            let sheet = pattern_sheet(name, &plan, &plan.notes, 0.0002);
            let bar = sheet.lines.iter().find(|l| l.layer == INFO).unwrap();
            assert!((bar.points[2][0] - bar.points[1][0] - 100.0).abs() < 1e-9);
            let cut: Vec<&PenLine> = sheet.lines.iter().filter(|l| l.layer == CUT).collect();
            assert_eq!(cut.len(), plan.pieces.len());
            for (line, piece) in cut.iter().zip(plan.pieces.iter().rev()) {
                let found = [line.points[2][0] - line.points[0][0], line.points[2][1] - line.points[0][1]];
                let expected = [piece.x_m, piece.y_m].map(|[a, b]| MM * (b - a) + 0.2);
                assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-9), "{name} {found:?} {expected:?}");
            }
            let inside = |p: &[f64; 2]| (0..2).all(|i| p[i] >= 0.0 && p[i] <= sheet.size[i]);
            assert!(sheet.lines.iter().flat_map(|l| &l.points).all(inside), "{name}");
        }
    }
}
