//! A marker that repeats its place while the others move: the tracking program lost it and kept its last place.

use super::frozen::stands_still;
use super::seen::{Doubt, Seen};

/// One marker of a run repeats its place, and its other frames do not.
pub(super) fn stuck(seen: &Seen) -> Option<Doubt> {
    let markers = || (0..seen.markers.len()).flat_map(|marker| seen.runs.iter().map(move |run| (marker, run)));
    markers().find_map(|(marker, run)| {
        let Doubt { message, .. } = stands_still(&run.times_s, &run.places_m[marker..=marker])?;
        let still = message.replacen("all markers are", &format!("only marker {} is", seen.markers[marker].0), 1);
        let help =
            "leave its positions blank there, or track it again: the program lost it and repeated its last place";
        Some(Doubt::new(format!("run {}: {still}", run.label), help))
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::stuck;

    #[test]
    fn a_marker_that_keeps_its_place_is_refused() {
        let kept = |made: &mut Made| {
            made.each(|run, t, marker, place| {
                if run == 1 && marker == 0 && (10.0..18.0).contains(&t) {
                    *place = [0.09, 0.004]
                }
            })
        };
        refused(stuck, kept, &["run 2: only marker a is frozen", "from 10.0 to 18.0 s", "blank"]);
        right(stuck);
    }
}
