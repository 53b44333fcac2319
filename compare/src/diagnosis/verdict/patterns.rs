//! Shapes that a misfit may have whatever its cause: what a person looks for in residuals before thinking of physics.
//!
//! A pattern is a place times a time. Places are small rotations at one point of the robot (a kink, a stiffer stretch), one
//! marker alone, or all markers together; times are one hold alone, all holds alike, in proportion to the bending or to
//! its square, or from a pressure on. Displacements are first order: points beyond a rotated one turn about it and come
//! nearer, because the far side of the body keeps its length,
//!
//! ```text
//! δx_j = Σ_k c_k [(−(y_j − ȳ_k), x_j − x̄_k) − R t_k]   over the points k before marker j, halfway between neighbours
//! ```
//!
//! with R the distance of the centre line from the far side and t_k the direction of the robot at k.
//!
//! No pattern knows an effect. A misfit along one of them more than along all effects is what "outside the catalogue" means.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::experiments::TIP_FORCE_N;
use crate::diagnosis::source::pressure_levels;
use crate::fit::numbers::sort_by;
use crate::layout::Layout;
use crate::wording::short;
use data::{Hold, Phase};

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ResidualPattern {
    /// Its appearance, to follow "The remaining misfit looks as if".
    pub words: String,
    /// What would show it, to follow "Next:".
    pub check: String,
    /// The whole robot bends otherwise at some time: all that a wrong law of a uniform robot can leave. Without it, a place.
    pub is_uniform: bool,
    /// What broke, if this is what something broken looks like.
    pub fault: Option<PatternCause>,
    /// Change of all values in run layout, in any unit.
    pub direction: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PatternCause {
    /// A place of the robot or a marker, with the times of the bending or without any.
    Place,
    /// One hold: a set point that was not reached.
    Hold,
}

enum PatternPlace {
    /// A rotation halfway between neighbouring markers, 0 between base and first marker.
    Bend(usize),
    /// Rotations at all of these points.
    Bends(Vec<f64>),
    /// One marker in x or y.
    Marker(usize, [f64; 2]),
    /// One marker, displaced along the robot.
    Along(usize),
    /// All markers in x or y.
    All([f64; 2]),
}

struct When {
    /// Clause on the time that follows the description of the pattern.
    words: String,
    check: String,
    /// Factor of the pattern in each hold.
    time: Vec<f64>,
}

struct Outline {
    xy: Vec<[f64; 2]>,
    /// Halfway from every one of them to the next.
    middle: Vec<[f64; 2]>,
    /// Unit vector from every one of them to the next.
    along: Vec<[f64; 2]>,
    /// Approach per turn \[m\], with the sign of the bending.
    shorter_m: f64,
    /// Place in the outline of every marker of the data.
    place: Vec<usize>,
}

/// All patterns for a prediction in run layout \[m\]; none for data of another shape, and none in space.
pub(crate) fn patterns(case: &DiagnosisCase, prediction_m: &[f64]) -> Vec<ResidualPattern> {
    let Some(layout) = planar(case) else { return Vec::new() };
    let markers = &case.first().dataset.markers;
    let outlines = outlines(case, &layout, prediction_m);
    let bent = bending(&layout, prediction_m);
    let stations = order(&case.first().scenario.markers_m);
    let always = vec![1.0; layout.holds];
    let mut found = Vec::new();
    let mut add = |words: String, check: String, place: &PatternPlace, time: &Vec<f64>| {
        let fault = (*time == always || *time == bent).then_some(PatternCause::Place);
        let direction = direction(case, &layout, &outlines, place, time);
        found.push(ResidualPattern { words, check, is_uniform: false, fault, direction });
    };
    // A rotation before the first marker is one of mount or camera, which the catalogue has.
    for k in 1..layout.markers {
        let [before, beyond] = [k - 1, k].map(|at| &markers[stations[at]].name);
        let at = format!("between markers {before} and {beyond}");
        let look = format!(
            "look at the body and the actuator {at} (a pouch that does not fill, a fold, tape, a leak), and hang a known force on \
             the tip with the actuator vented: a wall that is stiffer there bends less there then too, an actuator that pulls less \
             does not"
        );
        let words = format!("the robot bends otherwise {at} in proportion to its bending");
        add(words, look, &PatternPlace::Bend(k), &bent);
        let look = format!(
            "photograph the inflated body with the actuator vented, and once more rolled by 180°: a kink {at} is there without \
             actuator and rolls along, an error of camera or markers does not"
        );
        let words = format!("the robot has a fixed kink {at}");
        add(words, look, &PatternPlace::Bend(k), &always);
    }
    let all_along = |f: fn(f64) -> f64| PatternPlace::Bends(stretches(case).iter().map(|[s, ds]| f(*s) * ds).collect());
    let look = "hang a known force on the inflated body with the actuator vented, first on its middle and then on its tip: a wall \
                that is not the same all along gives two stiffnesses, one that is the same leaves the actuator, whose widths and \
                seams are measured from base to tip";
    let mut varies = |words: &str, shape| add(words.into(), look.into(), &all_along(shape), &bent);
    varies("stiffness changes steadily along the robot", |s| 1.0 - 2.0 * s);
    varies("the robot's middle bends otherwise than its ends", |s| 1.0 - 6.0 * s + 6.0 * s * s);
    for (m, marker) in markers.iter().enumerate() {
        let name = &marker.name;
        let look = format!(
            "measure the station of marker {name} along the straight robot with a tape, and correct s_mm in about.toml if it is \
             another one"
        );
        let words = format!("marker {name} sits elsewhere along the robot");
        add(words, look, &PatternPlace::Along(m), &always);
        for (axis, unit) in AXES {
            let look = format!(
                "look at marker {name} in the images (what the tracking follows there, labels that are exchanged), glue it on \
                 again and repeat one run: what is the marker's own moves with it"
            );
            let words = format!("marker {name} alone is off in {axis}");
            add(words, look, &PatternPlace::Marker(m, unit), &always);
        }
    }
    let times = times(case, &bent);
    let tip = all_along(|s| 1.0 - s);
    for When { words, check, time } in &times {
        let look = format!(
            "look for what touches or pulls the tip (a hose, a cable, the floor), and {check}, also with ±{TIP_FORCE_N} N on the tip"
        );
        let pulled = format!("something bends the robot from its tip {words}");
        add(pulled, look, &tip, time);
        for (axis, unit) in AXES {
            let look = format!(
                "put fiducials on the clamp and in the room and {check}: camera and mount move them too, the robot does not"
            );
            let shifted = format!("the image shifts in {axis} {words}");
            add(shifted, look, &PatternPlace::All(unit), time);
        }
    }
    let whole = all_along(|_| 1.0);
    let gauge = if case.is_gauged() { "" } else { ", with a gauge read at the actuator (column p_gauge_kpa)" };
    for (i, When { words, check, time }) in times.into_iter().enumerate() {
        found.push(ResidualPattern {
            words: format!("the whole robot bends otherwise {words}"),
            check: format!("{check}{gauge}"),
            is_uniform: true,
            // Single holds come first.
            fault: (i < layout.holds).then_some(PatternCause::Hold),
            direction: direction(case, &layout, &outlines, &whole, &time),
        });
    }
    found
}

const AXES: [(&str, [f64; 2]); 2] = [("x", [1.0, 0.0]), ("y", [0.0, 1.0])];

/// Uniform bending of every hold separately, what any law of a uniform robot may do: of the outline, and as the model bends with
/// pressure, which knows stretches without actuator.
pub(crate) fn uniform_bending(case: &DiagnosisCase, prediction_m: &[f64]) -> Vec<Vec<f64>> {
    let Some(layout) = planar(case) else { return Vec::new() };
    let outlines = outlines(case, &layout, prediction_m);
    let bent = PatternPlace::Bends(stretches(case).iter().map(|[_, ds]| *ds).collect());
    let by_model = |h: usize| {
        let own = layout.hold_range(h);
        let slope = case.noise().directions.iter().enumerate();
        slope.map(|(i, u)| if own.contains(&i) { u[0] } else { 0.0 }).collect()
    };
    let by_outline = |h: usize| direction(case, &layout, &outlines, &bent, &alone(layout.holds, h));
    (0..layout.holds).flat_map(|h| [by_outline(h), by_model(h)]).collect()
}

/// The layout of data in one plane, in which a place can be rotated one way only.
fn planar(case: &DiagnosisCase) -> Option<Layout> {
    Layout::of(&case.first().dataset).ok().filter(|layout| layout.axes == 2 && !case.first().scenario.is_spatial())
}

/// Stretches between neighbouring markers, the first from the base: middle and length over the last station.
fn stretches(case: &DiagnosisCase) -> Vec<[f64; 2]> {
    let stations = &case.first().scenario.markers_m;
    let ordered: Vec<f64> = order(stations).iter().map(|m| stations[*m]).collect();
    let last = ordered.last().copied().filter(|last| *last > 0.0).unwrap_or(1.0);
    let mut before = 0.0;
    let mut stretch = |s: &f64| {
        let own = [0.5 * (s + before) / last, (s - before) / last];
        before = *s;
        own
    };
    ordered.iter().map(&mut stretch).collect()
}

fn alone(holds: usize, hold: usize) -> Vec<f64> {
    (0..holds).map(|i| f64::from(u8::from(i == hold))).collect()
}

fn times(case: &DiagnosisCase, bent: &[f64]) -> Vec<When> {
    let holds = &case.first().dataset.holds;
    let one = |(h, hold): (usize, &Hold)| {
        let (number, pressure) = (h + 1, short(1e-3 * hold.p_act_pa));
        let branch = if hold.phase == Phase::Unload { " on the way down" } else { "" };
        let check = format!(
            "take hold {number} again ({pressure} kPa{branch}), early and late in a run: what belongs to the pressure comes again, \
             what happened once does not"
        );
        let words = format!("in hold {number} alone ({:.0} kPa)", hold.p_act_pa / 1e3);
        When { words, check, time: alone(holds.len(), h) }
    };
    let mut all: Vec<When> = holds.iter().enumerate().map(one).collect();
    let finer = |from: &str| format!("repeat in finer steps of pressure{from} to see where it begins and how it grows");
    let time = bent.iter().map(|b| b * b).collect();
    all.push(When { words: "faster than its bending".into(), check: finer(""), time });
    let mut levels = pressure_levels(holds);
    levels.sort_by(f64::total_cmp);
    // Above the last but one level there is one hold level left, which is in the list already.
    for from in levels.iter().take(levels.len().saturating_sub(2)) {
        let time = holds.iter().map(|h| (h.p_act_pa - from).max(0.0)).collect();
        let check = finer(&format!(" around and above {} kPa", short(1e-3 * from)));
        all.push(When { words: format!("from {:.0} kPa on", from / 1e3), check, time });
    }
    all
}

fn order(stations_m: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..stations_m.len()).collect();
    sort_by(&mut order, |marker| stations_m[*marker]);
    order
}

