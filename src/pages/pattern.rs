//! A cutting plan laid out as one drawing true to size.

use models::cutting::{CuttingPlan, MarkKind, PatternMark, PatternPiece};
use report::sheet::{PatternSheet, Pen, PenLine, SheetText};

const MM: f64 = 1e3;
/// White around everything \[mm\].
const BORDER: f64 = 10.0;
/// Between pieces \[mm\], for their names.
const GAP: f64 = 16.0;
/// Capitals of names, and of small words \[mm\].
const TEXT: [f64; 2] = [4.0, 2.8];
/// PenLine of the legend \[mm\].
const ROW: f64 = 6.0;
/// A known length to check a print by \[mm\].
const SCALE_BAR: f64 = 100.0;
/// Half of a marker's cross, and length of the arrow of the fibres \[mm\].
const CROSS: f64 = 3.0;
const ARROW: f64 = 24.0;

const CUT: usize = 0;
const WARP: usize = 1;
/// First pen of [`KINDS`].
const FIRST: usize = 2;
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

fn pen(kind: MarkKind) -> Pen {
    let layer = |name, meaning, colour, aci, dashes, tinted| Pen { name, meaning, colour, aci, dashes, tinted };
    match kind {
        MarkKind::Lap => layer("LAP", "overlap: roll up and join these edges on each other", "#7a5195", 6, &[], true),
        MarkKind::Tape => layer("TAPE", "adhesive tape", "#2e8b57", 3, &[], true),
        MarkKind::Glue => layer("GLUE", "glue", "#2e8b57", 3, &[], true),
        MarkKind::Weld => layer("WELD", "weld", "#c0392b", 1, &[], true),
        MarkKind::Place => layer("PLACE", "where another piece lies", "#777777", 8, &[1.0, 1.5], false),
        MarkKind::Valley => layer("FOLD_VALLEY", "fold, outer faces meet", "#1f5fbf", 5, &[5.0, 2.0], false),
        MarkKind::Mountain => {
            layer("FOLD_MOUNTAIN", "fold, inner faces meet", "#1f5fbf", 4, &[7.0, 1.5, 1.0, 1.5], false)
        }
        MarkKind::Marker => layer("MARKER", "marker", "#000000", 7, &[], false),
    }
}

/// The plan as a drawing: pieces below each other, the legend and a known length under them.
pub(crate) fn pattern_sheet(title: &str, plan: &CuttingPlan, told: &[String]) -> PatternSheet {
    let layer = |name, meaning| Pen { name, meaning, colour: "#000000", aci: 7, dashes: &[], tinted: false };
    let mut layers = vec![layer("CUT", "cut"), layer("WARP", "direction of the warp")];
    layers.extend(KINDS.map(pen));
    let mut sheet = PatternSheet { title: title.into(), layers, ..PatternSheet::default() };
    let used: Vec<usize> = (0..FIRST + KINDS.len()).filter(|i| is_used(plan, *i)).collect();
    let mut y = BORDER;
    foot(&mut sheet, &used, told, &mut y);
    for piece in plan.pieces.iter().rev() {
        placed(&mut sheet, piece, &mut y);
    }
    sheet.labels.push(SheetText { at: [BORDER, y], height: 1.5 * TEXT[0], text: title.into() });
    y += 3.0 * TEXT[0];
    let right = sheet.lines.iter().flat_map(|l| &l.points).map(|p| p[0]).fold(0.0, f64::max);
    let words = sheet.labels.iter().map(|l| l.at[0] + 0.8 * l.height * l.text.chars().count() as f64);
    sheet.size = [words.fold(right, f64::max).ceil() + BORDER, y.ceil() + BORDER];
    sheet
}

fn is_used(plan: &CuttingPlan, layer: usize) -> bool {
    let kind = layer.checked_sub(FIRST).map(|i| KINDS[i]);
    kind.is_none_or(|kind| plan.pieces.iter().flat_map(|p| &p.marks).any(|mark| mark.kind == kind))
}

/// Notes, the scale bar and the legend, from the bottom up.
fn foot(sheet: &mut PatternSheet, used: &[usize], told: &[String], y: &mut f64) {
    for text in told.iter().rev() {
        sheet.labels.push(SheetText { at: [BORDER, *y], height: TEXT[1], text: text.clone() });
        *y += ROW;
    }
    *y += ROW;
    let bar = [[0.0, 2.0], [0.0, 0.0], [SCALE_BAR, 0.0], [SCALE_BAR, 2.0]].map(|[dx, dy]| [BORDER + dx, *y + dy]);
    sheet.lines.push(PenLine { layer: CUT, points: bar.to_vec(), closed: false });
    let text = format!("{SCALE_BAR} mm: measure this on the print");
    sheet.labels.push(SheetText { at: [BORDER + SCALE_BAR + 5.0, *y], height: TEXT[1], text });
    *y += 1.5 * ROW;
    for layer in used.iter().rev() {
        let middle = *y + 0.5 * TEXT[1];
        let [from, to] = [BORDER, BORDER + 15.0];
        match layer.checked_sub(FIRST).map(|i| KINDS[i]) {
            None if *layer == WARP => arrow(sheet, 0.0, [0.5 * (from + to), middle], to - from),
            Some(MarkKind::Marker) => sheet.lines.extend(lines(*layer, [0.5 * (from + to); 2], [middle; 2])),
            _ if sheet.layers[*layer].tinted => sheet.lines.extend(lines(*layer, [from, to], [*y, *y + TEXT[1]])),
            _ => sheet.lines.extend(lines(*layer, [from, to], [middle; 2])),
        }
        let text = sheet.layers[*layer].meaning.to_string();
        sheet.labels.push(SheetText { at: [to + 5.0, *y], height: TEXT[1], text });
        *y += ROW;
    }
    *y += GAP;
}

