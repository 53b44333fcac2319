//! A robot's run in words.

use crate::tables::table;
use fem::robot::{Reading, Snap};
use fem::session::RobotSummary;

const MM: f64 = 1e3;

/// What a robot's run came to, as text.
pub fn text(robot: &RobotSummary) -> String {
    let readings = &robot.readings;
    let Some(last) = readings.last() else { return String::new() };
    let mut out = String::new();
    if robot.is_spatial {
        out.push_str("\nDisplacement of the sections [mm] along y and z; the turn is that of the tip's normal\n");
    } else {
        out.push_str(
            "\nDisplacement towards the actuator [mm]: section at the station; at the tip also the mean of its ring\n",
        );
    }
    let axes = if robot.is_spatial { &[("y", 1), ("z", 2)][..] } else { &[("", 1)] };
    let mut head = vec!["actuator kPa".to_string()];
    head.extend(robot.is_spatial.then(|| "along".to_string()));
    head.extend(last.stations_m.iter().map(|s| format!("s = {:.0}", s * MM)));
    head.extend(["tip ring", "tip x", "turn deg"].map(String::from));
    head.extend((!robot.is_spatial).then_some(["tip z", "most z"]).into_iter().flatten().map(String::from));
    let row = |r: &Reading, (name, axis): (&str, usize)| {
        let mut row = vec![pressures(r)];
        row.extend(robot.is_spatial.then(|| name.to_string()));
        row.extend(r.moved_m.iter().map(|d| format!("{:.1}", d[axis] * MM)));
        row.push(r.ring_moved_m.last().map_or("–".into(), |d| format!("{:.1}", d[axis] * MM)));
        row.push(r.moved_m.last().map_or("–".into(), |d| format!("{:.1}", d[0] * MM)));
        row.push(format!("{:.1}", r.tip_angle_rad.to_degrees()));
        let aside = (!robot.is_spatial).then(|| r.out_of_plane_m().map(|m| format!("{:.1}", m * MM)));
        row.extend(aside.into_iter().flatten());
        row
    };
    let rows = readings.iter().flat_map(|r| axes.iter().map(|axis| row(r, *axis)));
    out.push_str(&table(&head, 0, rows.collect()));
    out.push('\n');
    out.push_str(&state(readings));
    out.push_str(&buckling(&robot.snaps));
    out
}

/// Of all strips, or one number where they are alike \[kPa\].
fn pressures(r: &Reading) -> String {
    let alike = r.strips_pa.iter().all(|pa| *pa == r.actuator_pa);
    let strips = if alike { &[r.actuator_pa][..] } else { &r.strips_pa };
    strips.iter().map(|pa| format!("{:.0}", pa * 1e-3)).collect::<Vec<_>>().join("/")
}

fn state(readings: &[Reading]) -> String {
    let strength = readings.iter().any(|r| r.seam_share.is_some());
    let mut head = vec![
        "actuator kPa",
        "body cm³",
        "actuator cm³",
        "von Mises MPa",
        "in",
        "at mm",
        "weld N/m",
        "in",
        "at mm",
        "kinetic %",
        "at rest",
    ];
    head.extend(strength.then_some(["weld", "of its strength"]).into_iter().flatten());
    let rows = readings.iter().map(|r| {
        let mut row = vec![
            pressures(r),
            format!("{:.1}", r.body_m3 * 1e6),
            format!("{:.1}", r.actuator_m3 * 1e6),
            format!("{:.1}", r.von_mises_pa * 1e-6),
            r.von_mises_part.clone(),
            format!("{:.0}", r.von_mises_at_m * MM),
            format!("{:.0}", r.seam_n_per_m),
            r.seam_part.clone(),
            format!("{:.0}", r.seam_at_m * MM),
            format!("{:.2}", 100.0 * r.kinetic_share),
            match (r.is_at_rest, r.ahead_m) {
                (true, _) => "yes".into(),
                (false, Some(ahead_m)) => format!("no, {:.1} mm ahead", ahead_m * MM),
                (false, None) => "not known".into(),
            },
        ];
        let share = r.seam_share.map(|share| [r.seam.clone(), format!("{share:.2}")]);
        row.extend(share.into_iter().flatten());
        row
    });
    table(&head, 0, rows.collect())
}

fn buckling(found: &[Snap]) -> String {
    if found.is_empty() {
        return "\nno buckling event while the actuator is filled\n".into();
    }
    let mut largest: Vec<&Snap> = found.iter().collect();
    largest.sort_by(|a, b| b.released_j.total_cmp(&a.released_j));
    let released_mj: f64 = found.iter().map(|s| s.released_j * 1e3).sum();
    let mut out = format!("\n{} buckling events, {released_mj:.0} mJ released in all; the largest:\n", found.len());
    let rows = largest.iter().take(8).map(|s| {
        vec![
            format!("{:.3}", s.time_s),
            format!("{:.0}", s.place_m * MM),
            format!("{:.1}", s.released_j * 1e3),
            format!("{:.1}", s.kinetic_j * 1e3),
        ]
    });
    out.push_str(&table(&["time s", "at mm", "released mJ", "walls' kinetic peak mJ"], 0, rows.collect()));
    out
}