fn outlines(case: &DiagnosisCase, layout: &Layout, prediction_m: &[f64]) -> Vec<Outline> {
    let order = order(&case.first().scenario.markers_m);
    let centre_m = case.first().scenario.centre_line_m.unwrap_or(case.first().scenario.radius_m);
    let outline = |sample: &[f64]| {
        let mut xy = vec![[0.0; 2]];
        xy.extend(order.iter().map(|m| [sample[2 * m], sample[2 * m + 1]]));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, m)| place[*m] = at + 1);
        let pairs = || xy.windows(2).map(|pair| (pair[0], pair[1]));
        let middle = pairs().map(|(a, b)| [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]))).collect();
        let along = pairs().map(|(a, b)| towards(a, b)).collect();
        let shorter_m = xy.last().map_or(0.0, |tip| if tip[1] < 0.0 { -centre_m } else { centre_m });
        Outline { middle, along, shorter_m, place, xy }
    };
    prediction_m.chunks_exact(2 * layout.markers).map(outline).collect()
}

/// Deflection of the farthest marker per hold, last sample, over the largest.
fn bending(layout: &Layout, prediction_m: &[f64]) -> Vec<f64> {
    let tip = |h: usize| {
        let last = layout.index(h, layout.samples - 1, 0);
        let sample = &prediction_m[last..last + 2 * layout.markers];
        sample.chunks_exact(2).map(|xy| xy[1]).fold(0.0, |a: f64, y| if y.abs() > a.abs() { y } else { a })
    };
    let all: Vec<f64> = (0..layout.holds).map(tip).collect();
    let most = all.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    if most > 0.0 { all.iter().map(|b| b / most).collect() } else { all }
}

