//! Cutting plans: the flat pieces of fabric that a robot is made of, and all that is drawn on them.
//!
//! x runs along the robot from its base. y runs across: on the body round its circumference from the actuator's middle, on a
//! sheet of the actuator across its unfolded width. All pieces are seen from outside the finished robot.

use crate::actuators::pattern::{ChamberBottom, Film, Panel, Pattern};
use crate::scenario::{Scenario, Span};
use serde::Serialize;
use spelling::si;
use std::f64::consts::PI;

/// What a mark on a piece means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MarkKind {
    /// Welded to the piece under it.
    Weld,
    /// Stuck to the piece under it with tape.
    Tape,
    /// Stuck to the piece under it with glue.
    Glue,
    /// Edges of one piece that overlap and are welded to a tube.
    Lap,
    /// Folded so that the outer faces meet.
    Valley,
    /// Folded so that the inner faces meet.
    Mountain,
    /// Where another piece comes to lie.
    Place,
    /// Place at which a marker is stuck to the fabric.
    Marker,
}

/// A mark: an area, a line if one side has no length, a point if none has.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PatternMark {
    /// Meaning of the mark on the piece.
    pub kind: MarkKind,
    /// From and to along the robot \[m\]; equal for a line or a point.
    #[serde(rename = "x_mm", serialize_with = "si::mm")]
    pub x_m: [f64; 2],
    /// From and to across the robot \[m\].
    #[serde(rename = "y_mm", serialize_with = "si::mm")]
    pub y_m: [f64; 2],
}

/// Rectangle of fabric with all that is cut, drawn and welded on it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PatternPiece {
    /// Part of the robot that the piece becomes.
    pub name: String,
    /// Number of pieces of this shape to cut.
    pub copies: usize,
    /// Fabric of the piece, a name in [`crate::fabrics::MATERIALS`].
    pub fabric: &'static str,
    /// Angle of the warp to the robot's axis \[rad\], counter-clockwise.
    #[serde(rename = "warp_deg", serialize_with = "si::deg")]
    pub warp_rad: f64,
    /// Cut edges along the robot \[m\], from its base.
    #[serde(rename = "x_mm", serialize_with = "si::mm")]
    pub x_m: [f64; 2],
    /// Cut edges across the robot \[m\], from and to.
    #[serde(rename = "y_mm", serialize_with = "si::mm")]
    pub y_m: [f64; 2],
    /// All that is drawn on it.
    pub marks: Vec<PatternMark>,
}

/// Cutting plan of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct CuttingPlan {
    /// Pieces of the body, then of every stretch of the actuator.
    pub pieces: Vec<PatternPiece>,
    /// What the plan leaves to its reader.
    pub notes: Vec<String>,
}

/// Widths that the robot's maker chooses \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Making {
    /// Width of the welds; places in a scenario are their middles.
    pub weld_m: f64,
    /// Fabric beyond welds and ends, and the overlap where a sheet becomes a tube.
    pub allowance_m: f64,
}

/// A stretch that holds less than this of one more unit holds it: rounding \[units\].
const ROUNDING: f64 = 1e-6;

impl CuttingPlan {
    /// The pieces of a robot with all its zones.
    ///
    /// # Errors
    /// The fault with its number: no actuator, or a stretch that cannot be sewn.
    pub fn new(scenario: &Scenario, making: &Making) -> Result<CuttingPlan, String> {
        if !scenario.actuator.exists() {
            return Err("a beam without [actuator] has no sewing pattern; add one".into());
        }
        if scenario.is_spatial() {
            return Err(
                "sewing patterns are built for one strip along the body; write one [actuator] without azimuth_deg and turns"
                    .into(),
            );
        }
        let spans = scenario.spans();
        let mut notes = Vec::new();
        let mut strips = Vec::new();
        for span in joined(&spans, |a, b| a.actuator.is_some() && b.actuator.is_some() && a.shape == b.shape) {
            strips.extend(CutStrip::new(&span, scenario.length_m, making, &mut notes)?);
        }
        let alike = |a: &Span, b: &Span| a.radius_m == b.radius_m;
        let bodies = joined(&spans, alike);
        let mut pieces: Vec<PatternPiece> =
            bodies.iter().map(|span| body(scenario, span, bodies.len(), &strips, making)).collect();
        pieces.extend(strips.iter().flat_map(|strip| strip.pieces(strips.len())));
        notes.push("Fittings, gas inlets, passages between pouches and the cap of the tip are not drawn.".into());
        Ok(CuttingPlan { pieces, notes })
    }
}

fn joined(spans: &[Span], alike: impl Fn(&Span, &Span) -> bool) -> Vec<Span> {
    let mut all: Vec<Span> = Vec::new();
    for span in spans {
        match all.last_mut() {
            Some(last) if alike(last, span) => last.length_m += span.length_m,
            _ => all.push(*span),
        }
    }
    all
}

