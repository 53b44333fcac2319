//! Runs that are copies: a repetition that is none makes every error too small.

use super::seen::{Doubt, Seen, SeenRun, minus};

/// Places nearer than this are the same: rounding of tables \[m\].
const SAME_M: f64 = 1.5e-7;

/// Two runs have the same places in all their frames, or places that differ by one shift, whatever their times and pressures are.
pub(super) fn copies(seen: &Seen) -> Option<Doubt> {
    for (k, run) in seen.runs.iter().enumerate() {
        if let Some(copy) = seen.runs[..k].iter().find(|other| same(run, other)) {
            let message = format!(
                "runs {} and {} are identical to the last digit: one is a copy and not a repetition",
                copy.label, run.label
            );
            return Some(Doubt::new(message, "leave the copy out, or export the second run again"));
        }
    }
    None
}

fn same(a: &SeenRun, b: &SeenRun) -> bool {
    let first = a.places_m.iter().zip(&b.places_m).find_map(|(a, b)| Some(minus(*a.first()?, *b.first()?)));
    let shift = first.filter(|shift| shift[0].is_finite()).unwrap_or_default();
    let near = |(a, b): (&[f64; 3], &[f64; 3])| {
        (a[0].is_nan() && b[0].is_nan()) || (0..3).all(|axis| (a[axis] - b[axis] - shift[axis]).abs() <= SAME_M)
    };
    let columns = |(a, b): (&Vec<[f64; 3]>, &Vec<[f64; 3]>)| a.len() == b.len() && a.iter().zip(b).all(near);
    a.places_m.iter().zip(&b.places_m).all(columns)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::copies;

    #[test]
    fn a_copied_run_is_refused() {
        refused(copies, |made: &mut Made| made.copy(0, 2), &["runs 1 and 3 are identical", "not a repetition"]);
        let cropped = |made: &mut Made| {
            made.copy(0, 1);
            made.shifted = Some((1, [0.012, -0.004]));
        };
        refused(copies, cropped, &["runs 1 and 2 are identical"]);
        right(copies);
    }
}
