//! Numbers that are a plausible robot only in another unit, or with the y axis turned over.
//!
//! These checks look at the whole file and say which column to rename; they never convert anything themselves.

use crate::columns::TableSheet;
use crate::dataset::Dataset;
use crate::error::{DataError, Result};
use crate::header::{P_ACT, P_BODY, P_MORE, QUANTITIES, STATION, X, Y, Z};
use crate::policy;
use crate::units::mm;

/// Refuses lengths and pressures that look like another unit.
pub(crate) fn check_units(sheet: &TableSheet, largest: &[f64; QUANTITIES.len()]) -> Result<()> {
    let unit = |quantity: usize| sheet.unit(quantity);
    let p_act_pa = P_MORE.iter().fold(largest[P_ACT], |most, more| most.max(largest[*more]));
    let known_robot = p_act_pa > 0.0 || largest[STATION] > 0.0;
    let looks = |quantity, value, word: &str| Err(unit_error(sheet, quantity, value, word));
    let is_short = |quantity: usize| largest[quantity] < policy::SHORTEST_ROBOT_M;
    if unit(X) == "mm" && known_robot && is_short(X) && is_short(Y) {
        return looks(X, mm(largest[X]), "metres");
    }
    if unit(STATION) == "mm" && largest[STATION] > 0.0 && is_short(STATION) {
        return looks(STATION, mm(largest[STATION]), "metres");
    }
    for quantity in [X, Y, Z, STATION] {
        if unit(quantity) == "m" && largest[quantity] > policy::LONGEST_ROBOT_M {
            return looks(quantity, largest[quantity], "millimetres");
        }
    }
    if unit(P_ACT) == "kPa" && unit(P_BODY) == "kPa" {
        return check_small_pressures(sheet, largest[P_BODY] * 1e-3, p_act_pa * 1e-3);
    }
    Ok(())
}

fn unit_error(sheet: &TableSheet, quantity: usize, largest: f64, word: &str) -> DataError {
    let (base, suffix) = (QUANTITIES[quantity].base, if word == "metres" { "m" } else { "mm" });
    let message = format!("the largest value of this column is {largest:.4}: it looks like {word}");
    let help = format!("name the column {base}_{suffix}");
    sheet.fault(quantity, message, help)
}

fn check_small_pressures(sheet: &TableSheet, p_body: f64, p_act: f64) -> Result<()> {
    let fits = |([body, act], _): &([f64; 2], &str)| p_body > 0.0 && p_act > 0.0 && p_body < *body && p_act < *act;
    // Smallest unit last.
    let units = [(policy::LIKE_PSI, "psi"), (policy::LIKE_BAR, "bar"), (policy::LIKE_MPA, "MPa")];
    let Some((_, unit)) = units.into_iter().rfind(fits) else { return Ok(()) };
    let suffix = unit.to_lowercase();
    let message = format!("the largest pressures are {p_act} (actuator) and {p_body} (body): they look like {unit}");
    let help = format!(
        "name the columns p_act_{suffix}, p_body_{suffix}; if they really are that small, give them in Pa as p_act_pa, \
         p_body_pa"
    );
    Err(sheet.fault(P_ACT, message, help))
}

/// Refuses a table whose last marker moves to negative y when the actuator is inflated; without a header, one that was
/// read before and is now of a planar robot.
pub(crate) fn check_y_up(sheet: Option<&TableSheet>, dataset: &Dataset) -> Result<()> {
    let Some((exchanged, message)) = wrong_y(dataset) else { return Ok(()) };
    let down = sheet.and_then(|sheet| sheet.at[Y].as_ref()).is_some_and(|column| column.turned);
    let unit = sheet.map_or("mm", |sheet| sheet.unit(Y));
    let help = match (exchanged, down) {
        (true, _) => {
            "x runs from the base along the straight robot, y towards the actuator: exchange the names of the two columns".into()
        }
        (_, true) => {
            format!("y_down_{unit} means the values grow downwards; here they grow upwards: name the column y_{unit}")
        }
        _ => format!("y is positive towards the actuator: multiply it by -1, or name the column y_down_{unit}"),
    };
    Err(match sheet {
        Some(sheet) => sheet.fault(Y, message, help),
        None => DataError::of(&dataset.name, message, help),
    })
}

/// Whether the last marker is, at the highest actuator pressure, more than 5 mm below its place in the first hold (mean over runs).
/// True where the markers lie along y rather than x in that hold: then y does not point down.
fn wrong_y(dataset: &Dataset) -> Option<(bool, String)> {
    let holds = &dataset.holds;
    let by_pressure = |&a: &usize, &b: &usize| holds[a].p_act_pa.total_cmp(&holds[b].p_act_pa);
    let highest = (0..holds.len()).max_by(by_pressure)?;
    if holds[highest].p_act_pa <= holds[0].p_act_pa {
        return None;
    }
    let mean = dataset.mean_over_runs();
    let at = |hold: usize, marker: usize, axis: usize| {
        let samples = dataset.samples_per_hold;
        (0..samples).map(|sample| mean[dataset.offset(hold, sample, marker) + axis]).sum::<f64>() / samples as f64
    };
    let place = |marker: usize| dataset.markers[marker].station_m.unwrap_or_else(|| at(0, marker, 0));
    let last = (0..dataset.markers.len()).max_by(|&a, &b| place(a).total_cmp(&place(b)))?;
    let moved_m = at(highest, last, 1) - at(0, last, 1);
    if moved_m >= -policy::SURELY_DOWN_M {
        return None;
    }
    let markers = 0..dataset.markers.len();
    let length_m = |axis: usize| {
        let places = markers.clone().map(|marker| at(0, marker, axis));
        places.clone().fold(f64::NEG_INFINITY, f64::max) - places.fold(f64::INFINITY, f64::min)
    };
    if length_m(1) > length_m(0) {
        let [x, y] = [0, 1].map(|axis| mm(length_m(axis)));
        let taken = format!("the markers take up {y:.1} mm of y and {x:.1} mm of x");
        return Some((true, format!("x and y look exchanged: in the first hold {taken}")));
    }
    let (p, name, moved) = (holds[highest].p_act_pa * 1e-3, &dataset.markers[last].name, mm(moved_m));
    Some((false, format!("y points down: at {p:.1} kPa marker {name} has moved by {moved:.1} mm")))
}
