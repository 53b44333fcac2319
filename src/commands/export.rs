use super::export_table::{target, trusted, write};
use super::inputs;
use super::predict::wanted;
use crate::cli::{ExportCommand, LinearArgs, RigidArgs};
use crate::prelude::*;
use models::CHANNELS;
use models::export::{Joint, Linear, Surroundings};

pub(super) fn run(command: &ExportCommand, context: &mut Context) -> Result<Outcome> {
    match command {
        ExportCommand::C(args) => super::export_table::c(args, context),
        ExportCommand::Fmu(args) => super::export_table::fmu(args, context),
        ExportCommand::Linear(args) => linear(args),
        ExportCommand::Mjcf(args) => rigid(args, "xml", Linear::mjcf, context),
        ExportCommand::Urdf(args) => rigid(args, "urdf", Linear::urdf, context),
    }
}

/// Joints of a muscle, which has one unit.
const JOINTS: usize = 5;

/// Refuses a working point at which actuators are flat: all of them, or any where every channel needs a drive.
fn open(model: &Model, loads: &Loads, needs_all: bool) -> Result<()> {
    let slopes = model.jacobian(loads, &mut model.prediction())?;
    let is_flat = |channel: &usize| slopes[*channel].y_per_pa.is_nan();
    let flat = model.channels().find(is_flat).filter(|_| needs_all || model.channels().all(|c| is_flat(&c)));
    flat.map_or(Ok(()), |channel| {
        let pressures = pressure_words(loads);
        let message = format!("cannot export a chain: the actuators of channel {channel} are flat at {pressures} kPa");
        Err(Failure::usage(message, "give a pressure that opens them, for example --pressure 20kPa"))
    })
}

fn chain(args: &LinearArgs, needs_all: bool) -> Result<(Scenario, Linear)> {
    let scenario = inputs::robot(&args.robot, true)?.1;
    let all = wanted(&scenario, args.pressure.as_deref())?;
    let loads = match (&args.pressure, all.as_slice()) {
        (Some(typed), [_, _, ..]) => {
            let message = format!("--pressure {typed} is more than one working point");
            return Err(Failure::usage(message, "give one pressure, with / between supply channels"));
        }
        (_, all) => all[all.len() / 2],
    };
    let model = Model::new(&scenario);
    open(&model, &loads, needs_all)?;
    trusted(&model, [loads], "give another --pressure, or a smaller load")?;
    let units = if scenario.actuator.count > 1 { scenario.actuator.count } else { JOINTS };
    let chain = Linear::new(&scenario, args.joints.map_or(units, |joints| joints as usize), &loads)?;
    Ok((scenario, chain))
}

fn linear(args: &LinearArgs) -> Result<Outcome> {
    let (scenario, chain) = chain(args, false)?;
    let answer = LinearAnswer {
        scenario: &args.robot.scenario,
        name: &scenario.name,
        p_body_kpa: chain.loads.body_pa / 1e3,
        p_act_channels_kpa: chain.loads.actuator_pa.map(|pa| pa / 1e3),
        tip_at_mm: chain.tip_at_m * 1e3,
        joints: &chain.joints,
    };
    let mut outcome = Outcome::answer(chain_text(&scenario, &chain), "ibr.export.linear", &answer);
    if chain.joints.iter().any(|joint| joint.stiffness_nm.is_nan() || joint.offset_nm.is_nan()) {
        outcome.notes.push("note: an actuator is flat or at the end of its stroke there, and has no slope".into());
    }
    Ok(outcome)
}

