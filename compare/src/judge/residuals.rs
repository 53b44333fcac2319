//! The residual map, marker × hold, and the directed contrasts that go with it: drift during holds, loading against
//! unloading.
//!
//! Every entry is a linear functional of f − ȳ over its own standard deviation under the noise model (the widened one,
//! see [`crate::noise`]). All of them are corrected together by Holm's procedure, so that among all entries of a right
//! model one is called significant at level α in about a fraction α of all datasets.

use crate::beside_mean::BesideMean;
use crate::fit::numbers::largest;
use crate::layout::{Weights, apply};
use crate::policy;
use crate::stats::{holm, reported_p, two_sided_p};
use serde::Serialize;

/// A signed difference, model minus measurement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviation {
    /// Difference in length, model minus measurement \[mm\].
    pub mm: f64,
    /// In standard deviations of the noise of the mean; `None` if the noise is unknown.
    pub in_noise: Option<f64>,
    /// Two-sided p, corrected for all contrasts of this comparison (Holm), never below 1e-6; 3 runs or more.
    pub p_corrected: Option<f64>,
}

impl Deviation {
    /// Whether it is more than noise: p < α, or above 5 times the noise where no p can be given; `None` if the noise
    /// is unknown.
    pub fn is_significant(&self, alpha: f64) -> Option<bool> {
        match self.p_corrected {
            Some(p) => Some(p < alpha),
            None => self.in_noise.map(|z| z.abs() > policy::MANY_TIMES_THE_NOISE),
        }
    }
}

/// One marker at one hold, means over the samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ResidualCell {
    /// Along the straight robot, away from the base.
    pub x: Deviation,
    /// Across it, the direction of bending.
    pub y: Deviation,
    /// Along z, where the markers have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<Deviation>,
    /// Length of the error vector \[mm\].
    pub norm_mm: f64,
    /// Length of the vector of the standardised errors.
    pub norm_in_noise: Option<f64>,
    /// Enough runs saw the marker in this hold; where not, all else is zero.
    pub seen: bool,
}

impl ResidualCell {
    /// The deviations along x, y and, where the markers have it, z.
    pub fn axes(&self) -> Vec<Deviation> {
        [self.x, self.y].into_iter().chain(self.z).collect()
    }
}

/// A hold as labelled in tables and plots.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HoldLabel {
    /// Actuator pressure, of supply channel 0 where there are several \[kPa\].
    pub p_act_kpa: f64,
    /// Pressures of all supply channels, where there are several \[kPa\].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub p_act_channels_kpa: Vec<f64>,
    /// Body pressure of the hold \[kPa\].
    pub p_body_kpa: f64,
    /// How the hold was reached: `load`, `hold` or `unload`.
    pub phase: &'static str,
    /// 0 for the first hold with these pressures and this phase, 1 for the second, …
    pub occurrence: usize,
}

/// Error in the movement during one hold: late third minus early third of the samples, model minus measurement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Drift {
    /// Index of the hold in the protocol.
    pub hold: usize,
    /// Mean over markers, weighted by the shape of the most bent hold; positive: the model moves on in the bending
    /// direction more than the robot.
    pub deviation: Deviation,
}

/// Error in the gap between unloading and loading at the same pressures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoopGap {
    /// Index of the hold reached by loading.
    pub load_hold: usize,
    /// Index of the hold reached by unloading.
    pub unload_hold: usize,
    /// (f − ȳ) unloading minus loading, weighted like [`Drift`]; negative: the robot stays more bent than the model.
    pub deviation: Deviation,
}

/// The residual map and the directed contrasts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResidualMap {
    /// Holds in protocol order, the columns of the map.
    pub holds: Vec<HoldLabel>,
    /// Rows, ordered as in the data.
    pub markers: Vec<String>,
    /// Index of the marker furthest from the base.
    pub tip: usize,
    /// Differences as `cells[marker][hold]`, means over the samples.
    pub cells: Vec<Vec<ResidualCell>>,
    /// Drift error of each hold; empty with one sample per hold.
    pub drifts: Vec<Drift>,
    /// Loop errors; empty without a matching pair of holds.
    pub loops: Vec<LoopGap>,
    /// Contrasts the p-values are corrected for.
    pub contrasts: usize,
}

