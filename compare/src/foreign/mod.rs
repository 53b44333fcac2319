//! A model that is not ours: predictions of another simulator F take the place of the scenario's prediction M₀.
//!
//! ```text
//! F + [M(θ, B) − M₀]  is compared with y      ⇔      M(θ, B)  is compared with  y − F + M₀
//! ```
//!
//! An effect acts as the change that it makes in the scenario, and so does B. The shift F − M₀ is the same in every run, so noise, prices
//! and p-values are the same as for a scenario. The change is exact where F is the scenario, and of first order in F − M₀.

mod correction;
mod judged;
#[cfg(test)]
mod tests;

pub use correction::ForeignCorrection;
pub use judged::judge;

use crate::error::CompareError;
use crate::evidence::{Evidence, ForeignBase};
use crate::fit::numbers::{largest, squared_distance};
use crate::policy;
use crate::slips::slips_of_predictions;
use crate::study::predict::{fit_scenario, predict_dataset, seen_by};
use data::{CorrectionTable, Dataset, Predictions, Table, parse_predictions};
use fem::session::sha256;
use models::Scenario;
use spelling::files::{MOST_DATA, read_whole};
use std::path::Path;

/// A table of predictions as text.
#[derive(Debug, Clone)]
pub struct BaseTable {
    file: String,
    text: String,
}

impl BaseTable {
    /// Reads a CSV or Parquet file.
    ///
    /// # Errors
    /// A file that cannot be read, or is not a text.
    pub fn read(file: &str) -> Result<BaseTable, CompareError> {
        let path = Path::new(file);
        if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet")) {
            return BaseTable::of(file, &data::read_parquet(path)?);
        }
        let help = "give a CSV file with the columns p_act_kpa,marker,x_mm,y_mm: predictions for these data";
        Ok(BaseTable { file: file.into(), text: text_of(file, help)? })
    }

    /// Of columns at hand; `name` is for messages.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn of(name: &str, table: &Table) -> Result<BaseTable, CompareError> {
        let mut text = Vec::new();
        table.to_csv(&mut text)?;
        Ok(BaseTable { file: name.into(), text: String::from_utf8_lossy(&text).into_owned() })
    }

    /// The predictions for data in the plane of a scenario, checked.
    pub(crate) fn predictions(&self, scenario: &Scenario, dataset: &Dataset) -> Result<Predictions, CompareError> {
        let predictions = parse_predictions(&self.file, &self.text, dataset)?;
        if !scenario.is_spatial() {
            check_axes(scenario, dataset, &predictions)?;
        }
        Ok(predictions)
    }
}

fn text_of(file: &str, help: &str) -> Result<String, CompareError> {
    let unread = |cause: String| CompareError::Unread { path: file.into(), cause, help: help.into() };
    let bytes = read_whole(Path::new(file), MOST_DATA).map_err(|cause| unread(cause.to_string()))?;
    String::from_utf8(bytes).map_err(|_| unread("it is not a text in UTF-8".into()))
}

/// Reads a correction that [`ForeignCorrection::text`] wrote.
///
/// # Errors
/// A file that cannot be read, or has no such table.
pub fn read_correction(file: &str) -> Result<CorrectionTable, CompareError> {
    let text = text_of(file, "give a file that `ibr add … --base TABLE --out correction.csv` wrote")?;
    Ok(data::parse_correction(file, &text)?)
}

