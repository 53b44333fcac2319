//! `ibr design`

use super::pattern::usual_pattern;
use super::{Context, Outcome};
use crate::cli::DesignArgs;
use crate::failure::Failure;
use crate::output::{Input, check_folder, maker, sha256, write_files};
use crate::shown::designed::{Checked, design_json, design_text};
use fem::session::{FeRun, Settings, Source, simulate};
use ibr::pages::design_files;
use std::path::PathBuf;
use sweep::design::{Design, Wish, design, misses_of_reading};

pub fn run(args: &DesignArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let wish = Wish::read(&args.wish, ibr::studies::scenario)?;
    let stem = args.wish.file_stem().unwrap_or_default().to_string_lossy();
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("ibr-report/design-{stem}")));
    check_folder(&folder)?;
    let found = searched(&wish, args.threads as usize, context)?;
    let checked = match args.no_check {
        true => Err("left out".to_string()),
        false => checked(&wish, &found, args.threads as usize, context)?,
    };
    let mut files = design_files(&wish, &found, checked.as_ref().ok().map(|checked| &checked.places_m[..]))?;
    files.text("design.toml", found.file.text.clone());
    let pattern = usual_pattern(&found.file.scenario);
    pattern.iter().for_each(|svg| files.text("pattern.svg", svg.clone()));
    if let Ok(Checked { pictures, .. }) = &checked {
        files.files.extend(pictures.iter().cloned());
    }
    files.retired = ["pattern.svg", "side.png", "section.png", "cut.png"].map(String::from).to_vec();
    let input = |name: String, text: &[u8]| Input { name, sha256: sha256(text) };
    let own = input(args.wish.display().to_string(), &std::fs::read(&args.wish).unwrap_or_default());
    write_files(&folder, &files, &[own, input(wish.base.name.clone(), wish.base.text.as_bytes())], context)?;
    let mut outcome =
        Outcome::new(design_text(&wish, &found, &checked), design_json(&args.wish, &wish, &found, &checked));
    outcome.notes.extend(pattern.err().map(|why| format!("no pattern: {why}")));
    outcome.notes.push(format!("robot: {}", folder.join("design.toml").display()));
    outcome.code = u8::from(!found.reached(&wish));
    Ok(outcome)
}

/// The search; Ctrl-C ends it, and nothing is written.
fn searched(wish: &Wish, threads: usize, context: &mut Context) -> Result<Design, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(context.fem(|progress| match pool {
        Ok(pool) => pool.install(|| design(wish, progress)),
        Err(_) => design(wish, progress),
    })?)
}

/// One finite element run of the design; or why there is none.
fn checked(
    wish: &Wish,
    found: &Design,
    threads: usize,
    context: &mut Context,
) -> Result<Result<Checked, String>, Failure> {
    let all = found.loads.actuator_pa;
    if all.iter().any(|pa| *pa != all[0]) {
        return Ok(Err("finite elements of a robot have one actuator pressure, and this design has several".into()));
    }
    if all[0] <= found.loads.body_pa {
        return Ok(Err("at a pressure below the body's the actuator stays flat".into()));
    }
    let set = [("fem.pressures_kpa".to_string(), format!("[{}]", fem::session::rounded(1e-3 * all[0])))];
    let file = found.file.with(&set)?;
    let source = Source { text: file.text.clone(), name: "design.toml".into(), folder: wish.folder.clone() };
    let settings = Settings { frames: false, threads, maker: maker(), ..Settings::default() };
    let run = match context.fem(|progress| simulate(&source, &settings, progress)) {
        Ok(run) => run,
        Err(error @ fem::FemError::Interrupted { .. }) => return Err(error.into()),
        Err(error) => return Ok(Err(error.to_string())),
    };
    Ok(read(wish, found, run))
}

fn read(wish: &Wish, found: &Design, run: FeRun) -> Result<Checked, String> {
    let reading = run.readings().last().ok_or("the run has no hold")?;
    let at = |(s, d): (&f64, &[f64; 3])| [s + d[0], d[1]];
    let places_m: Vec<[f64; 2]> = reading.stations_m.iter().zip(&reading.moved_m).map(at).collect();
    let misses = misses_of_reading(wish, found.file.length_m, &reading.stations_m, &places_m, reading.tip_angle_rad);
    let is_picture = |name: &str| ["side.png", "section.png", "cut.png"].contains(&name);
    let warnings = run.summary.warnings();
    let pictures = run.files.into_iter().filter(|(name, _)| is_picture(name)).collect();
    Ok(Checked { places_m, misses, warnings, pictures })
}
