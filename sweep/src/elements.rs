//! Parts by finite elements: one run per robot, read at all its pressures. Its folder is kept only on request.

use crate::columns::{ACCOUNTS, columns};
use crate::part::{Rows, StudyPart};
use crate::study::{Output, Study};
use compare::wording::short;
use fem::FemError;
use fem::robot::Reading;
use fem::session::{FeRun, Progress, RunJob, RunSettings, simulate_each, simulate_job};
use models::CHANNELS;
use std::path::Path;

/// Runs the robots of the parts, and writes each part below `folder` as soon as it is complete; returns the processor time \[s\].
/// With [`RunSettings::folder`] each run stays there, in a folder named by problem and engine, and is not made again.
pub(crate) fn compute(
    study: &Study,
    parts: &[StudyPart],
    folder: &Path,
    settings: &RunSettings,
    progress: Progress,
) -> Result<f64, FemError> {
    let width = columns(study).len();
    let times = simulate_each(parts.len(), settings.threads, progress, &|k, threads, tell| {
        let (part, settings) = (&parts[k], RunSettings { threads, ..settings.clone() });
        let robots = part.robots(study.per_robot());
        let (first, count, mut rows) = (robots.start, robots.len() as f64, Rows::default());
        for robot in robots {
            let done = (robot - first) as f64;
            let mut told = |text: &str, share: Option<f64>| tell(text, share.map(|share| (done + share) / count));
            match job(study, robot).map(|(job, kpa)| (simulate_job(&job, &settings, &mut told), kpa)) {
                Ok((Ok(run), kpa)) => {
                    rows.cpu_s += run.cost.cpu_s_of_all_sessions;
                    kpa.iter().for_each(|kpa| read(study, &run, *kpa, width, &mut rows));
                }
                Ok((Err(error), kpa)) if error.is_stop() || matches!(error, FemError::Refused(_)) => {
                    kpa.iter().for_each(|_| rows.fail(width, error.to_string()));
                }
                Ok((Err(error), _)) => return Err(error),
                Err(why) => (0..study.per_robot()).for_each(|_| rows.fail(width, why.clone())),
            }
        }
        rows.write(&part.path(study, folder)).map_err(|error| error.of_run(folder))?;
        Ok(rows.cpu_s)
    })?;
    Ok(times.iter().sum())
}

/// The run of a robot, which rises through its pressures; or why there is none.
fn job(study: &Study, robot: usize) -> Result<(RunJob, Vec<f64>), String> {
    let (file, channels) = study.robot(robot).map_err(|error| error.to_string())?;
    // One pressure for all channels, or one pose with a pressure for each; read at the highest.
    let of_strips =
        |pose: &[f64; CHANNELS]| file.scenario.strips().map(|strip| pose[strip.channel]).fold(0.0, f64::max);
    let kpa: Vec<f64> = channels.iter().map(of_strips).collect();
    let mut rising = kpa.clone();
    rising.sort_by(f64::total_cmp);
    rising.dedup();
    // Below the body's pressure an actuator stays flat, and a run is refused.
    rising.retain(|kpa| 1e3 * kpa > file.p_body_pa);
    if let (true, Some(highest)) = (rising.is_empty(), kpa.iter().copied().reduce(f64::max)) {
        return Err(flat(highest, file.p_body_pa));
    }
    let holds = if study.has_channels() { format!("{channels:?}") } else { format!("{rising:?}") };
    let set = [("fem.pressures_kpa".to_string(), holds)];
    let file = file.with(&set).map_err(|error| error.to_string())?;
    Ok((RunJob { source: file.source(&study.folder), what: format!("robot {}", robot + 1), folder: None }, kpa))
}

fn flat(kpa: f64, body_pa: f64) -> String {
    format!("an actuator at {kpa} kPa in a body at {} kPa stays flat", short(1e-3 * body_pa))
}

fn read(study: &Study, run: &FeRun, kpa: f64, width: usize, rows: &mut Rows) {
    let same = |r: &&Reading| (r.actuator_pa - 1e3 * kpa).abs() < 1.0;
    let Some(reading) = run.readings().iter().find(same) else {
        let body_pa = run.readings().first().map_or(study.base.p_body_pa, |r| r.body_pa);
        return rows.fail(width, flat(kpa, body_pa));
    };
    rows.row(width, |numbers| study.outputs.iter().for_each(|output| put(*output, reading, run, study, numbers)));
}

fn put(output: Output, r: &Reading, run: &FeRun, study: &Study, numbers: &mut Vec<f64>) {
    let at = |i: usize, moved: &[[f64; 3]]| match (r.stations_m.get(i), moved.get(i)) {
        (Some(s), Some(d)) => [s + d[0], d[1], d[2]].map(|m| 1e3 * m),
        _ => [f64::NAN; 3],
    };
    let axes = study.axes_of_place().len();
    match output {
        Output::Tip => {
            let tip = at(r.stations_m.len().saturating_sub(1), &r.moved_m);
            numbers.extend(&tip[..axes]);
            numbers.push(r.tip_angle_rad.to_degrees());
        }
        Output::Markers => {
            let places = (0..study.base.markers_m.len()).map(|i| at(i, &r.seen_moved_m));
            places.for_each(|place| numbers.extend(&place[..axes]));
        }
        Output::Ledger => {
            let stored = |name: &str| 1e3 * r.ledger.iter().filter(|l| l.0 == name).map(|l| l.2).sum::<f64>();
            let of = |account: &str| match account {
                "actuator_gas" => -1e3 * r.actuator_pa * r.actuator_m3,
                "body_gas" => -1e3 * r.body_pa * r.body_m3,
                "wall" => stored("bending") + stored("folds"),
                "stretch" => stored("membrane"),
                "compressed_sheets" => stored("compressed sheets"),
                "contact" => stored("contact"),
                "numerical" => stored("hourglass"),
                _ => f64::NAN,
            };
            numbers.extend(ACCOUNTS.map(|(name, _)| of(name)));
        }
        Output::Limits => numbers.push(f64::from(u8::from(run.summary.warnings().is_empty()))),
        Output::Time => numbers.push(run.cost.cpu_s_of_all_sessions / run.readings().len().max(1) as f64),
    }
}
