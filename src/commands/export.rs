//! `ibr export`

use super::inputs::{self, quantity};
use super::predict::wanted;
use crate::cli::{ExportArgs, ExportCommand, LinearArgs};
use crate::prelude::*;
use crate::tables::Table as Columns;
use models::CHANNELS;
use models::export::{Bound, Joint, Linear, Origin, Table, Untabulated};

pub(super) fn run(command: &ExportCommand, context: &mut Context) -> Result<Outcome> {
    match command {
        ExportCommand::C(args) => c(args, context),
        ExportCommand::Linear(args) => linear(args),
    }
}

/// Joints of a muscle, which has one unit.
const JOINTS: usize = 5;

fn linear(args: &LinearArgs) -> Result<Outcome> {
    let scenario = inputs::robot(&args.robot)?.1;
    let all = wanted(&scenario, args.pressure.as_deref())?;
    let loads = match (&args.pressure, all.as_slice()) {
        (Some(typed), [_, _, ..]) => {
            let message = format!("--pressure {typed} is more than one working point");
            return Err(Failure::usage(message, "give one pressure, with / between supply channels"));
        }
        (_, all) => all[all.len() / 2],
    };
    let units = if scenario.actuator.count > 1 { scenario.actuator.count } else { JOINTS };
    let chain = Linear::new(&scenario, args.joints.map_or(units, |joints| joints as usize), &loads)?;
    let answer = LinearAnswer {
        scenario: &args.robot.scenario,
        name: &scenario.name,
        p_body_kpa: loads.body_pa / 1e3,
        p_act_channels_kpa: loads.actuator_pa.map(|pa| pa / 1e3),
        joints: &chain.joints,
    };
    let mut outcome = Outcome::answer(chain_text(&scenario, &chain), "ibr.export.linear", &answer);
    if chain.joints.iter().any(|joint| joint.stiffness_nm.is_nan() || joint.offset_nm.is_nan()) {
        outcome.notes.push("note: an actuator is flat or at the end of its stroke there, and has no slope".into());
    }
    Ok(outcome)
}

fn chain_text(scenario: &Scenario, chain: &Linear) -> String {
    let mut joints = Columns::of(chain.joints.iter().enumerate())
        .right("joint", |(i, _)| (i + 1).to_string())
        .number("start [mm]", 1, |(_, joint)| joint.start_m * 1e3)
        .number("length [mm]", 1, |(_, joint)| joint.length_m * 1e3)
        .number("q [deg]", 2, |(_, joint)| joint.angle_rad.to_degrees())
        .right("K [N m/rad]", |(_, joint)| or_dash(joint.stiffness_nm))
        .right("C [N m s/rad]", |(_, joint)| joint.damping_nms.map_or("-".into(), or_dash))
        .right("b [N m]", |(_, joint)| or_dash(joint.offset_nm));
    for channel in channels(chain) {
        joints = joints.right(format!("B{channel} [N m/kPa]"), |(_, joint)| or_dash(joint.per_pa[channel] * 1e3));
    }
    format!(
        "{} at {} kPa, body pressure {} kPa\n{}Moment that bends a joint: b + B P - K q - C q\u{27}. Predicted.\n",
        scenario.name,
        pressure_words(&chain.loads),
        chain.loads.body_pa / 1e3,
        joints.text()
    )
}

/// A number; none where an actuator is flat.
fn or_dash(value: f64) -> String {
    if value.is_nan() { "-".into() } else { format!("{value:.5}") }
}

/// Channels that drive a joint; at least the first.
fn channels(chain: &Linear) -> Vec<usize> {
    let drives = |channel: &usize| *channel == 0 || chain.joints.iter().any(|joint| joint.per_pa[*channel] != 0.0);
    (0..CHANNELS).filter(drives).collect()
}

/// `ibr.export.linear`: `ibr export linear SCENARIO`
#[derive(Serialize)]
struct LinearAnswer<'a> {
    /// Scenario as typed
    scenario: &'a str,
    /// Name in the scenario
    name: &'a str,
    /// Body pressure
    p_body_kpa: f64,
    /// Actuator pressure of every channel at the working point
    p_act_channels_kpa: [f64; CHANNELS],
    /// Base to tip
    joints: &'a [Joint],
}

