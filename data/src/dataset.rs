//! The measured marker positions of one robot, as a dense tensor.
//!
//! A dataset is the same protocol repeated in several **runs**. A protocol is a sequence of **holds** (pressures kept
//! for a few seconds); in every hold each **marker** is seen `samples_per_hold` times. All lengths are metres, all
//! pressures pascals, all times seconds; units are converted where the file is read and nowhere else.

use crate::error::{DataError, Result};
use crate::header::RowPressures;

/// Whether a hold was reached by raising the actuator pressure, by lowering it, or without changing it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Phase {
    /// The actuator pressure was raised to reach this hold (the first hold of a run counts as `Load`).
    Load,
    /// The actuator pressure is the same as in the hold before.
    Hold,
    /// The actuator pressure was lowered to reach this hold.
    Unload,
}

impl Phase {
    /// The word used in the `phase` column and in JSON: `load`, `hold` or `unload`.
    pub fn word(self) -> &'static str {
        match self {
            Phase::Load => "load",
            Phase::Hold => "hold",
            Phase::Unload => "unload",
        }
    }

    /// The phase of a word, in upper or lower case.
    pub(crate) fn of(word: &str) -> Option<Phase> {
        let all = [Phase::Load, Phase::Hold, Phase::Unload];
        all.into_iter().find(|phase| word.eq_ignore_ascii_case(phase.word()))
    }
}

/// One step of the protocol: constant pressures, the same in every run.
#[derive(Debug, Clone, PartialEq)]
pub struct Hold {
    /// Body gauge pressure p_b \[Pa\], mean over runs of the recorded value.
    pub p_body_pa: f64,
    /// Actuator gauge pressure P \[Pa\], mean over runs of the recorded value; of supply channel 0 where there are more.
    pub p_act_pa: f64,
    /// The same of the supply channels 1, 2, … \[Pa\]; empty where the table has one actuator pressure.
    pub more_act_pa: Vec<f64>,
    /// Whether the hold was reached by loading, by unloading or with equal pressure.
    pub phase: Phase,
    /// 0 for the first hold with these pressures and this phase, 1 for the second, …
    pub occurrence: usize,
    /// Time of each sample since the start of the run \[s\], mean over runs; `samples_per_hold` values.
    pub t_s: Vec<f64>,
}

impl Hold {
    /// Pressures of the body, of channel 0 and of the channels from 1 on, 0 of channels that the table has not.
    pub(crate) fn pressures_pa(&self) -> RowPressures {
        let more = |channel: usize| self.more_act_pa.get(channel).copied().unwrap_or(0.0);
        [self.p_body_pa, self.p_act_pa, more(0), more(1), more(2)]
    }

    /// Pressures of all channels that the table has, channel 0 first \[Pa\].
    pub fn channels_pa(&self) -> impl Iterator<Item = f64> + '_ {
        std::iter::once(self.p_act_pa).chain(self.more_act_pa.iter().copied())
    }

    /// Their sum \[Pa\]: whether it rose or fell is the phase.
    pub fn sum_act_pa(&self) -> f64 {
        self.channels_pa().sum()
    }
}

/// A marker: its label in the file and where it sits on the undeformed robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Label, exactly as written in the `marker` column.
    pub name: String,
    /// Station along the undeformed body from the base \[m\]; `None` if neither the file nor `about.toml` gives it.
    pub station_m: Option<f64>,
}

/// Marker positions of several runs of one protocol.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    /// Short name: the folder name of an embedded set, or the file stem.
    pub name: String,
    /// Actuator kind as written in the `actuator` column, lower case (`spam`, `cpam`, `epam`, `fpam`, …).
    pub actuator: String,
    /// Run labels in order of first appearance.
    pub runs: Vec<String>,
    /// Holds of the protocol in the order of time, the same in every run.
    pub holds: Vec<Hold>,
    /// Markers ordered by station (by first appearance where stations are unknown).
    pub markers: Vec<Marker>,
    /// Samples kept per (run, hold, marker).
    pub samples_per_hold: usize,
    /// Coordinates of a marker: 2 (x, y) or, of a table with z, 3 (x, y, z).
    pub axes: usize,
    /// Positions \[m\], laid out `[run][hold][sample][marker][axis]`; no NaN.
    pub coordinates_m: Vec<f64>,
    /// What a gauge at the actuator read \[Pa\], laid out `[run][hold][sample]`; `None` without one.
    pub gauge_pa: Option<Vec<f64>>,
    /// Cells that a camera lost for a whole hold.
    pub lost: Lost,
    /// Units that the table names for the pressures of actuator and body.
    pub pressure_units: [&'static str; 2],
    /// What reading assumed about the file, in words.
    pub told: Vec<String>,
}

/// Units of the pressures in tables of this program, actuator and body.
pub const IN_KPA: [&str; 2] = ["kPa"; 2];

impl Dataset {
    /// Number of values of one run: holds × samples × markers × axes.
    pub fn values_per_run(&self) -> usize {
        self.holds.len() * self.samples_per_hold * self.markers.len() * self.axes
    }

    /// All values of one run, laid out `[hold][sample][marker][axis]` \[m\].
    pub fn run(&self, run: usize) -> &[f64] {
        let n = self.values_per_run();
        &self.coordinates_m[run * n..(run + 1) * n]
    }

    /// Offset of (hold, sample, marker) inside one run; `+0` is x, `+1` is y, `+2` is z of a table with z.
    pub fn offset(&self, hold: usize, sample: usize, marker: usize) -> usize {
        ((hold * self.samples_per_hold + sample) * self.markers.len() + marker) * self.axes
    }

