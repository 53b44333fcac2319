//! The missing moment that an explanation predicts: what the base would miss at the bends of a robot that has it.

use crate::error::CompareError;
use models::{Loads, Model, Prediction, Scenario, Step};

/// Stretches into which a robot is cut for a curve: what varies along the body is averaged over them.
const STRETCHES: usize = 24;

/// Pressures that an explanation is followed through.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PressurePath {
    pub p_body_pa: f64,
    /// Actuator pressures on the way up or down \[Pa\].
    pub p_act_pa: Vec<f64>,
    /// Pressure from which they are reached: none on the way up, the highest on the way down \[Pa\].
    pub from_pa: Option<f64>,
    /// Time that each is held \[s\].
    pub wait_s: f64,
}

/// Bend \[1/m\] and missing moment \[N·m\], mean over the body where it has actuators; NaN where there is none.
pub(crate) type CurvePoint = [f64; 2];

/// What the base misses at the bends of another robot, at every pressure of a path.
pub(crate) fn curve(base: &Scenario, other: &Scenario, path: &PressurePath) -> Result<Vec<CurvePoint>, CompareError> {
    let cuts: Vec<f64> = (1..STRETCHES).map(|i| base.length_m * i as f64 / STRETCHES as f64).collect();
    let [base, other] = [base, other].map(|scenario| Model::in_pieces(scenario, &cuts));
    let (mut of_base, mut of_other) = (base.prediction(), other.prediction());
    let mut points = Vec::with_capacity(path.p_act_pa.len());
    for p in &path.p_act_pa {
        let steps = steps(path, *p);
        let mut bends: Vec<Vec<f64>> = Vec::new();
        let keep = &mut |_: usize, at: &Prediction| bends.push(other.states(at).iter().map(|s| s.curvature).collect());
        if other.follow(&steps, &mut of_other, keep).is_err() {
            points.push([f64::NAN; 2]);
            continue;
        }
        let mut missing = Vec::new();
        base.hold(&steps, &bends, &mut of_base, &mut |_, at| missing = at.missing_moments().to_vec())?;
        points.push(mean(&base, &bends[bends.len() - 1], &missing));
    }
    Ok(points)
}

/// What the base misses where its actuators bend it all along by a turn of the tip; `None` where they cannot.
pub(crate) fn at_turn(base: &Scenario, loads: &Loads, turn_rad: f64) -> Option<CurvePoint> {
    let model = Model::new(base);
    let of = |i: usize, bend: f64| if model.is_active(i) { bend } else { 0.0 };
    let count = model.segments().len();
    let active_m: f64 = (0..count).map(|i| of(i, model.segments()[i].length_m)).sum();
    let bends: Vec<f64> = (0..count).map(|i| of(i, turn_rad / active_m)).collect();
    let (mut missing, mut at) = (Vec::new(), model.prediction());
    let step = [Step { t_s: 0.0, loads: *loads }];
    model
        .hold(&step, std::slice::from_ref(&bends), &mut at, &mut |_, at| missing = at.missing_moments().to_vec())
        .ok()?;
    Some(mean(&model, &bends, &missing)).filter(|point| point.iter().all(|v| v.is_finite()))
}

/// The pressure from where it is reached, and after the time that it is held.
fn steps(path: &PressurePath, p_act_pa: f64) -> Vec<Step> {
    let step = |t_s: f64, p: f64| Step { t_s, loads: Loads::uniform(path.p_body_pa, p) };
    match path.from_pa {
        None => vec![step(0.0, p_act_pa), step(path.wait_s, p_act_pa)],
        Some(from) => {
            [(0.0, from), (1.0, from), (1.0, p_act_pa), (2.0, p_act_pa)].map(|(t, p)| step(t * path.wait_s, p)).to_vec()
        }
    }
}

fn mean(model: &Model, bends: &[f64], missing: &[f64]) -> CurvePoint {
    let mut sums = [0.0; 3];
    for (i, segment) in model.segments().iter().enumerate() {
        if model.is_active(i) && missing[i].is_finite() {
            let h = segment.length_m;
            sums = [sums[0] + h * bends[i], sums[1] + h * missing[i], sums[2] + h];
        }
    }
    [sums[0] / sums[2], sums[1] / sums[2]]
}

/// Half-widths of the band that some shifted curves span about a curve: their distances across it, added in squares.
pub(crate) fn band(curve: &[CurvePoint], shifted: &[Vec<CurvePoint>]) -> Vec<f64> {
    let slope = |i: usize| {
        let (low, high) = (i.saturating_sub(1), (i + 1).min(curve.len() - 1));
        let run = curve[high][0] - curve[low][0];
        if run == 0.0 { 0.0 } else { (curve[high][1] - curve[low][1]) / run }
    };
    let across = |i: usize| {
        let away = |other: &Vec<CurvePoint>| other[i][1] - curve[i][1] - slope(i) * (other[i][0] - curve[i][0]);
        shifted.iter().map(away).filter(|d| d.is_finite()).map(|d| d * d).sum::<f64>().sqrt()
    };
    (0..curve.len()).map(across).collect()
}
