//! `ibr design`

use super::pattern::usual_pattern;
use crate::cli::DesignArgs;
use crate::prelude::*;
use crate::shown::designed::{DesignAnswer, design_text};
use fem::FemError;
use fem::session::{FeRun, Job, Progress, Settings, Source, simulate, simulate_all};
use ibr::pages::design_files;
use sweep::design::{Checked, Design, Round, Rounds, Wish, misses_of_reading};

/// Pictures of a finite element run that go with its design.
const PICTURES: [&str; 3] = ["side.png", "section.png", "cut.png"];

pub(super) fn run(args: &DesignArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let wish = Wish::read(&args.wish, ibr::studies::scenario)?;
    let stem = args.wish.file_stem().unwrap_or_default().to_string_lossy();
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("ibr-report/design-{stem}")));
    check_folder(&folder)?;
    let mut rounds = Rounds::new(args.correct as usize);
    while searched(&mut rounds, &wish, context)? {
        let checked = match args.no_check {
            true => Err("left out".to_string()),
            false => checked(&wish, &rounds, &folder, context)?,
        };
        rounds.tell(checked);
    }
    let Round { design: found, checked, .. } = &rounds.all[rounds.best()];
    let mut files = design_files(&wish, found, checked.as_ref().ok().map(|checked| &checked.places_m[..]))?;
    files.text("design.toml", found.file.text.clone());
    let pattern = usual_pattern(&found.file.scenario);
    pattern.iter().for_each(|svg| files.text("pattern.svg", svg.clone()));
    if let Ok(Checked { pictures, .. }) = checked {
        files.files.extend(pictures.iter().cloned());
    }
    files.retired = PICTURES.iter().chain(&["pattern.svg"]).map(|name| name.to_string()).collect();
    let inputs = [read_input(&args.wish), Input::of(&wish.base.name, wish.base.text.as_bytes())];
    write_files(&folder, &files, &inputs, context)?;
    let answer = DesignAnswer::of(args.wish.display().to_string(), &wish, &rounds);
    let mut outcome = Outcome::answer(design_text(&wish, &rounds), "ibr.design", &answer);
    outcome.notes.extend(pattern.err().map(|why| format!("no pattern: {why}")));
    outcome.notes.push(format!("robot: {}", folder.join("design.toml").display()));
    outcome.code = u8::from(!rounds.reached(&wish));
    Ok(outcome)
}

/// The next search, if there is one; Ctrl-C ends it, and nothing is written.
fn searched(rounds: &mut Rounds, wish: &Wish, context: &mut Context) -> Result<bool, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(context.threads).build();
    let mut search = |progress: Progress| rounds.search(wish, progress).map(|found| found.is_some());
    Ok(context.fem(|progress| match pool {
        Ok(pool) => pool.install(|| search(progress)),
        Err(_) => search(progress),
    })?)
}

/// One finite element run of the last design; or why there is none. With corrections it is kept in a folder below that of the design.
fn checked(
    wish: &Wish,
    rounds: &Rounds,
    folder: &Path,
    context: &mut Context,
) -> Result<Result<Checked, String>, Failure> {
    let number = rounds.all.len();
    let Some(Round { design: found, .. }) = rounds.all.last() else { return Ok(Err("there is no design".into())) };
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
    let mut settings = Settings { frames: false, threads: context.threads, maker: maker(), ..Settings::default() };
    let made = match rounds.corrections {
        0 => context.fem(|progress| simulate(&source, &settings, progress)),
        more => {
            settings.folder = Some(folder.join("runs"));
            let job = Job { source, what: format!("check {number} of at most {}", 1 + more), folder: None };
            let made = context.fem(|progress| simulate_all(&[job], &settings, progress));
            made.and_then(|mut made| made.runs.remove(0))
        }
    };
    match made {
        Ok(run) => Ok(read(wish, found, run)),
        Err(error @ (FemError::Interrupted { .. } | FemError::Folder { .. })) => Err(error.into()),
        Err(error) => Ok(Err(error.to_string())),
    }
}

fn read(wish: &Wish, found: &Design, run: FeRun) -> Result<Checked, String> {
    let reading = run.readings().last().ok_or("the run has no hold")?;
    let at = |(s, d): (&f64, &[f64; 3])| [s + d[0], d[1]];
    let places_m: Vec<[f64; 2]> = reading.stations_m.iter().zip(&reading.moved_m).map(at).collect();
    let misses = misses_of_reading(wish, found.file.length_m, &reading.stations_m, &places_m, reading.tip_angle_rad);
    let warnings = run.summary.warnings();
    let written = |name: &&str| Some((name.to_string(), std::fs::read(run.folder.as_ref()?.join(name)).ok()?));
    let mut pictures: Vec<(String, Vec<u8>)> = PICTURES.iter().filter_map(written).collect();
    pictures.extend(run.files.into_iter().filter(|(name, _)| PICTURES.contains(&name.as_str())));
    Ok(Checked { places_m, misses, warnings, pictures })
}
