//! A prediction next to the mean measurement: what every metric starts from.

use crate::error::CompareError;
use crate::fit::numbers::{differences, largest};
use crate::layout::Layout;
use crate::noise::NoiseModel;
use crate::policy;
use data::{Dataset, Phase};

/// A prediction f and the mean over runs ȳ of one dataset, with the noise of ȳ. Lengths in metres.
pub struct BesideMean<'a> {
    pub dataset: &'a Dataset,
    pub noise: &'a NoiseModel,
    pub layout: Layout,
    /// f − ȳ in run layout.
    pub residual_m: Vec<f64>,
    /// Means over the samples of f, `[hold][marker][axis]`.
    pub model_means_m: Vec<f64>,
    /// Means over the samples of ȳ, `[hold][marker][axis]`.
    pub data_means_m: Vec<f64>,
    /// The outermost marker: largest station, or the last one if a station is unknown.
    pub tip: usize,
    /// The outermost marker of each hold that enough runs saw there.
    pub tips: Vec<usize>,
    /// Largest distance of a measured hold mean from the straight body: |y|, the paper's d_max, in space √(y² + z²).
    pub d_max_m: f64,
}

impl<'a> BesideMean<'a> {
    /// Pair a prediction in run layout with the data; an error if shapes differ or a value is not finite.
    pub fn new(
        dataset: &'a Dataset,
        noise: &'a NoiseModel,
        prediction_m: &[f64],
    ) -> Result<BesideMean<'a>, CompareError> {
        let layout = Layout::of(dataset)?;
        layout.check("the prediction", prediction_m)?;
        let mean = dataset.mean_over_runs();
        let data_means_m = layout.hold_means(&mean);
        let seen = |hold: usize, marker: usize| dataset.is_seen(hold, marker);
        let cells = (0..layout.holds).flat_map(|h| (0..layout.markers).map(move |m| (h, m)));
        let across = |[_, y, z]: [f64; 3]| y.hypot(z);
        let heights = cells.filter(|&(h, m)| seen(h, m)).map(|(h, m)| across(place(&data_means_m, &layout, h, m)));
        Ok(BesideMean {
            dataset,
            noise,
            layout,
            residual_m: differences(prediction_m, &mean),
            model_means_m: layout.hold_means(prediction_m),
            d_max_m: heights.fold(0.0, f64::max),
            tip: outermost(dataset, &|_| true),
            tips: (0..layout.holds).map(|h| outermost(dataset, &|m| seen(h, m))).collect(),
            data_means_m,
        })
    }

    /// (f, ȳ) of one hold mean, `[x, y, z]` each, z being 0 in the plane.
    pub fn pair(&self, hold: usize, marker: usize) -> ([f64; 3], [f64; 3]) {
        let of = |means_m| place(means_m, &self.layout, hold, marker);
        (of(&self.model_means_m), of(&self.data_means_m))
    }

    /// f − ȳ of one hold mean, `[x, y, z]`.
    pub fn error(&self, hold: usize, marker: usize) -> [f64; 3] {
        let (f, y) = self.pair(hold, marker);
        std::array::from_fn(|axis| f[axis] - y[axis])
    }

    /// Whether markers have a third coordinate.
    pub fn is_spatial(&self) -> bool {
        self.layout.axes == 3
    }

    /// Markers of one hold that enough runs saw there.
    pub fn seen(&self, hold: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.layout.markers).filter(move |marker| self.dataset.is_seen(hold, *marker))
    }

    /// (y of the model, y measured) over the markers of one hold that were seen; none in space, because the paper's accuracy is of one
    /// plane.
    pub fn deflections(&self, hold: usize) -> (Vec<f64>, Vec<f64>) {
        self.seen(hold).filter(|_| !self.is_spatial()).map(|m| self.pair(hold, m)).map(|(f, y)| (f[1], y[1])).unzip()
    }

    /// Whether a hold belongs to the paper's accuracy: under pressure and not on the way down.
    pub fn is_pressurised_loading(&self, hold: usize) -> bool {
        let h = &self.dataset.holds[hold];
        h.phase != Phase::Unload && h.sum_act_pa() > policy::ZERO_PRESSURE_PA
    }

    /// +1 if the robot bends towards +y, −1 if towards −y: the sign of the largest measured deflection.
    pub fn bend_sign(&self) -> f64 {
        let ys = (0..self.layout.holds).flat_map(|hold| self.deflections(hold).1);
        ys.fold(0.0, |d: f64, y| if y.abs() > d.abs() { y } else { d }).signum()
    }
}

fn place(means_m: &[f64], layout: &Layout, hold: usize, marker: usize) -> [f64; 3] {
    let at = (hold * layout.markers + marker) * layout.axes;
    std::array::from_fn(|axis| if axis < layout.axes { means_m[at + axis] } else { 0.0 })
}

fn outermost(dataset: &Dataset, is_seen: &dyn Fn(usize) -> bool) -> usize {
    let seen = || (0..dataset.markers.len()).filter(|m| is_seen(*m));
    let stations: Option<Vec<f64>> = dataset.markers.iter().map(|m| m.station_m).collect();
    let by_station = stations.and_then(|s| largest(seen(), |marker| s[*marker]));
    by_station.or_else(|| seen().last()).unwrap_or(dataset.markers.len() - 1)
}
