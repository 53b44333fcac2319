//! How positions change with pressure, read off the data themselves.
//!
//! ```text
//! ∂y/∂ln P = P/(P + p₀) ∂y/∂u,    u = ln(P + p₀)
//! ```
//!
//! with the slope of a monotone cubic through the holds of one branch of the protocol (Fritsch & Butland 1984; ends: the
//! parabola through three, cut as in Moler 2004, ch. 3.4). In u, because a robot bends most per pascal while P is about the
//! body's pressure.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P | actuator pressure | Pa |
//! | p₀ | body pressure, no less than a hundredth of the highest P | Pa |
//!
//! Validity: one actuator pressure; two pressures on a branch at least, and crude with three. A model that fits knows better, one that does not fit knows
//! less.

use crate::fit::numbers::mean;
use crate::layout::Layout;
use data::Dataset;

/// Least p₀ over the highest actuator pressure.
const LEAST_SHIFT: f64 = 0.01;
/// Coordinates closer than this are the same pressure.
const SAME: f64 = 1e-6;

/// ∂y/∂ln P of the mean over runs in run layout \[m\], zero in holds without actuator pressure; `None` where no branch has two
/// pressures, or supply channels have different ones.
pub(crate) fn data_slope(dataset: &Dataset) -> Option<Vec<f64>> {
    let layout = Layout::of(dataset).ok().filter(|_| !dataset.channels_differ())?;
    let means = layout.hold_means(&dataset.mean_over_runs());
    let width = layout.axes * layout.markers;
    let top = dataset.holds.iter().fold(0.0, |most: f64, hold| most.max(hold.p_act_pa));
    let shift = |h: usize| dataset.holds[h].p_body_pa.max(LEAST_SHIFT * top);
    let u: Vec<f64> = (0..layout.holds).map(|h| (dataset.holds[h].p_act_pa + shift(h)).ln()).collect();
    let mut slope = vec![0.0; layout.values()];
    let mut known = vec![false; layout.holds];
    for branch in branches(dataset, &u).into_iter().filter(|branch| branch.len() > 1) {
        for k in 0..width {
            let seen =
                |same: &Vec<usize>| same.iter().copied().filter(|h| dataset.is_seen(*h, k / layout.axes)).collect();
            let nodes: Vec<Vec<usize>> = branch.iter().map(seen).filter(|same: &Vec<usize>| !same.is_empty()).collect();
            if nodes.len() < 2 {
                continue;
            }
            let at: Vec<f64> = nodes.iter().map(|same| u[same[0]]).collect();
            let values: Vec<f64> = nodes.iter().map(|same| mean(same.iter().map(|h| means[h * width + k]))).collect();
            for (same, d) in nodes.iter().zip(slopes(&at, &values)) {
                for &h in same.iter().filter(|h| !known[**h]) {
                    let p = dataset.holds[h].p_act_pa;
                    (0..layout.samples).for_each(|s| slope[layout.index(h, s, 0) + k] = p / (p + shift(h)) * d);
                }
            }
        }
        branch.iter().flatten().for_each(|h| known[*h] = true);
    }
    known.contains(&true).then_some(slope)
}

/// Holds of one body pressure with rising or with falling actuator pressure; holds at the same pressure stand together. A hold
/// where the pressure turns ends one branch and begins the next.
fn branches(dataset: &Dataset, u: &[f64]) -> Vec<Vec<Vec<usize>>> {
    let mut all: Vec<Vec<Vec<usize>>> = Vec::new();
    for h in 0..u.len() {
        let same_body = |g: usize| dataset.holds[g].p_body_pa == dataset.holds[h].p_body_pa;
        match all.last_mut() {
            Some(branch) if same_body(branch[0][0]) => {
                let n = branch.len();
                let step = u[h] - u[branch[n - 1][0]];
                if step.abs() < SAME {
                    branch[n - 1].push(h);
                } else if n < 2 || step * (u[branch[n - 1][0]] - u[branch[n - 2][0]]) > 0.0 {
                    branch.push(vec![h]);
                } else {
                    let turn = branch[n - 1].clone();
                    all.push(vec![turn, vec![h]]);
                }
            }
            _ => all.push(vec![vec![h]]),
        }
    }
    all
}

