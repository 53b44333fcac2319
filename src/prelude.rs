//! Names that most commands, tables and pages use.

pub(crate) use crate::context::{Context, Outcome};
pub(crate) use crate::failure::{Failure, MISSED, Result, refuse_if};
pub(crate) use crate::output::{
    Input, check_folder, check_set_folder, machine, maker, program, read_input, replace_files, set_name, sha256,
    spares_inputs, write_example, write_files, write_texts, write_whole,
};
pub(crate) use crate::pages::Files;
pub(crate) use crate::tables::{TextTable, lines, wrapped};
pub(crate) use crate::words::{effect, in_words, number, pressure_words};
pub(crate) use compare::{Evidence, ScenarioFile};
pub(crate) use data::{Dataset, Provenance};
pub(crate) use models::scenario::quantity::Quantity;
pub(crate) use models::{Known, Loads, Model, Scenario};
pub(crate) use report::chart::{Bar, Chart, ChartColumn, ChartRow, KeyLook, LegendEntry, Mark, Point, RowPlace, Space};
pub(crate) use report::{Drawn, Ink, LineSeries, LineStyle, Lines, Symbol};
pub(crate) use serde::Serialize;
pub(crate) use std::path::{Path, PathBuf};
