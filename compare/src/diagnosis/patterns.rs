//! Shapes that a misfit may have whatever its cause: what a person looks for in residuals before thinking of physics.
//!
//! A pattern is a place times a time. Places are small rotations at one point of the robot (a kink, a stiffer stretch), one
//! marker by itself, or all markers together; times are one hold by itself, all holds alike, in proportion to the bending or to
//! its square, or from a pressure on. Displacements are first order: what lies beyond a rotated point turns about it and comes
//! nearer, because the far side of the body keeps its length,
//!
//! ```text
//! δx_j = Σ_k c_k [(−(y_j − ȳ_k), x_j − x̄_k) − R t_k]   over the points k before marker j, halfway between neighbours
//! ```
//!
//! with R the distance of the centre line from the far side and t_k the direction of the robot at k.
//!
//! No pattern knows an effect. A misfit along one of them more than along all effects is what "outside the catalogue" means.

use super::case::Case;
use super::look;
use super::shapes::Shape;
use crate::layout::Layout;
use crate::policy;

/// Directions of the image.
const AXES: [(&str, [f64; 2]); 2] = [("x", [1.0, 0.0]), ("y", [0.0, 1.0])];

pub struct Pattern {
    /// What it looks like, to follow "What is left looks as if".
    pub words: String,
    /// What would show it, to follow "Next:".
    pub check: String,
    /// The whole robot bends otherwise at some time: all that a wrong law of a uniform robot can leave. Without it, a place.
    pub is_uniform: bool,
    /// What broke, if this is what something broken looks like.
    pub fault: Option<Fault>,
    /// Its place, as an index into [`Patterns::shapes`].
    pub shape: usize,
    /// When: one factor per hold.
    pub time: Vec<f64>,
}

/// All patterns, and the displacements of their places \[any unit\].
#[derive(Default)]
pub struct Patterns {
    pub all: Vec<Pattern>,
    pub shapes: Vec<Shape>,
}

/// A fault that one pattern tells by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// A place of the robot or a marker, with the times of the bending or none of its own.
    Place,
    /// One hold: a set point that was not reached.
    Hold,
}

enum Place {
    /// A rotation halfway between neighbouring markers, 0 between base and first marker.
    Bend(usize),
    /// Rotations at all of these points.
    Bends(Vec<f64>),
    /// One marker in x or y.
    Marker(usize, [f64; 2]),
    Along(usize),
    /// All markers in x or y.
    All([f64; 2]),
}

/// When: one factor per hold.
type Time = Vec<f64>;

/// A time that singles out holds.
struct When {
    /// To follow what happens then.
    words: String,
    check: String,
    time: Time,
}

/// The robot seen in one sample: base and markers in the order of their stations.
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

