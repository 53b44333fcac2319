//! Sine and cosine together, inline: the fast twin of `f64::sin_cos` for the angles of this crate; and differences of them
//! that keep their digits at small angles.

/// Angles up to which three-part reduction keeps full accuracy; larger ones go to the standard library.
const REDUCED_UP_TO: f64 = 1e4;
const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
/// π/2 in three parts of 33 bits, so that n times a part is exact for |n| < 2²⁰ (Cody & Waite; values as in fdlibm).
const PIO2: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
/// Adding and subtracting 1.5·2⁵² rounds to the nearest integer without a library call.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// `(sin x, cos x)` within 2 units in the last place; polynomials of fdlibm's `__kernel_sin` and `__kernel_cos`.
#[inline]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() >= REDUCED_UP_TO || x.is_nan() {
        return x.sin_cos();
    }
    let n = (x * TWO_OVER_PI + ROUND) - ROUND;
    let r = ((x - n * PIO2[0]) - n * PIO2[1]) - n * PIO2[2];
    let z = r * r;
    let sin = r + r
        * z
        * (-1.666_666_666_666_663e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10)))));
    let tail = z
        * z
        * (4.166_666_666_666_66e-2
            + z * (-1.388_888_888_887_411e-3
                + z * (2.480_158_728_947_673e-5
                    + z * (-2.755_731_435_139_066_3e-7
                        + z * (2.087_572_321_298_175e-9 - z * 1.135_964_755_778_819_5e-11)))));
    let half = 0.5 * z;
    let whole = 1.0 - half;
    let cos = whole + (((1.0 - whole) - half) + tail);
    let quadrant = n as i64 & 3;
    let (a, b) = if quadrant & 1 == 0 { (sin, cos) } else { (cos, sin) };
    (if quadrant & 2 == 0 { a } else { -a }, if (quadrant + 1) & 2 == 0 { b } else { -b })
}

/// Below this argument the power series is used; its tenth term is then under 1e-20, and above it nothing cancels.
const SERIES_BELOW: f64 = 1.0;

/// `(x − sin x)/x³`, accurate to rounding for all x; 1/6 at x = 0.
pub fn sine_deficit(x: f64) -> f64 {
    if x.abs() > SERIES_BELOW {
        return (x - x.sin()) / x.powi(3);
    }
    series(x, |_| 1.0)
}

/// `(sin x − x cos x)/x³`, accurate to rounding for all x; 1/3 at x = 0.
pub fn sine_lag(x: f64) -> f64 {
    if x.abs() > SERIES_BELOW {
        return (x.sin() - x * x.cos()) / x.powi(3);
    }
    series(x, |k| 2.0 * k + 2.0)
}

/// `sin x / x`, 1 at x = 0.
pub fn sinc(x: f64) -> f64 {
    1.0 - x * x * sine_deficit(x)
}

fn series(x: f64, weight: impl Fn(f64) -> f64) -> f64 {
    let (mut term, mut sum) = (1.0 / 6.0, weight(0.0) / 6.0);
    for k in 1..=10 {
        let k = f64::from(k);
        term *= -x * x / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
        sum += weight(k) * term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_direct_forms_meet_at_the_switch() {
        let x: f64 = SERIES_BELOW;
        assert!((sine_deficit(x) - (x - x.sin())).abs() < 1e-15);
        assert!((sine_lag(x) - (x.sin() - x * x.cos())).abs() < 1e-15);
        assert!((sinc(0.7) - 0.7_f64.sin() / 0.7).abs() < 1e-15);
    }

    #[test]
    fn the_fast_twin_agrees_with_the_standard_library() {
        let mut worst = 0.0_f64;
        for i in -400_000..400_000 {
            let x = f64::from(i) * 7.123e-5;
            let ((s, c), (s0, c0)) = (sin_cos(x), x.sin_cos());
            worst = worst.max((s - s0).abs()).max((c - c0).abs());
        }
        assert!(worst <= 2.3e-16, "{worst:e}");
    }

    #[test]
    fn large_and_undefined_angles_go_to_the_standard_library() {
        assert_eq!(sin_cos(1e9), 1e9_f64.sin_cos());
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }
}