/// A piece with its name above, the base of the robot on the left.
fn placed(sheet: &mut PatternSheet, piece: &PatternPiece, y: &mut f64) {
    let [x0, y0] = [BORDER - MM * piece.x_m[0], *y - MM * piece.y_m[0]];
    let moved = |x_m: [f64; 2], y_m: [f64; 2]| (x_m.map(|v| x0 + MM * v), y_m.map(|v| y0 + MM * v));
    let mut marks: Vec<&PatternMark> = piece.marks.iter().collect();
    marks.sort_by_key(|mark| order(mark.kind));
    for mark in marks {
        let (x, y) = moved(mark.x_m, mark.y_m);
        sheet.lines.extend(lines(FIRST + order(mark.kind), x, y));
    }
    let (x, across) = moved(piece.x_m, piece.y_m);
    sheet.lines.push(PenLine { layer: CUT, points: rectangle(x, across), closed: true });
    arrow(sheet, piece.warp_rad, [x[1] - 0.7 * ARROW - 4.0, across[0] + 0.28 * (across[1] - across[0])], ARROW);
    let copies = if piece.copies > 1 { format!("{} × ", piece.copies) } else { String::new() };
    let size = [x[1] - x[0], across[1] - across[0]].map(|v| format!("{:.1}", v));
    let text = format!("{copies}{}, {}, {} × {} mm, base on the left", piece.name, piece.fabric, size[0], size[1]);
    sheet.labels.push(SheetText { at: [BORDER, across[1] + 3.0], height: TEXT[0], text });
    *y = across[1] + GAP;
}

fn order(kind: MarkKind) -> usize {
    KINDS.iter().position(|known| *known == kind).unwrap_or(0)
}

fn rectangle(x: [f64; 2], y: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
}

/// An area, a line or a cross.
fn lines(layer: usize, x: [f64; 2], y: [f64; 2]) -> Vec<PenLine> {
    let open = |points| PenLine { layer, points, closed: false };
    match (x[0] == x[1], y[0] == y[1]) {
        (true, true) => vec![
            open(vec![[x[0] - CROSS, y[0]], [x[0] + CROSS, y[0]]]),
            open(vec![[x[0], y[0] - CROSS], [x[0], y[0] + CROSS]]),
        ],
        (false, false) => vec![PenLine { layer, points: rectangle(x, y), closed: true }],
        _ => vec![open(vec![[x[0], y[0]], [x[1], y[1]]])],
    }
}

fn arrow(sheet: &mut PatternSheet, angle: f64, middle: [f64; 2], length: f64) {
    let at = |along: f64, aside: f64| {
        let (sin, cos) = angle.sin_cos();
        [middle[0] + along * cos - aside * sin, middle[1] + along * sin + aside * cos]
    };
    let half = 0.5 * length;
    for end in [-1.0, 1.0] {
        let points = vec![at(0.0, 0.0), at(end * half, 0.0), at(end * (half - 3.0), 1.5)];
        sheet.lines.push(PenLine { layer: WARP, points, closed: false });
        sheet.lines.push(PenLine {
            layer: WARP,
            points: vec![at(end * half, 0.0), at(end * (half - 3.0), -1.5)],
            closed: false,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use models::Scenario;
    use models::cutting::Making;

    #[test]
    fn the_scale_bar_and_the_pieces_are_as_long_as_they_say_and_all_is_on_the_sheet() {
        for name in ["spam", "cpam", "epam", "fpam"] {
            let scenario = Scenario::parse(models::shipped(name).unwrap()).unwrap();
            let plan = CuttingPlan::new(&scenario, &Making { weld_m: 0.003, allowance_m: 0.01 }).unwrap();
            let sheet = pattern_sheet(name, &plan, &plan.notes);
            let bar = sheet.lines.iter().find(|l| l.layer == CUT && !l.closed).unwrap();
            assert!((bar.points[2][0] - bar.points[1][0] - 100.0).abs() < 1e-9);
            let cut: Vec<&PenLine> = sheet.lines.iter().filter(|l| l.layer == CUT && l.closed).collect();
            assert_eq!(cut.len(), plan.pieces.len());
            for (line, piece) in cut.iter().zip(plan.pieces.iter().rev()) {
                let found = [line.points[2][0] - line.points[0][0], line.points[2][1] - line.points[0][1]];
                let wanted = [piece.x_m, piece.y_m].map(|[a, b]| MM * (b - a));
                assert!((0..2).all(|i| (found[i] - wanted[i]).abs() < 1e-9), "{name} {found:?} {wanted:?}");
            }
            let inside = |p: &[f64; 2]| (0..2).all(|i| p[i] >= 0.0 && p[i] <= sheet.size[i]);
            assert!(sheet.lines.iter().flat_map(|l| &l.points).all(inside), "{name}");
        }
    }
}