/// All patterns for a prediction in run layout \[m\]; none for data of another shape.
pub fn patterns(case: &Case, prediction_m: &[f64]) -> Patterns {
    let Ok(layout) = Layout::of(&case.first().dataset) else { return Patterns::default() };
    let (names, outlines) = (&case.first().dataset.markers, outlines(case, &layout, prediction_m));
    let bent = bending(&layout, prediction_m);
    let stations = order(&case.first().scenario.markers_m);
    let always = vec![1.0; layout.holds];
    let mut found = Patterns::default();
    let place = |place: Place| shape(case, &layout, &outlines, &place);
    let mut add = |words: String, check: String, shape: usize, time: &Time| {
        let fault = (*time == always || *time == bent).then_some(Fault::Place);
        found.all.push(Pattern { words, check, is_uniform: false, fault, shape, time: time.clone() });
    };
    let mut shapes = Vec::new();
    let mut next = |shape: Shape| {
        shapes.push(shape);
        shapes.len() - 1
    };
    // A rotation before the first marker is one of mount or camera, which the catalogue has.
    for k in 1..layout.markers {
        let at = between(&stations, k, |m| &names[m].name);
        let one = next(place(Place::Bend(k)));
        let words = format!("the robot bends otherwise {at} in proportion to its bending");
        add(words, look::stretch(&at), one, &bent);
        add(format!("the robot has a fixed kink {at}"), look::kink(&at), one, &always);
    }
    let along = |f: fn(f64) -> f64| place(Place::Bends(stretches(case).iter().map(|[s, ds]| f(*s) * ds).collect()));
    let steady = next(along(|s| 1.0 - 2.0 * s));
    add("stiffness changes steadily along the robot".into(), look::along(), steady, &bent);
    let middle = next(along(|s| 1.0 - 6.0 * s + 6.0 * s * s));
    add("the robot's middle bends otherwise than its ends".into(), look::along(), middle, &bent);
    for (m, marker) in names.iter().enumerate() {
        let name = &marker.name;
        let station = next(place(Place::Along(m)));
        add(format!("marker {name} sits elsewhere along the robot"), look::station(name), station, &always);
        for (axis, unit) in AXES {
            let words = format!("marker {name} stands alone in {axis}");
            add(words, look::marker(name), next(place(Place::Marker(m, unit))), &always);
        }
    }
    let times = times(case, &bent);
    let tip = next(along(|s| 1.0 - s));
    let images = AXES.map(|(axis, unit)| (axis, next(place(Place::All(unit)))));
    for When { words, check, time } in &times {
        add(format!("something bends the robot from its tip {words}"), look::tip(check), tip, time);
        for (axis, image) in images {
            add(format!("the image shifts in {axis} {words}"), look::image(check), image, time);
        }
    }
    let whole = next(along(|_| 1.0));
    let read = case.is_gauged();
    for (i, When { words, check, time }) in times.into_iter().enumerate() {
        let (words, check) = (format!("the whole robot bends otherwise {words}"), look::whole(&check, read));
        // Single holds come first.
        let fault = (i < layout.holds).then_some(Fault::Hold);
        found.all.push(Pattern { words, check, is_uniform: true, fault, shape: whole, time });
    }
    Patterns { shapes, ..found }
}

/// Uniform bending of every hold by itself, what any law of a uniform robot may do: of the outline, and as the model bends with
/// pressure, which knows stretches without actuator.
pub fn uniform_bending(case: &Case, prediction_m: &[f64]) -> Vec<Vec<f64>> {
    let Ok(layout) = Layout::of(&case.first().dataset) else { return Vec::new() };
    let outlines = outlines(case, &layout, prediction_m);
    let bent = shape(case, &layout, &outlines, &Place::Bends(stretches(case).iter().map(|[_, ds]| *ds).collect()));
    let by_model = |h: usize| {
        let own = layout.hold_range(h);
        let slope = case.noise().directions.iter().enumerate();
        slope.map(|(i, u)| if own.contains(&i) { u[0] } else { 0.0 }).collect()
    };
    let by_outline = |h: usize| bent.direction(&alone(layout.holds, h));
    (0..layout.holds).flat_map(|h| [by_outline(h), by_model(h)]).collect()
}

/// Stretches between neighbouring markers, the first from the base: middle and length over the last station.
fn stretches(case: &Case) -> Vec<[f64; 2]> {
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

fn alone(holds: usize, hold: usize) -> Time {
    (0..holds).map(|i| f64::from(u8::from(i == hold))).collect()
}

/// Times that single out holds, with words; every hold by itself first.
fn times(case: &Case, bent: &Time) -> Vec<When> {
    let holds = &case.first().dataset.holds;
    let mut all: Vec<When> = Vec::new();
    for (h, hold) in holds.iter().enumerate() {
        let (words, check) =
            (format!("in hold {} alone ({:.0} kPa)", h + 1, hold.p_act_pa / 1e3), look::one_hold(h + 1, hold));
        all.push(When { words, check, time: alone(holds.len(), h) });
    }
    let time = bent.iter().map(|b| b * b).collect();
    all.push(When { words: "faster than its bending".into(), check: look::finer(None), time });
    let mut levels: Vec<f64> = Vec::new();
    for p in holds.iter().map(|h| h.p_act_pa).filter(|p| *p > policy::ZERO_PRESSURE_PA) {
        if !levels.iter().any(|l| policy::is_same_pressure(*l, p)) {
            levels.push(p);
        }
    }
    levels.sort_by(f64::total_cmp);
    // Above the last but one level there is one hold level left, which stands alone already.
    for from in levels.iter().take(levels.len().saturating_sub(2)) {
        let time = holds.iter().map(|h| (h.p_act_pa - from).max(0.0)).collect();
        all.push(When { words: format!("from {:.0} kPa on", from / 1e3), check: look::finer(Some(*from)), time });
    }
    all
}

/// Indices of markers by station.
fn order(stations_m: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..stations_m.len()).collect();
    order.sort_by(|a, b| stations_m[*a].total_cmp(&stations_m[*b]));
    order
}

