//! What finite elements say about a robot of which not everything was measured: quantiles over a hypercube of all assumed numbers.
//!
//! Every robot of the hypercube has another value of every assumed number (`hypercube` in `fem::robot`). The 80 % interval of a marker is
//! between the 10 % and the 90 % quantile of what they say. It holds what the numbers may be, by the intervals that were assumed; it does
//! not hold what the finite elements get wrong. Which number to measure first: the shares of the variance, Σ by least squares,
//!
//! ```text
//! y = a + Σ_k b_k u_k + rest        share_k = b_k² var(u_k)/var(y)        swing_k = 0.8 b_k
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | y | height of the outermost marker | mm |
//! | u_k | place of number k in its interval, 0 to 1 | – |
//! | swing_k | what number k does from the tenth to the ninth tenth of its interval | mm |
//!
//! **Validity**: shares of a straight law; the rest is bends of it, couplings and the scatter of folds.

mod of_run;

use crate::policy;
pub use crate::policy::is_same_reading;
use crate::stats::quantile;
use fem::FemError;
use fem::record::RecordShape;
use nalgebra::{DMatrix, DVector};
pub use of_run::Intervals;
use serde::{Deserialize, Serialize};

/// Ends of the reported interval, and its middle.
pub const QUANTILES: [f64; 3] = [0.1, 0.5, 0.9];
/// Runs beyond the numbers that a straight law needs to say anything.
const SPARE: usize = 5;

/// A number of the robot that has an interval because it was not measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Varied {
    /// Key of `[fem]`, with its unit.
    pub name: String,
    /// Ends of its interval in that unit.
    pub interval: [f64; 2],
    /// Its values at a tenth and at nine tenths of that.
    pub tenths: [f64; 2],
    /// Meaning of the key, as the documents state it.
    pub meaning: String,
    /// Source or reason of the interval.
    pub reason: String,
}

/// One robot of the hypercube, with its numbers and its states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Places of the numbers in their intervals, 0 to 1.
    pub shares: Vec<f64>,
    /// What it did; empty if it stopped.
    pub states: Vec<MemberState>,
    /// Reason why its run stopped early, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

/// Markers of a robot at one actuator pressure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MemberState {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Displacements of the sections at the markers, x along the straight robot, y towards the actuator \[mm\].
    pub moved_mm: Vec<[f64; 2]>,
}

/// A Latin hypercube of robots, run with finite elements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Uncertain {
    /// Number of the engine that made it.
    pub engine: u32,
    /// Actuator kind of the scenario, such as `epam`.
    pub actuator: String,
    /// Name of the scenario that is varied.
    pub scenario: String,
    /// Settings that make it another robot than the recommended one, as typed; empty for that one.
    pub variant: String,
    /// Element sizes of body and actuator \[mm\].
    pub mesh_mm: [f64; 2],
    /// Body gauge pressure \[kPa\].
    pub body_kpa: f64,
    /// Stations of the markers along the straight robot \[mm\].
    pub stations_mm: Vec<f64>,
    /// Numbers that were varied, with their intervals.
    pub numbers: Vec<Varied>,
    /// Robots of the hypercube, one per run.
    pub members: Vec<Member>,
}

/// How far one varied number moves the outermost marker.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Weight {
    /// Index of the number in [`Uncertain::numbers`].
    pub number: usize,
    /// From a tenth to nine tenths of its interval \[mm\].
    pub swing_mm: f64,
    /// Share of the variance over all members that this number explains.
    pub share: f64,
}

const RECORD: RecordShape = RecordShape { schema: "ibr.uncertain", version: 1 };

/// Hypercubes of the paper's robots, as `ibr simulate NAME --uncertain` wrote them.
const STORED: &[&str] = &[
    include_str!("../../../assets/uncertain/spam.json"),
    include_str!("../../../assets/uncertain/spam-face.json"),
    include_str!("../../../assets/uncertain/spam-seams.json"),
    include_str!("../../../assets/uncertain/cpam.json"),
    include_str!("../../../assets/uncertain/epam.json"),
    include_str!("../../../assets/uncertain/fpam.json"),
];

