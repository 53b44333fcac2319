//! What is read of a robot while it runs, and how it is told.

use crate::commands::tables::table;
use fem::robot::{Gauge, Hold, KEYS, Key, Reading, RobotRun, Snap, Watch, snaps};
use fem::{FemError, Problem, Simulation};
use models::{Scenario, scenario::Wall};
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

const MM: f64 = 1e3;
/// A hold this near to the present counts as reached \[s\].
const NOW_S: f64 = 1e-12;

/// A robot and how to read it.
#[derive(Clone)]
pub struct Robot {
    /// Its scenario.
    pub scenario: Scenario,
    /// Its run.
    pub run: RobotRun,
    gauge: Gauge,
}

impl Robot {
    /// For its problem.
    pub fn new(scenario: &Scenario, run: &RobotRun, problem: &Problem) -> Result<Robot, FemError> {
        Ok(Robot { scenario: scenario.clone(), run: run.clone(), gauge: Gauge::new(scenario, problem)? })
    }

    /// What the scenario says to the reduced model alone.
    pub fn left_out(&self) -> Option<String> {
        let effects = self.scenario.effects.iter().map(|e| e.name.clone());
        let wall = self.scenario.wall != Wall::default();
        let names: Vec<String> = wall.then(|| "[body] wall_…".into()).into_iter().chain(effects).collect();
        let text = format!("read by the reduced model alone, not by finite elements: {}", names.join(", "));
        (!names.is_empty()).then_some(text)
    }

    /// Starts to watch a run.
    pub fn watch(&self, problem: &Problem) -> Watched {
        let holds = self.run.holds().into_iter().filter(|hold| hold.time_s <= problem.settings.end_s + NOW_S);
        Watched {
            filled_s: self.run.settings.body_ramp_s,
            gauge: self.gauge.clone(),
            holds: holds.collect(),
            readings: Vec::new(),
            watch: Watch::new(&problem.mesh),
        }
    }
}

/// Readings of a run so far.
pub struct Watched {
    /// Energies between outputs.
    pub watch: Watch,
    filled_s: f64,
    gauge: Gauge,
    holds: Vec<Hold>,
    /// Readings so far.
    pub readings: Vec<Reading>,
}

impl Watched {
    /// When the robot is to be read next \[s\].
    pub fn next_s(&self) -> Option<f64> {
        self.holds.get(self.readings.len()).map(|hold| hold.time_s)
    }

    /// Pressure of the hold that a moment leads to or lies in \[Pa\].
    pub fn hold_pa(&self, time_s: f64) -> Option<f64> {
        let ahead = self.holds.iter().find(|hold| time_s <= hold.time_s + NOW_S);
        ahead.or(self.holds.last()).map(|hold| hold.pressure_pa)
    }

    /// Reads the robot.
    pub fn read(&mut self, run: &Simulation) -> Result<(), FemError> {
        self.readings.push(self.gauge.read(run)?);
        Ok(())
    }

    /// Buckling while the actuator is filled.
    pub fn snaps(&self) -> Vec<Snap> {
        snaps(self.watch.samples(), self.filled_s)
    }

    /// For a checkpoint.
    pub fn save(&self) -> Vec<u8> {
        let mut out = fem::bytes::Writer::new();
        out.f64s(&self.watch.save());
        // Numbers keep their bits in JSON; what is not finite is refused on the way back.
        out.bytes(&serde_json::to_vec(&self.readings).unwrap_or_default());
        out.into_bytes()
    }

    /// From a checkpoint.
    pub fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let mut from = fem::bytes::Reader::new(saved);
        self.watch.restore(&from.f64s()?);
        self.readings = serde_json::from_slice(from.bytes()?).ok()?;
        from.is_empty().then_some(())
    }

    /// For the summary.
    pub fn summary(&self, Robot { scenario, run, .. }: &Robot) -> RobotSummary {
        let setting = |key: &Key| (key.name.to_string(), (key.get)(&run.settings).map(|value| rounded(value / key.si)));
        RobotSummary {
            actuator: scenario.actuator.kind.name.into(),
            length_m: scenario.length_m,
            body_pa: scenario.p_body_pa,
            radius_m: scenario.radius_m,
            width_m: scenario.actuator.shape.width_m,
            pouch_m: scenario.actuator.shape.length_m,
            count: scenario.actuator.count,
            model: run.model.name().into(),
            set: run.set.clone(),
            base: if run.settings.encastre { "encastre" } else { "pinned" }.into(),
            settings: KEYS.iter().filter(|key| key.name != "mesh_mm").map(setting).collect(),
            readings: self.readings.clone(),
            snaps: self.snaps(),
        }
    }
}

