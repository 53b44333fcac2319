//! What would show a fault that no effect of the catalogue explains: where to look, and what to take again.
//!
//! Separations λ are expected of laws, and the law of a fault is not known. So none is computed here; what is proposed goes
//! by the pattern that the fault left, and tells robot, set-up and camera apart by what moves along when one of them is changed.

use super::experiments::TIP_FORCE_N;
use super::result::{Diagnosis, Verdict};
use crate::residuals::ResidualCell;
use crate::wording::{list, short};
use data::{Hold, Phase};

pub fn stretch(at: &str) -> String {
    format!(
        "look at the body and the actuator {at} (a pouch that does not fill, a fold, tape, a leak), and hang a known force on \
         the tip with the actuator vented: a wall that is stiffer there bends less there then too, an actuator that pulls less \
         does not"
    )
}

/// A kink that is always there.
pub fn kink(at: &str) -> String {
    format!(
        "photograph the inflated body with the actuator vented, and once more rolled by 180°: a kink {at} is there without \
         actuator and rolls along, an error of camera or markers does not"
    )
}

/// A stiffness or a drive that is not the same all along.
pub fn along() -> String {
    "hang a known force on the inflated body with the actuator vented, first on its middle and then on its tip: a wall that is \
     not the same all along gives two stiffnesses, one that is the same leaves the actuator, whose widths and seams are \
     measured from base to tip"
        .into()
}

/// A marker at another station than the one that is told.
pub fn station(name: &str) -> String {
    format!(
        "measure the station of marker {name} along the straight robot with a tape, and correct s_mm in about.toml if it is \
         another one"
    )
}

/// A marker that disagrees with its neighbours.
pub fn marker(name: &str) -> String {
    format!(
        "look at marker {name} in the images (what the tracking follows there, labels that are exchanged), glue it on anew and \
         take one run again: what is the marker's own moves with it"
    )
}

/// Something at the tip, at some time.
pub fn tip(when: &str) -> String {
    format!(
        "look for what touches or pulls the tip (a hose, a cable, the floor), and {when}, also with ±{TIP_FORCE_N} N on the tip"
    )
}

/// An image that moves, at some time.
pub fn image(when: &str) -> String {
    format!("put fiducials on the clamp and in the room and {when}: camera and mount move them too, the robot does not")
}

/// Another bend of the whole robot, at some time; `read`: a gauge was read already.
pub fn whole(when: &str, read: bool) -> String {
    let gauge = if read { "" } else { ", with a gauge read at the actuator (column p_gauge_kpa)" };
    format!("{when}{gauge}")
}

pub fn one_hold(number: usize, hold: &Hold) -> String {
    let pressure = short(1e-3 * hold.p_act_pa);
    let branch = if hold.phase == Phase::Unload { " on the way down" } else { "" };
    format!(
        "take hold {number} again ({pressure} kPa{branch}), early and late in a run: what belongs to the pressure comes again, \
         what happened once does not"
    )
}

/// To see how it grows, from a pressure on if there is one.
pub fn finer(from_pa: Option<f64>) -> String {
    let from = from_pa.map_or(String::new(), |p| format!(" around and above {} kPa", short(1e-3 * p)));
    format!("repeat in finer steps of pressure{from} to see where it begins and how it grows")
}

/// What to do next where nothing in the catalogue explains the misfit; `None` with another verdict.
pub fn next(d: &Diagnosis) -> Option<String> {
    if d.verdict != Some(Verdict::OutOfCatalog) {
        return None;
    }
    let mut told = Vec::new();
    if let Some(kept) = &d.kept_bending {
        told.push(format!("do a bending test, for the answer with B = {:.2} N·m²", kept.value_nm2));
    }
    if !d.outliers.runs.is_empty() {
        let runs: Vec<String> = d.outliers.runs.iter().map(|r| r.run.clone()).collect();
        let word = if runs.len() == 1 { "run" } else { "runs" };
        told.push(format!("take {word} {} again or leave it out, it is not like the others", list(&runs)));
    }
    told.extend(d.pattern.as_ref().map(|pattern| pattern.check.clone()).or_else(|| where_most(d)));
    let rest = match d.pattern.as_ref().filter(|pattern| pattern.simpler) {
        Some(_) => "If nothing is found there, the effects named above remain.",
        None => "",
    };
    let none = "No experiment of the list is computed for a law that is not in the catalogue.";
    Some(format!("Next: {}. {none} {rest}", told.join("; ")).trim_end().to_string())
}

/// The marker and the hold where the final model fails most.
fn where_most(d: &Diagnosis) -> Option<String> {
    let map = &d.residuals_after;
    let size = |cell: &ResidualCell| cell.norm_in_noise.unwrap_or(cell.norm_mm);
    let cells = map.cells.iter().enumerate().flat_map(|(m, row)| row.iter().enumerate().map(move |(h, c)| (m, h, c)));
    let (marker, hold, _) = cells.max_by(|a, b| size(a.2).total_cmp(&size(b.2)))?;
    let at = &map.holds[hold];
    Some(format!(
        "look at marker {} at {} kPa ({}), where the model fails most, and take that hold again, also with ±{TIP_FORCE_N} N on \
         the tip",
        map.markers[marker],
        short(at.p_act_kpa),
        at.phase
    ))
}
