//! Files of a robot's complete run in addition to the common ones: readings, markers as a dataset, buckling events, pictures.

use super::{FeRun, Further, Loaded, WatchedRobot, rounded};
use crate::output::picture::{self, Image, PictureLook, Viewpoint};
use crate::robot::{Reading, Snap};
use crate::{FemError, Mesh, Result, Simulation};
use std::fmt::Display;

/// Share of the elements whose stress is within the colour scale: a few at the ends of welds are far above all others.
const WITHIN: f64 = 0.99;
const MM: f64 = 1e3;
const AXES: [&str; 3] = ["x", "y", "z"];

/// All of them, by name; further ones are made in parallel with the pictures, which take as long.
pub(super) fn files(
    loaded: &Loaded,
    run: &FeRun,
    state: &Simulation,
    further: Option<Further>,
) -> Result<Vec<(String, Vec<u8>)>> {
    std::thread::scope(|scope| {
        let making = further.map(|make| scope.spawn(move || make(loaded, run)));
        let mut found = own(loaded, run, state)?;
        if let Some(making) = making {
            let made = making.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            found.extend(made.map_err(FemError::Problem)?);
        }
        Ok(found)
    })
}

fn own(loaded: &Loaded, run: &FeRun, state: &Simulation) -> Result<Vec<(String, Vec<u8>)>> {
    let mesh = &loaded.case.problem.mesh;
    let (mut found, pictures) = match (&loaded.robot, &run.summary.robot) {
        (Some(robot), Some(read)) => {
            let tables = [
                ("readings.csv", readings_csv(&read.readings)),
                ("markers.csv", markers_csv(robot, &read.readings)),
                ("snaps.csv", snaps_csv(&read.snaps)),
            ];
            let tables = tables.map(|(name, text)| (name.to_string(), text.into_bytes())).to_vec();
            (tables, pictures(robot, mesh, state, read.readings.last().is_none_or(|r| r.is_at_rest))?)
        }
        _ if loaded.case.outputs.pictures => (Vec::new(), vec![end(loaded, state)?]),
        _ => (Vec::new(), Vec::new()),
    };
    found.extend(pictures.iter().map(|(name, image)| (name.to_string(), picture::png_bytes(image))));
    Ok(found)
}

/// The end state of a case, coloured by von Mises stress.
fn end(loaded: &Loaded, state: &Simulation) -> Result<(&'static str, Image)> {
    let problem = &loaded.case.problem;
    let title = format!("{}, von Mises stress [MPa] at {:.4} s", problem.name, state.time_s());
    let look = PictureLook { view: loaded.case.outputs.view, title, ..PictureLook::default() };
    Ok(("picture.png", picture::render(&problem.mesh, &state.positions(), &stress_mpa(state), &look)?))
}

fn readings_csv(readings: &[Reading]) -> String {
    let mut out = String::from("p_act_kpa,time_s,quantity,place,value,unit\n");
    for r in readings {
        let mut line = |quantity: &str, place: &dyn Display, value: f64, unit: &str| {
            let (kpa, time_s) = (r.actuator_pa * 1e-3, r.time_s);
            out += &format!("{kpa},{time_s},{quantity},{place},{value},{unit}\n");
        };
        for ((station, moved), ring) in r.stations_m.iter().zip(&r.moved_m).zip(&r.ring_moved_m) {
            let place = rounded(station * MM);
            for (k, axis) in AXES.into_iter().enumerate() {
                line(&format!("d{axis}"), &place, moved[k] * MM, "mm");
                line(&format!("ring_d{axis}"), &place, ring[k] * MM, "mm");
            }
        }
        for (station, moved) in r.stations_m.iter().zip(&r.seen_moved_m) {
            for (k, axis) in AXES.into_iter().enumerate() {
                line(&format!("seen_d{axis}"), &rounded(station * MM), moved[k] * MM, "mm");
            }
        }
        line("tip_turn", &"", r.tip_angle_rad.to_degrees(), "deg");
        line("volume", &"body", r.body_m3 * 1e6, "cm3");
        line("volume", &"actuator", r.actuator_m3 * 1e6, "cm3");
        let at = |part: &str, at_m: f64| format!("{part} at {:.0} mm", at_m * MM);
        let hottest = at(&r.von_mises_part, r.von_mises_at_m);
        let seam = at(&r.seam_part, r.seam_at_m);
        line("von_mises_max", &hottest, r.von_mises_pa * 1e-6, "MPa");
        line("weld_force_max", &seam, r.seam_n_per_m, "N/m");
        if let Some(share) = r.seam_share {
            line("weld_force_over_strength", &r.seam, share, "1");
        }
        let [tip_m, most_m] = r.out_of_plane_m();
        line("out_of_plane", &"tip", tip_m * MM, "mm");
        line("out_of_plane", &"most", most_m * MM, "mm");
        if let Some(i) = r.inflated {
            for (name, m) in [("arm", i.arm_m), ("pouch_width", i.width_m), ("pouch_height", i.height_m)] {
                line(name, &"inner", m * MM, "mm");
            }
        }
        for (k, axis) in AXES.into_iter().enumerate() {
            line(&format!("reaction_{axis}"), &"base", r.base_n[k], "N");
            line(&format!("reaction_m{axis}"), &"base", r.base_nm[k], "N m");
        }
        line("kinetic_share", &"", r.kinetic_share, "1");
        line("waited", &"", r.waited_s, "s");
        line("at_rest", &"", f64::from(u8::from(r.is_at_rest)), "1");
        for (name, kind, energy) in &r.ledger {
            line(&format!("energy {kind}"), name, *energy, "J");
        }
    }
    out
}

