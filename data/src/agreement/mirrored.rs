//! A run that bends the other way: its picture was mirrored, or one of its axes is turned.

use super::seen::{Doubt, Seen, SeenRun, middle, minus, size};
use crate::units::mm;

/// Movement that a marker must make to be judged \[m\].
const TELLING_M: f64 = 0.01;
/// Cosine between the movements of a run and of the others, below which the run goes another way.
const ANOTHER_WAY: f64 = 0.0;

/// From rest to the highest pressure the farthest marker moves another way than in the other runs.
pub(super) fn mirrored(seen: &Seen) -> Option<Doubt> {
    let ways: Vec<[f64; 3]> = seen.runs.iter().map(way).collect::<Option<_>>()?;
    (0..ways.len()).find_map(|run| {
        let usual = middle(ways.iter().enumerate().filter(|(other, _)| *other != run).map(|(_, way)| *way))?;
        let cosine = ways[run].iter().zip(usual).map(|(a, b)| a * b).sum::<f64>() / (size(ways[run]) * size(usual));
        if size(ways[run]).min(size(usual)) < TELLING_M || cosine >= ANOTHER_WAY {
            return None;
        }
        let message = format!(
            "run {}: the farthest marker moves by {:.1} mm as the pressure rises, another way than in the other runs",
            seen.runs[run].label,
            mm(size(ways[run]))
        );
        Some(Doubt::new(message, "the picture was mirrored or turned: import this run separately, with its own --axes"))
    })
}

/// Movement of the farthest marker that was seen, from rest to the highest pressure, across the robot \[m\].
fn way(run: &SeenRun) -> Option<[f64; 3]> {
    let rest = run.rest()?;
    let top = run.levels.iter().max_by(|a, b| a.pressures_pa[1].total_cmp(&b.pressures_pa[1]))?;
    let both = rest.places_m.iter().zip(&top.places_m).filter_map(|(rest, top)| Some(((*rest)?, (*top)?)));
    let (rest, top) = both.max_by(|a, b| size(a.0).total_cmp(&size(b.0)))?;
    let [_, y, z] = minus(top, rest);
    Some([0.0, y, z])
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::mirrored;

    #[test]
    fn a_run_that_bends_the_other_way_is_refused() {
        let turned = |made: &mut Made| {
            made.each(|run, _, _, place| {
                if run == 1 {
                    place[1] = -place[1]
                }
            })
        };
        refused(mirrored, turned, &["run 2: the farthest marker moves by", "another way", "--axes"]);
        right(mirrored);
    }
}
