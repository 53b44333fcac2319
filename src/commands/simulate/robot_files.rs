//! Files of a robot's run beside those of every run: readings, markers as a dataset, buckling events, plots, pictures.

use super::robot::{self, Robot, Watched};
use crate::failure::Failure;
use fem::output::picture::{self, Image, Look, View};
use fem::robot::{Reading, Snap};
use fem::{Mesh, Simulation};
use report::{LineSeries, LineStyle, Lines, lines};
use std::fmt::Write;
use std::path::Path;

/// Share of the elements whose stress lies within the colour scale: a few at the ends of welds are far above all others.
const WITHIN: f64 = 0.99;
const MM: f64 = 1e3;

/// Writes all of them.
pub fn write(robot: &Robot, watched: &Watched, mesh: &Mesh, run: &Simulation, folder: &Path) -> Result<(), Failure> {
    let (readings, found) = (&watched.readings, watched.snaps());
    let text = |name: &str, text: String| data::write_atomically(&folder.join(name), text.as_bytes());
    text("readings.csv", readings_csv(readings))?;
    text("markers.csv", markers_csv(robot, readings))?;
    text("snaps.csv", snaps_csv(&found))?;
    let plots = [
        ("history.png", history(robot, watched, &found)),
        ("displacement.png", displacement(&robot.scenario.name, readings)),
    ];
    // Drawing the plots takes as long as all pictures.
    std::thread::scope(|scope| {
        let draw = |(name, plot): (&'static str, Option<Lines>)| Some((name, lines(&plot?)));
        let drawing = scope.spawn(move || plots.into_iter().filter_map(draw).collect::<Vec<_>>());
        for (name, image) in pictures(robot, mesh, run)? {
            picture::write_png(&folder.join(name), &image)?;
        }
        for (name, drawn) in drawing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)) {
            data::write_atomically(&folder.join(name), &drawn?.png)?;
        }
        Ok(())
    })
}

/// Displacement of every station over the actuator's pressure; `None` for a single reading.
fn displacement(name: &str, readings: &[Reading]) -> Option<Lines> {
    let stations = &readings.first().filter(|_| readings.len() > 2)?.stations_m;
    let series = |k: usize| LineSeries {
        name: format!("{:.0} mm", stations[k] * MM),
        points: readings.iter().map(|r| [r.actuator_pa * 1e-3, r.moved_m[k][1] * MM]).collect(),
        half_width: Vec::new(),
        style: LineStyle::LinePoints,
        colour: None,
    };
    Some(Lines {
        title: format!("{name}: displacement towards the actuator, by distance from the base"),
        x_label: "actuator pressure [kPa]".into(),
        y_label: "displacement [mm]".into(),
        series: (0..stations.len()).map(series).collect(),
    })
}

fn readings_csv(readings: &[Reading]) -> String {
    let mut out = String::from("p_act_kpa,time_s,quantity,place,value,unit\n");
    for r in readings {
        let mut line = |quantity: &str, place: String, value: f64, unit: &str| {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{},{},{quantity},{place},{value},{unit}", r.actuator_pa * 1e-3, r.time_s);
        };
        for ((station, moved), ring) in r.stations_m.iter().zip(&r.moved_m).zip(&r.ring_moved_m) {
            for (k, axis) in ["dx", "dy", "dz"].into_iter().enumerate() {
                line(axis, robot::rounded(station * MM).to_string(), moved[k] * MM, "mm");
                line(&format!("ring_{axis}"), robot::rounded(station * MM).to_string(), ring[k] * MM, "mm");
            }
        }
        for (station, moved) in r.stations_m.iter().zip(&r.seen_moved_m) {
            for (k, axis) in ["dx", "dy", "dz"].into_iter().enumerate() {
                line(&format!("seen_{axis}"), robot::rounded(station * MM).to_string(), moved[k] * MM, "mm");
            }
        }
        line("tip_turn", String::new(), r.tip_angle_rad.to_degrees(), "deg");
        line("volume", "body".into(), r.body_m3 * 1e6, "cm3");
        line("volume", "actuator".into(), r.actuator_m3 * 1e6, "cm3");
        line(
            "von_mises_max",
            format!("{} at {:.0} mm", r.von_mises_part, r.von_mises_at_m * MM),
            r.von_mises_pa * 1e-6,
            "MPa",
        );
        line("weld_force_max", format!("{} at {:.0} mm", r.seam_part, r.seam_at_m * MM), r.seam_n_per_m, "N/m");
        if let Some(i) = r.inflated {
            for (name, m) in [("arm", i.arm_m), ("pouch_width", i.width_m), ("pouch_height", i.height_m)] {
                line(name, "inner".into(), m * MM, "mm");
            }
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            line(&format!("reaction_{axis}"), "base".into(), r.base_n[k], "N");
            line(&format!("reaction_m{axis}"), "base".into(), r.base_nm[k], "N m");
        }
        line("kinetic_share", String::new(), r.kinetic_share, "1");
        for (name, kind, energy) in &r.ledger {
            line(&format!("energy {kind}"), name.clone(), *energy, "J");
        }
    }
    out
}

