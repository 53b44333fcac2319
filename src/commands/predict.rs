use super::inputs::{self, quantity};
use crate::cli::PredictArgs;
use crate::prelude::*;
use crate::shown::predicted::{
    NearestPlace, PredictAnswer, PredictedState, above_limit, beyond_words, columns, nearest_words, text,
};
use ibr::pages::predicted_files;
use ibr::{PressureInterval, check_fed, predict, predict_for, predict_near, pressure_interval};
use models::scenario::quantity::{MOST, parse_pressures};
use models::{CHANNELS, LOADS, Target, collapse_length_m, collapse_loads};

pub(super) fn run(args: &PredictArgs, context: &mut Context) -> Result<Outcome> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    // A stream is built in the plane.
    let (file, scenario) = inputs::robot(&args.robot, args.follow)?;
    let typed = &args.robot.scenario;
    if args.follow {
        return follow(&scenario, context);
    }
    if args.limits {
        return limits(typed, &scenario, &asked(&scenario, args)?);
    }
    let aimed = args.inverse.as_deref().and_then(|text| text.split_once(',')).map(place).transpose()?;
    let (mut steered, mut interval) = (None, None);
    let states = match (&args.inverse, aimed) {
        (_, Some(place)) => {
            let found = predict_near(&scenario, place)?;
            steered = Some((place, found.1));
            vec![found.0]
        }
        (Some(text), None) => {
            let target = target(text)?;
            interval = pressure_interval(&scenario, target)?;
            vec![predict_for(&scenario, target)?]
        }
        (None, None) => predict(&scenario, &asked(&scenario, args)?)?,
    };
    let model = Model::new(&scenario);
    if let Some(folder) = &args.out {
        write_files(folder, &predicted_files(&scenario, &states)?, &inputs::named(&file, [])?, context)?;
    }
    // Rows of numbers may be many, and their objects are not printed.
    let told = states.iter().filter(|_| !args.csv).map(|s| PredictedState::of(&model, &scenario, s));
    let answer = PredictAnswer {
        scenario: typed,
        name: &scenario.name,
        actuator: scenario.actuator.kind.name,
        effects: scenario.effects.iter().map(|e| e.name.as_str()).collect(),
        states: told.collect(),
        nearest: steered.as_ref().map(|(place, found)| NearestPlace::of(*place, found)),
        pressure_interval: interval.as_ref(),
    };
    let words = interval.as_ref().map(interval_words).unwrap_or_default();
    let mut outcome = Outcome::answer(text(&scenario, &states) + &words, "ibr.predict", &answer);
    if args.csv {
        let mut csv = Vec::new();
        columns(&scenario, &states).to_csv(&mut csv)?;
        outcome.text = String::from_utf8_lossy(&csv).into_owned();
    }
    outcome.notes.extend(steered.and_then(|(place, found)| nearest_words(place, &found)));
    outcome.notes.extend(inputs::superseded(&scenario));
    outcome.notes.extend(above_limit(&scenario, &states.iter().map(|s| s.loads).collect::<Vec<_>>()));
    outcome.notes.extend(states.iter().flat_map(|s| beyond_words(&model, &s.loads, &s.prediction)));
    Ok(outcome)
}

fn follow(scenario: &Scenario, context: &Context) -> Result<Outcome> {
    let message = "--follow writes lines of numbers";
    refuse_if(context.json, message, "leave out --json")?;
    let followed = ibr::follow(scenario, std::io::stdin().lock(), std::io::stdout().lock())?;
    Ok(Outcome { notes: followed.words(), ..Outcome::default() })
}

/// The pressures of robots whose unmeasured numbers fill their intervals.
fn interval_words(found: &PressureInterval) -> String {
    let numbers: Vec<String> =
        found.numbers.iter().map(|n| format!("{} {} to {}", n.key, n.interval[0], n.interval[1])).collect();
    let pressures = found
        .p_pa
        .map_or("no pressure".to_string(), |[low, high]| format!("{:.3} to {:.3} kPa", low / 1e3, high / 1e3));
    let missed = match found.missed {
        0 => String::new(),
        missed => format!("; {missed} of {} robots do not reach the target", found.robots),
    };
    let drawn = format!("Over {} robots drawn from the intervals of numbers that were not measured", found.robots);
    format!("{drawn}: {pressures}{missed}\n  {}\n", numbers.join("\n  "))
}

fn place((x, y): (&str, &str)) -> Result<[f64; 2]> {
    Ok([quantity("--inverse", x, Quantity::Length)?, quantity("--inverse", y, Quantity::Length)?])
}

/// Reads a height, an angle or a place from the text of `--inverse`.
fn target(text: &str) -> Result<Target> {
    match text.split_once('=') {
        Some(("tip", value)) => Ok(Target::TipHeight(quantity("--inverse", value, Quantity::Length)?)),
        Some(("angle", value)) => Ok(Target::Angle(quantity("--inverse", value, Quantity::Angle)?)),
        _ => {
            let help = "write tip=100mm (height) or angle=60deg (total bend), or a place x,y: 300mm,120mm";
            Err(Failure::usage(format!("--inverse {text} is not understood"), help))
        }
    }
}

