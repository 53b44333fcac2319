//! `ibr add`

use super::extend::{Ground, Rung, check_runs, ranked, rungs_text, short, typed, value};
use super::inputs::{self, Loaded, NamedScenario, diagnosed, positive};
use super::{Context, Outcome};
use crate::cli::Add;
use crate::extended::{Addition, NewBending, extended};
use crate::failure::Failure;
use crate::output::today;
use compare::diagnosis::{Diagnosis, Options, ParameterValue};
use compare::known::Known;
use models::Scenario;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

/// What asks for the effects that the diagnosis itself adds.
const BEST: &str = "best";

pub fn run(args: &Add, context: &mut Context) -> Result<Outcome, Failure> {
    let sigma_m = args.sigma.as_deref().map(|t| positive("--sigma", t)).transpose()?;
    let named = inputs::scenario(&args.scenario)?;
    let wish = Wish::read(&named.scenario, &args.effect, args.data.is_some())?;
    let options = Options { sigma_m, keep_bending: args.keep_bending, next_experiment: false, ..Options::default() };
    let found = match &args.data {
        Some(spec) => {
            let data = inputs::datasets(spec, &args.also, context)?;
            (context.progress)("fitting every effect", None);
            with_data(&named.scenario, &wish, &data, &options)?
        }
        None => Found::without_data(&named.scenario, &wish),
    };
    let names: Vec<String> = found.additions.iter().map(|a| a.name.clone()).collect();
    let target = target(args, &names)?;
    let (text, _) = extended(&named.text, &named.scenario, found.bending.as_ref(), &found.additions)?;
    write(&target, &text, context)?;
    let mut outcome = Outcome::new(words(args, &found, &target), to_json(args, &named, &found, &target));
    outcome.notes.extend(found.warnings.iter().map(|w| format!("warning: {w}")));
    Ok(outcome)
}

/// The effect as typed.
struct Wish {
    name: String,
    /// Keys and values in the units of the scenario; `None`: to be fitted.
    values: Option<Vec<(String, f64)>>,
}

impl Wish {
    fn read(scenario: &Scenario, text: &str, has_data: bool) -> Result<Wish, Failure> {
        if text == BEST {
            if !has_data {
                return Err(Failure::usage("`best` needs data to say what is best", "ibr add SCENARIO best DATA"));
            }
            return Ok(Wish { name: BEST.into(), values: None });
        }
        let (name, values) = typed(scenario, text)?;
        let typical = || {
            let catalogue = scenario.catalogue();
            let effect = catalogue.by_name(&name)?;
            let si = effect.typical_for(scenario.actuator.kind.name);
            Some(effect.parameters.iter().zip(si).map(|(p, v)| (p.key.to_string(), v / p.si)).collect())
        };
        let values = if values.is_none() && !has_data { typical() } else { values };
        Ok(Wish { name, values })
    }
}

/// What is written, and what it brings.
struct Found {
    additions: Vec<Addition>,
    bending: Option<NewBending>,
    rungs: Vec<Rung>,
    noise_floor_mm: Option<f64>,
    told: Vec<String>,
    values: Vec<(String, Vec<ParameterValue>)>,
    data: Vec<[String; 2]>,
    warnings: Vec<String>,
}

