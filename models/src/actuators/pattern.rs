//! Sewing patterns: how an actuator is cut, folded, welded and joined to the body, as plain data.
//!
//! The sheet of one unit covers a strip of the body and is described by its cross-section: panels from the edge at −W/2
//! to the edge at +W/2, each at a level above the wall (level 0). Where one panel ends the next begins: a fold. At both
//! ends of a unit all panels are welded flat onto the wall, so as many layers meet there as lie over each other; its edges
//! may be welded onto the wall too (`side_welds`).
//!
//! ```text
//!   level 3        ┌──────────── top ────────────┐
//!         2        └─ gusset 2 ─┐   ┌─ gusset 2 ─┘         fold depth f
//!         1        ┌─ gusset 1 ─┘   └─ gusset 1 ─┐
//!         0  ══════╧════════════ wall ═══════════╧══════
//!                −W/2                           +W/2       arc along the body's circumference
//! ```
//!
//! To add a pattern: state it in the file of its actuator. The mesher reads nothing else.

use super::shape::ActuatorShape;

/// How an actuator is made. Lengths lie flat on the body; s is the arc from the middle of the strip.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Material of the actuator's sheet, in [`crate::fabrics::MATERIALS`].
    pub fabric: &'static str,
    /// Material of the body's wall, in [`crate::fabrics::MATERIALS`].
    pub body_fabric: &'static str,
    /// Loose sheets that make the body's wall at the sides of the pouches.
    pub body_sheets: usize,
    /// Distance from seam to seam along the body \[m\].
    pub pitch_m: f64,
    /// Width W of the strip along the circumference \[m\].
    pub width_m: f64,
    /// How the bottom of the chamber is joined to the body.
    pub joint: ChamberBottom,
    /// Whether the sheet is welded along its edges at ±W/2 too, from the first seam to the last.
    pub side_welds: bool,
    /// The sheet, in the order of its cross-section.
    pub panels: Vec<Panel>,
}

/// Bottom of the actuator's chamber, and how it is joined to the body's wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChamberBottom {
    /// The body's wall is the bottom; the sheet is welded onto it along its edges.
    Wall,
    /// A bottom sheet of the actuator's own is stuck to the wall over its whole face: plies that bend as one.
    Bonded {
        /// Adhesive layer between the bottom sheet and the wall.
        film: Film,
        /// Angle of the bottom sheet's warp to the body axis \[rad\], counter-clockwise seen from outside.
        warp_rad: f64,
    },
    /// A bottom sheet of the actuator's own (one of the panels) touches the wall and is joined to it at the seams only.
    Seams,
}

/// Adhesive layer that bonds two plies of fabric over their whole face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Film {
    /// Adhesive transfer tape, for the material law of plies on tape.
    Tape,
    /// Silicone glue, for the material law of glued plies.
    Glue,
}

/// One flat piece of the sheet between two edges or folds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// Name of the piece, unique in the pattern.
    pub name: &'static str,
    /// Height above the wall, counted in layers from 1.
    pub level: usize,
    /// Arc from the middle of the strip at which the piece begins \[m\].
    pub from_m: f64,
    /// Where it ends \[m\]; below `from_m` where the sheet runs back.
    pub to_m: f64,
    /// Angle of its warp to the body axis \[rad\], counter-clockwise seen from outside.
    pub warp_rad: f64,
}

/// Places closer than this are one \[m\].
const SAME_M: f64 = 1e-9;

impl Panel {
    /// Lower and higher end of the piece along the arc \[m\], whichever way the sheet runs.
    pub fn range_m(&self) -> [f64; 2] {
        [self.from_m.min(self.to_m), self.from_m.max(self.to_m)]
    }
}

impl Pattern {
    /// Unfolded width of the sheet above the wall \[m\].
    pub fn sheet_width_m(&self) -> f64 {
        self.panels.iter().map(|p| (p.to_m - p.from_m).abs()).sum()
    }

    /// Largest number of layers over each other at a seam, the wall's own not counted.
    pub fn layers_at(&self, s_m: f64) -> usize {
        let over = |p: &&Panel| p.range_m()[0] < s_m && s_m < p.range_m()[1];
        self.panels.iter().filter(over).count() + usize::from(matches!(self.joint, ChamberBottom::Bonded { .. }))
    }