fn c(args: &ExportArgs, context: &mut Context) -> Result<Outcome> {
    let scenario = inputs::robot(&args.robot)?.1;
    let (model, range_pa) = (Model::new(&scenario), range(&scenario, args.pressure.as_deref())?);
    let history = if model.has_history() { scenario.remembering() } else { Vec::new() };
    if !history.is_empty() && !args.loading {
        let message =
            format!("with {} a state depends on those before it, and a table knows the pressure", history.join(", "));
        let help = "add --loading for the first loading from rest, or leave it out of the scenario";
        return Err(Failure::usage(message, help));
    }
    if args.out.extension().is_none_or(|end| end != "c") {
        let message = format!("--out {} does not end with .c", args.out.display());
        return Err(Failure::usage(message, "write for example --out robot.c"));
    }
    let table = Table::new(&model, scenario.p_body_pa, range_pa).map_err(refused)?;
    let stem = args.out.file_stem().unwrap_or_default().to_string_lossy();
    let command = format!("ibr {} export c {}", env!("CARGO_PKG_VERSION"), args.robot.scenario);
    let origin = Origin { prefix: &stem, robot: &scenario.name, command: &command, history: &history };
    let [header, source] = table.c_files(&origin);
    let files = [(args.out.with_extension("h"), header), (args.out.clone(), source)];
    write_texts(&files, context)?;
    Ok(told(args, &table, &files.map(|(path, _)| path.display().to_string())))
}

/// Pressures from:to; a number without unit has that of the other.
fn range(scenario: &Scenario, typed: Option<&str>) -> Result<[f64; 2]> {
    let Some(typed) = typed else { return Ok([0.0, scenario.p_max_pa]) };
    let Some((from, to)) = typed.split_once(':') else {
        let help = "write from:to, for example --pressure 0:40kPa";
        return Err(Failure::usage(format!("--pressure {typed} is no range"), help));
    };
    let high = quantity("--pressure", to, Quantity::Pressure)?;
    let unit = to.trim_start_matches(|c: char| !c.is_alphabetic());
    let low = match from.parse::<f64>() {
        Ok(_) => quantity("--pressure", &format!("{from}{unit}"), Quantity::Pressure)?,
        Err(_) => quantity("--pressure", from, Quantity::Pressure)?,
    };
    Ok([low, high])
}

fn refused(error: Untabulated) -> Failure {
    let help = match &error {
        Untabulated::Unsolved(unsolved) => return unsolved.clone().into(),
        Untabulated::Order { .. } | Untabulated::Range { .. } => "write from:to, for example --pressure 0:40kPa",
        Untabulated::Channels { .. } => "ibr-capi solves such a robot (docs/control.md)",
        Untabulated::TooRough { .. } => "export the pressures on one side of it, for example --pressure 5:40kPa",
    };
    Failure::usage(error.to_string(), help)
}

/// `ibr.export.c`: `ibr export c SCENARIO`
#[derive(Serialize)]
struct TableAnswer<'a> {
    /// Scenario as typed
    scenario: &'a str,
    /// Files
    written: &'a [String],
    /// Constants, in single precision
    bytes: usize,
    /// Polynomials of each output
    pieces: usize,
    /// Of the polynomials
    degree: usize,
    /// Markers in the table
    markers: usize,
    /// Body pressure
    p_body_kpa: f64,
    /// Actuator pressures, from and to
    p_act_kpa: [f64; 2],
    /// Pressure up to which the actuator is flat
    p_open_kpa: f64,
    /// Heights of the tip that have one pressure, from and to
    heights_mm: Option<[f64; 2]>,
    /// Largest differences from the model
    bound: &'a Bound,
}

fn told(args: &ExportArgs, table: &Table, names: &[String]) -> Outcome {
    let (bound, kpa) = (&table.bound, |pa: f64| pa / 1e3);
    let markers = match table.markers() {
        0 => String::new(),
        count => format!(", {count} markers {:.1e} mm", bound.marker_m * 1e3),
    };
    let text = format!(
        "{}: {} bytes of constants, {} pieces of degree {}\nActuator pressures {} to {} kPa at body pressure {} kPa.\n\
         Largest difference from the model at {} pressures: tip {:.1e} mm ({:.1e} of the length), angle {:.1e} deg{markers}.\n",
        names.join(", "),
        table.bytes(),
        table.pieces(),
        table.degree,
        kpa(table.range_pa[0]),
        kpa(table.range_pa[1]),
        kpa(table.body_pa),
        bound.pressures,
        bound.tip_m * 1e3,
        bound.tip_m / table.length_m,
        bound.angle_rad.to_degrees(),
    );
    let answer = TableAnswer {
        scenario: &args.robot.scenario,
        written: names,
        bytes: table.bytes(),
        pieces: table.pieces(),
        degree: table.degree,
        markers: table.markers(),
        p_body_kpa: kpa(table.body_pa),
        p_act_kpa: table.range_pa.map(kpa),
        p_open_kpa: kpa(table.open_pa),
        heights_mm: table.heights_m().map(|h| h.map(|m| m * 1e3)),
        bound,
    };
    let mut outcome = Outcome::answer(text, "ibr.export.c", &answer);
    if table.markers() == 0 {
        outcome.notes.push("note: no markers in the table: the scenario has none, or they do not fit".into());
    }
    outcome
}
