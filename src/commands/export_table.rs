//! `ibr export c` and `ibr export fmu`: tables over the pressure.

use super::inputs::{self, quantity};
use crate::cli::ExportArgs;
use crate::prelude::{
    Context, Failure, Loads, Model, Outcome, Quantity, Result, Scenario, Serialize, refuse_if, write_whole,
};
use crate::shown::predicted::beyond_words;
use models::export::{Bound, Origin, Table, Untabulated};
use std::path::{Path, PathBuf};

pub(super) fn c(args: &ExportArgs, context: &mut Context) -> Result<Outcome> {
    let path = target(args.out.as_ref(), "c")?;
    let (scenario, table, has_history) = table(args)?;
    let history = if has_history { scenario.remembering() } else { Vec::new() };
    let [header, source] = table.c_files(&origin(&command(args), &path, &scenario, &history));
    let files = [(path.with_extension("h"), header.into_bytes()), (path, source.into_bytes())];
    write(&files, context)?;
    Ok(report(args, &table, &files.map(|(path, _)| path.display().to_string())))
}

pub(super) fn fmu(args: &ExportArgs, context: &mut Context) -> Result<Outcome> {
    let path = target(args.out.as_ref(), "fmu")?;
    let (scenario, table, has_history) = table(args)?;
    let history = if has_history { scenario.remembering() } else { Vec::new() };
    let command = command(args);
    let origin = origin(&command, &path, &scenario, &history);
    let mut files: Vec<(String, Vec<u8>)> = table
        .fmu_files(&origin, scenario.line.as_ref())
        .into_iter()
        .map(|(name, text)| (name, text.into_bytes()))
        .collect();
    let built = library(&files, &origin.name());
    let has_library = built.is_some();
    files.extend(built);
    write(&[(path.clone(), crate::zip::stored(&files))], context)?;
    let mut outcome = report(args, &table, &[path.display().to_string()]);
    if !has_library {
        outcome.notes.push("note: no C compiler `cc` here, so the unit has sources and no library".into());
    }
    Ok(outcome)
}

/// The library of the unit for this machine, with its name in the archive; none without a C compiler.
fn library(files: &[(String, Vec<u8>)], name: &str) -> Option<(String, Vec<u8>)> {
    let (system, ending) = if cfg!(target_os = "macos") { ("darwin", "dylib") } else { ("linux", "so") };
    let folder = std::env::temp_dir().join(format!("ibr-fmu-{}", std::process::id()));
    std::fs::create_dir_all(&folder).ok()?;
    let own = |name: &str| folder.join(name.rsplit('/').next().unwrap_or(name));
    let made = files.iter().try_for_each(|(name, bytes)| std::fs::write(own(name), bytes)).ok().and_then(|()| {
        let sources = files.iter().filter(|(name, _)| name.ends_with(".c")).map(|(name, _)| own(name));
        let flags = ["-std=c99", "-O2", "-shared", "-fPIC", "-fvisibility=hidden", "-o", "library"];
        let mut cc = std::process::Command::new("cc");
        let ran = cc.args(flags).args(sources).arg("-lm").current_dir(&folder).output().ok()?;
        if ran.status.success() { std::fs::read(folder.join("library")).ok() } else { None }
    });
    // A leftover in a folder for temporary files does no harm.
    drop(std::fs::remove_dir_all(&folder));
    Some((format!("binaries/{}-{system}/{name}.{ending}", std::env::consts::ARCH), made?))
}

/// Writes files for other programs. A file that is there is replaced only with --force.
pub(super) fn write(files: &[(PathBuf, Vec<u8>)], context: &mut Context) -> Result<()> {
    if let Some((path, _)) = files.iter().find(|(path, _)| path.exists() && !context.force) {
        let message = format!("cannot write {}: it exists", path.display());
        return Err(Failure::usage(message, "add --force, or choose another file with --out"));
    }
    write_whole(files, context)
}

