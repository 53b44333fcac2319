//! Chord arm: a taut weld line is a chord of the wall, not its arc, so the actuator sits nearer to the far side.
//!
//! R', α, A and ȳ are of an arc 2πR − w closed by a chord w (`section.rs`); its hinge p_b A ȳ replaces p_b πR³. D falls from 80 to 69.3 mm
//! for R = 40, w = 60; finite elements of the shipped robots have 69 to 70 mm (ePAM) and 68 to 69 mm (cPAM). The pull of the actuator along
//! the body leaves its line no reason to stay on the arc: the wall's hoop tension at both of its ends, p_b R', pulls it straight, and the
//! line carries it.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "chord_arm",
    formula: "D = D₀ − 2R + R' (1 + cosα), w/(2πR − w) = sinα/(π − α), w = share × width; hinge p_b A ȳ",
    sentence: "The weld lines are pulled straight across the body, so the actuator sits nearer to the far side than a diameter.",
    differs: "More bend per stroke and a weaker pull than a round body gives.",
    remedy: "Measure the distance from the far wall to a weld at full pressure.",
    validity: "weld lines across the wall that stay taut",
    reference: "derived here",
    parameters: &[Parameter { symbol: "w/W", meaning: "share of the pouch's width that is pulled straight", ..SHARE }],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in assembly.active_sites(Family::Pouch) {
            let width_m = values[0] * site.strip_m;
            let Some(drawn) = CutSection::drawn_in(site.radius_m, width_m, width_m) else { continue };
            site.linkage.arm_m += drawn.chord_m - 2.0 * site.radius_m;
            (site.area_m2, site.first_m3) = drawn.about_axis(site.radius_m);
            site.body_pressure.scale(drawn.moment_share(site.radius_m));
        }
    },
    ..BALANCE
};
