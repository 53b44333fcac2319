//! Many predictions in one call, results side by side.

use crate::error::{Solved, Unsolved};
use crate::model::{Model, Prediction, Tip};
use crate::term::Loads;

/// Results of [`Model::predict_batch`]. Make it with [`Model::batch`], use it again and again.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// Markers \[m\], all of the first state, then all of the second …
    pub markers: Vec<[f64; 2]>,
    /// Their z \[m\] in the same order, of a robot in space; empty of a planar one.
    pub markers_z_m: Vec<f64>,
    /// Pose of the end of the centre line, one per state.
    pub tips: Vec<Tip>,
    /// One set of buffers per thread.
    states: Vec<Prediction>,
}

struct BatchShare<'a> {
    first: usize,
    loads: &'a [Loads],
    markers: &'a mut [[f64; 2]],
    z_m: &'a mut [f64],
    tips: &'a mut [Tip],
}

impl Model {
    /// Buffers for batches of up to `count` states on `threads` threads (at least one); a larger batch makes them grow
    /// once.
    pub fn batch(&self, count: usize, threads: usize) -> Batch {
        let states = vec![self.prediction(); threads.max(1)];
        let in_space = if self.is_spatial() { count * self.marker_count() } else { 0 };
        Batch {
            markers: Vec::with_capacity(count * self.marker_count()),
            markers_z_m: Vec::with_capacity(in_space),
            tips: Vec::with_capacity(count),
            states,
        }
    }

    /// Predicts one state per item of `loads`, each identical to the bit to [`Model::predict`] at these loads, whatever
    /// the number of threads. On one thread it allocates nothing.
    ///
    /// ```
    /// let model = models::Model::new(&models::Scenario::parse(models::shipped("epam-textbook").unwrap()).unwrap());
    /// let loads: Vec<_> = (0..31).map(|kpa| models::Loads::uniform(2e3, 1e3 * f64::from(kpa))).collect();
    /// let mut batch = model.batch(loads.len(), 1);
    /// model.predict_batch(&loads, &mut batch).unwrap();
    /// assert_eq!((batch.tips.len(), batch.markers.len()), (31, 31 * 6));
    /// ```
    ///
    /// # Errors
    /// The first [`Unsolved`]; the states before it are in `out`, so `out.tips.len()` is the index of the culprit.
    pub fn predict_batch(&self, loads: &[Loads], out: &mut Batch) -> Solved {
        out.markers.resize(loads.len() * self.marker_count(), [0.0; 2]);
        out.markers_z_m.resize(loads.len() * self.heights_each(), 0.0);
        out.tips.resize(loads.len(), Tip::default());
        let whole =
            BatchShare { first: 0, loads, markers: &mut out.markers, z_m: &mut out.markers_z_m, tips: &mut out.tips };
        let failed = match out.states.as_mut_slice() {
            [state] => self.predict_part(whole, state),
            states => self.predict_parts(whole, states),
        };
        let Err((index, error)) = failed else { return Ok(()) };
        out.markers.truncate(index * self.marker_count());
        out.markers_z_m.truncate(index * self.heights_each());
        out.tips.truncate(index);
        Err(error)
    }

    fn heights_each(&self) -> usize {
        if self.is_spatial() { self.marker_count() } else { 0 }
    }

    /// Equal parts, one per thread; of several failures the first counts.
    fn predict_parts(&self, whole: BatchShare, states: &mut [Prediction]) -> Result<(), (usize, Unsolved)> {
        let size = whole.loads.len().div_ceil(states.len()).max(1);
        let mut markers = whole.markers.chunks_mut((size * self.marker_count()).max(1));
        let mut z_m = whole.z_m.chunks_mut((size * self.heights_each()).max(1));
        let each = whole.loads.chunks(size).zip(whole.tips.chunks_mut(size)).zip(states).enumerate();
        std::thread::scope(|scope| {
            let mut running = Vec::with_capacity(each.len());
            for (k, ((loads, tips), state)) in each {
                let (markers, z_m) = (markers.next().unwrap_or_default(), z_m.next().unwrap_or_default());
                let part = BatchShare { first: k * size, loads, markers, z_m, tips };
                running.push(scope.spawn(move || self.predict_part(part, state)));
            }
            // A panic of a part is passed on.
            running
                .into_iter()
                .try_for_each(|part| part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        })
    }

    fn predict_part(&self, part: BatchShare, state: &mut Prediction) -> Result<(), (usize, Unsolved)> {
        let count = self.marker_count();
        for (i, (item, tip)) in part.loads.iter().zip(part.tips).enumerate() {
            self.settle(item, state, false).map_err(|error| (part.first + i, error))?;
            let own = i * count..(i + 1) * count;
            if self.is_spatial() {
                self.see(state);
                part.markers[own.clone()].copy_from_slice(&state.markers);
                part.z_m[own].copy_from_slice(&state.markers_z_m);
            } else {
                self.sight(&state.work, &mut part.markers[own]);
            }
            *tip = state.tip;
        }
        Ok(())
    }
}
