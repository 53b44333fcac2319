//! The shape of one run, `[hold][sample][marker][axis]`, and the linear contrasts taken from it.

use crate::error::CompareError;
use crate::policy;
use data::Dataset;

/// Counts of one run; arrays "in run layout" are flat in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    pub holds: usize,
    pub samples: usize,
    pub markers: usize,
    /// Coordinates of a marker: 2, or 3 with z.
    pub axes: usize,
}

/// A sparse linear functional of one run: (index in the run layout, weight).
pub(crate) type Weights = Vec<(usize, f64)>;

impl Layout {
    /// The layout of a dataset; an error if any count, or the number of runs, is zero or an array is not finite.
    pub fn of(dataset: &Dataset) -> Result<Layout, CompareError> {
        let layout = Layout {
            holds: dataset.holds.len(),
            samples: dataset.samples_per_hold,
            markers: dataset.markers.len(),
            axes: dataset.axes,
        };
        if layout.values() == 0 || dataset.runs.is_empty() {
            return Err(CompareError::told(format!(
                "the dataset `{}` is empty: it needs at least one run, one hold, one marker and one sample",
                dataset.name
            )));
        }
        if dataset.coordinates_m.len() != layout.values() * dataset.runs.len() {
            return Err(layout.wrong_length("the dataset (per run)", dataset.coordinates_m.len() / dataset.runs.len()));
        }
        for run in 0..dataset.runs.len() {
            layout.check("a measured position", dataset.run(run))?;
        }
        Ok(layout)
    }

    /// Values of one run: holds × samples × markers × axes.
    pub fn values(&self) -> usize {
        self.holds * self.samples * self.markers * self.axes
    }

    /// Index of (hold, sample, marker); `+0` is x, `+1` is y, `+2` is z.
    pub fn index(&self, hold: usize, sample: usize, marker: usize) -> usize {
        ((hold * self.samples + sample) * self.markers + marker) * self.axes
    }

    pub fn hold_range(&self, hold: usize) -> std::ops::Range<usize> {
        self.index(hold, 0, 0)..self.index(hold + 1, 0, 0)
    }

    /// An error unless `values` has this layout and is finite and below a kilometre; `what` names the array in the
    /// message.
    pub fn check(&self, what: &'static str, values: &[f64]) -> Result<(), CompareError> {
        if values.len() != self.values() {
            return Err(self.wrong_length(what, values.len()));
        }
        match values.iter().position(|v| !policy::is_a_length(*v)) {
            None => Ok(()),
            Some(i) => Err(CompareError::told(format!(
                "{what} has no usable number at hold {}, marker {} (counted from 1): check the model or the file there \
                 (finite, below 1 km)",
                i / (self.axes * self.markers * self.samples) + 1,
                i / self.axes % self.markers + 1
            ))),
        }
    }

    /// Mean over the samples of each hold: `[hold][marker][axis]`, flat, in the unit of `values`.
    pub fn hold_means(&self, values: &[f64]) -> Vec<f64> {
        let width = self.axes * self.markers;
        let mut means = vec![0.0; self.holds * width];
        for (i, v) in values.iter().enumerate() {
            means[i / (width * self.samples) * width + i % width] += v / self.samples as f64;
        }
        means
    }

    /// The functional "mean over the samples of a hold" of one marker; `axis` 0 is x, 1 is y, 2 is z.
    pub fn mean_weights(&self, hold: usize, marker: usize, axis: usize) -> Weights {
        let weight = 1.0 / self.samples as f64;
        (0..self.samples).map(|s| (self.index(hold, s, marker) + axis, weight)).collect()
    }

    fn wrong_length(&self, what: &'static str, found: usize) -> CompareError {
        let (holds, samples) = (self.holds, self.samples);
        let (markers, axes) = (self.markers, self.axes);
        CompareError::told(format!(
            "{what} has {found} values, one run of the data has {} ({holds} holds x {samples} samples x {markers} markers x {axes}): \
             predict at the holds, sample times and markers of the dataset",
            self.values()
        ))
    }
}

/// Unit weights, one each.
pub(crate) fn single(values: impl IntoIterator<Item = usize>) -> Vec<Weights> {
    values.into_iter().map(|i| vec![(i, 1.0)]).collect()
}

/// Values of one hold in run layout.
pub(crate) fn width(dataset: &Dataset) -> usize {
    dataset.values_per_run() / dataset.holds.len()
}

/// Places of the values of some holds in run layout.
pub(crate) fn values_of(dataset: &Dataset, holds: &[usize]) -> impl Iterator<Item = usize> {
    let width = width(dataset);
    holds.iter().flat_map(move |hold| hold * width..(hold + 1) * width)
}

/// Σ wᵢ vᵢ over sparse weights (i, wᵢ).
pub(crate) fn apply(weights: &[(usize, f64)], values: &[f64]) -> f64 {
    weights.iter().map(|&(i, w)| w * values[i]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hold_means_average_over_samples_only() {
        let layout = Layout { holds: 2, samples: 2, markers: 1, axes: 2 };
        let values = [1.0, 2.0, 3.0, 4.0, 10.0, 20.0, 30.0, 40.0];
        assert_eq!(layout.hold_means(&values), [2.0, 3.0, 20.0, 30.0]);
        assert_eq!(apply(&layout.mean_weights(1, 0, 1), &values), 30.0);
    }

    #[test]
    fn a_wrong_length_or_a_nan_is_named() {
        let layout = Layout { holds: 2, samples: 1, markers: 2, axes: 2 };
        let short = layout.check("the prediction", &[0.0; 3]).unwrap_err().to_string();
        assert!(short.contains("the prediction has 3 values") && short.contains("8"), "{short}");
        let mut values = [0.0; 8];
        values[6] = f64::NAN;
        let nan = layout.check("the prediction", &values).unwrap_err().to_string();
        assert!(nan.contains("hold 2, marker 2"), "{nan}");
    }
}
