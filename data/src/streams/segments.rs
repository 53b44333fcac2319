//! Streams of (run, marker), cut into holds.

use crate::dataset::Phase;
use crate::error::DataError;
use crate::header::{PRESSURES, RowPressures};
use crate::policy::{tolerance_act_pa, tolerance_body_pa};
use crate::rows::Observation;

/// Whether pressures are within so many tolerances of the first.
pub(crate) fn are_near(of: RowPressures, other: RowPressures, tolerances: f64) -> bool {
    let tolerance = |k: usize| if k == 0 { tolerance_body_pa(of[0]) } else { tolerance_act_pa(of[k]) };
    (0..of.len()).all(|k| (other[k] - of[k]).abs() <= tolerances * tolerance(k))
}

/// Samples kept per (run, hold, marker) before neighbours are merged; above the few that `Dataset` holds, far below a
/// camera's frames.
const MOST_SAMPLES: usize = 64;

#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SampleSums {
    pub count: u64,
    /// Time \[s\], x, y, z \[m\] (0 of a table without z), and what the gauge read \[Pa\].
    sums: [f64; 5],
}

impl SampleSums {
    fn mean(&self, which: usize) -> f64 {
        self.sums[which] / self.count.max(1) as f64
    }

    pub(crate) fn t_s(&self) -> f64 {
        self.mean(0)
    }

    pub(crate) fn place(&self) -> [f64; 3] {
        [1, 2, 3].map(|which| self.mean(which))
    }

    pub(crate) fn gauge_pa(&self) -> f64 {
        self.mean(4)
    }

    pub(crate) fn add(&mut self, other: SampleSums) {
        self.count += other.count;
        self.sums.iter_mut().zip(other.sums).for_each(|(sum, value)| *sum += value);
    }
}

/// One hold as one marker saw it.
#[derive(Debug, Clone)]
pub(crate) struct HoldSegment {
    pub phase: Phase,
    pub first_line: u64,
    pub samples: Vec<SampleSums>,
    pub rows: u64,
    /// The first actuator pressure and the last \[Pa\].
    pub ends_pa: [f64; 2],
    /// The first reading below its bounds, in the order of [`PRESSURES`], to be judged by the mean.
    pub too_low: [Option<DataError>; PRESSURES.len()],
    /// Observations per sample; doubles whenever neighbours are merged.
    pub(super) stride: u64,
    sums_pa: RowPressures,
}

impl HoldSegment {
    pub(super) fn new(row: &Observation, line: u64) -> HoldSegment {
        HoldSegment {
            phase: row.phase,
            first_line: line,
            samples: Vec::new(),
            rows: 0,
            ends_pa: [row.pressures_pa[1]; 2],
            too_low: Default::default(),
            stride: 1,
            sums_pa: RowPressures::default(),
        }
    }

    pub(crate) fn p_act_pa(&self) -> f64 {
        self.means_pa()[1]
    }

    /// Mean over the rows of every pressure \[Pa\].
    pub(crate) fn means_pa(&self) -> RowPressures {
        self.sums_pa.map(|sum| sum / self.rows.max(1) as f64)
    }

    pub(crate) fn first_t_s(&self) -> f64 {
        self.samples.first().map_or(f64::INFINITY, SampleSums::t_s)
    }

    pub(crate) fn last_t_s(&self) -> f64 {
        self.samples.last().map_or(f64::NEG_INFINITY, SampleSums::t_s)
    }

    pub(super) fn continues_with(&self, row: &Observation) -> bool {
        row.phase == self.phase && are_near(self.means_pa(), row.pressures_pa, 1.0)
    }

    /// Takes in a later segment of one row: a single reading that departed and came back is noise.
    fn absorb(&mut self, one: HoldSegment) {
        self.rows += one.rows;
        self.sums_pa.iter_mut().zip(one.sums_pa).for_each(|(sum, other)| *sum += other);
        one.samples.into_iter().for_each(|sample| self.push(sample));
        let low = self.too_low.iter_mut().zip(one.too_low);
        low.for_each(|(own, other)| *own = own.take().or(other));
    }

    /// Takes samples out, and returns how many rows they were.
    pub(crate) fn take_out(&mut self, is_out: impl Fn(&SampleSums) -> bool) -> u64 {
        let gone: u64 = self.samples.iter().filter(|sample| is_out(sample)).map(|sample| sample.count).sum();
        if gone > 0 {
            // Pressures stay what they are on average.
            let left = (self.rows - gone) as f64 / self.rows as f64;
            self.sums_pa = self.sums_pa.map(|sum| left * sum);
            self.rows -= gone;
            self.samples.retain(|sample| !is_out(sample));
        }
        gone
    }

