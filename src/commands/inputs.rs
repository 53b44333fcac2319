//! Scenarios, data and quantities as typed on the command line.

use crate::cli::{FitArgs, RobotArgs, ScatterArgs};
use crate::prelude::*;
use compare::diagnosis::Options;
use compare::foreign::{BaseTable, on_base};
use compare::progress::part;
use compare::progress::shares::READ;
use compare::study::{Generator, HoldScatter};
use compare::typed_effect::with_effect;
use ibr::studies::scenario;
use models::scenario::quantity::parse;
use spelling::units::Range;

/// Splits `key=value` of an option `--set` at its first `=`.
pub(super) fn setting<'t>(text: &'t str, help: &str) -> Result<(&'t str, &'t str)> {
    let both = text.split_once('=').map(|(key, value)| (key.trim(), value.trim()));
    both.ok_or_else(|| Failure::usage(format!("--set {text}: the = is missing"), help))
}

/// Names that were typed for an option, each once.
pub(super) fn each_once<'t>(option: &str, names: impl IntoIterator<Item = &'t str>) -> Result<()> {
    let mut seen = Vec::new();
    for name in names {
        let help = "leave one of the two out";
        let message = format!("{option} gives {name} twice");
        refuse_if(seen.contains(&name), message, help)?;
        seen.push(name);
    }
    Ok(())
}

/// Names of effects that were typed as `name` or `name:key=value`.
/// The missing part where a scenario, or data, are alone.
pub(super) fn without_data(verb: &str, name: &str) -> Failure {
    let help = match scenario(name).is_ok() {
        true => format!("name them after it: `ibr {verb} {name} DATA`, for example `ibr {verb} {name} synthetic-epam`"),
        false => format!(
            "a scenario comes first: `ibr {verb} epam {name}`; tables of beams and muscles stand alone, `ibr characterize {name}` reads tests of fabrics"
        ),
    };
    Failure::usage(format!("{name} alone: a scenario and data are needed"), help)
}

pub(super) fn effect_names(typed: &[String]) -> impl Iterator<Item = &str> {
    typed.iter().map(|text| text.split([':', '=']).next().unwrap_or_default())
}

pub(super) fn fit_options(args: &FitArgs) -> Result<Options> {
    Ok(Options {
        sigma_m: positive("--sigma", args.noise.sigma.as_ref())?,
        tolerance_m: positive("--tolerance", args.tolerance.as_ref())?,
        keep_bending: args.keep_bending,
        not: args.not.clone(),
        ..Options::default()
    })
}

/// A robot as typed: its file, and the scenario with what was changed; strips round the body may come in where it `is_planar` no more.
pub(super) fn robot(args: &RobotArgs, is_planar: bool) -> Result<(ScenarioFile, Scenario)> {
    let mut file = scenario(&args.scenario)?;
    if is_planar {
        file = file.planar()?;
    }
    let help = "write for example --set body.radius_mm=45";
    let changes = args.changes.set.iter().map(|text| setting(text, help)).collect::<Result<Vec<_>, _>>()?;
    each_once("--set", changes.iter().map(|(key, _)| *key))?;
    each_once("--effect", effect_names(&args.effect))?;
    if !changes.is_empty() {
        let changes: Vec<_> = changes.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
        file = if is_planar { file.with(&changes)? } else { file.with_in_space(&changes)? };
    }
    let mut changed = if args.bare { file.bare() } else { file.scenario.clone() };
    for text in &args.effect {
        changed = with_effect(&changed, text)?.0;
    }
    if let Some(text) = &args.body_pressure {
        changed.p_body_pa = bounded("--body-pressure", text, Quantity::Pressure, &Range::BODY_PRESSURE)?;
    }
    Ok((file, changed))
}

pub(super) fn evidence(spec: &str, context: &mut Context) -> Result<Evidence> {
    Ok(Evidence::read_with(spec, &mut part(context.progress, [0.0, READ]))?)
}

/// Loads the data of a diagnosis and those to be fitted along, each on the base of another simulator if one is given.
pub(super) fn all_evidence(
    scenario: &Scenario,
    first: &str,
    fit: &FitArgs,
    context: &mut Context,
) -> Result<Vec<Evidence>> {
    let data: Vec<&str> = std::iter::once(first).chain(fit.also.iter().map(String::as_str)).collect();
    let bases = bases(&fit.base, data.len())?;
    let on = |(spec, base): (&&str, Option<BaseTable>)| -> Result<Evidence> {
        let read = evidence(spec, context)?;
        Ok(match base {
            Some(base) => on_base(scenario, &read, &base)?,
            None => read,
        })
    };
    data.iter().zip(bases).map(on).collect()
}