/// Displacements of a place at some times, of markers where they were seen.
fn direction(
    case: &DiagnosisCase,
    layout: &Layout,
    outlines: &[Outline],
    place: &PatternPlace,
    time: &[f64],
) -> Vec<f64> {
    let mut all = Vec::with_capacity(layout.values());
    for (sample, outline) in outlines.iter().enumerate() {
        let hold = sample / layout.samples;
        let factor = |marker: usize| if case.first().dataset.is_seen(hold, marker) { time[hold] } else { 0.0 };
        let moved = |marker: usize| displacement(outline, place, marker).map(|d| factor(marker) * d);
        all.extend((0..layout.markers).flat_map(moved));
    }
    all
}

fn displacement(outline: &Outline, place: &PatternPlace, marker: usize) -> [f64; 2] {
    let (xy, at) = (&outline.xy, outline.place[marker]);
    match place {
        PatternPlace::Bend(k) if *k < at => turned([0.0; 2], outline, at, *k, 1.0),
        PatternPlace::Bends(turns) => {
            turns[..at].iter().enumerate().fold([0.0; 2], |sum, (k, turn)| turned(sum, outline, at, k, *turn))
        }
        PatternPlace::Marker(own, d) => d.map(|d| if *own == marker { d } else { 0.0 }),
        PatternPlace::Along(own) if *own == marker => towards(xy[at - 1], xy[(at + 1).min(xy.len() - 1)]),
        PatternPlace::Bend(_) | PatternPlace::Along(_) => [0.0; 2],
        PatternPlace::All(d) => *d,
    }
}

/// A displacement plus the displacement of a point of the outline by a turn at point k before it.
fn turned(sum: [f64; 2], outline: &Outline, at: usize, k: usize, turn: f64) -> [f64; 2] {
    let ([x, y], [x0, y0], [tx, ty]) = (outline.xy[at], outline.middle[k], outline.along[k]);
    let shorter_m = outline.shorter_m;
    [sum[0] - turn * (y - y0 + shorter_m * tx), sum[1] + turn * (x - x0 - shorter_m * ty)]
}

fn towards(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let chord = [0, 1].map(|axis| to[axis] - from[axis]);
    let length = chord[0].hypot(chord[1]);
    if length > 0.0 { chord.map(|c| c / length) } else { [0.0; 2] }
}