/// Compute the residual map of a comparison.
pub fn residual_map(c: &BesideMean) -> ResidualMap {
    let (holds, axes) = (c.layout.holds, c.layout.axes);
    let cells = (0..c.layout.markers)
        .flat_map(|m| (0..holds).flat_map(move |h| (0..axes).map(move |axis| c.layout.mean_weights(h, m, axis))));
    let pairs = loop_pairs(c);
    let mut contrasts: Vec<Weights> = cells.collect();
    let drift_start = contrasts.len();
    let drifting = if c.layout.samples > 1 { holds } else { 0 };
    contrasts.extend((0..drifting).map(|h| drift_weights(c, h, &bending_weights(c, h))));
    contrasts.extend(pairs.iter().map(|&(load, unload)| gap_weights(c, load, unload, &bending_weights(c, load))));
    let deviations = deviations(c, &contrasts);
    let drift = |hold: usize| Drift { hold, deviation: deviations[drift_start + hold] };
    let gap = |(i, &(load_hold, unload_hold)): (usize, &(usize, usize))| LoopGap {
        load_hold,
        unload_hold,
        deviation: deviations[drift_start + drifting + i],
    };
    ResidualMap {
        holds: c.dataset.holds.iter().map(label).collect(),
        markers: c.dataset.markers.iter().map(|m| m.name.clone()).collect(),
        tip: c.tip,
        cells: deviations[..drift_start]
            .chunks(axes * holds)
            .enumerate()
            .map(|(m, row)| row.chunks(axes).enumerate().map(|(h, axes)| cell(axes, c.dataset.is_seen(h, m))).collect())
            .collect(),
        drifts: (0..drifting).map(drift).collect(),
        loops: pairs.iter().enumerate().map(gap).collect(),
        contrasts: contrasts.len(),
    }
}

/// The printed label of a hold.
pub fn label(hold: &data::Hold) -> HoldLabel {
    HoldLabel {
        p_act_kpa: 1e-3 * hold.p_act_pa,
        p_act_channels_kpa: hold.channels_pa().filter(|_| !hold.more_act_pa.is_empty()).map(|p| 1e-3 * p).collect(),
        p_body_kpa: 1e-3 * hold.p_body_pa,
        phase: hold.phase.word(),
        occurrence: hold.occurrence,
    }
}

/// Values, standardised values and jointly corrected p of all contrasts.
fn deviations(c: &BesideMean, contrasts: &[Weights]) -> Vec<Deviation> {
    let values: Vec<f64> = contrasts.iter().map(|w| apply(w, &c.residual_m)).collect();
    let in_noise: Vec<Option<f64>> = contrasts
        .iter()
        .zip(&values)
        .map(|(w, v)| c.noise.test_sd(w).filter(|sd| *sd > 0.0).map(|sd| v / sd))
        .collect();
    let raw: Vec<f64> = in_noise.iter().map(|z| z.map_or(1.0, |z| two_sided_p(z, c.noise.pure_error_dof))).collect();
    let corrected = holm(&raw);
    let p = |i: usize| c.noise.gives_p_values().then(|| reported_p(corrected[i]));
    (0..values.len()).map(|i| Deviation { mm: 1e3 * values[i], in_noise: in_noise[i], p_corrected: p(i) }).collect()
}

fn cell(axes: &[Deviation], seen: bool) -> ResidualCell {
    let (x, y, z) = (axes[0], axes[1], axes.get(2).copied());
    let length =
        |of: &dyn Fn(&Deviation) -> Option<f64>| axes.iter().map(of).try_fold(0.0_f64, |sum, v| Some(sum.hypot(v?)));
    let norm_mm = length(&|d| Some(d.mm)).unwrap_or(0.0);
    ResidualCell { x, y, z, norm_mm, norm_in_noise: length(&|d| d.in_noise), seen }
}

