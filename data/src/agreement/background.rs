//! A marker that stays where it is while the robot moves: a place on the background that looks like a marker.

use super::seen::{Doubt, Level, Seen, SeenRun, minus, size};
use crate::units::mm;

/// A marker moves at least this part of the way of one that is nearer to the base.
const LEAST_PART: f64 = 0.15;
/// The innermost marker moves at least this part of what it would if the body bent evenly.
const INSIDE_PART: f64 = 0.3;
/// Way that a marker must go to be judged \[m\].
const TELLING_M: f64 = 0.01;
/// Fewest holds over which a way is judged.
const FEWEST: usize = 3;

/// From some hold on to the end a marker hardly moves, and one that is nearer to the base at rest does. On a body that bends and is held at its
/// base the outer marker moves more.
pub(super) fn background(seen: &Seen) -> Option<Doubt> {
    seen.runs.iter().find_map(|run| of_run(seen, run))
}

fn of_run(seen: &Seen, run: &SeenRun) -> Option<Doubt> {
    let rest = run.at_rest()?;
    for (marker, at) in rest.iter().enumerate() {
        for inner in (0..rest.len()).filter(|inner| size(rest[*inner]) < size(*at)) {
            let last = run.levels.len().saturating_sub(FEWEST);
            let still = |k: usize| {
                let ways = ways_m(run, [marker, inner], k)?;
                (ways[1] > TELLING_M && ways[0] < LEAST_PART * ways[1]).then_some((k, ways.map(mm)))
            };
            let Some((k, [own, other])) = (0..=last).find_map(still) else { continue };
            let since_s = run.times_s[*run.levels[k].frames.first()?];
            let names = [marker, inner].map(|of| &seen.markers[of].0);
            let message = format!(
                "run {}: from {since_s:.1} s on marker {} moves by {own:.1} mm, and marker {}, nearer to the base, by {other:.1} mm: it looks \
                 like a place on the background",
                run.label, names[0], names[1]
            );
            return Some(Doubt::new(message, "track the marker again, or leave its positions blank there"));
        }
    }
    None
}

/// Words on the innermost marker if it stays where it is and the next one moves. A robot whose actuator begins beyond it does so too, so it is not a
/// contradiction.
pub(crate) fn still_inside(seen: &Seen) -> Option<String> {
    seen.runs.iter().find_map(|run| {
        let rest = run.at_rest()?;
        let mut order: Vec<usize> = (0..rest.len()).collect();
        order.sort_by(|a, b| size(rest[*a]).total_cmp(&size(rest[*b])));
        let [inner, next] = [*order.first()?, *order.get(1)?];
        let [own, other] = ways_m(run, [inner, next], 0)?;
        // A body that bends evenly moves a marker by the square of its distance from the base.
        let even = (size(rest[inner]) / size(rest[next])).powi(2);
        let names = [inner, next].map(|of| &seen.markers[of].0);
        (other > TELLING_M && own < INSIDE_PART * even * other).then(|| {
            format!(
                "run {}: marker {} moves by {:.1} mm, and marker {} by {:.1} mm: marker {} is a place on the background, or the actuator begins \
                 beyond it",
                run.label,
                names[0],
                mm(own),
                names[1],
                mm(other),
                names[0]
            )
        })
    })
}

/// Ways of two markers over the holds from `first` on in which both were seen \[m\]; `None` if these are too few.
fn ways_m(run: &SeenRun, markers: [usize; 2], first: usize) -> Option<[f64; 2]> {
    let both = |level: &Level| Some([level.places_m[markers[0]]?, level.places_m[markers[1]]?]);
    let places: Vec<[[f64; 3]; 2]> = run.levels[first..].iter().filter_map(both).collect();
    let way = |of: usize| places.windows(2).map(|pair| size(minus(pair[1][of], pair[0][of]))).sum();
    (places.len() >= FEWEST).then(|| [0, 1].map(way))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::{background, still_inside};

    #[test]
    fn a_marker_on_the_background_is_refused() {
        let fixed = |made: &mut Made| {
            made.each(|_, _, marker, place| {
                if marker == 2 {
                    *place = [0.25, 0.11]
                }
            })
        };
        refused(background, fixed, &["marker c moves by", "nearer to the base", "background"]);
        let later = |made: &mut Made| {
            made.each(|_, t, marker, place| {
                if marker == 1 && t > 8.0 {
                    *place = [0.2, 0.05]
                }
            })
        };
        refused(background, later, &["from 5.5 s", "marker b moves by 0.0 mm"]);
        right(background);
        // Not seen in the last holds but one: it moved meanwhile.
        let lost = |made: &mut Made| {
            made.each(|_, t, marker, place| {
                if marker == 2 && (15.0..30.0).contains(&t) {
                    *place = [f64::NAN; 2]
                }
            })
        };
        let mut made = Made::new(1);
        lost(&mut made);
        assert!(background(&made.seen()).is_none());
        refused(background, |made| (lost(made), fixed(made)).1, &["marker c moves by 0.0 mm"]);
        let mut made = Made::new(1);
        made.each(|_, t, marker, place| {
            if marker == 0 {
                *place = [0.09 + 2e-4 * (7.0 * t).sin(), 0.01]
            }
        });
        let said = still_inside(&made.seen()).unwrap();
        assert!(said.contains("run 1: marker a moves by") && said.contains("begins beyond it"), "{said}");
        assert!((0..20).all(|seed| still_inside(&Made::new(seed).seen()).is_none()));
    }
}