/// The file to write, with the ending of its format.
pub(super) fn target(out: Option<&PathBuf>, ending: &str) -> Result<PathBuf> {
    let example = format!("robot.{ending}");
    let path = out.cloned().unwrap_or_else(|| example.clone().into());
    let message = format!("--out {} does not end with .{ending}", path.display());
    let help = format!("write for example --out {example}");
    refuse_if(path.extension().is_none_or(|end| end != ending), message, help)?;
    Ok(path)
}

fn command(args: &ExportArgs) -> String {
    format!("ibr {} export {}", env!("CARGO_PKG_VERSION"), args.robot.scenario)
}

fn origin<'a>(command: &'a str, path: &'a Path, scenario: &'a Scenario, history: &'a [&'a str]) -> Origin<'a> {
    let prefix = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    Origin { prefix, robot: &scenario.name, command, history }
}

pub(super) fn trusted(model: &Model, poses: impl IntoIterator<Item = Loads>, help: &str) -> Result<()> {
    let mut at = model.prediction();
    for loads in poses {
        model.predict(&loads, &mut at)?;
        if let Some(words) = beyond_words(model, &loads, &at).first() {
            let words = words.trim_start_matches("warning: ").trim_end_matches("; do not trust this pose");
            return Err(Failure::usage(format!("cannot export a pose that the robot does not hold: {words}"), help));
        }
    }
    Ok(())
}

/// Steps of the pressure between which the poses of a table are examined.
const LOOKED_AT: usize = 256;

fn table(args: &ExportArgs) -> Result<(Scenario, Table, bool)> {
    let scenario = inputs::robot(&args.robot, true)?.1;
    let (model, range_pa) = (Model::new(&scenario), range(&scenario, args.pressure.as_deref())?);
    let has_history = model.has_history();
    if has_history && !args.loading {
        let effects = scenario.remembering().join(", ");
        let message = format!("with {effects} a state depends on those before it, and a table knows the pressure");
        let help = "add --loading for the first loading from rest, or leave it out of the scenario";
        return Err(Failure::usage(message, help));
    }
    let table = Table::new(&model, scenario.p_body_pa, range_pa).map_err(refused)?;
    let step_pa = (range_pa[1] - range_pa[0]) / LOOKED_AT as f64;
    let pressures = (0..=LOOKED_AT).map(|i| (range_pa[0] + step_pa * i as f64).min(range_pa[1]));
    let poses = pressures.map(|p| Loads::uniform(scenario.p_body_pa, p));
    trusted(&model, poses, "give a range --pressure from:to without it, or a smaller load")?;
    Ok((scenario, table, has_history))
}

/// Pressures from:to; a number without unit has the unit of the other.
fn range(scenario: &Scenario, typed: Option<&str>) -> Result<[f64; 2]> {
    let Some(typed) = typed else { return Ok([0.0, scenario.p_max_pa]) };
    let Some((from, to)) = typed.split_once(':') else {
        let help = "write from:to, for example --pressure 0:40kPa";
        return Err(Failure::usage(format!("--pressure {typed} is not a range"), help));
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

/// `ibr.export.c`: `ibr export c SCENARIO`, `ibr export fmu SCENARIO`
#[derive(Serialize)]
struct TableAnswer<'a> {
    /// Path or name of the scenario as typed
    scenario: &'a str,
    /// Files that were written, C or FMU
    written: &'a [String],
    /// Size of the constants in single precision, in bytes
    bytes: usize,
    /// Number of polynomials of each output, one per range of pressures
    pieces: usize,
    /// Degree of the polynomials, the same for all
    degree: usize,
    /// Number of markers in the table
    markers: usize,
    /// Body pressure for which the table holds
    p_body_kpa: f64,
    /// Range of actuator pressures, from and to
    p_act_kpa: [f64; 2],
    /// Pressure up to which the actuator is flat
    p_open_kpa: f64,
    /// Heights of the tip that have one pressure, from and to
    heights_mm: Option<[f64; 2]>,
    /// Largest differences between the table and the model
    bound: &'a Bound,
}

fn report(args: &ExportArgs, table: &Table, names: &[String]) -> Outcome {
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