    pub(super) fn add(&mut self, row: &Observation) {
        self.rows += 1;
        self.sums_pa.iter_mut().zip(row.pressures_pa).for_each(|(sum, pressure_pa)| *sum += pressure_pa);
        self.ends_pa[1] = row.pressures_pa[1];
        let [z_m, gauge_pa] = [row.z_m, row.gauge_pa].map(|value| value.unwrap_or(0.0));
        self.push(SampleSums { count: 1, sums: [row.t_s, row.x_m, row.y_m, z_m, gauge_pa] });
    }

    fn push(&mut self, one: SampleSums) {
        match self.samples.last_mut() {
            Some(last) if last.count < self.stride => last.add(one),
            _ => self.samples.push(one),
        }
        if self.samples.len() > MOST_SAMPLES {
            self.stride *= 2;
            self.samples = self.samples.chunks(2).map(merged).collect();
        }
    }
}

pub(crate) fn merged(samples: &[SampleSums]) -> SampleSums {
    let mut all = SampleSums::default();
    samples.iter().for_each(|sample| all.add(*sample));
    all
}

/// The observations of one marker in one run.
#[derive(Debug)]
pub(crate) struct Stream {
    pub run: usize,
    pub marker: usize,
    pub first_line: u64,
    pub first_t_s: f64,
    pub segments: Vec<HoldSegment>,
    pub(super) last_t_s: f64,
}

impl Stream {
    /// Puts a last segment of one row back into the one before, if this row goes on there: the reading was noise.
    pub(super) fn take_back(&mut self, row: &Observation) {
        let [.., before, last] = self.segments.as_slice() else { return };
        let noise = last.rows == 1 && last.phase == before.phase && are_near(before.means_pa(), last.means_pa(), 2.0);
        if noise && before.continues_with(row) && !last.continues_with(row) {
            let one = self.segments.pop();
            self.segments.last_mut().zip(one).into_iter().for_each(|(before, one)| before.absorb(one));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(t_s: f64, p_act_pa: f64) -> Observation<'static> {
        let (run, marker, phase) = ("1", "1", Phase::Load);
        let (x_m, y_m, gauge_pa) = (2.0 * t_s, -t_s, Some(3.0 * t_s));
        let (z_m, pressures_pa) = (Some(4.0 * t_s), [2000.0, p_act_pa, 0.0, 0.0, 0.0]);
        Observation { run, marker, phase, t_s, pressures_pa, x_m, y_m, z_m, station_m: None, gauge_pa }
    }

    #[test]
    fn a_hold_ends_when_a_pressure_leaves_its_tolerance() {
        let mut segment = HoldSegment::new(&row(0.0, 20_000.0), 1);
        segment.add(&row(0.0, 20_000.0));
        assert!(segment.continues_with(&row(1.0, 20_999.0)) && !segment.continues_with(&row(1.0, 21_001.0)));
        segment = HoldSegment::new(&row(0.0, 0.0), 1);
        segment.add(&row(0.0, 0.0));
        assert!(segment.continues_with(&row(1.0, 499.0)) && !segment.continues_with(&row(1.0, 501.0)));
        let body = |p_body_pa: f64, p_act_pa: f64| {
            let mut other = row(1.0, p_act_pa);
            other.pressures_pa[0] = p_body_pa;
            other
        };
        assert!(segment.continues_with(&body(2199.0, 0.0)) && !segment.continues_with(&body(2201.0, 0.0)));
        let other_phase = Observation { phase: Phase::Unload, ..row(1.0, 20_000.0) };
        assert!(!segment.continues_with(&other_phase) && !segment.continues_with(&body(2201.0, 20_000.0)));
        for channel in 0..3 {
            let mut other = row(1.0, 0.0);
            other.pressures_pa[2 + channel] = 501.0;
            assert!(!segment.continues_with(&other), "{channel}");
        }
    }

    #[test]
    fn at_most_64_samples_are_kept_and_none_is_lost() {
        for rows in [1_u64, 64, 65, 1000, 12_345] {
            let mut segment = HoldSegment::new(&row(0.0, 0.0), 1);
            (0..rows).for_each(|i| segment.add(&row(i as f64, 0.0)));
            let sum = (rows * (rows - 1) / 2) as f64;
            assert!(segment.samples.len() <= MOST_SAMPLES && segment.samples.len() as u64 >= rows.min(32));
            let sums = [sum, 2.0 * sum, -sum, 4.0 * sum, 3.0 * sum];
            assert_eq!(merged(&segment.samples), SampleSums { count: rows, sums });
            let full = &segment.samples[..segment.samples.len() - 1];
            assert!(full.iter().all(|sample| sample.count == segment.stride), "equal counts but for the last");
        }
    }
}