/// The measurements on another simulator's base: positions less its predictions, plus the scenario's.
///
/// # Errors
/// Scenario and data that do not match; predictions that are not for these data, or whose axes, units or labels are exchanged.
pub fn on_base(scenario: &Scenario, evidence: &Evidence, base: &BaseTable) -> Result<Evidence, CompareError> {
    let mut dataset = seen_by(scenario, evidence.dataset.clone());
    let (fitted, _) = fit_scenario(scenario, &dataset, evidence.about.as_ref())?;
    let own_m = predict_dataset(&fitted, &dataset)?.coordinates_m;
    let predictions = base.predictions(&fitted, &dataset)?;
    let base_m = in_run_layout(&dataset, &predictions);
    let mean_m = dataset.mean_over_runs();
    let found = ForeignBase {
        table: base.file.clone(),
        sha256: sha256(base.text.as_bytes()),
        from_data_mm: rms_mm(&dataset, &base_m, &mean_m),
        from_scenario_mm: rms_mm(&dataset, &base_m, &own_m),
        data_sha256: evidence.sha256()?,
    };
    let values = dataset.values_per_run();
    for (i, value) in dataset.coordinates_m.iter_mut().enumerate() {
        *value += own_m[i % values] - base_m[i % values];
    }
    Ok(Evidence { dataset, base: Some(found), ..evidence.clone() })
}

/// Predictions for every sample; of what too few runs saw the value in the data.
pub(crate) fn in_run_layout(dataset: &Dataset, predictions: &Predictions) -> Vec<f64> {
    let width = dataset.markers.len() * dataset.axes;
    let of_hold = predictions.places_m.chunks_exact(width.max(1));
    let mut values: Vec<f64> = of_hold.flat_map(|hold| hold.repeat(dataset.samples_per_hold)).collect();
    dataset.unseen_values().for_each(|i| values[i] = dataset.coordinates_m[i]);
    values
}

fn rms_mm(dataset: &Dataset, one_m: &[f64], other_m: &[f64]) -> f64 {
    let seen = one_m.len() - dataset.unseen_values().count();
    1e3 * (squared_distance(one_m, other_m) / (seen.max(1) / dataset.axes) as f64).sqrt()
}

/// Refuses exchanged axes, labels and units, and a base that bends away from the actuator. Its line is where a marker is farthest from the scenario.
fn check_axes(scenario: &Scenario, dataset: &Dataset, predictions: &Predictions) -> Result<(), CompareError> {
    let alone = Dataset {
        runs: vec!["base".into()],
        coordinates_m: in_run_layout(dataset, predictions),
        gauge_pa: None,
        ..dataset.clone()
    };
    let own_m = predict_dataset(scenario, &alone)?.coordinates_m;
    let samples = dataset.samples_per_hold;
    let place = |cell: usize| dataset.offset(cell / dataset.markers.len(), samples - 1, cell % dataset.markers.len());
    let away = |cell: &usize| {
        let at = place(*cell);
        (own_m[at] - alone.coordinates_m[at]).hypot(own_m[at + 1] - alone.coordinates_m[at + 1])
    };
    let cells = 0..dataset.holds.len() * dataset.markers.len();
    let farthest = largest(cells.clone(), away).unwrap_or(0);
    let refused = |cell: usize, message: String, help: String| -> Result<(), CompareError> {
        Err(CompareError::from(predictions.fault(cell, message, help)))
    };
    if let Some(words) = slips_of_predictions(&alone, scenario).into_iter().next() {
        let (message, help) = words.split_once(". ").unwrap_or((&words, "correct the table"));
        return refused(farthest, message.replace(" in the only run", ""), help.into());
    }
    let [own_y, y] = [&own_m, &alone.coordinates_m].map(|of_m| move |cell: usize| of_m[place(cell) + 1]);
    let most = largest(cells, |cell| own_y(*cell).abs()).unwrap_or(0);
    if policy::bend_apart(own_y(most), y(most)) {
        let [own_mm, mm] = [own_y(most), y(most)].map(|m| 1e3 * m);
        let message = format!("y = {mm:.1} mm here, and {own_mm:.1} mm in the scenario: the base bends the other way");
        return refused(most, message, "y is positive towards the actuator: write -y".into());
    }
    Ok(())
}

impl ForeignBase {
    /// What the candidates are changes of.
    pub fn sentence(&self) -> String {
        format!(
            "The base is {}, {:.2} mm from the markers (rms) and {:.2} mm from the scenario. Effects and B are changes of it, \
             computed with the scenario.",
            self.table, self.from_data_mm, self.from_scenario_mm
        )
    }
}