/// Where the k-th point lies, k ≥ 1.
fn between<'a>(order: &[usize], k: usize, name: impl Fn(usize) -> &'a String) -> String {
    format!("between markers {} and {}", name(order[k - 1]), name(order[k]))
}

fn outlines(case: &Case, layout: &Layout, prediction_m: &[f64]) -> Vec<Outline> {
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
fn bending(layout: &Layout, prediction_m: &[f64]) -> Time {
    let tip = |h: usize| {
        let last = layout.index(h, layout.samples - 1, 0);
        let sample = &prediction_m[last..last + 2 * layout.markers];
        sample.chunks_exact(2).map(|xy| xy[1]).fold(0.0, |a: f64, y| if y.abs() > a.abs() { y } else { a })
    };
    let all: Time = (0..layout.holds).map(tip).collect();
    let most = all.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    if most > 0.0 { all.iter().map(|b| b / most).collect() } else { all }
}

/// Of markers where they were seen.
fn shape(case: &Case, layout: &Layout, outlines: &[Outline], place: &Place) -> Shape {
    let beyond = |m: &usize| {
        outlines.first().is_some_and(|outline| match place {
            Place::Bend(k) => outline.place[*m] > *k,
            Place::Marker(own, _) | Place::Along(own) => own == m,
            Place::Bends(_) | Place::All(_) => true,
        })
    };
    let moved: Vec<usize> = (0..layout.markers).filter(beyond).collect();
    Shape::of(layout, &moved, &|sample, marker| match case.first().dataset.is_seen(sample / layout.samples, marker) {
        true => displacement(&outlines[sample], place, marker),
        false => [0.0; 2],
    })
}

fn displacement(outline: &Outline, place: &Place, marker: usize) -> [f64; 2] {
    let (xy, at) = (&outline.xy, outline.place[marker]);
    match place {
        Place::Bend(k) if *k < at => turned([0.0; 2], outline, at, *k, 1.0),
        Place::Bends(turns) => {
            turns[..at].iter().enumerate().fold([0.0; 2], |sum, (k, turn)| turned(sum, outline, at, k, *turn))
        }
        Place::Marker(own, d) => d.map(|d| if *own == marker { d } else { 0.0 }),
        Place::Along(own) if *own == marker => towards(xy[at - 1], xy[(at + 1).min(xy.len() - 1)]),
        Place::Bend(_) | Place::Along(_) => [0.0; 2],
        Place::All(d) => *d,
    }
}

/// A displacement and, on top, that of a point of the outline by a turn at point k before it.
fn turned(sum: [f64; 2], outline: &Outline, at: usize, k: usize, turn: f64) -> [f64; 2] {
    let Outline { xy, middle, along, shorter_m, .. } = outline;
    [
        sum[0] - turn * (xy[at][1] - middle[k][1] + shorter_m * along[k][0]),
        sum[1] + turn * (xy[at][0] - middle[k][0] - shorter_m * along[k][1]),
    ]
}

/// Unit vector from one point to another; zero if they are one.
fn towards(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let chord = [0, 1].map(|axis| to[axis] - from[axis]);
    let length = chord[0].hypot(chord[1]);
    if length > 0.0 { chord.map(|c| c / length) } else { [0.0; 2] }
}
