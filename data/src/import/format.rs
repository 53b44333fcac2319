//! A kind of tracking file: its name, how it is recognised, and its reader.

use super::options::ImportOptions;
use super::recording::Recording;
use super::sheet::CellText;
use crate::error::Result;

/// A program's tracking file, as one entry of the list.
#[derive(Debug)]
pub struct Format {
    /// Program or layout of such files, for example `DeepLabCut`.
    pub name: &'static str,
    /// Sign by which a file of this kind is recognised, in words.
    pub known_by: &'static str,
    /// A small file of this kind below `data/tests`.
    pub fixture: &'static str,
    /// Likelihood below which positions are lost, unless the caller gives another; `None` without likelihoods.
    pub likelihood: Option<f64>,
    /// Whether a text, of which these are the first lines as cells, is of this kind.
    pub(crate) recognise: fn(&CellText, &[Vec<&str>], &ImportOptions) -> bool,
    pub(crate) read: fn(&CellText, &ImportOptions) -> Result<Vec<Recording>>,
}