fn centred(middle_m: f64, width_m: f64) -> [f64; 2] {
    [middle_m - 0.5 * width_m, middle_m + 0.5 * width_m]
}

/// The wall of a stretch of equal radius, unrolled; its seam is opposite the actuator.
fn body(scenario: &Scenario, span: &Span, of: usize, strips: &[CutStrip], making: &Making) -> PatternPiece {
    let (start_m, end_m) = (span.start_m, span.start_m + span.length_m);
    let here = |x_m: f64| start_m - making.weld_m <= x_m && x_m <= end_m + making.weld_m;
    let pattern = (scenario.actuator.kind.pattern)(&span.shape);
    let x_m = [start_m - making.allowance_m, end_m + making.allowance_m];
    let y_m = centred(0.0, 2.0 * PI * span.radius_m + making.allowance_m);
    let lap =
        |edge_m: f64, inwards: f64| PatternMark { kind: MarkKind::Lap, x_m, y_m: ordered([edge_m, edge_m - inwards]) };
    let mut marks = vec![lap(y_m[0], -making.allowance_m), lap(y_m[1], making.allowance_m)];
    let strips = strips.iter().filter(|strip| here(strip.start_m) && here(strip.end_m()));
    marks.extend(strips.flat_map(CutStrip::on_body));
    let markers = scenario.markers_m.iter().filter(|x| here(**x));
    let sides = [-0.5, 0.5].map(|side| side * PI * span.radius_m);
    marks
        .extend(markers.flat_map(|x| sides.map(|y| PatternMark { kind: MarkKind::Marker, x_m: [*x; 2], y_m: [y; 2] })));
    let number = if of > 1 { format!(" from {:.0} mm", start_m * 1e3) } else { String::new() };
    PatternPiece {
        name: format!("body tube{number}{}", if pattern.body_sheets > 1 { ", inner and outer" } else { "" }),
        copies: pattern.body_sheets,
        fabric: pattern.body_fabric,
        warp_rad: 0.0,
        x_m,
        y_m,
        marks,
    }
}

fn ordered(pair: [f64; 2]) -> [f64; 2] {
    [pair[0].min(pair[1]), pair[0].max(pair[1])]
}

struct CutStrip {
    pattern: Pattern,
    start_m: f64,
    units: usize,
    body_m: f64,
    making: Making,
}

impl CutStrip {
    fn new(span: &Span, body_m: f64, making: &Making, notes: &mut Vec<String>) -> Result<Option<CutStrip>, String> {
        let Some(actuator) = span.actuator else { return Ok(None) };
        let pattern = (actuator.pattern)(&span.shape);
        pattern.check(span.radius_m, making.weld_m)?;
        let units = (span.length_m / pattern.pitch_m + ROUNDING).floor();
        let rest_mm = 1e3 * (span.length_m - units * pattern.pitch_m);
        if rest_mm > 1e3 * ROUNDING {
            let (from, to) = (1e3 * span.start_m, 1e3 * (span.start_m + span.length_m));
            notes.push(format!(
                "From {from:.0} to {to:.0} mm {units} whole units fit; the last {rest_mm:.0} mm stay without."
            ));
        }
        let strip = CutStrip { pattern, start_m: span.start_m, units: units as usize, body_m, making: *making };
        Ok((strip.units > 0).then_some(strip))
    }

    fn end_m(&self) -> f64 {
        self.start_m + self.units as f64 * self.pattern.pitch_m
    }

    /// Cut edges along the robot, not beyond the body's.
    fn x_m(&self) -> [f64; 2] {
        let Making { weld_m, allowance_m } = self.making;
        let beyond = 0.5 * weld_m + allowance_m;
        [(self.start_m - beyond).max(-allowance_m), (self.end_m() + beyond).min(self.body_m + allowance_m)]
    }

    /// Cross welds from edge to edge, and those along the edges.
    fn welds(&self, width_m: f64, sides: bool) -> Vec<PatternMark> {
        let weld_m = self.making.weld_m;
        let side_m = if sides { weld_m } else { 0.0 };
        let weld = |x_m, y_m| PatternMark { kind: MarkKind::Weld, x_m, y_m };
        let across = centred(0.0, width_m + side_m);
        let seams = (0..=self.units).map(|i| self.start_m + i as f64 * self.pattern.pitch_m);
        let mut welds: Vec<PatternMark> = seams.map(|x| weld(centred(x, weld_m), across)).collect();
        let edges = [-0.5, 0.5].map(|edge| edge * width_m);
        let along = [self.start_m - 0.5 * weld_m, self.end_m() + 0.5 * weld_m];
        welds.extend(edges.iter().filter(|_| sides).map(|edge| weld(along, centred(*edge, weld_m))));
        welds
    }