/// The columns of a measured dataset, so that `ibr compare` can hold the reduced model against the run.
fn markers_csv(robot: &Robot, readings: &[Reading]) -> String {
    let mut out = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,s_mm\n");
    let kind = robot.scenario.actuator.kind.name;
    let mut before = 0.0;
    for r in readings {
        let phase = if r.actuator_pa >= before { "load" } else { "unload" };
        before = r.actuator_pa;
        for (k, station) in robot.scenario.markers_m.iter().enumerate() {
            let Some(moved) = r.seen_moved_m.get(k) else { continue };
            let (x, y) = ((station + moved[0]) * MM, moved[1] * MM);
            let (body, actuator) = (robot::rounded(r.body_pa * 1e-3), robot::rounded(r.actuator_pa * 1e-3));
            let s = robot::rounded(station * MM);
            let _ = writeln!(out, "fem,{kind},{},{body},{actuator},{phase},{},{x},{y},{s}", r.time_s, k + 1);
        }
    }
    out
}

fn snaps_csv(found: &[Snap]) -> String {
    let mut out = String::from("time_s,place_mm,released_mJ,kinetic_mJ\n");
    for s in found {
        let _ = writeln!(out, "{},{},{},{}", s.time_s, s.place_m * MM, s.released_j * 1e3, s.kinetic_j * 1e3);
    }
    out
}

/// Stored and kinetic energy over time with the buckling events.
fn history(robot: &Robot, watched: &Watched, found: &[Snap]) -> Option<Lines> {
    let samples = watched.watch.samples();
    if samples.is_empty() {
        return None;
    }
    let series = |name: &str, points: Vec<[f64; 2]>, style, colour| LineSeries {
        name: name.into(),
        points,
        half_width: Vec::new(),
        style,
        colour: Some(colour),
    };
    let stored = samples.iter().map(|s| [s.time_s, s.stored_j * 1e3]).collect();
    let kinetic = samples.iter().map(|s| [s.time_s, s.kinetic_j * 1e3]).collect();
    let walls = samples.iter().map(|s| [s.time_s, s.walls_j * 1e3]).collect();
    let marks: Vec<[f64; 2]> = found.iter().map(|s| [s.time_s, s.kinetic_j * 1e3]).collect();
    let mut all = vec![
        series("stored", stored, LineStyle::Line, 0),
        series("kinetic", kinetic, LineStyle::Line, 1),
        series("kinetic, walls", walls, LineStyle::Line, 2),
    ];
    if !marks.is_empty() {
        all.push(series("buckling", marks, LineStyle::Points, 3));
    }
    Some(Lines {
        title: format!("{}: energy over time", robot.scenario.name),
        x_label: "time [s]".into(),
        y_label: "energy [mJ]".into(),
        series: all,
    })
}

/// Side view, cross-section through the middle of a unit, and cut along the robot.
fn pictures(robot: &Robot, mesh: &Mesh, run: &Simulation) -> Result<Vec<(&'static str, Image)>, Failure> {
    let (stress_mpa, positions) = (stress_mpa(run), run.positions());
    let actuator = &robot.scenario.actuator;
    let unit = actuator.shape.length_m;
    let middle_m = actuator.start_m + ((actuator.count - 1) / 2) as f64 * unit + 0.5 * unit;
    let across = picture::Cut { normal: [1.0, 0.0, 0.0], at_m: middle_m };
    let along = picture::Cut { normal: [0.0, 0.0, 1.0], at_m: 0.0 };
    let look = |what: &str| look(robot, what, &stress_mpa);
    let end = Look { view: View::End, ..look(&format!("section that was at {:.0} mm", middle_m * MM)) };
    let section = picture::section(mesh, &positions, &stress_mpa, &across, &end)?;
    let cut = picture::section(mesh, &positions, &stress_mpa, &along, &look("middle plane"))?;
    Ok(vec![("side.png", side_view(robot, mesh, run)?), ("section.png", section), ("cut.png", cut)])
}

/// The robot from the side.
pub fn side_view(robot: &Robot, mesh: &Mesh, run: &Simulation) -> Result<Image, Failure> {
    let stress_mpa = stress_mpa(run);
    Ok(picture::render(mesh, &run.positions(), &stress_mpa, &look(robot, &robot.scenario.name, &stress_mpa))?)
}

fn stress_mpa(run: &Simulation) -> Vec<f64> {
    run.element_fields().von_mises_pa.iter().map(|s| s * 1e-6).collect()
}

/// One colour scale for all pictures of a run: from 0 to a round number above nearly all stresses.
fn look(robot: &Robot, what: &str, stress_mpa: &[f64]) -> Look {
    let mut sorted = stress_mpa.to_vec();
    sorted.sort_by(f64::total_cmp);
    let nearly_all = sorted.get((WITHIN * sorted.len() as f64) as usize).copied().unwrap_or(0.0);
    let pressure = robot.run.pressures_pa.last().map_or(0.0, |p| p * 1e-3);
    let title = format!("{what}, von Mises [MPa], {pressure:.0} kPa");
    Look { view: View::Side, limits: Some((0.0, picture::round_above(nearly_all))), title, ..Look::default() }
}
