//! Curvature → centre line: the heading integrated along the arc, exactly for piecewise constant curvature.
//!
//! κ is the heading change per length s of the taut generator, whose length is kept; the centre line shortens to
//! (1 − s) ds. A stretch of length h is an arc of turn u = κh:
//!
//! ```text
//! along = (1 − s) h sin u/u        across = (1 − s) h (1 − cos u)/u
//! s = κc for κ ≥ 0        s = κc + 2c k ln cosh(κ/k) → −κc for κ < 0, where the generator at the actuator is taut
//! ```
//!
//! c is the distance of the centre line from the taut generator, k the curvature over which the taut generator changes side.

use crate::body::soft_step;
use crate::trig::sin_cos;

/// Displacement over a stretch, in the frame of its start, with first and second derivatives by κ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Arc {
    /// Along and across, and their derivatives.
    pub chord: [f64; 2],
    pub slope: [f64; 2],
    pub bend: [f64; 2],
    /// Sine and cosine of the turn.
    pub turn: [f64; 2],
}

/// Below this turn the closed forms lose digits, and the series are exact to rounding and cheaper.
pub(crate) const SERIES_BELOW: f64 = 0.25;

/// Coefficients of `sin u/u` and `(1 − cos u)/u²` in u², signs alternating.
const SIN_SERIES: [f64; 6] = inverse_of([1.0, 6.0, 120.0, 5040.0, 362_880.0, 3.991_68e7]);
const COS_SERIES: [f64; 6] = inverse_of([2.0, 24.0, 720.0, 40320.0, 3_628_800.0, 4.790_016e8]);

/// Coefficients of a series from their inverses.
pub(crate) const fn inverse_of<const N: usize>(mut of: [f64; N]) -> [f64; N] {
    let mut i = 0;
    while i < N {
        of[i] = 1.0 / of[i];
        i += 1;
    }
    of
}

/// `c₀ − z (c₁ − z (c₂ − …))`
#[inline(always)]
pub(crate) fn alternating<const N: usize>(z: f64, coefficients: [f64; N]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| c - z * sum)
}

/// `sin u/u`, `(1 − cos u)/u`, their first and second derivatives; then `sin u` and `cos u`.
#[inline(always)]
pub(crate) fn sinc_pair(u: f64) -> [f64; 8] {
    if u.abs() < SERIES_BELOW {
        let z = u * u;
        let (a, b) = (alternating(z, SIN_SERIES), alternating(z, COS_SERIES));
        let da = alternating(z, const { inverse_of([3.0, 30.0, 840.0, 45360.0, 3.991_68e6]) });
        let db = alternating(z, const { inverse_of([2.0, 8.0, 144.0, 5760.0, 403_200.0, 4.354_56e7]) });
        let dda = alternating(z, const { inverse_of([3.0, 10.0, 168.0, 6480.0]) });
        let ddb = alternating(z, const { inverse_of([4.0, 36.0, 960.0, 50400.0]) });
        return [a, u * b, -u * da, db, -dda, -u * ddb, u * a, 1.0 - z * b];
    }
    let (sin, cos) = sin_cos(u);
    let per = 1.0 / u;
    let (a, b) = (sin * per, (1.0 - cos) * per);
    let (da, db) = ((cos - a) * per, (sin - b) * per);
    [a, b, da, db, (-sin - 2.0 * da) * per, (cos - 2.0 * db) * per, sin, cos]
}

/// How the centre line shortens with the bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineShortening {
    /// Distance c from the taut generator \[m\].
    pub(crate) from_taut_m: f64,
    /// Curvature k over which the taut generator changes side \[1/m\].
    pub(crate) turn_per_m: f64,
}

/// Largest c k: a body that changes side is longer by up to 0.26 c k, 0.05 %.
const MOST_LONGER: f64 = 2e-3;

impl LineShortening {
    /// Of a body whose restoring moment changes sign over `hinge_curvature`.
    pub(crate) fn new(from_taut_m: f64, hinge_curvature: f64) -> LineShortening {
        LineShortening { from_taut_m, turn_per_m: hinge_curvature.min(MOST_LONGER / from_taut_m.abs()) }
    }

    /// Shortening s, and its first and second derivatives by κ.
    #[inline(always)]
    pub(crate) fn shortening(&self, kappa: f64) -> [f64; 3] {
        let c = self.from_taut_m;
        if kappa < 0.0 { self.away(kappa) } else { [kappa * c, c, 0.0] }
    }

    #[cold]
    fn away(&self, kappa: f64) -> [f64; 3] {
        let (c, k) = (self.from_taut_m, self.turn_per_m);
        let (log, tanh) = soft_step(kappa, k);
        [c * (kappa + 2.0 * log), c * (1.0 + 2.0 * tanh), 2.0 * c * (1.0 - tanh * tanh) / k]
    }
}

/// The arc of curvature `kappa` over a taut length `h`.
#[inline(always)]
pub(crate) fn arc(kappa: f64, h: f64, centre: LineShortening) -> Arc {
    let [a, b, da, db, dda, ddb, sin, cos] = sinc_pair(kappa * h);
    let [shorter, d_shorter, dd_shorter] = centre.shortening(kappa);
    let (line, lost, more) = ((1.0 - shorter) * h, d_shorter * h, dd_shorter * h);
    Arc {
        chord: [line * a, line * b],
        slope: [line * h * da - lost * a, line * h * db - lost * b],
        bend: [(a, da, dda), (b, db, ddb)].map(|(f, d, dd)| h * (line * h * dd - 2.0 * lost * d) - more * f),
        turn: [sin, cos],
    }
}

