//! What was measured on one robot, as everything here takes it.

use crate::error::CompareError;
use crate::progress::Progress;
use data::{About, Dataset};
use fem::session::sha256;

/// Measurements of one robot: the table, and what the table does not say.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// File, folder or embedded set, as it was named.
    pub name: String,
    /// Marker positions of all runs, with pressures and times.
    pub dataset: Dataset,
    /// How the robot lay, what was loaded, what was measured directly.
    pub about: Option<About>,
}

impl Evidence {
    /// Of data that are at hand.
    pub fn of(dataset: Dataset, about: Option<About>) -> Evidence {
        Evidence { name: dataset.name.clone(), dataset, about }
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
        Ok(Evidence { name: name.into(), dataset, about })
    }

    /// SHA-256 of the table as it was read, in hex.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn sha256(&self) -> Result<String, CompareError> {
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
