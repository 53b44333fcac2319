//! Sunk muscle: a tube glued over its flat width draws the wall in and is half in the body.
//!
//! ```text
//! wall     an arc 2πR − W closed by the chord 2r₀ (`section.rs`): A, ȳ, D
//! body     A_b = A − πr₀²/2,  A_b ȳ_b = Aȳ − (πr₀²/2)(D − 4r₀/3π)         hinge p_b A_b ȳ_b in place of p_b πR³
//! arm      D alone: the axis stays in the chord, nothing is left of `arm_growth`
//! gas      ΔA = πR² − A_b        what a flat end must push aside (`flat_ends`)
//! ```
//!
//! R, W and r₀ = W/π are the radius of the body, flat width and radius of the muscle; D is 68.3 mm for R = 40, W = 60, not 2R + r₀ = 99. At
//! either edge three tensions meet: P r above, (P − p_b) r below, p_b R' from the wall. The upper two pull up and down and cancel but for
//! p_b r; the wall pulls outwards, and up by p_b R' cosβ, at most p_b R. Against P r both are small once P is a few p_b: the tube is round,
//! its widest place is the wall's chord, and nothing is left that could lift it. An arm that the scenario gives is replaced. Finite elements
//! of the shipped robot at 30 kPa: axis 70 mm from the far side.

use super::entry::*;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "sunk_muscle",
    formula: "D = R' (1 + cosβ), 2r₀/(2πR − W) = sinβ/(π − β); hinge p_b A_b ȳ_b",
    sentence: "The muscle is glued over its whole width, draws the wall in and is half inside the body, nearer to the far side.",
    differs: "More bend per stroke than an arm outside the body allows, and a body that resists less.",
    remedy: "Measure the distance from the far wall to the middle of the muscle at full pressure.",
    validity: "glued over the whole flat width; P above some 3 p_b",
    reference: "derived here",
    parameters: &[SHARE.means("1: half in the wall, 0: on it")],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in assembly.active_sites(Family::Mckibben) {
            let (radius_m, width_m) = (site.radius_m, site.shape.width_m);
            let Some(body) = drawn_in(radius_m, width_m) else { continue };
            let part = |on: f64, sunk: f64| on + values[0] * (sunk - on);
            let lost_m2 = PI * radius_m.powi(2) - body.area_m2;
            site.linkage.arm_m = part(site.linkage.arm_m, body.chord_m);
            // The axis stays in the wall's chord however wide the tube is.
            site.linkage.arm_growth = part(site.linkage.arm_growth, 0.0);
            site.weave.drawn_in_m2 = values[0] * lost_m2;
            let (area_m2, first_m3) = body.about_axis(radius_m);
            (site.area_m2, site.first_m3) = (part(site.area_m2, area_m2), values[0] * first_m3);
            site.body_pressure.scale(part(1.0, body.moment_share(radius_m)));
        }
    },
    ..BALANCE
};

/// The body's part of the section with a muscle half in its wall; `None` where the muscle is too wide for the body.
fn drawn_in(radius_m: f64, width_m: f64) -> Option<CutSection> {
    let tube_m = width_m / PI;
    let whole = CutSection::drawn_in(radius_m, width_m, 2.0 * tube_m)?;
    let half = 0.5 * PI * tube_m.powi(2);
    let area_m2 = whole.area_m2 - half;
    let moment = whole.area_m2 * whole.centroid_m - half * (whole.chord_m - 4.0 * tube_m / (3.0 * PI));
    Some(CutSection { area_m2, centroid_m: moment / area_m2, ..whole })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_muscle_lies_where_the_finite_elements_have_it() {
        // At 30 kPa the section of `ibr simulate fpam` has far side, bottom and top of the tube at −27.9, 20.9 and 64.0 mm.
        let axis = 0.5 * (20.9 + 64.0) + 27.9;
        let arm = 1e3 * drawn_in(0.04, 0.06).unwrap().chord_m;
        assert!((arm / axis - 1.0).abs() < 0.035, "{arm} {axis}");
    }
}
