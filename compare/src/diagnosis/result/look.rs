//! What would show a fault that no effect of the catalogue explains: where to look, and what to take again.
//!
//! Separations λ are expected of laws, and the law of a fault is not known. So none is computed here; the proposal follows
//! the pattern that the fault left, and separates robot, set-up and camera by what moves along when one of them is changed.

use crate::diagnosis::experiments::TIP_FORCE_N;
use crate::diagnosis::result::{Diagnosis, Verdict};
use crate::fit::numbers::largest;
use crate::wording::{channels_word, list, uncapitalised};
use models::effects::Group;

/// What to do next where nothing in the catalogue explains the misfit; `None` with another verdict.
pub(crate) fn next(d: &Diagnosis) -> Option<String> {
    if d.verdict != Some(Verdict::OutOfCatalog) {
        return None;
    }
    let mut told = Vec::new();
    if let Some(kept) = &d.kept_bending {
        told.push(format!("do a bending test, for the answer with B = {:.2} N·m²", kept.value_nm2));
    }
    if !d.outliers.runs.is_empty() {
        let word = if d.outliers.runs.len() == 1 { "run" } else { "runs" };
        let runs = list(d.outliers.runs.iter().map(|r| &r.run));
        told.push(format!("take {word} {runs} again or leave it out, it is not like the others"));
    }
    told.extend(d.attempt.iter().filter(|added| added.group == Group::Measurement).filter_map(|added| {
        let ranked = d.ranked(&added.effect)?;
        let board = if added.effect.starts_with("camera") { " (ibr data import --board)" } else { "" };
        Some(format!("{}{board}", uncapitalised(ranked.remedy.trim_end_matches('.'))))
    }));
    told.extend(d.pattern.as_ref().map(|pattern| pattern.check.clone()).or_else(|| where_most(d)));
    let rest = match d.pattern.as_ref().filter(|pattern| pattern.simpler) {
        Some(_) => "If nothing is found there, the effects named above remain.",
        None => "",
    };
    let none = "No experiment of the list is computed for a law that is not in the catalogue.";
    Some(format!("Next: {}. {none} {rest}", told.join("; ")).trim_end().to_string())
}

fn where_most(d: &Diagnosis) -> Option<String> {
    let map = &d.residuals_after;
    let cells = map.cells.iter().enumerate().flat_map(|(m, row)| row.iter().enumerate().map(move |(h, c)| (m, h, c)));
    let (marker, hold, _) = largest(cells, |(_, _, cell)| cell.norm_in_noise.unwrap_or(cell.norm_mm))?;
    let at = &map.holds[hold];
    Some(format!(
        "look at marker {} at {} kPa ({}), where the model fails most, and take that hold again, also with ±{TIP_FORCE_N} N on \
         the tip",
        map.markers[marker],
        channels_word(at),
        at.phase
    ))
}
