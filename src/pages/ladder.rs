//! The page of a climb: one effect after the other until only noise is left.

use super::diagnosis_figures::waterfall;
use super::{Maker, Result, Values};
use crate::prelude::*;
use ::compare::ladder::Climb;

/// A climb from bare to extended, and what it was made of.
pub struct Climbed<'a> {
    /// The climb.
    pub climb: &'a Climb,
    /// Names of robot and data.
    pub names: [&'a str; 2],
    /// Both as typed.
    pub typed: [&'a str; 2],
    /// Data that were fitted along, as typed.
    pub also: &'a [String],
}

/// The page of a ladder with its waterfall, and the scenario of every step.
///
/// # Errors
/// A chart that cannot be drawn.
pub fn ladder_page(page: &Climbed, maker: &Maker) -> Result<Files> {
    let Climbed { climb, names: [robot, data], typed, also } = page;
    let mut files = Files::default();
    climb.files.iter().for_each(|(name, text)| files.text(name, text.clone()));
    let title = "From the model as given to the extended one";
    files.plot("waterfall", waterfall(title, &climb.rungs, climb.noise_floor_mm)?);
    let mut provenance = vec![["scenario", typed[0]], ["data", typed[1]]];
    provenance.extend(also.iter().map(|data| ["fitted along", data]));
    let rungs =
        climb.rungs.iter().map(|step| Values::new().with("label", step.label()).with("of", step)).collect::<Vec<_>>();
    let title = format!("{robot}: one effect after the other, on {data}");
    let values = Values::new()
        .with("title", title)
        .with("lead", &climb.ending)
        .with("notes", &climb.told)
        .with("rungs", rungs)
        .with("provenance", provenance);
    files.page("ladder.html", values, maker)?;
    Ok(files)
}