    fn on_body(&self) -> Vec<PatternMark> {
        let Pattern { width_m, body_sheets, joint, side_welds, .. } = self.pattern;
        let edge_m = if side_welds { self.making.weld_m + 2.0 * self.making.allowance_m } else { 0.0 };
        let place = PatternMark { kind: MarkKind::Place, x_m: self.x_m(), y_m: centred(0.0, width_m + edge_m) };
        match joint {
            ChamberBottom::Wall if body_sheets > 1 => self.welds(width_m, side_welds),
            ChamberBottom::Wall => std::iter::once(place).chain(self.welds(width_m, side_welds)).collect(),
            ChamberBottom::Bonded { film, .. } => vec![place, self.bonded(film, centred(0.0, width_m))],
            ChamberBottom::Seams => std::iter::once(place).chain(self.welds(width_m, false)).collect(),
        }
    }

    fn bonded(&self, film: Film, y_m: [f64; 2]) -> PatternMark {
        let kind = match film {
            Film::Tape => MarkKind::Tape,
            Film::Glue => MarkKind::Glue,
        };
        PatternMark { kind, x_m: [self.start_m, self.end_m()], y_m }
    }

    /// Its own pieces: none where it is part of the body.
    fn pieces(&self, of: usize) -> Vec<PatternPiece> {
        let number = if of > 1 { format!(" from {:.0} mm", self.start_m * 1e3) } else { String::new() };
        let piece = |name: &str, warp_rad, width_m: f64, marks| PatternPiece {
            name: format!("{name}{number}"),
            copies: 1,
            fabric: self.pattern.fabric,
            warp_rad,
            x_m: self.x_m(),
            y_m: centred(0.0, width_m),
            marks,
        };
        let Pattern { width_m, body_sheets, joint, side_welds, .. } = self.pattern;
        let sheet_m = self.pattern.sheet_width_m();
        let warp_rad = self.pattern.panels.last().map_or(0.0, |panel| panel.warp_rad);
        let beyond = if side_welds { self.making.weld_m + 2.0 * self.making.allowance_m } else { 0.0 };
        let folded = || self.folds().into_iter().chain(self.welds(sheet_m, side_welds)).collect::<Vec<_>>();
        match joint {
            ChamberBottom::Wall if body_sheets > 1 => Vec::new(),
            ChamberBottom::Wall => vec![piece("sheet of the pouches", warp_rad, sheet_m + beyond, folded())],
            // Two faces of one bias-cut sheet, folded round.
            ChamberBottom::Bonded { film, warp_rad: under } if !side_welds && under == -warp_rad => {
                let round_m = sheet_m + width_m;
                let cut_m = round_m + self.making.allowance_m;
                let stuck = [[-round_m, -sheet_m], [sheet_m, round_m]].map(|y| self.bonded(film, y.map(|v| 0.5 * v)));
                let edges = [-0.5, 0.5].map(|side| (side * cut_m, side.signum() * self.making.allowance_m));
                let laps = edges.map(|(edge, inwards)| PatternMark {
                    kind: MarkKind::Lap,
                    x_m: self.x_m(),
                    y_m: ordered([edge, edge - inwards]),
                });
                let folds = [-0.5, 0.5].map(|side| self.fold(side * sheet_m, MarkKind::Mountain));
                let marks = stuck.into_iter().chain(laps).chain(folds).chain(self.welds(round_m, false));
                vec![piece("sheet of the muscle", warp_rad, cut_m, marks.collect())]
            }
            ChamberBottom::Bonded { film, warp_rad: under } => {
                let stuck = std::iter::once(self.bonded(film, centred(0.0, width_m)));
                let below = stuck.chain(self.welds(width_m, side_welds)).collect();
                vec![
                    piece("upper sheet", warp_rad, sheet_m + beyond, folded()),
                    piece("lower sheet", under, width_m + beyond, below),
                ]
            }
            ChamberBottom::Seams => {
                vec![piece("sheet of the bag", warp_rad, sheet_m + self.making.allowance_m, folded())]
            }
        }
    }

    fn fold(&self, y_m: f64, kind: MarkKind) -> PatternMark {
        PatternMark { kind, x_m: self.x_m(), y_m: [y_m; 2] }
    }

    /// Folds between the panels. The face of a panel that runs back is upside down.
    fn folds(&self) -> Vec<PatternMark> {
        let panels = &self.pattern.panels;
        let mut y_m = -0.5 * self.pattern.sheet_width_m();
        let mut folds = Vec::new();
        for (a, b) in panels.iter().zip(panels.iter().skip(1)) {
            y_m += (a.to_m - a.from_m).abs();
            folds.push(self.fold(y_m, turn(a, b)));
        }
        folds
    }
}

/// How the sheet turns from one panel to the next, seen from the outer face of a panel that runs towards +y.
fn turn(a: &Panel, b: &Panel) -> MarkKind {
    let (over, upright) = (b.level > a.level, a.to_m > a.from_m);
    if over == upright { MarkKind::Valley } else { MarkKind::Mountain }
}

#[cfg(test)]
#[path = "cutting_tests.rs"]
mod tests;
