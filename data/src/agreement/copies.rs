//! Runs that are copies: a repetition that is none makes every error too small.

use super::seen::{Doubt, Seen, SeenRun};

/// Places nearer than this are the same: rounding of means \[m\].
const SAME_M: f64 = 1e-9;

/// Two runs have the same places in all their frames, whatever their times and pressures are.
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
    let near = |(a, b): (&[f64; 3], &[f64; 3])| {
        (a[0].is_nan() && b[0].is_nan()) || (0..3).all(|axis| (a[axis] - b[axis]).abs() <= SAME_M)
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
        right(copies);
    }
}
