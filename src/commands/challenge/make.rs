//! `ibr challenge new`

use super::super::inputs::quantity;
use super::super::{Context, Outcome};
use super::seal::{FILE, SALT, SEALED, Seal};
use crate::cli::ChallengeNew;
use crate::failure::Failure;
use crate::output::{check_folder, sha256, write_files};
use challenge::truth::{ROBOTS, known, standard_protocol};
use challenge::{Draw, HiddenEffect, Kind, Truth};
use compare::study::{Generator, generate, parse_protocol};
use data::{About, Dataset};
use ibr::pages::Files;
use models::Scenario;
use models::scenario::quantity::Quantity;
use serde_json::json;
use std::hash::{BuildHasher, Hasher};

/// Sizes accepted, in typical sizes.
const SIZES: std::ops::RangeInclusive<f64> = 0.05..=3.0;

pub fn run(args: &ChallengeNew, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(&args.out)?;
    if !args.force && (args.out.join(FILE).exists() || args.out.join("markers.csv").exists()) {
        let message = format!("{} already holds a challenge or a dataset", args.out.display());
        return Err(Failure::usage(message, "choose another folder, or add --force to replace it"));
    }
    let seed = args.seed.unwrap_or_else(unpredictable);
    let mut draw = Draw::new(seed, 0);
    let truth = truth(args, &mut draw)?;
    let protocol = args.protocol.as_deref().map_or(Ok(standard_protocol()), parse_protocol)?;
    let name = args.out.file_name().map_or("challenge".into(), |n| n.to_string_lossy().into_owned());
    let dataset = truth.dataset(&name, &protocol)?;
    let mut csv = Vec::new();
    data::write_markers_csv(&dataset, &mut csv)?;
    let about = data::about_toml(&about(&truth.told()?, &dataset));
    let handed_out = [truth.told_text()?.into_bytes(), about.into_bytes(), csv];
    let mut files = Files { files: SEALED.map(String::from).into_iter().zip(handed_out).collect(), ..Files::default() };
    let seal = Seal::close(&sealed_text(&truth, &files)?, &salt(args.seed, &mut draw));
    files.files.push((FILE.into(), seal.to_toml().into_bytes()));
    write_files(&args.out, &files, &[], context)?;
    let folder = args.out.display();
    let text = format!(
        "A sealed challenge is in {folder}: {} runs of a robot with actuator {}.\nSeal (SHA-256): {}\n\
         Look for what is hidden:   ibr diagnose {folder}/scenario.toml {folder} --json > answer.json\n\
         Open the seal afterwards:  ibr challenge reveal {folder} --diagnosis answer.json\n",
        dataset.runs.len(),
        dataset.actuator,
        seal.sha256
    );
    Ok(Outcome::new(
        text,
        json!({"schema": "ibr.challenge.new", "version": 1, "folder": args.out.display().to_string(), "sha256": seal.sha256, "runs": dataset.runs.len()}),
    ))
}

/// The truth and the hashes of the files it belongs to.
fn sealed_text(truth: &Truth, files: &Files) -> Result<String, Failure> {
    let text = toml::to_string(truth).map_err(|error| Failure::usage(error.to_string(), "report this"))?;
    let hashes: Vec<String> = files.files.iter().map(|(_, bytes)| format!("\"{}\"", sha256(bytes))).collect();
    Ok(format!("files_sha256 = [{}]\n{text}", hashes.join(", ")))
}

fn truth(args: &ChallengeNew, draw: &mut Draw) -> Result<Truth, Failure> {
    let kinds = ROBOTS.map(|(kind, _)| kind);
    let actuator = args.actuator.as_deref().unwrap_or_else(|| draw.one_of::<&str>(&kinds));
    let mut truth = Truth::draw(actuator, draw)?;
    if let Some(runs) = args.runs {
        truth.runs = runs as usize;
    }
    if let Some(sigma) = &args.sigma {
        truth.camera_sd_m = match quantity("--sigma", sigma, Quantity::Length)? {
            v if (0.0..=0.1).contains(&v) => v,
            v => return Err(Failure::usage(format!("--sigma {v} m is not from 0 to 100 mm"), "1mm is usual")),
        };
    }
    match args.effect.as_slice() {
        [] => truth.hide(kind(draw), draw)?,
        [one] if one == "random" => truth.hide(kind(draw), draw)?,
        [one] if one == "none" => {}
        typed => {
            if let Some(alone) = typed.iter().find(|text| ["none", "random"].contains(&text.as_str())) {
                let message = format!("--effect {alone} stands alone: it cannot be given with others");
                return Err(Failure::usage(message, "name the effects to hide, or give none or random by itself"));
            }
            for text in typed {
                let (name, times) = effect(text, draw)?;
                if truth.effects.iter().any(|choice| choice.name == name) {
                    return Err(Failure::usage(format!("the effect {name} is given twice"), "name each effect once"));
                }
                truth.add(name, times);
            }
        }
    }
    truth.robot()?;
    Ok(truth)
}

/// Half of the challenges hide one effect; the others keep a reader from assuming so.
fn kind(draw: &mut Draw) -> Kind {
    match draw.between(0.0, 1.0) {
        u if u < 0.15 => Kind::Nothing,
        u if u < 0.65 => Kind::One,
        u if u < 0.85 => Kind::Two,
        _ => Kind::Outside,
    }
}

/// `NAME` or `NAME=times its typical size`.
fn effect(text: &str, draw: &mut Draw) -> Result<(&'static str, f64), Failure> {
    let (name, times) = text.split_once('=').map_or((text, None), |(name, times)| (name, Some(times)));
    let wrong = |message: String| Failure::usage(message, "`ibr challenge list` shows what can be hidden");
    let effect: &HiddenEffect = known(name.trim()).map_err(|error| wrong(error.to_string()))?;
    let times = match times {
        None if effect.is_outside() => 1.0,
        None => draw.between(0.8, 1.5),
        Some(word) => match word.trim().parse::<f64>() {
            Ok(times) if SIZES.contains(&times) => times,
            _ => {
                let message =
                    format!("--effect {text}: `{word}` is not a size from {} to {}", SIZES.start(), SIZES.end());
                return Err(Failure::usage(message, format!("in typical sizes, for example {name}=1.2")));
            }
        },
    };
    Ok((effect.name, times))
}

/// A seed that nobody can guess: the keys of the standard library's hash maps are random.
fn unpredictable() -> u64 {
    std::collections::hash_map::RandomState::new().build_hasher().finish()
}

/// From the seed if one was given, so that the same command makes the same files.
fn salt(seed: Option<u64>, draw: &mut Draw) -> [u8; SALT] {
    let mut half = || match seed {
        Some(_) => draw.between(0.0, u64::MAX as f64) as u64,
        None => unpredictable(),
    };
    let mut salt = [0; SALT];
    salt[..8].copy_from_slice(&half().to_le_bytes());
    salt[8..].copy_from_slice(&half().to_le_bytes());
    salt
}

fn about(scenario: &Scenario, dataset: &Dataset) -> About {
    let notes = "Not a measurement. What is hidden is sealed in seal.toml; the recorded pressures are the set ones.";
    About {
        title: format!("Challenge: markers of {}", scenario.name),
        source: "ibr challenge new".into(),
        gravity_direction: Some(scenario.gravity_direction),
        notes: Some(notes.into()),
        ..generate::about(scenario, dataset, &Generator::default())
    }
}
