//! Readings of a robot while it runs.

use super::rounded;
use crate::case::DeclaredKey;
use crate::problem::Patience;
use crate::robot::{
    HoldEnd, KEYS, Reading, Rest, RobotGauge, RobotRun, RobotSettings, Sample, Settling, Snap, Watch, snaps,
};
use crate::vec3::norm;
use crate::{Problem, Result, Simulation, policy};
use models::Scenario;
use models::scenario::Wall;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// A hold this near to the present counts as reached \[s\].
const NOW_S: f64 = 1e-12;

/// A robot and how to read it.
#[derive(Clone)]
pub struct WatchedRobot {
    /// Scenario of which the case was made.
    pub scenario: Scenario,
    /// Settings, loads and pressures of the run.
    pub run: RobotRun,
    gauge: RobotGauge,
}

impl WatchedRobot {
    pub(super) fn new(scenario: &Scenario, run: &RobotRun, problem: &Problem) -> Result<WatchedRobot> {
        Ok(WatchedRobot { scenario: scenario.clone(), run: run.clone(), gauge: RobotGauge::new(scenario, problem)? })
    }

    /// Parts of the scenario that only the reduced model reads.
    pub(super) fn left_out(&self) -> Option<String> {
        let effects = self.scenario.effects.iter().map(|e| e.name.clone());
        let wall = self.scenario.wall != Wall::default();
        let names: Vec<String> = wall.then(|| "[body] wall_…".into()).into_iter().chain(effects).collect();
        let text = format!("read by the reduced model alone, not by finite elements: {}", names.join(", "));
        (!names.is_empty()).then_some(text)
    }

    pub(super) fn watch(&self, problem: &Problem) -> Watched {
        let holds = self.run.holds().into_iter().filter(|hold| hold.time_s <= problem.settings.end_s + NOW_S);
        Watched {
            filled_s: self.run.settings.body_ramp_s,
            weld_strength_n_per_m: self.run.settings.weld_strength_n_per_m,
            gauge: self.gauge.clone(),
            holds: holds.collect(),
            readings: Vec::new(),
            length_m: self.scenario.length_m,
            patience: problem.settings.patience,
            settling: Settling::default(),
            watch: Watch::new(&problem.mesh),
        }
    }
}

/// Readings of a run so far.
pub(super) struct Watched {
    pub watch: Watch,
    filled_s: f64,
    weld_strength_n_per_m: Option<f64>,
    gauge: RobotGauge,
    holds: Vec<HoldEnd>,
    length_m: f64,
    patience: Option<Patience>,
    settling: Settling,
    pub readings: Vec<Reading>,
}

#[derive(Serialize, Deserialize)]
pub(super) struct WatchedState {
    samples: Vec<Sample>,
    settling: Settling,
    readings: Vec<Reading>,
}

impl Watched {
    /// When the robot is to be read next \[s\].
    pub(crate) fn next_s(&self) -> Option<f64> {
        self.holds.get(self.readings.len()).map(|hold| hold.time_s)
    }

    /// Pressure of the present or next hold \[Pa\].
    pub(super) fn hold_pa(&self, time_s: f64) -> Option<f64> {
        let ahead = self.holds.iter().find(|hold| time_s <= hold.time_s + NOW_S);
        ahead.or(self.holds.last()).map(HoldEnd::highest_pa)
    }

    /// Whether the robot is at rest; to be called at the end of a hold, and of every window that it asks for.
    pub(super) fn rest(&mut self, run: &Simulation) -> Rest {
        // A run that goes on from a checkpoint may be within a window.
        if let Some(next_s) = self.settling.next_s().filter(|next_s| run.waited_s() + 0.5 * run.dt_s() < *next_s) {
            return Rest::Until(next_s);
        }
        let Some(patience) = self.patience else {
            return Rest::Over { waited_s: 0.0, ahead_m: f64::INFINITY, is_at_rest: false };
        };
        let tip_m = self.gauge.tip_moved_m(run);
        let allowed_m = policy::moves_no_more_m(patience.creep, norm(tip_m), self.length_m);
        self.settling.look(tip_m, allowed_m, run.waited_s(), patience)
    }