/// The columns of a measured dataset, so that `ibr compare` can hold the reduced model against the run; with strips round the body
/// z too, and a pressure for each channel.
fn markers_csv(robot: &WatchedRobot, readings: &[Reading]) -> String {
    let scenario = &robot.scenario;
    let highest = scenario.strips().map(|strip| strip.channel).max().filter(|_| !scenario.more_strips.is_empty());
    let channels = highest.unwrap_or(0) + 1;
    let more: String = (1..channels).map(|channel| format!("p_act_{channel}_kpa,")).collect();
    let axes = if scenario.is_spatial() { 3 } else { 2 };
    let names = ["x_mm", "y_mm", "z_mm"][..axes].join(",");
    let mut out = format!("run,actuator,t_s,p_body_kpa,p_act_kpa,{more}phase,marker,{names},s_mm\n");
    let kind = scenario.actuator.kind.name;
    let mut before = 0.0;
    for r in readings {
        let all_pa: f64 = r.strips_pa.iter().sum();
        let phase = if all_pa >= before { "load" } else { "unload" };
        before = all_pa;
        let strip = |channel: usize| scenario.strips().position(|strip| channels == 1 || strip.channel == channel);
        let of = |channel: usize| strip(channel).map_or(0.0, |i| r.strips_pa[i]);
        let pressures_pa = std::iter::once(r.body_pa).chain((0..channels).map(of));
        let pressures: Vec<String> = pressures_pa.map(|pa| rounded(pa * 1e-3).to_string()).collect();
        for (k, station) in scenario.markers_m.iter().enumerate() {
            let Some(moved) = r.seen_moved_m.get(k) else { continue };
            let place = [station + moved[0], moved[1], moved[2]].map(|m| (m * MM).to_string());
            let pressures = pressures.join(",");
            let place = place[..axes].join(",");
            let s = rounded(station * MM);
            let (time_s, number) = (r.time_s, k + 1);
            out += &format!("fem,{kind},{time_s},{pressures},{phase},{number},{place},{s}\n");
        }
    }
    out
}

fn snaps_csv(found: &[Snap]) -> String {
    let mut out = String::from("time_s,place_mm,released_mJ,kinetic_mJ\n");
    for s in found {
        let row = [s.time_s, s.place_m * MM, s.released_j * 1e3, s.kinetic_j * 1e3].map(|x| x.to_string());
        out += &(row.join(",") + "\n");
    }
    out
}

/// Side view, cross-section through the middle of a unit, and cut along the robot; with strips round the body from above too.
fn pictures(
    robot: &WatchedRobot,
    mesh: &Mesh,
    run: &Simulation,
    is_at_rest: bool,
) -> Result<Vec<(&'static str, Image)>> {
    let (stress_mpa, positions) = (stress_mpa(run), run.positions());
    let actuator = &robot.scenario.actuator;
    let unit = actuator.shape.length_m;
    let middle_m = actuator.start_m + ((actuator.count - 1) / 2) as f64 * unit + 0.5 * unit;
    let across = picture::Cut { normal: [1.0, 0.0, 0.0], at_m: middle_m };
    let along = picture::Cut { normal: [0.0, 0.0, 1.0], at_m: 0.0 };
    let look = |what: &str| look(robot, what, &stress_mpa, is_at_rest);
    let end = PictureLook { view: Viewpoint::End, ..look(&format!("section that was at {:.0} mm", middle_m * MM)) };
    let section = picture::section(mesh, &positions, &stress_mpa, &across, &end)?;
    let cut = picture::section(mesh, &positions, &stress_mpa, &along, &look("middle plane"))?;
    let name = &robot.scenario.name;
    let side = picture::render(mesh, &positions, &stress_mpa, &look(name))?;
    let mut made = vec![("side.png", side), ("section.png", section), ("cut.png", cut)];
    if robot.scenario.is_spatial() {
        let top = PictureLook { view: Viewpoint::Top, ..look(name) };
        made.push(("top.png", picture::render(mesh, &positions, &stress_mpa, &top)?));
    }
    Ok(made)
}

fn stress_mpa(run: &Simulation) -> Vec<f64> {
    run.element_fields().von_mises_pa.iter().map(|s| s * 1e-6).collect()
}

/// One colour scale for all pictures of a run: from 0 to a round number above nearly all stresses.
fn look(robot: &WatchedRobot, what: &str, stress_mpa: &[f64], is_at_rest: bool) -> PictureLook {
    let mut sorted = stress_mpa.to_vec();
    sorted.sort_by(f64::total_cmp);
    let nearly_all = sorted.get((WITHIN * sorted.len() as f64) as usize).copied().unwrap_or(0.0);
    let end_pa = robot.run.pressures_pa.last();
    let mut strips: Vec<String> = robot
        .scenario
        .strips()
        .filter_map(|strip| end_pa.map(|channels| format!("{:.0}", channels[strip.channel] * 1e-3)))
        .collect();
    if strips.iter().all(|pressure| *pressure == strips[0]) {
        strips.truncate(1);
    }
    let moves = if is_at_rest { "" } else { ", not at rest" };
    let title = format!("{what}, von Mises [MPa], {} kPa{moves}", strips.join("/"));
    PictureLook {
        view: Viewpoint::Side,
        limits: Some((0.0, picture::round_above(nearly_all))),
        title,
        ..PictureLook::default()
    }
}
