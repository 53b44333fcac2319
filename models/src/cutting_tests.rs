//! Pieces of the shipped robots against their sizes.

use super::*;

const MAKING: Making = Making { weld_m: 0.003, allowance_m: 0.01 };

fn plan(text: &str) -> CuttingPlan {
    CuttingPlan::new(&Scenario::parse(text).unwrap(), &MAKING).unwrap()
}

fn shipped(name: &str) -> CuttingPlan {
    plan(crate::shipped(name).unwrap())
}

fn size_mm(piece: &PatternPiece) -> [f64; 2] {
    [piece.x_m, piece.y_m].map(|[from, to]| ((to - from) * 1e6).round() * 1e-3)
}

fn count(piece: &PatternPiece, kind: MarkKind) -> usize {
    piece.marks.iter().filter(|mark| mark.kind == kind).count()
}

#[test]
fn the_body_is_its_circumference_and_one_overlap_wide() {
    for name in ["spam", "cpam", "epam", "fpam"] {
        let plan = shipped(name);
        let scenario = Scenario::parse(crate::shipped(name).unwrap()).unwrap();
        let body = size_mm(&plan.pieces[0]);
        let (length, round) = (1e3 * scenario.length_m, 2e3 * PI * scenario.radius_m);
        assert!((body[0] - length - 20.0).abs() < 2e-3 && (body[1] - round - 10.0).abs() < 2e-3, "{name} {body:?}");
        let lap: Vec<_> = plan.pieces[0].marks.iter().filter(|m| m.kind == MarkKind::Lap).collect();
        // Rolled up, the two laps lie over each other.
        assert!((lap[0].y_m[0] + 2.0 * PI * scenario.radius_m - lap[1].y_m[0]).abs() < 1e-12, "{name}");
    }
}

#[test]
fn every_robot_has_the_pieces_that_it_is_sewn_of() {
    let names = |name| shipped(name).pieces.iter().map(|p| format!("{} {}", p.copies, p.name)).collect::<Vec<_>>();
    assert_eq!(names("epam"), ["2 body tube, inner and outer"]);
    assert_eq!(names("cpam"), ["1 body tube", "1 sheet of the pouches"]);
    assert_eq!(names("spam"), ["1 body tube", "1 upper sheet", "1 lower sheet"]);
    assert_eq!(names("fpam"), ["1 body tube", "1 sheet of the muscle"]);
    let epam = shipped("epam");
    assert_eq!(count(&epam.pieces[0], MarkKind::Weld), 7 + 2, "six pouches");
    assert_eq!(count(&epam.pieces[0], MarkKind::Marker), 2 * 6);
}

#[test]
fn folding_the_sheet_along_its_marks_gives_the_pattern_back() {
    let scenario = Scenario::parse(crate::shipped("cpam").unwrap()).unwrap();
    let pattern = (scenario.actuator.kind.pattern)(&scenario.actuator.shape);
    let sheet = &shipped("cpam").pieces[1];
    let half = 0.5 * pattern.sheet_width_m();
    let mut places: Vec<f64> = sheet.marks.iter().filter(|m| m.y_m[0] == m.y_m[1]).map(|m| m.y_m[0]).collect();
    assert_eq!(places.len(), 4, "two gussets");
    places.push(half);
    let (mut flat, mut folded, mut way) = (-half, -0.5 * pattern.width_m, 1.0);
    for (place, panel) in places.iter().zip(&pattern.panels) {
        assert!((folded - panel.from_m).abs() < 1e-12, "{}", panel.name);
        folded += way * (place - flat);
        (flat, way) = (*place, -way);
        assert!((folded - panel.to_m).abs() < 1e-12, "{}", panel.name);
    }
    let kinds: Vec<_> = sheet.marks.iter().filter(|m| m.y_m[0] == m.y_m[1]).map(|m| m.kind).collect();
    use MarkKind::{Mountain, Valley};
    assert_eq!(kinds, [Valley, Mountain, Mountain, Valley], "mirrored, and the gussets lie inside");
}

#[test]
fn the_muscle_is_one_bias_cut_sheet_round_a_flat_tube() {
    let muscle = &shipped("fpam").pieces[1];
    let scenario = Scenario::parse(crate::shipped("fpam").unwrap()).unwrap();
    let width = 1e3 * scenario.actuator.shape.width_m;
    assert!((size_mm(muscle)[1] - 2.0 * width - 10.0).abs() < 2e-3);
    assert!((muscle.warp_rad.to_degrees() - 45.0).abs() < 1e-9);
    assert_eq!((count(muscle, MarkKind::Weld), count(muscle, MarkKind::Mountain)), (2, 2));
    let glued: f64 = muscle.marks.iter().filter(|m| m.kind == MarkKind::Glue).map(|m| m.y_m[1] - m.y_m[0]).sum();
    assert!((1e3 * glued - width).abs() < 1e-9, "one face");
}

#[test]
fn zones_cut_the_strip_and_half_units_are_told() {
    let text = crate::shipped("epam-textbook").unwrap();
    let gap = format!("{text}\n[[zone]]\nfrom_mm = 120\nto_mm = 210\npassive = true\n");
    let plan = plan(&gap);
    assert_eq!(count(&plan.pieces[0], MarkKind::Weld), (3 + 2) + (3 + 2), "two stretches of two whole units");
    assert!(
        plan.notes[0].contains("From 210 to 360 mm 2 whole units fit; the last 30 mm stay without"),
        "{:?}",
        plan.notes
    );
}

#[test]
fn what_cannot_be_cut_is_refused() {
    let beam = "name = \"b\"\n[body]\nradius_mm = 40\nlength_mm = 300\npressure_kpa = 2\n";
    let scenario = Scenario::parse(beam).unwrap();
    assert!(CuttingPlan::new(&scenario, &MAKING).unwrap_err().contains("[actuator]"));
    let epam = Scenario::parse(crate::shipped("epam").unwrap()).unwrap();
    let wide = Making { weld_m: 0.07, ..MAKING };
    assert!(CuttingPlan::new(&epam, &wide).unwrap_err().contains("overlap"));
}