/// The tables of another simulator's predictions, one for each of the data or none at all.
pub(super) fn bases(files: &[String], data: usize) -> Result<Vec<Option<BaseTable>>> {
    match files.len() {
        0 => Ok(vec![None; data]),
        given if given == data => files.iter().map(|file| Ok(Some(BaseTable::read(file)?))).collect(),
        given => {
            let help = "give --base once for every set of data, in their order: each has its own pressures";
            Err(Failure::usage(format!("--base is given {given} times for {data} sets of data"), help))
        }
    }
}

pub(super) fn named<'e>(file: &ScenarioFile, evidence: impl IntoIterator<Item = &'e Evidence>) -> Result<Vec<Input>> {
    let data = evidence.into_iter().map(|e| Ok(Input { name: format!("{} (as read)", e.name), sha256: e.sha256()? }));
    std::iter::once(Ok(Input { name: file.name.clone(), sha256: file.sha256() })).chain(data).collect()
}

pub(super) fn quantity(option: &str, text: &str, kind: Quantity) -> Result<f64> {
    parse(text, kind).map_err(|message| Failure::usage(format!("{option}: {message}"), "see ibr --help"))
}

pub(super) fn bounded(option: &str, text: &str, kind: Quantity, bounds: &Range) -> Result<f64> {
    let refused = |(message, help)| Failure::usage(format!("{option} {text}: {message}"), help);
    bounds.check(quantity(option, text, kind)?).map_err(refused)
}

/// A length of an option that must be above zero \[m\], if it was given.
pub(super) fn positive(option: &str, text: Option<&String>) -> Result<Option<f64>> {
    let Some(text) = text else { return Ok(None) };
    match quantity(option, text, Quantity::Length)? {
        v if v > 0.0 => Ok(Some(v)),
        _ => {
            Err(Failure::usage(format!("{option} {text} is not above zero"), format!("write for example {option} 1mm")))
        }
    }
}

pub(super) fn scattered(args: &ScatterArgs) -> Result<Generator> {
    let (camera_sd_m, per_hold) = (scatter("--sigma", &args.sigma)?, HoldScatter::USUAL);
    let mut scattered = Generator { seed: args.random.seed, camera_sd_m, per_hold, ..Generator::default() };
    for typed in &args.scatter {
        let (key, value) = typed.split_once('=').unwrap_or((typed, ""));
        let option = format!("--scatter {key}");
        let share = || match value.trim_end_matches('%').trim().parse::<f64>() {
            Ok(percent) if (0.0..=50.0).contains(&percent) => Ok(percent / 100.0),
            _ => Err(Failure::usage(format!("{option}={value} is not from 0 to 50 per cent"), "2% is usual")),
        };
        let length = || scatter(&option, value);
        let per_hold = &mut scattered.per_hold;
        match key {
            "white" => *per_hold = HoldScatter::default(),
            "pressure" => scattered.pressure_sd = share()?,
            "alignment" => scattered.alignment_sd_m = length()?,
            "hold_pressure" => per_hold.pressure_sd = share()?,
            "hold_alignment" => per_hold.alignment_sd_m = length()?,
            "lasting" => per_hold.lasting_sd_m = length()?,
            _ => {
                let known = ["white", "pressure", "alignment", "hold_pressure", "hold_alignment", "lasting"];
                let help = spelling::known(key, &known);
                return Err(Failure::usage(format!("{option} is not known"), help));
            }
        }
    }
    Ok(scattered)
}

/// A scatter of lengths as typed \[m\].
pub(super) fn scatter(option: &str, text: &str) -> Result<f64> {
    match quantity(option, text, Quantity::Length)? {
        v if (0.0..=0.1).contains(&v) => Ok(v),
        v => Err(Failure::usage(format!("{option} {v} m is not from 0 to 100 mm"), "1mm is usual")),
    }
}

pub(super) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect()
}

/// A note on an effect whose share represents mechanics that another effect has.
pub(super) fn superseded(scenario: &Scenario) -> Option<String> {
    let has = |name: &str| scenario.effects.iter().any(|e| e.name == name && e.values[0] > 0.0);
    let also = if has("sealed_sides") { ", and both together count it twice" } else { "" };
    let pouches = scenario.actuator.kind.has_pouches();
    (pouches && has("end_constraint")).then(|| {
        format!(
            "note: end_constraint is a share, taken from measured bags, of what sealed sides cost{also}; the effect sealed_sides \
             (share = 1) derives it"
        )
    })
}
