//! A robot's run in words.

use crate::prelude::*;
use fem::robot::{Reading, Snap};
use fem::session::RobotSummary;

const MM: f64 = 1e3;

/// What a robot's run came to, as text.
pub(super) fn text(robot: &RobotSummary) -> String {
    let readings = &robot.readings;
    let Some(last) = readings.last() else { return String::new() };
    let title = match robot.is_spatial {
        true => "Displacement of the sections [mm] along y and z; the turn is that of the tip's normal",
        false => "Displacement towards the actuator [mm]: section at the station; at the tip also the mean of its ring",
    };
    let axes = if robot.is_spatial { &[("y", 1), ("z", 2)][..] } else { &[("", 1)] };
    let rows = readings.iter().flat_map(|r| axes.iter().map(move |(name, axis)| (r, *name, *axis)));
    let mut moved = Table::of(rows)
        .right("actuator kPa", |(r, ..)| pressures(r))
        .when(robot.is_spatial, |table| table.right("along", |(_, name, _)| *name));
    for (k, s) in last.stations_m.iter().enumerate() {
        moved = moved.number(format!("s = {:.0}", s * MM), 1, |(r, _, axis)| r.moved_m.get(k).map(|d| d[*axis] * MM));
    }
    let aside = |r: &Reading, k: usize| r.out_of_plane_m()[k] * MM;
    let moved = moved
        .number("tip ring", 1, |(r, _, axis)| r.ring_moved_m.last().map(|d| d[*axis] * MM))
        .number("tip x", 1, |(r, ..)| r.moved_m.last().map(|d| d[0] * MM))
        .number("turn deg", 1, |(r, ..)| r.tip_angle_rad.to_degrees())
        .when(!robot.is_spatial, |table| {
            table.number("tip z", 1, |(r, ..)| aside(r, 0)).number("most z", 1, |(r, ..)| aside(r, 1))
        });
    format!("{}\n{}{}", moved.under(title), state(readings), buckling(&robot.snaps))
}

/// Of all strips, or one number where they are alike \[kPa\].
fn pressures(r: &Reading) -> String {
    let alike = r.strips_pa.iter().all(|pa| *pa == r.actuator_pa);
    let strips = if alike { &[r.actuator_pa][..] } else { &r.strips_pa };
    strips.iter().map(|pa| format!("{:.0}", pa * 1e-3)).collect::<Vec<_>>().join("/")
}

fn state(readings: &[Reading]) -> String {
    let at_rest = |r: &&Reading| match (r.is_at_rest, r.ahead_m) {
        (true, _) => "yes".into(),
        (false, Some(ahead_m)) => format!("no, {:.1} mm ahead", ahead_m * MM),
        (false, None) => "not known".into(),
    };
    let strength = readings.iter().any(|r| r.seam_share.is_some());
    Table::of(readings)
        .right("actuator kPa", |r| pressures(r))
        .number("body cm³", 1, |r| r.body_m3 * 1e6)
        .number("actuator cm³", 1, |r| r.actuator_m3 * 1e6)
        .number("von Mises MPa", 1, |r| r.von_mises_pa * 1e-6)
        .right("in", |r| &r.von_mises_part)
        .number("at mm", 0, |r| r.von_mises_at_m * MM)
        .number("weld N/m", 0, |r| r.seam_n_per_m)
        .right("in", |r| &r.seam_part)
        .number("at mm", 0, |r| r.seam_at_m * MM)
        .number("kinetic %", 2, |r| 100.0 * r.kinetic_share)
        .right("at rest", at_rest)
        .when(strength, |t| t.right("weld", |r| &r.seam).number("of its strength", 2, |r| r.seam_share))
        .text()
}

fn buckling(found: &[Snap]) -> String {
    if found.is_empty() {
        return "\nno buckling event while the actuator is filled\n".into();
    }
    let mut largest: Vec<&Snap> = found.iter().collect();
    largest.sort_by(|a, b| b.released_j.total_cmp(&a.released_j));
    let released_mj: f64 = found.iter().map(|s| s.released_j * 1e3).sum();
    let mut out = format!("\n{} buckling events, {released_mj:.0} mJ released in all; the largest:\n", found.len());
    out += &Table::of(largest.into_iter().take(8))
        .number("time s", 3, |s| s.time_s)
        .number("at mm", 0, |s| s.place_m * MM)
        .number("released mJ", 1, |s| s.released_j * 1e3)
        .number("walls' kinetic peak mJ", 1, |s| s.kinetic_j * 1e3)
        .text();
    out
}