/// Slopes of the monotone cubic at its nodes; two nodes and more.
fn slopes(at: &[f64], values: &[f64]) -> Vec<f64> {
    let lengths: Vec<f64> = at.windows(2).map(|w| w[1] - w[0]).collect();
    let secants: Vec<f64> = values.windows(2).zip(&lengths).map(|(w, l)| (w[1] - w[0]) / l).collect();
    let n = secants.len();
    if n == 1 {
        return vec![secants[0]; 2];
    }
    let mut out = vec![end(lengths[0], lengths[1], secants[0], secants[1])];
    out.extend((1..n).map(|i| between(lengths[i - 1], lengths[i], secants[i - 1], secants[i])));
    out.push(end(lengths[n - 1], lengths[n - 2], secants[n - 1], secants[n - 2]));
    out
}

/// Between two secants over lengths of one sign: their weighted harmonic mean; zero at an extremum.
fn between(before: f64, after: f64, left: f64, right: f64) -> f64 {
    if left * right <= 0.0 {
        return 0.0;
    }
    let (w, v) = (2.0 * after + before, after + 2.0 * before);
    (w + v) / (w / left + v / right)
}

/// At an end: the parabola's slope, of the near secant's sign and no more than three times as steep where it turns.
fn end(near: f64, far: f64, own: f64, next: f64) -> f64 {
    let slope = ((2.0 * near + far) * own - near * next) / (near + far);
    if slope * own <= 0.0 {
        0.0
    } else if own * next <= 0.0 && slope.abs() > 3.0 * own.abs() {
        3.0 * own
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = a ln(P + p₀) is a line in u, on every branch: its slope is a P/(P + p₀), exactly.
    #[test]
    fn a_logarithm_has_its_exact_slope_up_and_down_and_at_every_body_pressure() {
        let scenario = crate::study::published::textbook_scenario("epam").unwrap();
        let protocol =
            [(2e3, 0.0), (2e3, 10e3), (2e3, 30e3), (2e3, 30e3), (2e3, 20e3), (2e3, 0.0), (4e3, 20e3), (4e3, 60e3)];
        let generator = crate::study::Generator {
            runs: 1,
            protocol: protocol.iter().map(|(body, actuator)| [*body, *actuator]).collect(),
            ..Default::default()
        };
        let mut dataset = crate::study::generate(&scenario, "made", &generator).unwrap();
        let width = dataset.values_per_run() / protocol.len();
        // Another height on every branch: no secant may cross from one to another.
        for (h, (body, actuator)) in protocol.iter().enumerate() {
            let height = if h < 6 { 0.0 } else { 1.0 };
            dataset.coordinates_m[h * width..(h + 1) * width].fill(height + 0.1 * (actuator + body).ln());
        }
        let slope = data_slope(&dataset).unwrap();
        for (h, (body, actuator)) in protocol.iter().enumerate() {
            let exact = 0.1 * actuator / (actuator + body);
            assert!(slope[h * width..(h + 1) * width].iter().all(|d| (d - exact).abs() < 1e-9), "hold {h}");
        }
        dataset.holds.truncate(1);
        dataset.coordinates_m.truncate(width);
        assert!(data_slope(&dataset).is_none());
    }

    #[test]
    fn a_line_has_its_slope_and_a_parabola_nearly() {
        let at = [0.5, 1.0, 2.0, 2.5];
        let line: Vec<f64> = at.iter().map(|x| 3.0 * x - 1.0).collect();
        assert!(slopes(&at, &line).iter().all(|d| (d - 3.0).abs() < 1e-12));
        let parabola: Vec<f64> = at.iter().map(|x| x * x).collect();
        for (d, x) in slopes(&at, &parabola).iter().zip(at) {
            assert!((d / (2.0 * x) - 1.0).abs() < 0.12, "{d} at {x}");
        }
        let falling: Vec<f64> = at.iter().map(|x| -x).collect();
        assert!(slopes(&falling, &parabola).iter().zip(at).all(|(d, x)| (d / (2.0 * x) + 1.0).abs() < 0.12));
    }
}