fn rigid(
    args: &RigidArgs,
    ending: &str,
    text: fn(&Linear, &Surroundings) -> String,
    context: &mut Context,
) -> Result<Outcome> {
    let path = target(args.out.as_ref(), ending)?;
    let (scenario, chain) = chain(&args.chain, true)?;
    if let Some(i) = chain.joints.iter().position(|j| !(j.stiffness_nm > 0.0 && j.offset_nm.is_finite())) {
        let message = format!("joint {} has no stiffness K > 0 at {} kPa", i + 1, pressure_words(&chain.loads));
        return Err(Failure::usage(message, "give another working point, for example --pressure 20kPa"));
    }
    if let Some(i) = chain.joints.iter().position(|joint| joint.angle_rad.abs() > MOST_TURN_RAD) {
        let angle = chain.joints[i].angle_rad.to_degrees();
        let message = format!("joint {} is bent by {angle:.0} deg (allowed up to 60)", i + 1);
        return Err(Failure::usage(message, format!("divide the body more, for example --joints {}", 4 * (i + 1))));
    }
    let weight = scenario.effects.iter().find(|effect| effect.name == "gravity").map(|effect| effect.values[0]);
    let mass_kg_per_m = args.mass.or(weight.map(|w| w / G_M_S2)).unwrap_or(MASS_KG_PER_M);
    let message = format!("--mass is {mass_kg_per_m} kg/m (allowed above 0, below {MOST_MASS_KG_PER_M})");
    let help = "write for example --mass 0.1";
    refuse_if(!(mass_kg_per_m > 0.0 && mass_kg_per_m < MOST_MASS_KG_PER_M), message, help)?;
    let [x, y, _] = scenario.gravity_direction;
    let g = if weight.is_some() { G_M_S2 } else { 0.0 };
    let about = Surroundings {
        name: &scenario.name,
        command: &format!("ibr {} export {}", env!("CARGO_PKG_VERSION"), args.chain.robot.scenario),
        radius_m: scenario.radius_m,
        mass_kg_per_m,
        gravity_m_s2: [g * x, g * y],
        most_pa: scenario.p_max_pa,
    };
    write(&[(path.clone(), text(&chain, &about).into_bytes())], context)?;
    let written = path.display().to_string();
    let report = format!(
        "{written}: {} joints about {} kPa, {mass_kg_per_m:.3} kg/m, gravity {g} m/s²\n",
        chain.joints.len(),
        pressure_words(&chain.loads)
    );
    let answer = RigidAnswer {
        scenario: &args.chain.robot.scenario,
        written: &written,
        joints: chain.joints.len(),
        p_act_channels_kpa: chain.loads.actuator_pa.map(|pa| pa / 1e3),
        mass_kg_per_m,
        gravity_m_s2: about.gravity_m_s2,
    };
    let mut outcome = Outcome::answer(report, "ibr.export.rigid", &answer);
    if args.mass.is_none() && weight.is_none() {
        outcome.notes.push(format!("note: {MASS_KG_PER_M} kg/m is assumed; --mass sets it"));
    }
    if scenario.effects.iter().any(|effect| effect.name == "tip_load") {
        outcome.notes.push("note: the force of tip_load is not in the file: apply it in the simulator".into());
    }
    Ok(outcome)
}

/// Standard acceleration of gravity at the earth's surface \[m/s²\].
const G_M_S2: f64 = 9.80665;
/// Assumed mass per length of a fabric robot, and a bound for a slip of the unit \[kg/m\].
const MASS_KG_PER_M: f64 = 0.1;
const MOST_MASS_KG_PER_M: f64 = 100.0;
/// A larger angle of a joint needs more joints \[rad\].
const MOST_TURN_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// `ibr.export.rigid`: `ibr export mjcf SCENARIO`, `ibr export urdf SCENARIO`
#[derive(Serialize)]
struct RigidAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// File that was written for the simulator
    written: &'a str,
    /// Number of hinges in the file
    joints: usize,
    /// Actuator pressure of every channel at the working point
    p_act_channels_kpa: [f64; CHANNELS],
    /// Mass of the body per length
    mass_kg_per_m: f64,
    /// Gravity in the file along x and y \[m/s²\]
    gravity_m_s2: [f64; 2],
}

fn chain_text(scenario: &Scenario, chain: &Linear) -> String {
    let mut joints = TextTable::of(chain.joints.iter().enumerate())
        .right("joint", |(i, _)| (i + 1).to_string())
        .number("start [mm]", 1, |(_, joint)| joint.start_m * 1e3)
        .number("length [mm]", 1, |(_, joint)| joint.length_m * 1e3)
        .number("joint at [mm]", 2, |(_, joint)| joint.joint_at_m * 1e3)
        .number("q [deg]", 2, |(_, joint)| joint.angle_rad.to_degrees())
        .right("K [N m/rad]", |(_, joint)| or_dash(joint.stiffness_nm))
        .right("C [N m s/rad]", |(_, joint)| joint.damping_nms.map_or("-".into(), or_dash))
        .right("b [N m]", |(_, joint)| or_dash(joint.offset_nm));
    for channel in chain.channels() {
        joints = joints.right(format!("B{channel} [N m/kPa]"), |(_, joint)| or_dash(joint.per_pa[channel] * 1e3));
    }
    format!(
        "{} at {} kPa, body pressure {} kPa\n{}Moment that bends a joint: b + B P - K q - C q\u{27}. Predicted.\n\
         Joints are {:.1} mm from the centre line, away from the actuator; the tip is at {:.2} mm on it.\n",
        scenario.name,
        pressure_words(&chain.loads),
        chain.loads.body_pa / 1e3,
        joints.text(),
        chain.joints.first().map_or(0.0, |joint| joint.line_offset_m) * 1e3,
        chain.tip_at_m * 1e3,
    )
}

/// A number; none where an actuator is flat.
fn or_dash(value: f64) -> String {
    if value.is_nan() { "-".into() } else { format!("{value:.5}") }
}

/// `ibr.export.linear`: `ibr export linear SCENARIO`
#[derive(Serialize)]
struct LinearAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Name of the robot in the scenario
    name: &'a str,
    /// Body pressure at the working point
    p_body_kpa: f64,
    /// Actuator pressure of every channel at the working point
    p_act_channels_kpa: [f64; CHANNELS],
    /// Tip along the straight chain, on the centre line
    tip_at_mm: f64,
    /// Joints between rigid links, base to tip
    joints: &'a [Joint],
}
