use super::pattern::usual_pattern;
use crate::cli::DesignArgs;
use crate::prelude::*;
use fem::FemError;
use fem::session::{FeRun, Progress, RunJob, RunSettings, simulate, simulate_all};
use ibr::pages::design_files;
use sweep::design::{Checked, Design, Held, Miss, Round, Rounds, Spread, StopReason, Wish, misses_of_reading};

/// Pictures of a finite element run that go with its design.
const PICTURES: [&str; 3] = ["side.png", "section.png", "cut.png"];

pub(super) fn run(args: &DesignArgs, context: &mut Context) -> Result<Outcome> {
    let wish = Wish::read(&args.wish, |spec| ibr::studies::scenario(spec)?.planar())?;
    let stem = args.wish.file_stem().unwrap_or_default().to_string_lossy();
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("ibr-report/design-{stem}")));
    check_folder(&folder)?;
    let mut rounds = Rounds::new(args.correct as usize);
    while searched(&mut rounds, &wish, context)? {
        let checked = match args.no_check {
            true => Err("left out".to_string()),
            false => checked(&wish, &rounds, &folder, context)?,
        };
        rounds.answer(checked);
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
    let answer = design_answer(args.wish.display().to_string(), &wish, &rounds);
    let mut outcome = Outcome::answer(design_text(&wish, &rounds), "ibr.design", &answer);
    outcome.notes.extend(pattern.err().map(|why| format!("no pattern: {why}")));
    outcome.notes.push(format!("robot: {}", folder.join("design.toml").display()));
    outcome.code = u8::from(!rounds.reached(&wish));
    Ok(outcome)
}

/// The next search, if there is one; Ctrl-C ends it, and nothing is written.
fn searched(rounds: &mut Rounds, wish: &Wish, context: &mut Context) -> Result<bool> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(context.threads).build();
    let mut search = |progress: Progress| rounds.search(wish, progress).map(|found| found.is_some());
    Ok(context.fem(|progress| match pool {
        Ok(pool) => pool.install(|| search(progress)),
        Err(_) => search(progress),
    })?)
}

