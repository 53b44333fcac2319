//! Two markers that exchange their labels, from one frame to the next or in one of the runs.

use super::seen::{Doubt, Seen, SeenRun, middle, minus, size};

/// Two markers are each this much nearer to the place of the other one than to their own.
const NEARER: f64 = 0.2;
/// Places nearer than this count as one \[m\].
const APART_M: f64 = 0.02;

/// Two markers change places within a run, or have each other's places at rest in one run.
pub(super) fn swapped(seen: &Seen) -> Option<Doubt> {
    let count = seen.markers.len();
    let pairs = || (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
    let (run, [a, b], when) = seen.runs.iter().enumerate().find_map(|(r, run)| {
        let within = |pair| Some((run, pair, format!("from {:.1} s on", within(run, pair)?)));
        pairs()
            .find_map(within)
            .or_else(|| Some((run, pairs().find(|pair| at_rest(seen, r, *pair))?, "at rest".into())))
    })?;
    let message = format!(
        "run {}: {when} markers {} and {} have each other's places: their labels are exchanged",
        run.label, seen.markers[a].0, seen.markers[b].0
    );
    Some(Doubt::new(message, "exchange the labels there in the tracking program, and export again"))
}

/// Whether two places became each other's.
fn exchanged(before: [[f64; 3]; 2], after: [[f64; 3]; 2]) -> bool {
    let way = |from: usize, to: usize| size(minus(after[to], before[from]));
    let own = way(0, 0) + way(1, 1);
    own > 2.0 * APART_M && way(0, 1) + way(1, 0) < NEARER * own
}

/// The time of the frame in which two markers exchange their places \[s\].
fn within(run: &SeenRun, [a, b]: [usize; 2]) -> Option<f64> {
    let places = |k: usize| [run.places_m[a][k], run.places_m[b][k]];
    // Labels are exchanged only where one of the two markers jumps: a comparison of squares passes most frames over.
    let jumps = |[from, to]: [[f64; 3]; 2]| minus(to, from).map(|d| d * d).iter().sum::<f64>() > APART_M * APART_M;
    let mut seen = (0..run.times_s.len()).filter(|k| places(*k).iter().all(|place| place[0].is_finite()));
    let mut before = places(seen.next()?);
    seen.find(|k| {
        let [from, to] = [std::mem::replace(&mut before, places(*k)), places(*k)];
        (jumps([from[0], to[0]]) || jumps([from[1], to[1]])) && exchanged(from, to)
    })
    .map(|k| run.times_s[k])
}

/// Whether two markers of a run are at each other's places of the other runs.
fn at_rest(seen: &Seen, run: usize, pair: [usize; 2]) -> bool {
    let rest = |run: &SeenRun, marker: usize| run.rest()?.places_m[marker];
    let others = || seen.runs.iter().enumerate().filter(|(other, _)| *other != run);
    let usual = pair.map(|marker| middle(others().filter_map(|(_, run)| rest(run, marker))));
    let own = pair.map(|marker| rest(&seen.runs[run], marker));
    matches!((usual, own), ([Some(a), Some(b)], [Some(c), Some(d)]) if exchanged([a, b], [c, d]))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::swapped;

    fn slip(in_run: usize, from_s: f64) -> impl Fn(&mut Made) {
        move |made: &mut Made| made.swapped = Some((in_run, from_s))
    }

    #[test]
    fn exchanged_labels_are_refused() {
        refused(swapped, slip(0, 12.0), &["run 1: from 12.0 s on markers b and c", "labels are exchanged"]);
        refused(swapped, slip(1, -1.0), &["run 2: at rest markers b and c"]);
        right(swapped);
    }
}