    pub(super) fn read(&mut self, run: &Simulation, rest: Rest) -> Result<()> {
        let mut reading = self.gauge.read(run, rest)?;
        reading.seam_share = self.weld_strength_n_per_m.map(|strength| reading.seam_n_per_m / strength);
        self.readings.push(reading);
        Ok(())
    }

    /// Buckling while the actuator is filled.
    pub(super) fn snaps(&self) -> Vec<Snap> {
        snaps(&self.watch.samples, self.filled_s)
    }

    pub(super) fn save(&self) -> WatchedState {
        let (samples, settling) = (self.watch.samples.clone(), self.settling.clone());
        WatchedState { samples, settling, readings: self.readings.clone() }
    }

    pub(super) fn restore(&mut self, state: WatchedState) {
        (self.watch.samples, self.settling, self.readings) = (state.samples, state.settling, state.readings);
    }

    pub(super) fn summary(&self, WatchedRobot { scenario, run, .. }: &WatchedRobot) -> RobotSummary {
        let setting = |key: &DeclaredKey<RobotSettings>| {
            (key.name.to_string(), (key.get)(&run.settings).map(|value| rounded(value / key.si)))
        };
        RobotSummary {
            actuator: scenario.actuator.kind.name.into(),
            length_m: scenario.length_m,
            body_pa: scenario.p_body_pa,
            radius_m: scenario.radius_m,
            width_m: scenario.actuator.shape.width_m,
            pouch_m: scenario.actuator.shape.length_m,
            count: scenario.actuator.count,
            is_spatial: scenario.is_spatial(),
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
    /// Kind of the actuator: `spam`, `cpam`, `epam` or `fpam`.
    pub actuator: String,
    /// Length of the undeformed robot \[m\].
    pub length_m: f64,
    /// Gauge pressure of the body \[Pa\].
    pub body_pa: f64,
    /// Radius of the inflated body \[m\].
    pub radius_m: f64,
    /// Width of one unit of the actuator \[m\].
    pub width_m: f64,
    /// Length of one unit of the actuator \[m\].
    pub pouch_m: f64,
    /// Number of units in series along the robot.
    pub count: usize,
    /// Whether strips lie round the body, so that it bends out of the x–y plane.
    #[serde(default)]
    pub is_spatial: bool,
    /// Preset of `[fem]`, and the keys set in addition.
    #[serde(default)]
    pub model: String,
    /// Keys of `[fem]` that were set, without `model`.
    #[serde(default)]
    pub set: Vec<String>,
    /// How the base is held: `pinned` or `encastre`.
    #[serde(default)]
    pub base: String,
    /// Keys of `[fem]`, in the units of their names; what has no bound is null.
    #[serde(deserialize_with = "with_needed")]
    settings: BTreeMap<String, Option<f64>>,
    /// States of the robot at the ends of its holds, by time.
    pub readings: Vec<Reading>,
    /// Buckling while the actuator is filled.
    pub snaps: Vec<Snap>,
}

/// Settings that a comparison asks for.
const NEEDED: [&str; 3] = ["body_mesh_mm", "actuator_mesh_mm", "seed"];

fn with_needed<'de, D: Deserializer<'de>>(from: D) -> Result<BTreeMap<String, Option<f64>>, D::Error> {
    let found = BTreeMap::<String, Option<f64>>::deserialize(from)?;
    let lacks = NEEDED.into_iter().find(|key| found.get(*key).copied().flatten().is_none());
    lacks.map_or(Ok(found), |key| Err(serde::de::Error::missing_field(key)))
}

impl RobotSummary {
    /// What to know before believing the readings: a tip that moves, welds beyond their strength, a planar robot that leaves its plane.
    pub(super) fn warnings(&self) -> Vec<String> {
        let kpa = |r: &Reading| rounded(r.actuator_pa * 1e-3);
        let torn = self.readings.iter().find(|r| r.seam_share.is_some_and(policy::is_torn)).map(|r| {
            format!(
                "at {} kPa {} ({} at {:.0} mm) carries {:.0} N/m, {:.2} of weld_strength_n_per_m: it would open, and the run goes on as if it held",
                kpa(r), r.seam, r.seam_part, r.seam_at_m * 1e3, r.seam_n_per_m, r.seam_share.unwrap_or_default()
            )
        });
        let share = |r: &&Reading| r.out_of_plane_share();
        let aside = self.readings.iter().filter(|_| !self.is_spatial).max_by(|a, b| share(a).total_cmp(&share(b)));
        let aside = aside.filter(|r| policy::leaves_plane(share(r))).map(|r| {
            format!(
                "at {} kPa the tip is {:+.1} mm out of the x–y plane, {:.1} % of its way: no planar model shows that",
                kpa(r),
                r.out_of_plane_m()[0] * 1e3,
                100.0 * share(&r)
            )
        });
        // With rest_s = 0 every reading is taken in motion on purpose.
        let moving = self.readings.iter().filter(|r| !r.is_at_rest && r.waited_s > 0.0).map(|r| {
            format!(
                "at {} kPa the tip still moves after {:.2} s (at rest it would be up to {} mm further). Try: a longer rest_s, less or more \
                 mass_damping_1_s",
                kpa(r),
                r.waited_s,
                r.ahead_m.map_or("an unknown number of".into(), |m| format!("{:.1}", m * 1e3))
            )
        });
        moving.chain(torn).chain(aside).collect()
    }

    /// A key of `[fem]`, in the unit of its name.
    pub fn setting(&self, key: &str) -> f64 {
        self.settings.get(key).copied().flatten().unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    /// A planar robot whose tip moves 100 mm in its plane and aside, with a weld at a share of its strength.
    fn robot(aside_m: f64, share: Value, is_spatial: bool) -> RobotSummary {
        let none: [f64; 0] = [];
        let reading = json!({
            "time_s": 1, "actuator_pa": 20e3, "body_pa": 2e3, "stations_m": [0.3], "moved_m": [[0, 0.1, aside_m]],
            "seen_moved_m": none, "ring_moved_m": none, "tip_angle_rad": 0, "body_m3": 0, "actuator_m3": 0, "von_mises_pa": 0,
            "von_mises_part": "", "von_mises_at_m": 0, "seam_n_per_m": 900, "seam_part": "top", "seam_at_m": 0.12,
            "seam": "seam 3", "seam_share": share, "ledger": none, "kinetic_share": 0, "waited_s": 0.1, "ahead_m": 0, "is_at_rest": true,
        });
        let summary = json!({
            "actuator": "epam", "length_m": 0.3, "body_pa": 2e3, "radius_m": 0.04, "width_m": 0.06, "pouch_m": 0.06, "count": 5,
            "is_spatial": is_spatial, "settings": {"body_mesh_mm": 8, "actuator_mesh_mm": 4, "seed": 1}, "readings": [reading],
            "snaps": none,
        });
        serde_json::from_value(summary).unwrap()
    }

    #[test]
    fn a_weld_beyond_its_strength_and_a_tip_beside_its_plane_are_named() {
        let warnings = |aside_m: f64, share: Value| robot(aside_m, share, false).warnings();
        for share in [json!(null), json!(0.7), json!(0.99)] {
            assert_eq!(warnings(0.0016, share), Vec::<String>::new());
        }
        let torn = warnings(0.0, json!(1.3));
        assert!(
            torn.len() == 1 && torn[0].contains("at 20 kPa seam 3") && torn[0].contains("1.30 of weld_strength"),
            "{torn:?}"
        );
        let aside = warnings(-0.0024, json!(null));
        assert!(aside.len() == 1 && aside[0].contains("-2.4 mm") && aside[0].contains("2.4 %"), "{aside:?}");
        assert!(
            robot(0.05, json!(null), true).warnings().is_empty(),
            "a robot with strips round its body has no plane"
        );
    }
}