impl Found {
    fn without_data(scenario: &Scenario, wish: &Wish) -> Found {
        let catalogue = scenario.catalogue();
        let sentence = catalogue.by_name(&wish.name).map(|e| e.sentence.to_string());
        let addition = Addition {
            name: wish.name.clone(),
            values: wish.values.clone().unwrap_or_default(),
            basis: Known::Assumed.word(),
            interval: String::new(),
            data: Vec::new(),
            date: today(),
            bending_without_nm2: None,
            remarks: sentence.into_iter().collect(),
        };
        Found {
            told: vec![format!("Assumed: {}. Nothing was fitted; name data to fit it.", assumed(&addition))],
            additions: vec![addition],
            bending: None,
            rungs: Vec::new(),
            noise_floor_mm: None,
            values: Vec::new(),
            data: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

fn assumed(a: &Addition) -> String {
    let values: Vec<String> = a.values.iter().map(|(key, v)| format!("{key} = {}", short(*v))).collect();
    format!("{}, {}", a.name, values.join(", "))
}

fn with_data(scenario: &Scenario, wish: &Wish, data: &[Loaded], options: &Options) -> Result<Found, Failure> {
    let pairs = wish.name == BEST;
    let options = Options { pairs, ..options.clone() };
    let d = diagnosed(scenario, data, &options)?;
    let ground = Ground::new(&d, scenario, data);
    let mut found = match &wish.values {
        Some(values) => given(&ground, scenario, (&wish.name, values), &options)?,
        None if wish.name == BEST => best(&ground)?,
        None => fitted(&ground, &wish.name)?,
    };
    found.warnings.extend(check_runs(&data[0].dataset));
    found.data = data.iter().map(|data| [data.spec.clone(), data.input.sha256.clone()]).collect();
    Ok(found)
}

fn fitted(ground: &Ground, name: &str) -> Result<Found, Failure> {
    let d = ground.d;
    let r = ranked(d, name)?;
    let rung = ground.ranked_rung(r);
    let mut told = vec![format!("Calibrated: {name}, {}. {}", listed(&r.parameters), r.sentence)];
    if !r.in_set
        && let Some(first) = d.indistinguishable.first()
    {
        told.push(format!("These data prefer {first}: look at `ibr diagnose`."));
    } else if d.indistinguishable.len() > 1 {
        told.push(rivals(d));
    }
    let mut warnings = ground.warnings();
    if let Some(p) = r.p_corrected.filter(|p| *p >= d.alpha) {
        warnings.push(format!("{name} is not significant here (p = {p:.2} after correction): the fall may be chance"));
    }
    warnings.extend(r.notes.iter().cloned());
    Ok(Found {
        additions: vec![ground.calibrated(name, &r.parameters)],
        bending: ground.new_bending(rung.bending_nm2),
        values: vec![(name.to_string(), r.parameters.clone())],
        warnings,
        told,
        ..climbed(ground, rung)
    })
}

fn best(ground: &Ground) -> Result<Found, Failure> {
    let d = ground.d;
    if d.added.is_empty() {
        let story = d.summary.join(" ");
        return Err(Failure::usage(
            format!("the diagnosis adds nothing: {story}"),
            "to add an effect all the same name it instead of `best`",
        ));
    }
    let mut told: Vec<String> =
        d.added.iter().map(|a| format!("Calibrated: {}, {}.", a.effect, listed(&a.parameters))).collect();
    if d.indistinguishable.len() > 1 {
        told.push(rivals(d));
    }
    let rung = ground.verdict_rung();
    Ok(Found {
        additions: d.added.iter().map(|a| ground.calibrated(&a.effect, &a.parameters)).collect(),
        bending: ground.new_bending(rung.bending_nm2),
        values: d.added.iter().map(|a| (a.effect.clone(), a.parameters.clone())).collect(),
        warnings: ground.warnings(),
        told,
        ..climbed(ground, rung)
    })
}

/// Values of the user; only B is fitted.
fn given(
    ground: &Ground,
    scenario: &Scenario,
    (name, values): (&str, &[(String, f64)]),
    options: &Options,
) -> Result<Found, Failure> {
    let catalogue = scenario.catalogue();
    let value_of = |key: &str| values.iter().find(|(k, _)| k == key).map_or(0.0, |(_, v)| *v);
    let si = catalogue.by_name(name).map(|e| e.parameters.iter().map(|p| value_of(p.key) * p.si).collect::<Vec<_>>());
    let extended = scenario.with_effect(name, &si.unwrap_or_default());
    let after = diagnosed(&extended, ground.data, options)?;
    let with = Ground::new(&after, &extended, ground.data);
    let rung = with.base_rung(&format!("+ {name}"), Known::Assumed);
    let addition = ground.addition(name, values.to_vec(), Known::Assumed);
    Ok(Found {
        told: vec![format!("Assumed: {}; B was fitted with it.", assumed(&addition))],
        additions: vec![addition],
        bending: ground.new_bending(rung.bending_nm2),
        warnings: ground.warnings(),
        ..climbed(ground, rung)
    })
}

/// The part of the findings that is the same for all ways to a value.
fn climbed(ground: &Ground, rung: Rung) -> Found {
    let mut rungs = ground.first_rungs();
    rungs.push(rung);
    Found {
        additions: Vec::new(),
        bending: None,
        rungs,
        noise_floor_mm: ground.d.base.noise_floor_mm,
        told: Vec::new(),
        values: Vec::new(),
        data: Vec::new(),
        warnings: Vec::new(),
    }
}

fn listed(values: &[ParameterValue]) -> String {
    values.iter().map(value).collect::<Vec<_>>().join(", ")
}

fn rivals(d: &Diagnosis) -> String {
    format!("Equally good with these data: {}. The data do not choose between them.", d.indistinguishable.join(", "))
}

/// Where the new scenario goes: never onto the old one, and onto another file only if told.
fn target(args: &Add, names: &[String]) -> Result<PathBuf, Failure> {
    let old = Path::new(&args.scenario);
    let stem = old.file_stem().map_or("scenario".into(), |s| s.to_string_lossy().into_owned());
    let target = args.out.clone().unwrap_or_else(|| old.with_file_name(format!("{stem}-{}.toml", names.join("-"))));
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(&target, old) {
        let message = format!("{} is the scenario itself, which stays as it is", target.display());
        return Err(Failure::usage(message, "choose another file with --out"));
    }
    if target.is_dir() {
        let file = target.join(format!("{stem}-{}.toml", names.join("-")));
        let message = format!("{} is a folder, not a file", target.display());
        return Err(Failure::usage(message, format!("give a file, for example --out {}", file.display())));
    }
    if target.exists() && !args.force {
        let message = format!("{} exists already", target.display());
        return Err(Failure::usage(message, "choose another file with --out, or replace it with --force"));
    }
    Ok(target)
}

fn write(target: &Path, text: &str, context: &mut Context) -> Result<(), Failure> {
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    data::write_atomically(target, text.as_bytes())?;
    *written = true;
    Ok(())
}

fn words(args: &Add, found: &Found, target: &Path) -> String {
    let mut out = found.told.iter().map(|s| format!("{s}\n")).collect::<String>();
    if !found.rungs.is_empty() {
        out.push_str(&format!("\n{}", rungs_text(&found.rungs, found.noise_floor_mm)));
        if let Some([before, after]) = found.rungs.last_chunk::<2>()
            && after.training_mm > before.training_mm
        {
            out.push_str("The error does not fall with it: this is not what is missing, or not by that much.\n");
        }
        out.push_str("A smaller error does not prove the name; data the effect was not fitted to do more: ");
        out.push_str(&format!("`ibr validate {} DATA`\n", target.display()));
    }
    out.push_str(&format!("\nwritten: {}; {} is as it was\n", target.display(), args.scenario));
    if let Some([data, _]) = found.data.first() {
        out.push_str(&format!("see it: ibr compare {} {data}\n", target.display()));
    }
    out
}

fn to_json(args: &Add, named: &NamedScenario, found: &Found, target: &Path) -> Value {
    let effect = |a: &Addition| {
        let fitted = found.values.iter().find(|(name, _)| *name == a.name).map(|(_, values)| values);
        let values: serde_json::Map<String, Value> = a.values.iter().map(|(k, v)| (k.clone(), json!(v))).collect();
        json!({"effect": a.name, "how_known": a.basis, "values": values, "parameters": fitted})
    };
    let data = |[name, sha256]: &[String; 2]| json!({"name": name, "sha256": sha256});
    let known = found.rungs.len().checked_sub(2).and_then(|before| found.rungs.get(before));
    json!({
        "schema": "ibr.add", "version": 1,
        "scenario_file": args.scenario, "scenario_sha256": named.input.sha256, "written": target.display().to_string(),
        "effects": found.additions.iter().map(effect).collect::<Vec<_>>(),
        "bending_nm2": found.bending.as_ref().map(|b| b.value_nm2),
        "before": known, "after": found.rungs.last(), "rungs": found.rungs,
        "noise_floor_mm": found.noise_floor_mm,
        "data": found.data.first().map(data), "also": found.data.iter().skip(1).map(data).collect::<Vec<_>>(),
        "date": today(), "warnings": found.warnings,
    })
}