/// The pressures of a file, else of the command line or the scenario.
fn asked(scenario: &Scenario, args: &PredictArgs) -> Result<Vec<Loads>> {
    let typed = args.pressure.as_deref();
    let is_file = |path: &&Path| {
        path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) || path.exists() && !path.is_dir()
    };
    let Some(file) = typed.map(Path::new).filter(is_file) else { return wanted(scenario, typed) };
    let message = "--pressure FILE for a beam, which has no actuator";
    refuse_if(!scenario.actuator.exists(), message, "leave it out")?;
    Ok(ibr::pressures_of(scenario, file, MOST)?)
}

/// The pressures of the command line, else of the scenario; a beam has none to be asked for.
pub(super) fn wanted(scenario: &Scenario, pressures: Option<&str>) -> Result<Vec<Loads>> {
    let mut pressures = match pressures {
        Some(text) => {
            parse_pressures(text).map_err(|m| Failure::usage(format!("--pressure: {m}"), "see ibr predict --help"))?
        }
        None => scenario.pressures_pa.iter().map(|p| [*p; CHANNELS]).collect(),
    };
    let model = Model::new(scenario);
    pressures.iter().try_for_each(|all| check_fed(&model, all))?;
    if !scenario.actuator.exists() {
        pressures = vec![[0.0; CHANNELS]];
    }
    let help = "add --pressure 10kPa,20kPa or [predict] pressures_kpa to the scenario";
    refuse_if(pressures.is_empty(), "no pressure given", help)?;
    Ok(pressures.into_iter().map(|p| Loads { body_pa: scenario.p_body_pa, actuator_pa: p }).collect())
}

/// From which length on, and from which loads on, the robot folds.
fn limits(typed: &str, scenario: &Scenario, wanted: &[Loads]) -> Result<Outcome> {
    let help = "add what bends it, for example --effect gravity:weight_n_per_m=1.5";
    let message = "a robot without load collapses at no length";
    refuse_if(!scenario.effects.iter().any(|e| LOADS.contains(&e.name.as_str())), message, help)?;
    let straight = Loads::uniform(scenario.p_body_pa, 0.0);
    let steered = wanted.iter().filter(|loads| loads.actuator_pa.iter().any(|p| *p > 0.0));
    let found: Vec<(Loads, Option<f64>, [Option<f64>; 2])> = std::iter::once(&straight)
        .chain(steered)
        .map(|loads| (*loads, collapse_length_m(scenario, loads), collapse_loads(scenario, loads)))
        .collect();
    let mut text = format!("{} at body pressure {} kPa\n", scenario.name, scenario.p_body_pa / 1e3);
    let factor = |factor: Option<f64>| factor.map_or("none".into(), |factor| format!("{factor:.2}"));
    text += &TextTable::of(&found)
        .right("P [kPa]", |(loads, ..)| pressure_words(loads))
        .right("collapse length [mm]", |(_, length, _)| length.map_or("none".into(), |m| format!("{:.0}", m * 1e3)))
        .right("over its length", |(_, m, _)| m.map_or("-".into(), |m| format!("{:.2}", m / scenario.length_m)))
        .right("or at its loads times", |(.., [along, _])| factor(*along))
        .right("reversed", |(.., [_, reversed])| factor(*reversed))
        .text();
    text.push_str(
        "Predicted. As many more units as the length asks for; \"none\": not up to 50 times its length or loads.\n",
    );
    let kpa = |loads: &Loads| loads.actuator_pa.iter().map(|p| p / 1e3).collect();
    let collapse = found
        .iter()
        .map(|(loads, m, [load_factor, reversed_load_factor])| CollapseLength {
            p_act_channels_kpa: kpa(loads),
            length_mm: m.map(|m| m * 1e3),
            load_factor: *load_factor,
            reversed_load_factor: *reversed_load_factor,
        })
        .collect();
    let (p_body_kpa, length_mm) = (scenario.p_body_pa / 1e3, scenario.length_m * 1e3);
    let answer = LimitsAnswer { scenario: typed, name: &scenario.name, p_body_kpa, length_mm, collapse };
    Ok(Outcome::answer(text, "ibr.predict.limits", &answer))
}

/// `ibr.predict.limits`: `ibr predict SCENARIO --limits`
#[derive(Serialize)]
struct LimitsAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Name of the robot in the scenario
    name: &'a str,
    /// Body pressure at which the loads act
    p_body_kpa: f64,
    /// Length of the robot in the scenario
    length_mm: f64,
    /// Length at which it folds: straight, then at each pressure
    collapse: Vec<CollapseLength>,
}

/// Length at which loads fold the robot.
#[derive(Serialize)]
struct CollapseLength {
    /// Actuator pressure of every channel at that length
    p_act_channels_kpa: Vec<f64>,
    /// Length at which the loads fold it; null: none within 50 times its length
    length_mm: Option<f64>,
    /// Factor of its loads at which they fold it at its own length; null: none up to 50
    load_factor: Option<f64>,
    /// The same with the loads reversed
    reversed_load_factor: Option<f64>,
}