/// One finite element run of the last design; or why there is none. With corrections it is kept in a folder below the design's.
fn checked(wish: &Wish, rounds: &Rounds, folder: &Path, context: &mut Context) -> Result<Result<Checked, String>> {
    let number = rounds.all.len();
    let Some(Round { design: found, .. }) = rounds.all.last() else { return Ok(Err("no design was found".into())) };
    let all = found.loads.actuator_pa;
    if all.iter().any(|pa| *pa != all[0]) {
        return Ok(Err("finite elements of a robot have one actuator pressure, and this design has several".into()));
    }
    if all[0] <= found.loads.body_pa {
        return Ok(Err("at a pressure below the body's the actuator stays flat".into()));
    }
    let set = [("fem.pressures_kpa".to_string(), format!("[{}]", fem::session::rounded(1e-3 * all[0])))];
    let file = found.file.with(&set)?;
    let source = file.source(&wish.folder);
    let mut settings =
        RunSettings { frames: false, threads: context.threads, maker: maker(), ..RunSettings::default() };
    let made = match rounds.corrections {
        0 => context.fem(|progress| simulate(&source, &settings, progress)),
        more => {
            settings.folder = Some(folder.join("runs"));
            let job = RunJob { source, what: format!("check {number} of at most {}", 1 + more), folder: None };
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

fn shown(values: &[f64]) -> String {
    match values {
        [rad] => format!("{:.1}°", rad.to_degrees()),
        [x, y] => format!("{:.1}, {:.1}", 1e3 * x, 1e3 * y),
        _ => String::new(),
    }
}

fn design_text(wish: &Wish, rounds: &Rounds) -> String {
    let best = &rounds.all[rounds.best()];
    let Round { design: found, checked, .. } = best;
    let tolerance_mm = 1e3 * wish.tolerance * found.file.length_m;
    let (by, worst_m) = match rounds.corrections {
        0 => ("", found.worst_m()),
        _ if checked.is_err() => ("by the model ", found.worst_m()),
        _ => ("by finite elements ", best.worst_m()),
    };
    let within = format!("{:.1} mm (tolerance {tolerance_mm:.1} mm)", 1e3 * worst_m);
    let name = &found.file.scenario.name;
    let what = match (rounds.reached(wish), rounds.corrections) {
        (true, _) => "a design has the wish to",
        (false, 0) => "no design within these ranges has the wish; the nearest misses it by",
        (false, _) => "no design that was tried has the wish; the nearest misses it by",
    };
    let mut text = format!("{name}: {by}{what} {within}\n\n");
    text += &TextTable::of(&found.chosen).words("chosen", |(key, _)| key).right("value", |(_, value)| value).text();
    text += &format!(
        "Pressure {} kPa, body {} kPa.\n\n",
        pressure_words(&found.loads),
        compare::wording::short(1e-3 * found.loads.body_pa)
    );
    let all = found.loads.actuator_pa;
    if all.iter().any(|pa| *pa != all[0]) {
        let typed = all.map(|pa| format!("{}kPa", fem::session::rounded(1e-3 * pa))).join("/");
        text += &format!(
            "Pressures of single channels are not in design.toml: ibr predict design.toml --pressure {typed}\n\n"
        );
    }
    let other = |miss: &&Miss| best.by_elements(&miss.what);
    text += &TextTable::of(&found.misses)
        .words("wish [mm]", |miss| &miss.what)
        .right("target", |miss| shown(&miss.wanted))
        .right("model, predicted", |miss| shown(&miss.found))
        .number("miss [mm]", 1, |miss| 1e3 * miss.miss_m)
        .when(checked.is_ok(), |table| {
            table
                .right("finite elements", |miss| other(miss).map_or("not read".into(), |other| shown(&other.found)))
                .right("miss [mm]", |miss| other(miss).map_or(String::new(), |o| format!("{:.1}", 1e3 * o.miss_m)))
        })
        .text();
    if let Err(why) = checked {
        text += &format!("No finite element run: {why}.\n");
    }
    text += &rounds_text(wish, rounds);
    text += &match (&found.spread, &best.corrected) {
        (None, _) => {
            "No number is named as assumed, so no interval is given: add [[assumed]] with key, from and to.\n".into()
        }
        (Some(Spread { worst_m, .. }), Some(_)) => format!(
            "Over the assumed numbers the model, corrected by finite elements, misses the wish by up to {:.1} mm.\n",
            1e3 * worst_m
        ),
        (Some(Spread { x_m, y_m, worst_m }), None) => {
            let [x, y] = [x_m, y_m].map(|[low, high]| format!("{:.1} to {:.1}", 1e3 * low, 1e3 * high));
            let up_to = 1e3 * worst_m;
            format!(
                "Over the assumed numbers the tip is at x = {x} mm and y = {y} mm, and the wish is missed by up to {up_to:.1} mm.\n"
            )
        }
    };
    for held in &found.held {
        text += &format!(
            "Held back by {} at its end {}: one unit beyond it would take {:.2} mm off the miss.\n",
            held.key,
            compare::wording::short(held.value),
            1e3 * held.gain_m
        );
    }
    if searched_m(best) > wish.tolerance * found.file.length_m && found.held.is_empty() {
        text += "No end of a range holds it back. Longer lists, other free keys or a smaller wish may help.\n";
    }
    text
}

/// Largest miss of the model that the design was searched with: the corrected one where there is one \[m\].
fn searched_m(round: &Round) -> f64 {
    round.corrected.as_ref().unwrap_or(&round.design.misses).iter().map(|miss| miss.miss_m).fold(0.0, f64::max)
}

/// Design by design what was searched and what finite elements said, where corrections were asked for.
fn rounds_text(wish: &Wish, rounds: &Rounds) -> String {
    let best = rounds.best();
    let (Some(end), Some(first), 1..) = (rounds.end(wish), rounds.all.first(), rounds.corrections) else {
        return String::new();
    };
    let mm = |m: f64| format!("{:.1}", 1e3 * m);
    let row = |(k, round): (usize, &Round)| {
        let values = round.design.chosen.iter().map(|(_, value)| value.clone());
        let elements = round.checked.as_ref().map_or("none".into(), |_| mm(round.worst_m()));
        let corrected = round.corrected.as_ref().map_or("none".into(), |_| mm(searched_m(round)));
        let misses = [mm(round.design.worst_m()), corrected, elements];
        std::iter::once((k + 1).to_string()).chain(values).chain(misses).collect()
    };
    let keys = first.design.chosen.iter().map(|(key, _)| key.as_str());
    let head: Vec<&str> =
        std::iter::once("design").chain(keys).chain(["model", "corrected", "finite elements"]).collect();
    let mut text = "\nDesigns and their largest miss [mm]: by the model, by the model corrected by finite elements, and by finite elements.\n".to_string();
    text += &TextTable::finished(&head, 0, rounds.all.iter().enumerate().map(row).collect()).text();
    text += &match (best, rounds.all.len()) {
        (_, 1) => "The first design is written.".to_string(),
        (0, _) => {
            "The corrections did not help: the first design misses least by finite elements, and is written.".into()
        }
        (best, _) => format!(
            "The corrections took the miss by finite elements from {} to {} mm: design {} is written.",
            mm(first.worst_m()),
            mm(rounds.all[best].worst_m()),
            best + 1
        ),
    };
    text += &match (end, rounds.all.last().map(|last| &last.checked)) {
        (StopReason::Reached, _) => " It has the wish within the tolerance.\n".to_string(),
        (StopReason::Spent, _) => " No further design was tried: more need a larger --correct.\n".into(),
        (StopReason::Same, _) => {
            " The search came back to a design that was checked: more corrections would change nothing.\n".into()
        }
        (StopReason::Unchecked, Some(Err(why))) if rounds.all.len() > 1 => {
            format!(
                " Design {} has no finite element run ({why}), so the model is not corrected further.\n",
                rounds.all.len()
            )
        }
        (StopReason::Unchecked, _) => " Without a finite element run nothing corrects the model.\n".into(),
    };
    text
}

/// `ibr.design`: `ibr design WISH`
#[derive(Serialize)]
struct DesignAnswer<'a> {
    /// Path or name of the wish as typed
    wish: String,
    /// The robot that it began with
    scenario: &'a str,
    /// Every part of the wish is within the tolerance by the model; with `--correct` by finite elements
    reached: bool,
    /// Share of the length by which a wish may be missed
    tolerance_mm: f64,
    #[serde(flatten)]
    best: TriedDesign<'a>,
    /// Actuator pressure of every channel at the design
    p_act_channels_kpa: Vec<f64>,
    /// Body pressure of the best design found
    p_body_kpa: f64,
    /// Over the assumed numbers, where some are named
    interval: Option<Spread>,
    /// Ends of ranges that hold the design back, the most first
    held: &'a [Held],
    /// Number of starts of the search
    starts: usize,
    /// Starts that ended at this design or an equal one
    starts_that_agree: usize,
    /// With `--correct`: all that were checked, in their order
    #[serde(skip_serializing_if = "Option::is_none")]
    designs: Option<Vec<CheckedDesign<'a>>>,
    /// With `--correct`, reason why no further round ran
    #[serde(skip_serializing_if = "Option::is_none")]
    ended: Option<Option<StopReason>>,
}

#[derive(Serialize)]
struct ChosenValue<'a> {
    /// Key of the scenario that was chosen
    key: &'a str,
    /// Value as the scenario has it, in the unit of the key
    value: &'a str,
}

/// A design with its wish and its check.
#[derive(Serialize)]
struct TriedDesign<'a> {
    /// Values that were chosen for the free keys
    chosen: Vec<ChosenValue<'a>>,
    /// The wish by the model as it is, part by part
    misses: &'a [Miss],
    /// Result of one run of the design
    finite_elements: Option<&'a Checked>,
    /// Reason why finite elements did not run
    unchecked: Option<&'a str>,
}

