use super::{inputs, predict};
use crate::cli::GrowArgs;
use crate::prelude::*;
use models::scenario::Growth;
use models::{CHANNELS, Grown, Retraction, grown, longest_grown_m, longest_retractable_m};

/// Rows of the table: lengths from a tenth of the robot's to all of it.
const ROWS: usize = 10;

pub(super) fn run(args: &GrowArgs) -> Result<Outcome> {
    let (_, scenario) = inputs::robot(&args.robot, true)?;
    let Some(growth) = scenario.growth else {
        let help = "write [growth] into its scenario, or add --set growth.tip_force_n=2.3 --set growth.friction=0.3; tip_force_n is half \
            of the pressure at which the tube halts, times its area";
        return Err(Failure::usage(format!("{} has no table [growth]", args.robot.scenario), help));
    };
    let straight = vec![Loads { body_pa: scenario.p_body_pa, actuator_pa: [0.0; CHANNELS] }];
    let loads = args.pressure.as_deref().map_or(Ok(straight), |text| predict::wanted(&scenario, Some(text)))?;
    let states = loads.iter().map(|loads| GrowingState::of(&scenario, &growth, loads)).collect::<Result<Vec<_>>>()?;
    let p_body_kpa = scenario.p_body_pa / 1e3;
    let name = if scenario.name.is_empty() { &args.robot.scenario } else { &scenario.name };
    let mut text = format!("{name} at body pressure {p_body_kpa} kPa\n");
    loads.iter().zip(&states).for_each(|(loads, state)| text += &state.text(&scenario, loads));
    text += "Predicted from the scenario's [growth]; bends are those without a tail.\n";
    let answer = GrowAnswer { scenario: &args.robot.scenario, name: &scenario.name, p_body_kpa, states };
    let mut outcome = Outcome::answer(text, "ibr.grow", &answer);
    if answer.states.iter().any(GrowingState::is_unknown) {
        let note = "note: the length at which retraction buckles the body needs body.wall_stiffness_n_per_m";
        outcome.notes.push(note.into());
    }
    Ok(outcome)
}

impl GrowingState {
    fn of(scenario: &Scenario, growth: &Growth, loads: &Loads) -> Result<GrowingState> {
        let mut lengths: Vec<Grown> = Vec::new();
        for row in 1..=ROWS {
            match grown(scenario, growth, loads, scenario.length_m * row as f64 / ROWS as f64) {
                Ok(grown) => lengths.push(grown),
                Err(unsolved) if lengths.is_empty() => return Err(unsolved.into()),
                // A longer robot has no equilibrium either.
                Err(_) => break,
            }
        }
        Ok(GrowingState {
            p_act_channels_kpa: loads.actuator_pa.iter().map(|pa| pa / 1e3).collect(),
            grows_to_mm: 1e3 * longest_grown_m(scenario, growth, loads)?,
            retracts_from_mm: 1e3 * longest_retractable_m(scenario, growth, loads)?,
            lengths,
        })
    }

    /// Whether buckling of some length cannot be computed.
    fn is_unknown(&self) -> bool {
        self.lengths.iter().any(|row| row.retraction == Retraction::Unknown)
    }

    fn text(&self, scenario: &Scenario, loads: &Loads) -> String {
        let whole_mm = 1e3 * scenario.length_m;
        let up_to = |mm: f64| match mm {
            mm if mm < 0.5 => "not at all".into(),
            mm if mm < whole_mm => format!("up to {mm:.0} mm"),
            _ => "at every length".to_string(),
        };
        let table = TextTable::of(&self.lengths)
            .number("length [mm]", 0, |row| 1e3 * row.length_m)
            .number("turn [deg]", 1, |row| row.turn_rad.to_degrees())
            .number("tail at tip [N]", 2, |row| row.tail_n)
            .number("halts at [kPa]", 2, |row| row.halts_pa / 1e3)
            .number("starts at [kPa]", 2, |row| row.starts_pa / 1e3)
            .number("speed [mm/s]", 1, |row| row.speed_m_per_s.map(|speed| 1e3 * speed))
            .number("pull to retract [N]", 2, |row| row.retraction_n)
            .words("retraction", retraction_words);
        format!(
            "\nActuators at {} kPa\n{}Grows: {}. Retracted by its tail: {}{}.\n",
            pressure_words(loads),
            table.text(),
            up_to(self.grows_to_mm),
            up_to(self.retracts_from_mm),
            if self.is_unknown() { ", if it does not buckle" } else { "" }
        )
    }
}

fn retraction_words(row: &&Grown) -> String {
    match (row.retraction, row.retraction_folds_m) {
        (Retraction::Possible, _) => "possible".into(),
        (Retraction::Folds, station_m) => format!("folds at {:.0} mm", 1e3 * station_m.unwrap_or(0.0)),
        (Retraction::Buckles, _) => "buckles".into(),
        (Retraction::Unknown, _) => "no fold; buckling unknown".into(),
    }
}

/// `ibr.grow`: `ibr grow SCENARIO`
#[derive(Serialize)]
struct GrowAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Name of the robot in the scenario
    name: &'a str,
    /// Body pressure of all states
    p_body_kpa: f64,
    /// Growth at each pressure of the actuators
    states: Vec<GrowingState>,
}

/// Growth and retraction at one pressure of the actuators.
#[derive(Serialize)]
struct GrowingState {
    /// Actuator pressure of every channel
    p_act_channels_kpa: Vec<f64>,
    /// Length at which a tip in motion halts or a section folds; the robot's own: at none
    grows_to_mm: f64,
    /// Length up to which its tail retracts it, as far as it is known; the robot's own: at every length
    retracts_from_mm: f64,
    /// State at lengths up to the robot's own
    lengths: Vec<Grown>,
}
