//! Holds of all runs as the tidy marker table and a first `about.toml`.

use std::fmt::Write as _;

use super::holds::{Kept, PressedRun};
use super::options::ImportOptions;
use crate::cells::quoted;
use crate::dataset::Phase;
use crate::policy::tolerance_act_pa;
use crate::units::{kpa, mm};

/// Rows of a hold and marker; consecutive frames are averaged where there are more.
const MOST_ROWS: usize = 20;

pub(crate) fn markers_csv(
    runs: &[(PressedRun, Vec<Kept>)],
    markers: &[String],
    actuator: &str,
    one_row: bool,
) -> String {
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for (run, holds) in runs {
        for (hold, phase) in holds.iter().zip(phases(holds)) {
            let rows = if one_row { 1 } else { hold.frames.len().min(MOST_ROWS) };
            for row in 0..rows {
                let cut = |k: usize| k * hold.frames.len() / rows;
                add_rows(&mut text, run, &hold.frames[cut(row)..cut(row + 1)], phase, markers, actuator);
            }
        }
    }
    text
}

fn add_rows(text: &mut String, run: &PressedRun, frames: &[usize], phase: Phase, markers: &[String], actuator: &str) {
    let mean = |values: &[f64]| frames.iter().map(|frame| values[*frame]).sum::<f64>() / frames.len() as f64;
    let [body, act] = [0, 1].map(|which| kpa(mean(&run.pressures_pa[which])));
    let (label, actuator, t, phase) = (quoted(&run.label), quoted(actuator), mean(&run.times_s), phase.word());
    for (marker, column) in markers.iter().zip(&run.xy_m) {
        let places = frames.iter().map(|frame| column[*frame]);
        let seen: Vec<[f64; 2]> = places.filter(|place| place[0].is_finite()).collect();
        let mean_mm = |axis: usize| mm(seen.iter().map(|place| place[axis]).sum::<f64>() / seen.len() as f64);
        let place = if seen.is_empty() { ",".into() } else { format!("{:.4},{:.4}", mean_mm(0), mean_mm(1)) };
        let marker = quoted(marker);
        // Writing into a String cannot fail.
        let _ = writeln!(text, "{label},{actuator},{t:.4},{body:.4},{act:.4},{phase},{marker},{place}");
    }
}

/// How every hold was reached, by its pressure and the pressure of the hold before.
pub(crate) fn phases(holds: &[Kept]) -> Vec<Phase> {
    let mut before = f64::NEG_INFINITY;
    let phase = |hold: &Kept| {
        let change = hold.act_pa - before;
        let least = if before.is_finite() { tolerance_act_pa(before) } else { 0.0 };
        before = hold.act_pa;
        match hold.rising {
            Some(true) => Phase::Load,
            Some(false) => Phase::Unload,
            None if change > least => Phase::Load,
            None if change < -least => Phase::Unload,
            None => Phase::Hold,
        }
    };
    holds.iter().map(phase).collect()
}

/// A description of all that is known, with questions for the rest.
pub(crate) fn about_toml(
    program: &str,
    files: &[String],
    markers: &[(String, f64, bool)],
    actuator: &str,
    told: &[String],
) -> String {
    let string = |value: &str| toml::Value::from(value).to_string();
    let names = markers.iter().map(|(name, ..)| string(name)).collect::<Vec<_>>().join(", ");
    let stations = markers.iter().map(|(_, s, _)| format!("{:?}", mm(*s).round())).collect::<Vec<_>>().join(", ");
    let question = match markers.iter().all(|(.., given)| *given) {
        true => "",
        false => "   # QUESTION: estimated from the robot at rest; measure them along the undeformed body",
    };
    let title = string(&format!("Imported from {}", files.first().map_or("", String::as_str)));
    let source = string(&format!("{program}: {}", files.join(", ")));
    let actuator = string(actuator);
    let mut text = format!(
        "# Half filled by `ibr data import`. Answer the QUESTIONs, then delete them; `ibr data check` reads the rest.\n\
         title = {title}\n\
         provenance = \"measured\"\n\
         source = {source}   # QUESTION: which laboratory, bench and camera?\n\
         licence = \"not stated\"   # QUESTION: under which terms may others use these data?\n\
         actuator = {actuator}\n\n\
         # QUESTION: how large is the robot? Fill in and take off the #.\n\
         # [geometry]\n# body_radius_mm = 40\n# body_length_mm = 360\n# pouch_length_mm = 60\n# pouch_width_mm = 60\n# pouches = 6\n\n\
         [markers]\nnames = [{names}]\ns_mm = [{stations}]{question}\n\n\
         # QUESTION: does gravity act in the plane of bending? Then which way, along x and y:\n\
         # [gravity]\n# direction = [0, -1]\n\n\
         # QUESTION: was p_act read by a gauge at the actuator? Were positions taken from fiducials on the clamp?\n\
         # [direct]\n# pressure = true\n# frame = true\n\n\
         # What the import assumed:\n"
    );
    told.iter().for_each(|line| text.push_str(&format!("# - {}\n", line.replace(['\n', '\r'], " "))));
    text
}

/// A marker at the base \[m\].
const LEAST_STATION_M: f64 = 1e-3;

/// Stations given, or the places at rest along the robot.
pub(crate) fn stations(
    runs: &[(PressedRun, Vec<Kept>)],
    markers: &[String],
    options: &ImportOptions,
) -> Vec<(String, f64, bool)> {
    let of_run = |marker: usize, (run, holds): &(PressedRun, Vec<Kept>)| {
        let rest = holds.iter().min_by(|a, b| a.act_pa.total_cmp(&b.act_pa))?;
        let along = rest.frames.iter().map(|frame| run.xy_m[marker][*frame][0]);
        let seen: Vec<f64> = along.filter(|x| x.is_finite()).collect();
        (!seen.is_empty()).then(|| seen.iter().sum::<f64>() / seen.len() as f64)
    };
    let estimate = |marker: usize| {
        let found: Vec<f64> = runs.iter().filter_map(|run| of_run(marker, run)).collect();
        (found.iter().sum::<f64>() / found.len().max(1) as f64).max(LEAST_STATION_M)
    };
    let station = |(marker, name): (usize, &String)| {
        let given = options.station_m(name);
        (name.clone(), given.unwrap_or_else(|| estimate(marker)), given.is_some())
    };
    markers.iter().enumerate().map(station).collect()
}