impl<'a> TriedDesign<'a> {
    fn of(Round { design, checked, .. }: &'a Round) -> TriedDesign<'a> {
        let chosen = design.chosen.iter().map(|(key, value)| ChosenValue { key, value }).collect();
        let (finite_elements, unchecked) = (checked.as_ref().ok(), checked.as_ref().err().map(String::as_str));
        TriedDesign { chosen, misses: &design.misses, finite_elements, unchecked }
    }
}

#[derive(Serialize)]
struct CheckedDesign<'a> {
    #[serde(flatten)]
    design: TriedDesign<'a>,
    /// Largest miss by finite elements, and by the model of parts that they do not read
    worst_mm: f64,
    /// The wish by the model with what finite elements differed at the design before; null for the first
    corrected_by_finite_elements: Option<&'a [Miss]>,
    /// Whether this is the one that is written
    written: bool,
}

fn design_answer<'a>(typed: String, wish: &'a Wish, rounds: &'a Rounds) -> DesignAnswer<'a> {
    let best = rounds.best();
    let found = &rounds.all[best].design;
    let one = |(k, round): (usize, &'a Round)| CheckedDesign {
        design: TriedDesign::of(round),
        worst_mm: 1e3 * round.worst_m(),
        corrected_by_finite_elements: round.corrected.as_deref(),
        written: k == best,
    };
    let corrected = rounds.corrections > 0;
    DesignAnswer {
        wish: typed,
        scenario: &wish.base.name,
        reached: rounds.reached(wish),
        tolerance_mm: 1e3 * wish.tolerance * found.file.length_m,
        best: TriedDesign::of(&rounds.all[best]),
        p_act_channels_kpa: found.loads.actuator_pa.iter().map(|pa| 1e-3 * pa).collect(),
        p_body_kpa: 1e-3 * found.loads.body_pa,
        interval: found.spread,
        held: &found.held,
        starts: found.starts[0],
        starts_that_agree: found.starts[1],
        designs: corrected.then(|| rounds.all.iter().enumerate().map(one).collect()),
        ended: corrected.then(|| rounds.end(wish)),
    }
}
