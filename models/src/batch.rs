//! Many predictions in one call, results side by side.

use crate::error::Unsolved;
use crate::model::{Model, Prediction, Tip};
use crate::term::Loads;

/// Results of [`Model::predict_batch`]. Make it with [`Model::batch`], use it again and again.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// Markers \[m\], all of the first state, then all of the second …
    pub markers: Vec<[f64; 2]>,
    /// Tip per state.
    pub tips: Vec<Tip>,
    state: Prediction,
}

impl Model {
    /// Buffers for batches of up to `count` states; a larger batch makes them grow once.
    pub fn batch(&self, count: usize) -> Batch {
        let state = self.prediction();
        Batch { markers: Vec::with_capacity(count * state.markers.len()), tips: Vec::with_capacity(count), state }
    }

    /// Predicts one state per item of `loads`, each identical to the bit to [`Model::predict`] at these loads.
    ///
    /// ```
    /// let model = models::Model::new(&models::Scenario::parse(models::shipped("epam").unwrap()).unwrap());
    /// let loads: Vec<_> = (0..31).map(|kpa| models::Loads::uniform(2e3, 1e3 * f64::from(kpa))).collect();
    /// let mut batch = model.batch(loads.len());
    /// model.predict_batch(&loads, &mut batch).unwrap();
    /// assert_eq!((batch.tips.len(), batch.markers.len()), (31, 31 * 6));
    /// ```
    ///
    /// # Errors
    /// The first [`Unsolved`]; the states before it are in `out`, so `out.tips.len()` is the index of the culprit.
    pub fn predict_batch(&self, loads: &[Loads], out: &mut Batch) -> Result<(), Unsolved> {
        out.markers.clear();
        out.tips.clear();
        for item in loads {
            self.predict(item, &mut out.state)?;
            out.markers.extend_from_slice(&out.state.markers);
            out.tips.push(out.state.tip);
        }
        Ok(())
    }
}