    /// True with a bottom sheet that is taped to the wall.
    pub fn is_taped(&self) -> bool {
        matches!(self.joint, ChamberBottom::Bonded { film: Film::Tape, .. })
    }

    /// A taped pouch as a separate bag that only its seams hold: the tape is a strip across every seam.
    pub fn taped_at_seams(&self) -> Pattern {
        let half_m = 0.5 * self.width_m;
        let panels = vec![panel("bottom", 1, half_m, -half_m), panel("top", 2, -half_m, half_m)];
        Pattern { joint: ChamberBottom::Seams, side_welds: false, panels, ..self.clone() }
    }

    /// True where layers of the sheet lie over each other and can touch.
    pub fn folds(&self) -> bool {
        self.joint == ChamberBottom::Seams || self.panels.iter().any(|p| p.level > 1)
    }

    /// The chamber's own pattern if the welds along its sides have a width: the pattern's edges are the middles of these welds, as its
    /// ends are the middles of the seams, and folds keep their depth.
    pub fn between_welds(&self, weld_m: f64) -> Pattern {
        let mut pattern = self.clone();
        if self.side_welds {
            let inwards = |place: f64| place - 0.5 * weld_m * place.signum();
            pattern.width_m -= weld_m;
            pattern.panels.iter_mut().for_each(|p| (p.from_m, p.to_m) = (inwards(p.from_m), inwards(p.to_m)));
        }
        pattern
    }

    /// Refuses what cannot be sewn on a body of radius `radius_m` with welds `weld_m` wide (0: a line).
    ///
    /// # Errors
    /// The fault with its number: a sheet that does not close, layers in one place, welds that overlap, a pouch wider than
    /// half of the body.
    pub fn check(&self, radius_m: f64, weld_m: f64) -> Result<(), String> {
        self.sizes(radius_m, weld_m)?;
        self.panels.iter().try_for_each(|panel| self.place(panel))?;
        self.closed()?;
        for (i, panel) in self.panels.iter().enumerate() {
            if let Some(other) =
                self.panels[..i].iter().find(|o| o.level == panel.level && overlap_m(o, panel) > SAME_M)
            {
                return Err(format!(
                    "panels `{}` and `{}` lie over each other by {} mm at level {}; make the fold shallower or the pouch wider",
                    other.name,
                    panel.name,
                    mm(overlap_m(other, panel)),
                    panel.level
                ));
            }
        }
        self.panels.windows(2).try_for_each(|pair| self.fold(&pair[0], &pair[1]))
    }