    /// x and y of one marker in one sample \[m\].
    pub fn xy(&self, run: usize, hold: usize, sample: usize, marker: usize) -> [f64; 2] {
        let i = self.offset(hold, sample, marker);
        let values = self.run(run);
        [values[i], values[i + 1]]
    }

    /// Coordinates of one marker in one sample: x, y and, where the table has it, z \[m\].
    pub fn place(&self, run: usize, hold: usize, sample: usize, marker: usize) -> &[f64] {
        let i = self.offset(hold, sample, marker);
        &self.run(run)[i..i + self.axes]
    }

    /// Whether positions have three coordinates, x, y and z.
    pub fn has_z(&self) -> bool {
        self.axes == 3
    }

    /// The same positions without z, as a camera across the plane of bending sees them.
    pub fn in_plane(&self) -> Dataset {
        let coordinates_m = self.coordinates_m.chunks_exact(self.axes).flat_map(|place| &place[..2]).copied().collect();
        Dataset { axes: 2, coordinates_m, ..self.clone() }
    }

    /// Whether enough runs saw a marker in a hold; positions where they did not stand for nothing.
    pub fn is_seen(&self, hold: usize, marker: usize) -> bool {
        self.lost.unseen.binary_search(&[hold, marker]).is_err()
    }

    /// Whether this run lost a marker for a whole hold, or too few runs saw it there.
    pub fn is_lost(&self, run: usize, hold: usize, marker: usize) -> bool {
        !self.is_seen(hold, marker) || self.lost.filled.binary_search(&[run, hold, marker]).is_ok()
    }

    /// Indices in run layout of the values that stand for nothing, all coordinates of all samples.
    pub fn unseen_values(&self) -> impl Iterator<Item = usize> + '_ {
        let samples = move |cell: &[usize; 2]| {
            let [hold, marker] = *cell;
            (0..self.samples_per_hold).map(move |sample| self.offset(hold, sample, marker))
        };
        self.lost.unseen.iter().flat_map(samples).flat_map(|x| x..x + self.axes)
    }

    /// Readings of one run of the gauge at the actuator, laid out `[hold][sample]` \[Pa\].
    pub fn gauge(&self, run: usize) -> Option<&[f64]> {
        let n = self.holds.len() * self.samples_per_hold;
        self.gauge_pa.as_ref().map(|all| &all[run * n..(run + 1) * n])
    }

    /// Mean over runs, laid out like [`Dataset::run`] \[m\].
    ///
    /// ```
    /// let (dataset, _) = data::load("fem-epam", &mut |_, _| ()).unwrap();
    /// let sum: f64 = (0..dataset.runs.len()).map(|run| dataset.run(run)[0]).sum();
    /// assert!((dataset.mean_over_runs()[0] - sum / dataset.runs.len() as f64).abs() < 1e-15);
    /// ```
    pub fn mean_over_runs(&self) -> Vec<f64> {
        let n = self.values_per_run();
        let mut mean = vec![0.0; n];
        for run in 0..self.runs.len() {
            for (m, v) in mean.iter_mut().zip(self.run(run)) {
                *m += v;
            }
        }
        let runs = self.runs.len().max(1) as f64;
        mean.iter_mut().for_each(|m| *m /= runs);
        mean
    }
}

impl Dataset {
    /// The same dataset, if its parts fit together: for generators and importers that fill the fields themselves.
    ///
    /// # Errors
    /// No run, hold, marker or sample; a wrong number of values or times; a value that is not finite.
    pub fn checked(self) -> Result<Dataset> {
        let empty = self.runs.is_empty() || self.values_per_run() == 0;
        let timed = self.holds.iter().all(|hold| hold.t_s.len() == self.samples_per_hold);
        let gauge = self.gauge_pa.as_deref().unwrap_or_default();
        let times = self.holds.iter().flat_map(|hold| &hold.t_s);
        let finite = self.coordinates_m.iter().chain(times).chain(gauge).all(|value| value.is_finite());
        let expected = self.runs.len() * self.values_per_run();
        let readings = self.runs.len() * self.holds.len() * self.samples_per_hold;
        let wrong = |message: String| {
            let help = "lay coordinates_m out as [run][hold][sample][marker][axis] with 2 or 3 axes, and samples_per_hold times in every hold";
            Err(DataError::of(&self.name, message, help))
        };
        match (empty, timed, finite) {
            (true, ..) => wrong("the dataset has no values".to_string()),
            (_, false, _) => wrong(format!("a hold has not {} sample times", self.samples_per_hold)),
            (.., false) => wrong("a value is not finite".to_string()),
            _ if self.coordinates_m.len() != expected => {
                wrong(format!("expected {expected} values, found {}", self.coordinates_m.len()))
            }
            _ if self.gauge_pa.is_some() && gauge.len() != readings => {
                wrong(format!("expected {readings} readings of the gauge, found {}", gauge.len()))
            }
            _ => Ok(self),
        }
    }
}

/// Which cells of a dataset were not seen.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lost {
    /// (hold, marker) that too few runs saw, in order: left out of everything. The positions there stand for nothing and are the
    /// same in every run.
    pub unseen: Vec<[usize; 2]>,
    /// (run, hold, marker) that this run lost and enough others saw, in order: positions there are made from theirs.
    pub filled: Vec<[usize; 3]>,
    /// Rows of the table without a position: frames in which a marker was not seen.
    pub frames: u64,
}