/// A stretch of constant curvature in space: what all its points share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    from: [f64; 2],
    direction: [f64; 2],
    heading: f64,
    kappa: f64,
    /// 1 − s, and that over κ (not used where κ is small).
    line: f64,
    line_radius: f64,
}

impl Stretch {
    /// From its start (position, direction of the slid wall, heading), its curvature and its centre line.
    #[inline(always)]
    pub(crate) fn new(
        from: [f64; 2],
        direction: [f64; 2],
        heading: f64,
        kappa: f64,
        centre: LineShortening,
    ) -> Stretch {
        let line = 1.0 - centre.shortening(kappa)[0];
        Stretch { from, direction, heading, kappa, line, line_radius: line / kappa }
    }

    /// Position and heading at a taut length from its start.
    #[inline(always)]
    pub(crate) fn at(&self, offset: f64) -> ([f64; 2], f64) {
        let u = self.kappa * offset;
        let chord = if u.abs() < SERIES_BELOW {
            let (length, z) = (self.line * offset, u * u);
            [length * alternating(z, SIN_SERIES), length * u * alternating(z, COS_SERIES)]
        } else {
            let (sin, cos) = sin_cos(u);
            [self.line_radius * sin, self.line_radius * (1.0 - cos)]
        };
        (advance(self.from, self.direction, chord), self.heading + u)
    }
}

/// Direction (cos ψ, sin ψ) after an arc.
#[inline]
pub(crate) fn turned([c, s]: [f64; 2], [sin, cos]: [f64; 2]) -> [f64; 2] {
    [c * cos - s * sin, s * cos + c * sin]
}

/// Direction in which a stretch goes whose wall slides by an angle: it keeps its length, and its sections their heading.
#[inline]
pub(crate) fn slid(direction: [f64; 2], shear: f64) -> [f64; 2] {
    if shear == 0.0 { direction } else { turned(direction, shear.sin_cos().into()) }
}

/// End of an arc that starts at `from` with direction (cos ψ, sin ψ).
#[inline]
pub(crate) fn advance(from: [f64; 2], [c, s]: [f64; 2], [along, across]: [f64; 2]) -> [f64; 2] {
    [from[0] + c * along - s * across, from[1] + s * along + c * across]
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: LineShortening = LineShortening { from_taut_m: 0.04, turn_per_m: 0.05 };

    #[test]
    fn series_and_closed_form_agree_where_they_join() {
        let below = sinc_pair(SERIES_BELOW * (1.0 - 1e-15));
        let above = sinc_pair(SERIES_BELOW);
        for (b, a) in below.iter().zip(above) {
            assert!((b - a).abs() < 1e-9, "{b} {a}");
        }
    }

    #[test]
    fn a_point_of_a_stretch_is_the_end_of_its_arc() {
        for kappa in [-9.0, -3.0, -1e-9, 0.0, 1e-3, 0.8, 4.6, 24.9] {
            let (from, direction, heading) = ([0.1, -0.2], [0.6, 0.8], 0.927);
            let stretch = Stretch::new(from, direction, heading, kappa, LINE);
            for h in [0.0, 0.03, 0.07, 0.31, 1.5] {
                let (part, ([x, y], at)) = (arc(kappa, h, LINE), stretch.at(h));
                let end = advance(from, direction, part.chord);
                assert!((x - end[0]).abs() < 1e-15 && (y - end[1]).abs() < 1e-15, "{kappa} {h}");
                assert_eq!(at, heading + kappa * h);
            }
        }
    }

    #[test]
    fn derivatives_are_slopes_of_the_arc() {
        for kappa in [-3.0, -0.02, -1e-3, 0.2, 4.6] {
            let (h, d) = (0.07, 1e-6);
            let (m, p, at) = (arc(kappa - d, h, LINE), arc(kappa + d, h, LINE), arc(kappa, h, LINE));
            for i in [0, 1] {
                assert!(((p.chord[i] - m.chord[i]) / (2.0 * d) - at.slope[i]).abs() < 1e-10);
                assert!(((p.slope[i] - m.slope[i]) / (2.0 * d) - at.bend[i]).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn many_short_arcs_add_up_to_one_long_arc() {
        let (kappa, length, n) = (4.6, 0.36, 1000);
        let one = arc(kappa, length, LINE);
        let (mut xy, mut heading) = ([0.0; 2], 0.0_f64);
        for _ in 0..n {
            let step = arc(kappa, length / f64::from(n), LINE);
            xy = advance(xy, [heading.cos(), heading.sin()], step.chord);
            heading += kappa * length / f64::from(n);
        }
        assert!((xy[0] - one.chord[0]).abs() < 1e-13 && (xy[1] - one.chord[1]).abs() < 1e-13);
    }

    #[test]
    fn a_body_that_bends_away_is_as_short_as_one_that_bends_towards_its_actuator() {
        for kappa in [0.4, 3.0, 12.0] {
            let [towards, away] = [kappa, -kappa].map(|kappa| LINE.shortening(kappa)[0]);
            assert!(away <= towards && towards - away < 4.0 * 0.04 * 0.05 * std::f64::consts::LN_2, "{kappa}");
        }
        let wide = LineShortening::new(0.5, 0.05);
        let longest = (1..2000).map(|i| wide.shortening(-1e-4 * f64::from(i))[0]).fold(0.0, f64::min);
        assert!(longest > -6e-4, "{longest}");
    }
}
