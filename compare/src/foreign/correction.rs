//! What an effect adds to the predictions of another simulator: a displacement of every marker over the pressure.

use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::extension::{Extension, today};
use crate::fit::numbers::{differences, groups};
use crate::policy;
use crate::study::predict::{fit_scenario, predict_dataset};
use data::{Column, Dataset, Hold, Lost, Phase, Table};
use models::{HOLD_S, Model, Scenario};

/// Steps of the actuator pressure from 0 to the highest of the data.
const STEPS: usize = 30;

/// Displacements Δ = M(θ, B) − M₀ of the markers, which are added to another simulator's predictions.
#[derive(Debug, Clone)]
pub struct ForeignCorrection {
    /// Effects, best first.
    pub effects: Vec<String>,
    /// Names and SHA-256 of the data of the fit.
    fitted_on: Vec<[String; 2]>,
    /// Scenario without the effects.
    before: Scenario,
    /// With them.
    after: Scenario,
    /// Markers and holds of the data.
    dataset: Dataset,
}

impl ForeignCorrection {
    /// Of a scenario and what was added to it on data with a base.
    ///
    /// # Errors
    /// Data without a base; a robot with several actuator pressures.
    pub fn of(
        scenario: &Scenario,
        found: &Extension,
        evidence: &[Evidence],
    ) -> Result<ForeignCorrection, CompareError> {
        let Some(first) = evidence.first().filter(|first| first.base.is_some()) else {
            let message = "a correction is for the predictions of another simulator, and none were given";
            return Err(CompareError::refused(message, "name their table with --base, or give --out a name of .toml"));
        };
        let dataset = &first.dataset;
        if scenario.is_spatial() || dataset.channels_differ() {
            let message = "a correction is a table over one actuator pressure, and this robot has several channels";
            return Err(CompareError::refused(message, "write the scenario: --out extended.toml"));
        }
        let fitted = |of: &Scenario| fit_scenario(of, dataset, first.about.as_ref()).map(|(fitted, _)| fitted);
        let hash = |one: &Evidence| Ok([one.dataset.name.clone(), one.sha256()?]);
        Ok(ForeignCorrection {
            effects: found.additions.iter().map(|a| a.name.clone()).collect(),
            fitted_on: evidence.iter().map(hash).collect::<Result<_, CompareError>>()?,
            before: fitted(scenario)?,
            after: fitted(&found.file.scenario)?,
            dataset: dataset.clone(),
        })
    }

    /// Displacements at pressures of the body and the actuator \[Pa\], laid out `[pressure][marker][axis]` \[m\]. A robot with history walks
    /// them in order.
    ///
    /// # Errors
    /// A pressure without equilibrium.
    pub fn at(&self, pressures_pa: &[[f64; 2]]) -> Result<Vec<f64>, CompareError> {
        let walked = walked(&self.dataset, pressures_pa);
        let [before, after] = [&self.before, &self.after].map(|scenario| predict_dataset(scenario, &walked));
        Ok(differences(&after?.coordinates_m, &before?.coordinates_m))
    }

    /// Labels of the markers.
    pub fn markers(&self) -> impl Iterator<Item = &str> {
        self.dataset.markers.iter().map(|marker| marker.name.as_str())
    }

    fn has_history(&self) -> bool {
        [&self.before, &self.after].iter().any(|scenario| Model::new(scenario).has_history())
    }

    /// The table: from 0 to the highest pressure of the data at each of their body pressures, and back if loading and unloading differ.
    ///
    /// # Errors
    /// As [`ForeignCorrection::at`].
    pub fn table(&self) -> Result<Table, CompareError> {
        let holds = &self.dataset.holds;
        let most = holds.iter().map(|hold| hold.p_act_pa).fold(0.0, f64::max);
        let grid = (0..=STEPS).map(|i| most * i as f64 / STEPS as f64);
        let bodies = groups(holds, |a, b| policy::is_same_pressure(a.p_body_pa, b.p_body_pa));
        let with_phase = self.has_history();
        let mut path: Vec<f64> = grid.clone().collect();
        if with_phase {
            path.extend(grid.rev().skip(1));
        }
        let markers = self.dataset.markers.len();
        let (mut numbers, mut texts): ([Vec<f64>; 5], [Vec<String>; 2]) = Default::default();
        for body_pa in bodies.iter().map(|own| holds[own[0]].p_body_pa) {
            let pressures: Vec<[f64; 2]> = path.iter().map(|act_pa| [body_pa, *act_pa]).collect();
            let moved = self.at(&pressures)?;
            for (row, d) in moved.chunks_exact(2).enumerate() {
                let (step, marker) = (row / markers, row % markers);
                let phase = if step > STEPS { Phase::Unload } else { Phase::Load };
                let station = self.after.markers_m.get(marker).copied().unwrap_or(f64::NAN);
                let values = [body_pa * 1e-3, path[step] * 1e-3, station * 1e3, d[0] * 1e3, d[1] * 1e3];
                numbers.iter_mut().zip(values).for_each(|(column, value)| column.push(tidy(value)));
                let words = [phase.word().to_string(), self.dataset.markers[marker].name.clone()];
                texts.iter_mut().zip(words).for_each(|(column, word)| column.push(word));
            }
        }
        let [body, act, s, x, y] = numbers.map(Column::F64);
        let [phase, marker] = texts.map(Column::Str);
        let phase = with_phase.then(|| ("phase".to_string(), phase));
        let pressures = [("p_body_kpa".to_string(), body), ("p_act_kpa".into(), act)];
        let rest = [("marker".to_string(), marker), ("s_mm".into(), s), ("dx_mm".into(), x), ("dy_mm".into(), y)];
        Ok(Table { columns: pressures.into_iter().chain(phase).chain(rest).collect() })
    }

    /// The table as a CSV file: comments with the effects and the data of the fit, then columns.
    ///
    /// # Errors
    /// As [`ForeignCorrection::at`].
    pub fn text(&self) -> Result<String, CompareError> {
        let mut text = "# correction: add dx_mm and dy_mm to the predictions of every marker\n".to_string();
        text += &format!("# effects: {}\n", self.effects.join(", "));
        for [name, sha256] in &self.fitted_on {
            text += &format!("# fitted on: {name} ({}), SHA-256 {sha256}\n", today());
        }
        let mut table = Vec::new();
        self.table()?.to_csv(&mut table)?;
        Ok(text + &String::from_utf8_lossy(&table))
    }
}

fn tidy(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// Holds at these pressures with the markers of data and their time from hold to hold; a single run without positions.
fn walked(of: &Dataset, pressures_pa: &[[f64; 2]]) -> Dataset {
    let step_s = of.holds.windows(2).map(|pair| pair[1].t_s[0] - pair[0].t_s[0]).find(|s| *s > 0.0).unwrap_or(HOLD_S);
    let hold = |(i, [p_body_pa, p_act_pa]): (usize, &[f64; 2])| Hold {
        p_body_pa: *p_body_pa,
        p_act_pa: *p_act_pa,
        more_act_pa: Vec::new(),
        phase: Phase::Load,
        occurrence: 0,
        t_s: vec![step_s * (i + 1) as f64],
    };
    let holds: Vec<Hold> = pressures_pa.iter().enumerate().map(hold).collect();
    Dataset {
        runs: vec!["1".into()],
        samples_per_hold: 1,
        coordinates_m: vec![0.0; holds.len() * of.markers.len() * of.axes],
        holds,
        gauge_pa: None,
        lost: Lost::default(),
        ..of.clone()
    }
}
