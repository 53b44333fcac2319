//! Section of a tube whose wall is an arc that a chord closes: a strip of width w pulled straight in the wall.
//!
//! ```text
//! w/s = sinα/(π − α)     R' = s/(2(π − α))     A = R'² (π − α + sinα cosα)     ȳ = R' − 2R'³ sin³α/(3A)     D = R' (1 + cosα)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, w | length of the arc and of the chord | m |
//! | α | half of the angle that the chord takes from the circle of radius R' | rad |
//! | A, ȳ | area, height of its centroid above the far side | m², m |
//! | D | height of the chord above the far side | m |
//!
//! Hoop tension is p_b R' all along the arc. Valid for sheets without bending stiffness. Derived here.

use std::f64::consts::PI;

/// Such a section, heights from the far side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CutSection {
    pub radius_m: f64,
    pub cos: f64,
    pub area_m2: f64,
    pub centroid_m: f64,
    pub chord_m: f64,
}

impl CutSection {
    /// `None` if the chord is negative or not shorter than the arc.
    pub(crate) fn new(arc_m: f64, chord_m: f64) -> Option<CutSection> {
        if !(arc_m > 0.0 && chord_m >= 0.0 && chord_m < arc_m) {
            return None;
        }
        let beta = beyond(chord_m / arc_m);
        let (sin, cos) = (beta.sin(), -beta.cos());
        let radius_m = arc_m / (2.0 * beta);
        let area_m2 = radius_m.powi(2) * (beta + sin * cos);
        let centroid_m = radius_m - 2.0 * (radius_m * sin).powi(3) / (3.0 * area_m2);
        Some(CutSection { radius_m, cos, area_m2, centroid_m, chord_m: radius_m * (1.0 + cos) })
    }

    /// Of a body of radius R around a strip of flat width W, drawn in to a chord w.
    pub(crate) fn drawn_in(radius_m: f64, width_m: f64, chord_m: f64) -> Option<CutSection> {
        CutSection::new(2.0 * PI * radius_m - width_m, chord_m)
    }

    /// Slope of its area by the chord, R' cosα \[m\]: the hoop tension over p_b that the chord carries.
    pub(crate) fn by_chord_m(&self) -> f64 {
        self.radius_m * self.cos
    }

    /// Its area, and the first moment of that about the axis of a body of radius R.
    pub(crate) fn about_axis(&self, radius_m: f64) -> (f64, f64) {
        (self.area_m2, self.area_m2 * (self.centroid_m - radius_m))
    }

    /// Moment of the gas that the section takes, relative to the round body, Aȳ/(πR³).
    pub(crate) fn moment_share(&self, radius_m: f64) -> f64 {
        self.area_m2 * self.centroid_m / (PI * radius_m.powi(3))
    }
}

/// β = π − α of sinβ/β = `ratio`, from 0 to below 1, by Halley's iteration from above the root, where sinβ − β·`ratio` falls and is
/// concave: it comes down to the root and ends where rounding turns it back.
fn beyond(ratio: f64) -> f64 {
    let less = 1.0 - ratio;
    let mut beta = match ratio > 0.5 {
        true => (120.0 * less / (10.0 + (100.0 - 120.0 * less).sqrt())).sqrt(),
        false => PI / (1.0 + ratio),
    };
    for _ in 0..8 {
        let (sin, cos) = beta.sin_cos();
        let (value, slope) = (sin - ratio * beta, cos - ratio);
        let next = beta - value / (slope + 0.5 * value * sin / slope);
        if !(next > 0.0 && next < beta) {
            break;
        }
        beta = next;
    }
    beta
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_chord_leaves_a_circle_and_a_pouch_of_60_mm_in_a_body_of_80_a_chord_at_69() {
        let circle = CutSection::new(2.0 * PI * 0.04, 0.0).unwrap();
        assert!((circle.chord_m - 0.08).abs() < 1e-12 && (circle.centroid_m - 0.04).abs() < 1e-12, "{circle:?}");
        assert!((circle.area_m2 - PI * 1.6e-3).abs() < 1e-12 && (circle.moment_share(0.04) - 1.0).abs() < 1e-9);
        let pouch = CutSection::drawn_in(0.04, 0.06, 0.06).unwrap();
        assert!((pouch.chord_m - 0.0693).abs() < 5e-5, "{pouch:?}");
        // The chord closes the arc, and the gas of a slice pushes as hard on both sides of any cut.
        let sin = (1.0 - pouch.cos * pouch.cos).sqrt();
        assert!((2.0 * pouch.radius_m * sin - 0.06).abs() < 1e-12);
        assert!(CutSection::new(0.1, 0.1).is_none() && CutSection::new(0.1, -0.01).is_none());
    }

    #[test]
    fn the_angle_closes_the_chord_from_none_to_all_of_the_arc() {
        for i in 0..1000 {
            let ratio = f64::from(i) / 1000.0;
            let beta = beyond(ratio);
            assert!((beta.sin() - ratio * beta).abs() < 4e-16 && beta > 0.0 && beta <= PI, "{ratio}: {beta}");
        }
        assert!(
            beyond(1.0 - f64::EPSILON).is_finite()
                && CutSection::new(0.1, 0.1 - 1e-16).is_some_and(|s| s.area_m2.is_finite())
        );
    }

    #[test]
    fn a_long_chord_leaves_a_half() {
        let radius = 0.03;
        let round = CutSection::new(2.0 * PI * radius, 1e-7).unwrap();
        assert!((round.chord_m / (2.0 * radius) - 1.0).abs() < 1e-6 && (round.centroid_m / radius - 1.0).abs() < 1e-6);
        let half = CutSection::new(PI * radius, 2.0 * radius).unwrap();
        assert!((half.chord_m / radius - 1.0).abs() < 1e-12);
        assert!((half.area_m2 / (0.5 * PI * radius * radius) - 1.0).abs() < 1e-12);
        assert!((half.centroid_m / (radius * (1.0 - 4.0 / (3.0 * PI))) - 1.0).abs() < 1e-12);
        assert_eq!(CutSection::new(0.05, 0.06), None);
    }

    #[test]
    fn area_and_centroid_are_those_of_strips_of_the_section() {
        let (arc, chord) = (0.19, 0.038);
        let at = CutSection::new(arc, chord).unwrap();
        let radius = (0.25 * chord * chord + at.chord_m.powi(2)) / (2.0 * at.chord_m);
        let (mut area, mut moment, n) = (0.0, 0.0, 200_000);
        for i in 0..n {
            let y = at.chord_m * (f64::from(i) + 0.5) / f64::from(n);
            let strip = 2.0 * (radius * radius - (radius - y).powi(2)).sqrt() * at.chord_m / f64::from(n);
            (area, moment) = (area + strip, moment + strip * y);
        }
        assert!((area / at.area_m2 - 1.0).abs() < 1e-6 && (moment / area / at.centroid_m - 1.0).abs() < 1e-6);
    }
}