/// A robot's part of a run's summary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RobotSummary {
    /// Actuator kind.
    pub actuator: String,
    length_m: f64,
    /// Body gauge pressure \[Pa\].
    pub body_pa: f64,
    /// Radius of the body \[m\].
    pub radius_m: f64,
    /// Width of one unit of the actuator \[m\].
    pub width_m: f64,
    /// Length of one unit \[m\].
    pub pouch_m: f64,
    /// Units in series.
    pub count: usize,
    /// Preset of `[fem]`, and the keys that were set beside it.
    #[serde(default)]
    pub model: String,
    /// See there.
    #[serde(default)]
    pub set: Vec<String>,
    /// How the base is held.
    #[serde(default)]
    pub base: String,
    /// Keys of `[fem]`, in the units of their names; what has no bound is null.
    #[serde(deserialize_with = "with_needed")]
    settings: BTreeMap<String, Option<f64>>,
    /// States, by time.
    pub readings: Vec<Reading>,
    snaps: Vec<Snap>,
}

/// Settings that a comparison asks for.
const NEEDED: [&str; 3] = ["body_mesh_mm", "actuator_mesh_mm", "seed"];

fn with_needed<'de, D: Deserializer<'de>>(from: D) -> Result<BTreeMap<String, Option<f64>>, D::Error> {
    let found = BTreeMap::<String, Option<f64>>::deserialize(from)?;
    let lacks = NEEDED.into_iter().find(|key| found.get(*key).copied().flatten().is_none());
    lacks.map_or(Ok(found), |key| Err(serde::de::Error::missing_field(key)))
}

impl RobotSummary {
    /// A key of `[fem]`, in the unit of its name.
    pub fn setting(&self, key: &str) -> f64 {
        self.settings.get(key).copied().flatten().unwrap_or(f64::NAN)
    }
}

/// Without the digits that a change of unit leaves behind.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// Height of the outermost marker and of the tip of a reading \[mm\].
pub fn heights_mm(reading: &Reading) -> [f64; 2] {
    let y = |from_end: usize| reading.moved_m.iter().rev().nth(from_end).map_or(f64::NAN, |d| d[1] * MM);
    [y(1), y(0)]
}

/// What a robot's run came to, as text.
pub fn text(robot: &RobotSummary) -> String {
    let readings = &robot.readings;
    let Some(last) = readings.last() else { return String::new() };
    let mut out = String::new();
    out.push_str(
        "\nDisplacement towards the actuator [mm]: section at the station; at the tip also the mean of its ring\n",
    );
    let mut head = vec!["actuator kPa".to_string()];
    head.extend(last.stations_m.iter().map(|s| format!("s = {:.0}", s * MM)));
    head.extend(["tip ring", "tip x", "turn deg"].map(String::from));
    let rows = readings.iter().map(|r| {
        let mut row = vec![format!("{:.0}", r.actuator_pa * 1e-3)];
        row.extend(r.moved_m.iter().map(|d| format!("{:.1}", d[1] * MM)));
        row.push(r.ring_moved_m.last().map_or("–".into(), |d| format!("{:.1}", d[1] * MM)));
        row.push(r.moved_m.last().map_or("–".into(), |d| format!("{:.1}", d[0] * MM)));
        row.push(format!("{:.1}", r.tip_angle_rad.to_degrees()));
        row
    });
    out.push_str(&table(&head.iter().map(String::as_str).collect::<Vec<_>>(), 0, rows.collect()));
    out.push('\n');
    out.push_str(&state(readings));
    out.push_str(&buckling(&robot.snaps));
    out
}

fn state(readings: &[Reading]) -> String {
    let head = [
        "actuator kPa",
        "body cm³",
        "actuator cm³",
        "von Mises MPa",
        "in",
        "at mm",
        "weld N/m",
        "in",
        "at mm",
        "kinetic %",
    ];
    let rows = readings.iter().map(|r| {
        vec![
            format!("{:.0}", r.actuator_pa * 1e-3),
            format!("{:.1}", r.body_m3 * 1e6),
            format!("{:.1}", r.actuator_m3 * 1e6),
            format!("{:.1}", r.von_mises_pa * 1e-6),
            r.von_mises_part.clone(),
            format!("{:.0}", r.von_mises_at_m * MM),
            format!("{:.0}", r.seam_n_per_m),
            r.seam_part.clone(),
            format!("{:.0}", r.seam_at_m * MM),
            format!("{:.2}", 100.0 * r.kinetic_share),
        ]
    });
    table(&head, 0, rows.collect())
}

fn buckling(found: &[Snap]) -> String {
    if found.is_empty() {
        return "\nno buckling event while the actuator is filled\n".into();
    }
    let mut largest: Vec<&Snap> = found.iter().collect();
    largest.sort_by(|a, b| b.released_j.total_cmp(&a.released_j));
    let released_mj: f64 = found.iter().map(|s| s.released_j * 1e3).sum();
    let mut out = format!("\n{} buckling events, {released_mj:.0} mJ released in all; the largest:\n", found.len());
    let rows = largest.iter().take(8).map(|s| {
        vec![
            format!("{:.3}", s.time_s),
            format!("{:.0}", s.place_m * MM),
            format!("{:.1}", s.released_j * 1e3),
            format!("{:.1}", s.kinetic_j * 1e3),
        ]
    });
    out.push_str(&table(&["time s", "at mm", "released mJ", "walls' kinetic peak mJ"], 0, rows.collect()));
    out
}
