//! A kind of tracking file: its name, how it is recognised, and its reader. A page of a kind imports these names.

pub(super) use super::columns::{ColumnName, Roles, is_frame, lengths, si};
pub(super) use super::labels::without_subject;
pub(super) use super::layout::{FrameColumns, LIKELIHOOD, NOT_SEEN, PARTS, part};
pub(super) use super::options::ImportOptions;
pub(super) use super::recording::{Lengths, Pivot, Recording, counted};
pub(super) use super::sheet::CellText;
pub(super) use crate::cells::is_nothing;
pub(super) use crate::error::Result;
pub(super) use crate::units::MeasuredQuantity;

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
    /// Whether a text that begins like this is of this kind.
    pub(crate) recognise: fn(&Beginning) -> bool,
    pub(crate) read: fn(&CellText, &ImportOptions) -> Result<Vec<Recording>>,
}

/// A text and the cells of its first lines.
pub(crate) struct Beginning<'a> {
    pub sheet: &'a CellText<'a>,
    pub head: Vec<Vec<&'a str>>,
    pub options: &'a ImportOptions,
}

impl Beginning<'_> {
    pub(super) fn first(&self) -> &str {
        self.head.first().map_or("", |row| row[0])
    }

    /// Whether the first line has all of these cells.
    pub(super) fn has(&self, cells: &[&str]) -> bool {
        self.head.first().is_some_and(|row| cells.iter().all(|cell| row.contains(cell)))
    }

    /// Whether a cell of the first line is like this.
    pub(super) fn any(&self, is: impl Fn(&str) -> bool) -> bool {
        self.head.first().is_some_and(|row| row.iter().any(|cell| is(cell)))
    }
}