/// Hypercubes that come with the program.
///
/// # Errors
/// The errors of [`read`], for a program whose hypercubes were not made again with its records.
pub fn stored() -> Result<Vec<Uncertain>, FemError> {
    STORED.iter().map(|text| read("a hypercube that comes with the program", text)).collect()
}

/// Reads a record.
///
/// # Errors
/// [`FemError::Record`] with the line and the field, or the version.
pub fn read(file: &str, text: &str) -> Result<Uncertain, FemError> {
    RECORD.read(file, text, "make the file again: `ibr simulate ROBOT --uncertain` writes uncertain.json")
}

impl Uncertain {
    /// As it is stored, one robot a line.
    pub fn record(&self) -> String {
        let mut head = RECORD.stamped(&Uncertain { members: Vec::new(), ..self.clone() });
        if let Some(head) = head.as_object_mut() {
            head.remove("members");
        }
        let members: Vec<String> = self.members.iter().filter_map(|m| serde_json::to_string(m).ok()).collect();
        let head = head.to_string();
        format!("{},\n\"members\":[\n{}\n]}}\n", head.trim_end_matches('}'), members.join(",\n"))
    }

    /// Robots that reached a pressure, as what they are there.
    fn at(&self, actuator_kpa: f64) -> Vec<(&Member, &MemberState)> {
        let here = |m: &'_ Member| m.states.iter().position(|s| policy::is_same_reading(s.actuator_kpa, actuator_kpa));
        self.members.iter().filter_map(|m| here(m).map(|k| (m, &m.states[k]))).collect()
    }

    /// Actuator pressures at which states were read, of the longest run \[kPa\].
    pub fn pressures_kpa(&self) -> Vec<f64> {
        let longest = self.members.iter().max_by_key(|m| m.states.len());
        longest.map_or(Vec::new(), |m| m.states.iter().map(|s| s.actuator_kpa).collect())
    }

    /// 10 %, 50 % and 90 % quantile of a marker's displacement along x (0) or y (1) \[mm\]; `None` where nothing was read.
    pub fn quantiles_mm(&self, actuator_kpa: f64, marker: usize, axis: usize) -> Option<[f64; 3]> {
        let found = self.at(actuator_kpa);
        let mut values: Vec<f64> = found.iter().filter_map(|(_, s)| s.moved_mm.get(marker).map(|m| m[axis])).collect();
        values.sort_by(f64::total_cmp);
        let [low, middle, high] = QUANTILES.map(|q| quantile(&values, q));
        Some([low?, middle?, high?])
    }

    /// The same of the outermost marker's height.
    pub fn tip_mm(&self, actuator_kpa: f64) -> Option<[f64; 3]> {
        self.quantiles_mm(actuator_kpa, self.stations_mm.len().checked_sub(1)?, 1)
    }

    /// How many robots [`Uncertain::weights`] needs at least.
    pub fn needed(&self) -> usize {
        self.numbers.len() + SPARE
    }

    /// What every number does to the outermost marker's height at a pressure, largest first, and the share of the variance that a
    /// straight law leaves; `None` with too few robots.
    pub fn weights(&self, actuator_kpa: f64) -> Option<(Vec<Weight>, f64)> {
        let found = self.at(actuator_kpa);
        let last = self.stations_mm.len().checked_sub(1)?;
        let (n, k) = (found.len(), self.numbers.len());
        if n < self.needed() {
            return None;
        }
        let y = DVector::from_iterator(n, found.iter().map(|(_, s)| s.moved_mm.get(last).map_or(f64::NAN, |m| m[1])));
        let design = DMatrix::from_fn(n, k + 1, |i, j| if j == 0 { 1.0 } else { found[i].0.shares[j - 1] });
        let slopes = design.clone().svd(true, true).solve(&y, 1e-12).ok()?;
        let variance = |v: &DVector<f64>| v.variance();
        let all = variance(&y);
        let rest = variance(&(&y - &design * &slopes)) / all;
        let weight = |number: usize| {
            let slope = slopes[number + 1];
            let spread = design.column(number + 1).variance();
            Weight { number, swing_mm: (QUANTILES[2] - QUANTILES[0]) * slope, share: slope * slope * spread / all }
        };
        let mut weights: Vec<Weight> = (0..k).map(weight).collect();
        weights.sort_by(|a, b| b.swing_mm.abs().total_cmp(&a.swing_mm.abs()));
        Some((weights, rest))
    }