    fn sizes(&self, radius_m: f64, weld_m: f64) -> Result<(), String> {
        let half_m = std::f64::consts::PI * radius_m;
        for (name, value) in [("radius", radius_m), ("pitch", self.pitch_m), ("width", self.width_m)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(format!("the {name} is {} mm; write a positive length", mm(value)));
            }
        }
        if self.width_m > half_m {
            let (width, half) = (mm(self.width_m), mm(half_m));
            return Err(format!("a pouch of {width} mm is wider than half of the body, {half} mm; make it narrower"));
        }
        if !(weld_m >= 0.0 && weld_m < self.pitch_m) {
            let (weld, pitch) = (mm(weld_m), mm(self.pitch_m));
            return Err(format!(
                "welds of {weld} mm every {pitch} mm overlap; write a width from 0 to below {pitch} mm"
            ));
        }
        if self.body_sheets == 0 || self.panels.is_empty() {
            return Err("a pattern needs a wall and at least one panel".into());
        }
        if !self.side_welds {
            return Ok(());
        }
        if weld_m >= self.width_m {
            let (weld, width) = (mm(weld_m), mm(self.width_m));
            return Err(format!("side welds of {weld} mm fill a pouch of {width} mm; write a width below {width} mm"));
        }
        match self.joint {
            ChamberBottom::Seams => {
                Err("a bag joined at its seams only has no side welds on the wall; set side_welds to false".into())
            }
            _ => Ok(()),
        }
    }

    /// The sheet runs without a gap from edge to edge, or round.
    fn closed(&self) -> Result<(), String> {
        for (a, b) in self.panels.iter().zip(self.panels.iter().skip(1)) {
            if (a.to_m - b.from_m).abs() > SAME_M {
                let (end, begin) = (mm(a.to_m), mm(b.from_m));
                return Err(format!(
                    "the sheet does not close: `{}` ends at {end} mm and `{}` begins at {begin} mm",
                    a.name, b.name
                ));
            }
        }
        let (first, last) = (self.panels[0], self.panels[self.panels.len() - 1]);
        let (begin, end) = match self.joint {
            ChamberBottom::Seams => (last.to_m, last.to_m),
            _ => (-0.5 * self.width_m, 0.5 * self.width_m),
        };
        for (panel, found, end) in [(first, first.from_m, begin), (last, last.to_m, end)] {
            if (found - end).abs() > SAME_M {
                let (found, end) = (mm(found), mm(end));
                return Err(format!(
                    "the sheet does not close: the edge of `{}` is at {found} mm and must be joined at {end} mm",
                    panel.name
                ));
            }
        }
        Ok(())
    }

    /// A panel has a length and is on the strip.
    fn place(&self, panel: &Panel) -> Result<(), String> {
        let [low, high] = panel.range_m();
        let half = 0.5 * self.width_m;
        let on_strip = low >= -half - SAME_M && high <= half + SAME_M && high - low > SAME_M;
        if panel.level == 0 || !on_strip || !(panel.from_m + panel.to_m).is_finite() {
            return Err(format!(
                "panel `{}` from {} to {} mm at level {} is not on the strip from {} to {} mm above the wall",
                panel.name,
                mm(panel.from_m),
                mm(panel.to_m),
                panel.level,
                mm(-half),
                mm(half)
            ));
        }
        Ok(())
    }

    /// No other layer blocks the fold from `a` to `b`.
    fn fold(&self, a: &Panel, b: &Panel) -> Result<(), String> {
        let between = a.level.min(b.level) + 1..a.level.max(b.level);
        let over = |p: &&Panel| p.range_m()[0] + SAME_M < a.to_m && a.to_m < p.range_m()[1] - SAME_M;
        match self.panels.iter().filter(|p| between.contains(&p.level)).find(over) {
            None => Ok(()),
            Some(p) => Err(format!(
                "the fold from `{}` to `{}` at {} mm passes through `{}` at level {}",
                a.name,
                b.name,
                mm(a.to_m),
                p.name,
                p.level
            )),
        }
    }
}

pub(super) fn flat(shape: &ActuatorShape, joint: ChamberBottom) -> Pattern {
    let half = 0.5 * shape.width_m;
    Pattern {
        fabric: "tpu-nylon",
        body_fabric: "tpu-nylon",
        body_sheets: 1,
        pitch_m: shape.length_m,
        width_m: shape.width_m,
        joint,
        side_welds: true,
        panels: vec![panel("top", 1, -half, half)],
    }
}

pub(super) fn panel(name: &'static str, level: usize, from_m: f64, to_m: f64) -> Panel {
    Panel { name, level, from_m, to_m, warp_rad: 0.0 }
}

fn overlap_m(a: &Panel, b: &Panel) -> f64 {
    a.range_m()[1].min(b.range_m()[1]) - a.range_m()[0].max(b.range_m()[0])
}

