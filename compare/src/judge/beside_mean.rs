//! A prediction beside the mean measurement: what every metric starts from.

use crate::error::CompareError;
use crate::layout::Layout;
use crate::noise::NoiseModel;
use crate::policy;
use data::{Dataset, Phase};

/// A prediction f and the mean over runs ȳ of one dataset, with the noise of ȳ. Lengths in metres.
pub struct BesideMean<'a> {
    pub dataset: &'a Dataset,
    /// The noise of their mean.
    pub noise: &'a NoiseModel,
    /// Counts of one run.
    pub layout: Layout,
    /// f − ȳ in run layout.
    pub residual_m: Vec<f64>,
    /// Means over the samples of f, `[hold][marker][x, y]`.
    pub model_means_m: Vec<f64>,
    /// Means over the samples of ȳ, `[hold][marker][x, y]`.
    pub data_means_m: Vec<f64>,
    /// The outermost marker: largest station, or the last one if a station is unknown.
    pub tip: usize,
    /// The outermost marker of each hold that enough runs saw there.
    pub tips: Vec<usize>,
    /// Largest measured |y| of a hold mean, the paper's d_max.
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
        let heights = cells.filter(|&(h, m)| seen(h, m)).map(|(h, m)| data_means_m[(h * layout.markers + m) * 2 + 1]);
        Ok(BesideMean {
            dataset,
            noise,
            layout,
            residual_m: prediction_m.iter().zip(&mean).map(|(f, y)| f - y).collect(),
            model_means_m: layout.hold_means(prediction_m),
            d_max_m: heights.fold(0.0, |d: f64, y| d.max(y.abs())),
            tip: outermost(dataset, &|_| true),
            tips: (0..layout.holds).map(|h| outermost(dataset, &|m| seen(h, m))).collect(),
            data_means_m,
        })
    }

    /// (f, ȳ) of one hold mean, `[x, y]` each.
    pub fn pair(&self, hold: usize, marker: usize) -> ([f64; 2], [f64; 2]) {
        let i = (hold * self.layout.markers + marker) * 2;
        let (f, y) = (&self.model_means_m, &self.data_means_m);
        ([f[i], f[i + 1]], [y[i], y[i + 1]])
    }

    /// f − ȳ of one hold mean, `[x, y]`.
    pub fn error(&self, hold: usize, marker: usize) -> [f64; 2] {
        let (f, y) = self.pair(hold, marker);
        [f[0] - y[0], f[1] - y[1]]
    }

    /// Markers of one hold that enough runs saw there.
    pub fn seen(&self, hold: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.layout.markers).filter(move |marker| self.dataset.is_seen(hold, *marker))
    }

    /// (y of the model, y measured) over the markers of one hold that were seen.
    pub fn deflections(&self, hold: usize) -> (Vec<f64>, Vec<f64>) {
        self.seen(hold).map(|m| self.pair(hold, m)).map(|(f, y)| (f[1], y[1])).unzip()
    }

    /// Whether a hold belongs to the paper's accuracy: under pressure and not on the way down.
    pub fn is_pressurised_loading(&self, hold: usize) -> bool {
        let h = &self.dataset.holds[hold];
        h.phase != Phase::Unload && h.p_act_pa > policy::ZERO_PRESSURE_PA
    }

    /// +1 if the robot bends towards +y, −1 if towards −y: the sign of the largest measured deflection.
    pub fn bend_sign(&self) -> f64 {
        let ys = (0..self.layout.holds).flat_map(|hold| self.deflections(hold).1);
        ys.fold(0.0, |d: f64, y| if y.abs() > d.abs() { y } else { d }).signum()
    }
}

fn outermost(dataset: &Dataset, is_seen: &dyn Fn(usize) -> bool) -> usize {
    let seen = || (0..dataset.markers.len()).filter(|m| is_seen(*m));
    let stations: Option<Vec<f64>> = dataset.markers.iter().map(|m| m.station_m).collect();
    let by_station = stations.and_then(|s| seen().max_by(|&a, &b| s[a].total_cmp(&s[b])));
    by_station.or_else(|| seen().last()).unwrap_or(dataset.markers.len() - 1)
}