/// Weight of each marker's y and z: the measured shape of the most bent hold, distances from the straight body summing to one. Bending,
/// creep and hysteresis all have about this shape, so it gathers them with the least noise. In space every hold bends its own way, and
/// has its own shape.
fn bending_weights(c: &BesideMean, hold: usize) -> Vec<[f64; 2]> {
    let holds = if c.is_spatial() { hold..hold + 1 } else { 0..c.layout.holds };
    let across = |h, m| {
        let [_, y, z] = c.pair(h, m).1;
        [y, z]
    };
    let shapes = holds.map(|h| (0..c.layout.markers).map(|m| across(h, m)).collect::<Vec<[f64; 2]>>());
    let size = |shape: &Vec<[f64; 2]>| shape.iter().map(|[y, z]| y.hypot(*z)).sum::<f64>();
    let shape = largest(shapes, size).unwrap_or_default();
    match size(&shape) {
        total if total > 1e-9 => shape.iter().map(|across| across.map(|v| v / total)).collect(),
        _ => vec![[1.0 / shape.len().max(1) as f64, 0.0]; shape.len()],
    }
}

/// Coordinates across the body: index of the axis, and the weight of a marker there.
fn across<'w>(c: &BesideMean, weight: &'w [f64; 2]) -> impl Iterator<Item = (usize, f64)> + 'w {
    (1..c.layout.axes).zip(weight.iter().copied())
}

fn drift_weights(c: &BesideMean, hold: usize, shape: &[[f64; 2]]) -> Weights {
    let samples = c.layout.samples;
    let third = (samples / 3).max(1);
    let mut weights = Vec::new();
    for (marker, weight) in shape.iter().enumerate().filter(|(marker, _)| c.dataset.is_seen(hold, *marker)) {
        for (axis, w) in across(c, weight) {
            for k in 0..third {
                weights.push((c.layout.index(hold, samples - 1 - k, marker) + axis, w / third as f64));
                weights.push((c.layout.index(hold, k, marker) + axis, -w / third as f64));
            }
        }
    }
    weights
}

fn gap_weights(c: &BesideMean, load: usize, unload: usize, shape: &[[f64; 2]]) -> Weights {
    let signed = |hold: usize, sign: f64| {
        let seen = move |(m, _): &(usize, &[f64; 2])| [load, unload].iter().all(|h| c.dataset.is_seen(*h, *m));
        let markers = shape.iter().enumerate().filter(seen);
        let each = markers.flat_map(move |(m, weight)| across(c, weight).map(move |(axis, w)| (m, axis, w)));
        let weights = each.flat_map(move |(m, axis, w)| {
            c.layout.mean_weights(hold, m, axis).into_iter().map(move |(i, v)| (i, sign * w * v))
        });
        weights.collect::<Weights>()
    };
    let mut weights = signed(unload, 1.0);
    weights.extend(signed(load, -1.0));
    weights
}

/// Each unloading hold with the latest earlier loading hold at the same pressures.
fn loop_pairs(c: &BesideMean) -> Vec<(usize, usize)> {
    let holds = &c.dataset.holds;
    let matches =
        |l: usize, u: usize| holds[l].phase != data::Phase::Unload && policy::same_pressures(&holds[l], &holds[u]);
    let unloading = (0..holds.len()).filter(|&u| holds[u].phase == data::Phase::Unload);
    unloading.filter_map(|u| (0..u).rev().find(|&l| matches(l, u)).map(|l| (l, u))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_p_value_five_times_the_noise_stands_out() {
        let of = |in_noise, p_corrected| Deviation { mm: 1.0, in_noise, p_corrected }.is_significant(0.01);
        assert_eq!([4.9, 5.1, -5.1].map(|z| of(Some(z), None)), [Some(false), Some(true), Some(true)]);
        assert_eq!(
            (of(Some(9.0), Some(0.02)), of(Some(2.0), Some(0.009)), of(None, None)),
            (Some(false), Some(true), None)
        );
    }
}