fn mm(length_m: f64) -> String {
    // Adding 0 turns −0 into 0.
    format!("{}", (length_m * 1e6).round() / 1e3 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::super::BIAS;
    use super::*;
    use crate::Scenario;
    use crate::scenario::SHIPPED;

    fn shipped(name: &str) -> (Pattern, f64) {
        let scenario = Scenario::parse(crate::shipped(name).unwrap()).unwrap();
        ((scenario.actuator.kind.pattern)(&scenario.actuator.shape), scenario.radius_m)
    }

    fn refused(change: impl Fn(&mut Pattern), weld_m: f64) -> String {
        let (mut pattern, radius_m) = shipped("cpam");
        change(&mut pattern);
        pattern.check(radius_m, weld_m).unwrap_err()
    }

    #[test]
    fn every_shipped_pattern_can_be_sewn_from_known_fabrics() {
        for (name, _) in SHIPPED {
            let (pattern, radius_m) = shipped(name);
            for weld_m in [0.0, 0.005] {
                pattern.check(radius_m, weld_m).unwrap();
            }
            for fabric in [pattern.fabric, pattern.body_fabric] {
                assert!(crate::fabrics::material(fabric).is_some(), "{fabric}");
            }
        }
    }

    #[test]
    fn the_folded_sheet_is_the_published_2_60_times_as_wide_and_four_layers_meet_at_its_seams() {
        let (cpam, epam) = (shipped("cpam").0, shipped("epam").0);
        assert!((cpam.sheet_width_m() / epam.sheet_width_m() - 2.60).abs() < 1e-12);
        assert_eq!((cpam.layers_at(0.02) + 1, cpam.layers_at(0.0) + 1, epam.layers_at(0.0) + 1), (4, 2, 2));
    }

    #[test]
    fn faults_are_refused_with_the_number_that_is_wrong() {
        let open = refused(|p| p.panels[2].from_m = -0.02, 0.0);
        assert_eq!(open, "the sheet does not close: `gusset_2_left` ends at -30 mm and `top` begins at -20 mm");
        let edge = refused(|p| p.panels.truncate(2), 0.0);
        assert_eq!(
            edge,
            "the sheet does not close: the edge of `gusset_2_left` is at -30 mm and must be joined at 30 mm"
        );
        let wide = refused(|p| p.width_m = 0.13, 0.0);
        assert_eq!(wide, "a pouch of 130 mm is wider than half of the body, 125.664 mm; make it narrower");
        let weld = refused(|_| {}, 0.07);
        assert_eq!(weld, "welds of 70 mm every 60 mm overlap; write a width from 0 to below 60 mm");
        let through = refused(|p| p.panels.iter_mut().take(1).for_each(|p| p.level = 4), 0.0);
        assert!(
            through.contains("`gusset_1_left` to `gusset_2_left` at -6 mm passes through `top` at level 3"),
            "{through}"
        );
    }

    #[test]
    fn between_welds_the_chamber_is_narrower_and_its_folds_as_deep() {
        let (cpam, radius_m) = shipped("cpam");
        assert!(cpam.side_welds);
        let inner = cpam.between_welds(0.004);
        inner.check(radius_m, 0.004).unwrap();
        assert!((inner.width_m - 0.056).abs() < 1e-12);
        assert!((inner.sheet_width_m() - 0.152).abs() < 1e-12, "{}", inner.sheet_width_m());
        let error = cpam.between_welds(0.014).check(radius_m, 0.014).unwrap_err();
        assert!(error.contains("lie over each other by 2 mm"), "{error}");
        assert!(refused(|p| p.width_m = 0.05, 0.055).contains("side welds of 55 mm fill a pouch of 50 mm"));
        let fpam = shipped("fpam").0;
        assert_eq!(fpam.between_welds(0.004), fpam);
    }

    #[test]
    fn folds_deeper_than_half_the_pouch_are_refused() {
        let (kind, radius_m) = (crate::actuators::by_name("cpam").unwrap(), 0.04);
        let shape = ActuatorShape { length_m: 0.06, width_m: 0.06, fold_m: 0.035, volume_gain: 1.0, bias_rad: BIAS };
        let error = (kind.pattern)(&shape).check(radius_m, 0.0).unwrap_err();
        assert!(error.contains("lie over each other by 10 mm at level 2"), "{error}");
    }

    #[test]
    fn a_pouch_joined_at_its_seams_only_is_a_bag_of_its_own() {
        let (mut pattern, radius_m) = shipped("spam");
        pattern.joint = ChamberBottom::Seams;
        assert!(pattern.check(radius_m, 0.0).unwrap_err().contains("no side welds"));
        pattern.side_welds = false;
        assert!(pattern.check(radius_m, 0.0).unwrap_err().contains("does not close"));
        shipped("spam").0.taped_at_seams().check(radius_m, 0.0).unwrap();
    }
}
