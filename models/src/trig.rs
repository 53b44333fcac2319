//! Sine and cosine together, inline: the fast twin of `f64::sin_cos` for the angles of this crate.

/// Angles up to which three-part reduction keeps full accuracy; larger ones go to the standard library.
const REDUCED_UP_TO: f64 = 1e4;
/// 2/π.
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

#[cfg(test)]
mod tests {
    use super::*;

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
