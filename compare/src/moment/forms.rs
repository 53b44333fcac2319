//! How wrong the form of a law is: another law for the same effect, held against it in moments.
//!
//! ```text
//! w² = Σ (M − m)²/Σ m² ÷ Σ_k |m f_k ⟂ m|²/|m|²
//! ```
//!
//! M is the moment of the other law at its own bends, m that of the law at the size that fits best, f_k the factors by which the
//! evidence lets a form err, each as large as one share per doubling of bend or pressure. So w is the share that the form of this
//! law errs by for every doubling, the size being free.

/// A factor along bend and pressure, both in doublings.
pub type Factor = fn(f64, f64) -> f64;

/// By which a law's form may err: slopes and bends along bend and pressure. Its size is a parameter.
pub const FORM: [Factor; 4] = [|u, _| u, |_, v| v, |u, _| 0.5 * u * u, |_, v| 0.5 * v * v];

/// Logarithm to the base of two, counted from half a doubling below the top, within five.
pub fn doublings(share: f64) -> f64 {
    share.max(1.0 / 32.0).log2() + 0.5
}

/// w of a law's moments `law` against `truth` at the same points, whose bends and pressures are shares of the largest ones;
/// `None` where the law has no moment.
pub fn form_width(truth: &[f64], law: &[f64], at: &[[f64; 2]]) -> Option<f64> {
    let squares = dot(law, law);
    if squares <= 0.0 || truth.is_empty() {
        return None;
    }
    let left: Vec<f64> = truth.iter().zip(law).map(|(a, b)| a - b).collect();
    let open = FORM.iter().map(|factor| {
        let column: Vec<f64> = law.iter().zip(at).map(|(m, [k, p])| m * factor(doublings(*k), doublings(*p))).collect();
        (dot(&column, &column) - dot(&column, law).powi(2) / squares).max(0.0)
    });
    let open: f64 = open.sum();
    (open > 1e-6 * squares).then(|| (dot(&left, &left) / open).sqrt())
}

/// Size that takes a law nearest to the truth, from its moments at sizes from small to large; the law may bend with its size.
pub fn best_size(sizes: &[f64], law: &dyn Fn(f64) -> Option<Vec<f64>>, truth: &[f64]) -> Option<(f64, Vec<f64>)> {
    let away = |m: &[f64]| truth.iter().zip(m).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    let tried = sizes.iter().filter_map(|size| Some((*size, law(*size)?)));
    tried.min_by(|a, b| away(&a.1).total_cmp(&away(&b.1)))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: [[f64; 2]; 4] = [[0.4, 0.25], [0.7, 0.5], [0.9, 0.75], [1.0, 1.0]];

    #[test]
    fn a_law_that_is_right_has_no_width_and_one_share_of_a_slope_gives_it_back() {
        let law = [0.3, 0.5, 0.6, 0.65];
        assert_eq!(form_width(&law, &law, &AT), Some(0.0));
        assert_eq!(form_width(&[0.1], &[0.0], &AT[..1]), None);
        // Along every factor with the same share, what the size takes up left out: the mean square is that share.
        let share = 0.2;
        let mut squares = 0.0;
        for factor in FORM {
            let column: Vec<f64> =
                law.iter().zip(AT).map(|(m, [k, p])| m * factor(doublings(k), doublings(p))).collect();
            let along = dot(&column, &law) / dot(&law, &law);
            let truth: Vec<f64> = law.iter().zip(&column).map(|(m, c)| m + share * (c - along * m)).collect();
            squares += form_width(&truth, &law, &AT).unwrap().powi(2);
        }
        assert!((squares.sqrt() - share).abs() < 1e-12, "{}", squares.sqrt());
    }
}
