//! The residual map of a page.

use super::Result;
use super::figures::several_bodies;
use crate::prelude::*;
use crate::words::kpa;
use compare::residuals::{Deviation, ResidualCell, ResidualMap};
use compare::wording::short;
use report::number;

/// Panels of the map in the plane, and the axes that their cells show.
const PANELS: [(&str, usize); 2] = [("y, across the robot", 1), ("x, along the straight robot", 0)];
const PANELS_IN_SPACE: [(&str, usize); 3] =
    [("z, towards azimuth 90°", 2), ("y, towards azimuth 0°", 1), ("x, along the straight robot", 0)];
const MM: f64 = 1e3;
/// Rows that a page can show one under the other.
const MOST_MARKERS: usize = 24;
/// Columns that a page can show next to each other.
const MOST_HOLDS: usize = 40;
/// Residuals are drawn to this many times the noise; more is more of the same colour.
const MAP_LIMIT: f64 = 10.0;
pub(super) const MAP_COLOURS: &str = "Across (y), blue: the robot bends more than the model; orange: less. Along (x), blue: the \
    robot's marker is farther out than the model's; orange: nearer to the base.";

const MAP_COLOURS_IN_SPACE: &str =
    "Blue: the robot's marker is farther out along the axis than the model's; orange: less far.";

/// What the colours of the map of these data mean.
pub(super) fn colours(dataset: &Dataset) -> &'static str {
    if dataset.has_z() { MAP_COLOURS_IN_SPACE } else { MAP_COLOURS }
}

/// Signed residuals marker × hold, across the robot and along it, in units of noise (in mm when the noise is unknown). Of more
/// markers or holds than fit, the one of every few neighbours that is farthest off.
pub(super) fn map(title: &str, map: &ResidualMap, dataset: &Dataset) -> Result<Drawn> {
    let in_noise = map.cells.iter().flatten().all(|c| c.axes().iter().all(|d| d.in_noise.is_some()));
    let value = |seen: bool, d: Deviation| match d.in_noise {
        _ if !seen => f64::NAN,
        Some(z) if in_noise => z,
        _ => d.mm,
    };
    let farthest = |cells: &mut dyn Iterator<Item = &ResidualCell>| {
        let size = |cell: &ResidualCell| if in_noise { cell.norm_in_noise.unwrap_or(0.0) } else { cell.norm_mm };
        cells.fold(0.0, |most: f64, cell| most.max(size(cell)))
    };
    let (rows, each_row) = shown(map.markers.len(), MOST_MARKERS, &|m| farthest(&mut map.cells[m].iter()));
    let of_hold = |h: usize| farthest(&mut map.cells.iter().map(|row| &row[h]));
    let (columns, each_column) = shown(map.holds.len(), MOST_HOLDS, &of_hold);
    let several = several_bodies(dataset);
    let column = |h: &usize| {
        let hold = &map.holds[*h];
        let body = if several { format!("body {} kPa", short(hold.p_body_kpa)) } else { String::new() };
        ChartColumn { name: kpa(hold.p_act_kpa, &hold.p_act_channels_kpa), groups: [hold.phase.to_string(), body] }
    };
    let (mut places, mut marks) = (Vec::new(), Vec::new());
    let panels = if dataset.has_z() { &PANELS_IN_SPACE[..] } else { &PANELS };
    for (label, axis) in panels {
        places.push(ChartRow { name: (*label).into(), place: RowPlace::Heading, ..ChartRow::default() });
        // The tip is the top row.
        for m in rows.iter().rev() {
            for (k, h) in columns.iter().enumerate() {
                let cell = &map.cells[*m][*h];
                let off = value(cell.seen, cell.axes()[*axis]);
                let words = number(off, usize::from(off.abs() < 99.95 && columns.len() < 15));
                marks.push(Mark::Cell([places.len(), k], off / MAP_LIMIT, words, String::new()));
            }
            let station = dataset.markers[*m].station_m.map_or(*m as f64 + 1.0, |s| s * MM);
            places.push(ChartRow::beside(&number(station, 0)));
        }
    }
    let unit = if in_noise { "[times the noise]" } else { "[mm]" };
    let space = Space::Grid(places, columns.iter().map(column).collect());
    let heat = Some((format!("model − measured {unit}"), MAP_LIMIT));
    let title = format!("{title}{}", chosen(each_row, each_column));
    let mut chart = Chart::new(title, "actuator pressure [kPa]", "marker station [mm]");
    (chart.space, chart.marks, chart.heat) = (space, marks, heat);
    Ok(chart.draw("residual map")?)
}

/// Of every few neighbours, as many as leave no more than `most`, the one that is farthest off; and how many they are.
fn shown(count: usize, most: usize, off: &dyn Fn(usize) -> f64) -> (Vec<usize>, usize) {
    let each = count.div_ceil(most).max(1);
    let all: Vec<usize> = (0..count).collect();
    let farthest = |group: &[usize]| group.iter().copied().max_by(|a, b| off(*a).total_cmp(&off(*b)));
    (all.chunks(each).filter_map(farthest).collect(), each)
}

/// What was left out, to follow a title.
fn chosen(each_row: usize, each_column: usize) -> String {
    match (each_row, each_column) {
        (1, 1) => String::new(),
        (rows, 1) => format!(" (of every {rows} markers the one farthest off)"),
        (1, columns) => format!(" (of every {columns} holds the one farthest off)"),
        (rows, columns) => format!(" (of every {rows} markers and {columns} holds those farthest off)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_markers_those_farthest_off_are_shown_and_of_few_all() {
        let off = |m: usize| f64::from(u8::from(m == 123 || m == 399)) + 1e-3 * (m % 7) as f64;
        let (rows, each) = shown(400, 40, &off);
        assert_eq!((rows.len(), each), (40, 10));
        assert!(rows.contains(&123) && rows.contains(&399) && rows.is_sorted());
        assert_eq!(shown(40, 40, &off), ((0..40).collect(), 1));
        assert_eq!(shown(41, 40, &off).0.len(), 21);
    }
}
