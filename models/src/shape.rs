//! Curvature → centre line: the heading integrated along the arc, exactly for piecewise constant curvature.
//!
//! κ is the heading change per length s of the taut generator, whose length is kept; the centre line shortens to
//! (1 − κR) ds. A stretch of length h is an arc of turn u = κh:
//!
//! ```text
//! along = (1 − κR) h sin u/u        across = (1 − κR) h (1 − cos u)/u
//! ```

use crate::trig::sin_cos;

/// Displacement over a stretch, in the frame of its start, and derivatives by κ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arc {
    pub along: f64,
    pub across: f64,
    pub d_along: f64,
    pub d_across: f64,
}

/// Below this turn the closed forms lose digits and four terms of the series are exact to rounding.
const SERIES_BELOW: f64 = 1e-2;

/// `sin u/u`, `(1 − cos u)/u` and their derivatives.
fn sinc_pair(u: f64) -> [f64; 4] {
    if u.abs() < SERIES_BELOW {
        let u2 = u * u;
        return [
            1.0 - u2 * (1.0 / 6.0 - u2 * (1.0 / 120.0 - u2 / 5040.0)),
            u * (0.5 - u2 * (1.0 / 24.0 - u2 * (1.0 / 720.0 - u2 / 40320.0))),
            -u * (1.0 / 3.0 - u2 * (1.0 / 30.0 - u2 / 840.0)),
            0.5 - u2 * (1.0 / 8.0 - u2 * (1.0 / 144.0 - u2 / 5760.0)),
        ];
    }
    let (sin, cos) = sin_cos(u);
    let (a, b) = (sin / u, (1.0 - cos) / u);
    [a, b, (cos - a) / u, (sin - b) / u]
}

/// The arc of curvature `kappa` over a taut length `h` of a body of radius `radius`.
pub(crate) fn arc(kappa: f64, h: f64, radius: f64) -> Arc {
    let [a, b, da, db] = sinc_pair(kappa * h);
    let line = (1.0 - kappa * radius) * h;
    Arc {
        along: line * a,
        across: line * b,
        d_along: line * h * da - radius * h * a,
        d_across: line * h * db - radius * h * b,
    }
}

/// End of an arc that starts at `from` with direction (cos ψ, sin ψ).
pub(crate) fn advance(from: [f64; 2], direction: [f64; 2], along: f64, across: f64) -> [f64; 2] {
    let [c, s] = direction;
    [from[0] + c * along - s * across, from[1] + s * along + c * across]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_agree_where_they_join() {
        let below = sinc_pair(SERIES_BELOW * (1.0 - 1e-15));
        let above = sinc_pair(SERIES_BELOW);
        for (b, a) in below.iter().zip(above) {
            assert!((b - a).abs() < 1e-12, "{b} {a}");
        }
    }

    #[test]
    fn derivatives_are_slopes_of_the_arc() {
        for kappa in [-3.0, -1e-3, 0.0, 0.2, 4.6] {
            let (h, r, d) = (0.07, 0.04, 1e-6);
            let (m, p, at) = (arc(kappa - d, h, r), arc(kappa + d, h, r), arc(kappa, h, r));
            assert!(((p.along - m.along) / (2.0 * d) - at.d_along).abs() < 1e-10);
            assert!(((p.across - m.across) / (2.0 * d) - at.d_across).abs() < 1e-10);
        }
    }

    #[test]
    fn many_short_arcs_add_up_to_one_long_arc() {
        let (kappa, length, n) = (4.6, 0.36, 1000);
        let one = arc(kappa, length, 0.04);
        let (mut xy, mut heading) = ([0.0; 2], 0.0_f64);
        for _ in 0..n {
            let step = arc(kappa, length / f64::from(n), 0.04);
            xy = advance(xy, [heading.cos(), heading.sin()], step.along, step.across);
            heading += kappa * length / f64::from(n);
        }
        assert!((xy[0] - one.along).abs() < 1e-13 && (xy[1] - one.across).abs() < 1e-13);
    }
}