    /// Where in its interval one number would have to be for a height of the outermost marker, all others in the middle of theirs, by the
    /// straight law: a calibration, and no prediction; beyond 0 to 1 where no value of the interval does it.
    pub fn share_for(&self, actuator_kpa: f64, number: usize, y_mm: f64) -> Option<f64> {
        let (weights, _) = self.weights(actuator_kpa)?;
        let swing = weights.iter().find(|w| w.number == number)?.swing_mm;
        let slope = swing / (QUANTILES[2] - QUANTILES[0]);
        Some(0.5 + (y_mm - self.tip_mm(actuator_kpa)?[1]) / slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(name: &str) -> Varied {
        Varied {
            name: name.into(),
            interval: [0.0, 8.0],
            tenths: [0.8, 7.2],
            meaning: String::new(),
            reason: String::new(),
        }
    }

    /// Robots whose outermost marker is at 100 + 40 u₀ − 10 u₁ at 30 kPa.
    fn robots(count: usize) -> Uncertain {
        let member = |shares: &Vec<f64>| Member {
            shares: shares.clone(),
            states: vec![MemberState {
                actuator_kpa: 30.0,
                moved_mm: vec![[0.0, 1.0], [-5.0, 100.0 + 40.0 * shares[0] - 10.0 * shares[1]]],
            }],
            stopped: None,
        };
        let even = |i: usize| ((i as f64 + 0.5) / count as f64, (i as f64 * 0.618_033_988_75).fract());
        let mut members: Vec<Member> = (0..count).map(even).map(|(a, b)| member(&vec![a, b])).collect();
        members.push(Member { shares: vec![0.5, 0.5], states: Vec::new(), stopped: Some("turned inside out".into()) });
        Uncertain {
            engine: 0,
            actuator: "epam".into(),
            scenario: "made up".into(),
            variant: String::new(),
            mesh_mm: [8.0, 4.0],
            body_kpa: 2.0,
            stations_mm: vec![30.0, 330.0],
            numbers: vec![number("weld_mm"), number("bond")],
            members,
        }
    }

    #[test]
    fn the_interval_is_that_of_the_law_and_robots_that_stopped_say_nothing() {
        let [low, middle, high] = robots(400).tip_mm(30.0).unwrap();
        // The sum of two even numbers, of which a tenth of the area is below this.
        let exact = 90.0 + (0.1_f64 * 2.0 * 40.0 * 10.0).sqrt();
        assert!((low - exact).abs() < 0.5 && (high - (230.0 - exact)).abs() < 0.5, "{low} {exact} {high}");
        assert!((middle - 115.0).abs() < 0.5, "{middle}");
        assert_eq!(robots(400).tip_mm(20.0), None);
    }

    #[test]
    fn a_straight_law_is_told_with_its_slopes_and_leaves_nothing() {
        let (weights, rest) = robots(30).weights(30.0).unwrap();
        assert_eq!((weights[0].number, weights[1].number), (0, 1));
        assert!((weights[0].swing_mm - 32.0).abs() < 1e-9 && (weights[1].swing_mm + 8.0).abs() < 1e-9, "{weights:?}");
        assert!(rest < 1e-18);
        assert!(robots(6).weights(30.0).is_none(), "too few to say");
    }

    #[test]
    fn a_record_of_another_version_or_without_a_field_is_refused_by_its_name() {
        let text = robots(5).record();
        let refused = |text: &str| read("R/uncertain.json", text).unwrap_err().to_string();
        assert_eq!(read("R/uncertain.json", &text).unwrap(), robots(5));
        assert!(refused(&text.replace("\"version\":1", "\"version\":7")).contains("version 7"));
        assert!(refused(&text.replace("stations_mm", "stations")).contains("stations_mm"));
        assert!(refused(&text[..text.len() / 2]).contains("cut short"));
    }

    #[test]
    fn what_comes_with_the_program_can_be_read_and_most_of_its_robots_ran() {
        for cube in stored().unwrap() {
            let ran = cube.members.iter().filter(|m| m.stopped.is_none()).count();
            assert!(ran >= 10 && 5 * ran >= 4 * cube.members.len() && cube.tip_mm(30.0).is_some(), "{}", cube.scenario);
        }
    }
}
