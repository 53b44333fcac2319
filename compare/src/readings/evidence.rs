//! What was measured on one robot, as everything here takes it.

use crate::error::CompareError;
use crate::progress::Progress;
use data::{About, Dataset};
use fem::session::sha256;
use serde::Serialize;

/// Measurements of one robot: the table, and what the table does not say.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// File, folder or embedded set, as it was named.
    pub name: String,
    /// Marker positions of all runs, with pressures and times.
    pub dataset: Dataset,
    /// How the robot lay, what was loaded, what was measured directly.
    pub about: Option<About>,
    /// Predictions of another simulator that were subtracted from the positions ([`crate::foreign::on_base`]).
    pub base: Option<ForeignBase>,
}

/// Predictions of another simulator, in place of the scenario's.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ForeignBase {
    /// Table.
    pub table: String,
    /// Its SHA-256, in hex.
    pub sha256: String,
    /// Its distance from the measurements, root mean square over markers and holds \[mm\].
    pub from_data_mm: f64,
    /// Its distance from the scenario, whose effects are the candidates \[mm\].
    pub from_scenario_mm: f64,
    /// SHA-256 of the measurements as they were read.
    #[serde(skip)]
    pub(crate) data_sha256: String,
}

impl Evidence {
    /// Of data that are at hand.
    pub fn of(dataset: Dataset, about: Option<About>) -> Evidence {
        Evidence { name: dataset.name.clone(), dataset, about, base: None }
    }

    /// Reads a CSV or Parquet file, a folder with `markers.csv` and `about.toml`, or an embedded set.
    ///
    /// # Errors
    /// Nothing of that name, or a fault of its files with line, column and what to write.
    pub fn read(name: &str) -> Result<Evidence, CompareError> {
        Evidence::read_with(name, &mut |_, _| ())
    }

    /// The same, reporting its progress.
    ///
    /// # Errors
    /// As [`Evidence::read`].
    pub fn read_with(name: &str, progress: &mut Progress) -> Result<Evidence, CompareError> {
        let what = format!("reading {name}");
        let mut tell = |done: u64, total: u64| progress(&what, (total > 0).then(|| done as f64 / total as f64));
        let (dataset, about) = data::load(name, &mut tell)?;
        Ok(Evidence { name: name.into(), dataset, about, base: None })
    }

    /// SHA-256 of the table as it was read, in hex.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn sha256(&self) -> Result<String, CompareError> {
        if let Some(base) = &self.base {
            return Ok(base.data_sha256.clone());
        }
        let mut bytes = Vec::new();
        data::write_markers_csv(&self.dataset, &mut bytes)?;
        Ok(sha256(&bytes))
    }
}

/// Measurements that were used, as they were read.
#[derive(Debug, Clone, PartialEq)]
pub struct Used {
    /// Name of the dataset, and its runs.
    pub words: String,
    /// SHA-256 of the table, in hex.
    pub sha256: String,
}

impl Used {
    /// Of this evidence.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn of(evidence: &Evidence) -> Result<Used, CompareError> {
        let Evidence { dataset, .. } = evidence;
        let words = format!("{}, {} runs", dataset.name, dataset.runs.len());
        Ok(Used { words, sha256: evidence.sha256()? })
    }
}
