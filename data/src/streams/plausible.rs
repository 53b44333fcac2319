//! Numbers that are a plausible robot only in another unit, or with the y axis turned over.
//!
//! These checks look at the whole file and say which column to rename; they never convert anything themselves.

use crate::dataset::Dataset;
use crate::error::{DataError, Fault, Result};
use crate::header::{Header, P_ACT, P_BODY, QUANTITIES, STATION, X, Y, Z};
use crate::policy;
use crate::rows::{Row, RowReader};
use crate::units::mm;

/// Largest values seen, for the check of units.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Extremes {
    pub x_m: f64,
    pub y_m: f64,
    pub z_m: f64,
    pub station_m: f64,
    pub p_body_pa: f64,
    pub p_act_pa: f64,
    /// There is a column of gauge readings.
    pub gauge: bool,
}

impl Extremes {
    pub(crate) fn widen(&mut self, row: &Row) {
        let widen = |most: &mut f64, value: f64| *most = most.max(value.abs());
        widen(&mut self.x_m, row.x_m);
        widen(&mut self.y_m, row.y_m);
        widen(&mut self.z_m, row.z_m.unwrap_or(0.0));
        widen(&mut self.station_m, row.station_m.unwrap_or(0.0));
        widen(&mut self.p_body_pa, row.p_body_pa);
        [row.p_act_pa].iter().chain(&row.more_act_pa).for_each(|p| widen(&mut self.p_act_pa, *p));
        self.gauge |= row.gauge_pa.is_some();
    }
}

/// Refuses lengths and pressures that look like another unit.
///
/// # Errors
/// Metres in a millimetre column or millimetres in a metre column; psi, bar or MPa in the kPa columns.
pub(crate) fn check_units(cells: &RowReader, extremes: &Extremes) -> Result<()> {
    let unit = |quantity: usize| cells.header.unit(quantity);
    let known_robot = extremes.p_act_pa > 0.0 || extremes.station_m > 0.0;
    let looks = |quantity, value, word: &str| Err(unit_error(&cells.header, quantity, value, word));
    if unit(X) == "mm"
        && known_robot
        && extremes.x_m < policy::SHORTEST_ROBOT_M
        && extremes.y_m < policy::SHORTEST_ROBOT_M
    {
        return looks(X, mm(extremes.x_m), "metres");
    }
    if unit(STATION) == "mm" && extremes.station_m > 0.0 && extremes.station_m < policy::SHORTEST_ROBOT_M {
        return looks(STATION, mm(extremes.station_m), "metres");
    }
    let lengths = [(X, extremes.x_m), (Y, extremes.y_m), (Z, extremes.z_m), (STATION, extremes.station_m)];
    for (quantity, value_m) in lengths {
        if unit(quantity) == "m" && value_m > policy::LONGEST_ROBOT_M {
            return looks(quantity, value_m, "millimetres");
        }
    }
    if unit(P_ACT) == "kPa" && unit(P_BODY) == "kPa" {
        return check_small_pressures(cells, extremes.p_body_pa * 1e-3, extremes.p_act_pa * 1e-3);
    }
    Ok(())
}

fn unit_error(header: &Header, quantity: usize, largest: f64, word: &str) -> DataError {
    let (base, suffix) = (QUANTITIES[quantity].base, if word == "metres" { "m" } else { "mm" });
    let message = format!("the largest value of this column is {largest:.4}: it looks like {word}");
    DataError::Unit(header.fault(quantity, message, format!("name the column {base}_{suffix}")))
}

fn check_small_pressures(cells: &RowReader, p_body: f64, p_act: f64) -> Result<()> {
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
    Err(DataError::Unit(cells.header.fault(P_ACT, message, help)))
}

/// How y is not what it should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WrongY {
    Exchanged,
    Down,
}

impl WrongY {
    /// What to do, where y is in a column of this unit.
    fn help(self, unit: &str, down: bool) -> String {
        match (self, down) {
            (WrongY::Exchanged, _) => {
                "x runs from the base along the straight robot, y towards the actuator: exchange the names of the two columns".into()
            }
            (_, true) => {
                format!("y_down_{unit} means the values grow downwards; here they grow upwards: name the column y_{unit}")
            }
            _ => format!("y is positive towards the actuator: multiply it by -1, or name the column y_down_{unit}"),
        }
    }
}

/// Refuses a table whose last marker moves to negative y when the actuator is inflated.
///
/// # Errors
/// As [`wrong_y`].
pub(crate) fn check_y_up(header: &Header, dataset: &Dataset) -> Result<()> {
    let Some((wrong, message)) = wrong_y(dataset) else { return Ok(()) };
    Err(DataError::Unit(header.fault(Y, message, wrong.help(header.unit(Y), header.y_down))))
}

/// The same of a table that was read before and is now of a planar robot.
///
/// # Errors
/// As [`wrong_y`].
pub(crate) fn check_y_up_later(dataset: &Dataset) -> Result<()> {
    let Some((wrong, message)) = wrong_y(dataset) else { return Ok(()) };
    Err(DataError::Unit(Box::new(Fault::of_file(&dataset.name, message, wrong.help("mm", false)))))
}

/// Whether the last marker is, at the highest actuator pressure, more than 5 mm below its place in the first hold (mean over runs).
/// Markers along y rather than x in that hold are not reported as a y that points down.
fn wrong_y(dataset: &Dataset) -> Option<(WrongY, String)> {
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
        let [along_x, along_y] = [0, 1].map(|axis| mm(length_m(axis)));
        let message = format!(
            "x and y look exchanged: in the first hold the markers take up {along_y:.1} mm of y and {along_x:.1} mm of x"
        );
        return Some((WrongY::Exchanged, message));
    }
    let message = format!(
        "y points down: at {:.1} kPa marker {} has moved by {:.1} mm",
        holds[highest].p_act_pa * 1e-3,
        dataset.markers[last].name,
        mm(moved_m)
    );
    Some((WrongY::Down, message))
}
