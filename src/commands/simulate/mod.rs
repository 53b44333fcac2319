//! `ibr simulate`

mod batch;
mod cache;
mod exchange;
mod folder;
mod input;
mod paper_runs;
mod plan;
mod robot;
mod robot_files;
mod single;
mod small;
mod stepping;
mod summary;
mod uncertain;

use super::{Context, Outcome};
use crate::cli::Simulate;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::check_folder;
use plan::{About, Plan};
use serde_json::json;
use single::{Done, Finished, Manner};
use std::path::{Path, PathBuf};
use std::time::Duration;
use summary::SUMMARY;

pub use cache::{Keeper, all as all_runs};
pub use input::{Named, named};
pub use paper_runs::all as paper_runs;
pub use plan::{keys_of, pressures, sizes};
pub use robot::{heights_mm, rounded};
pub use small::{Small, run as small_run};

pub fn run(args: &Simulate, context: &mut Context) -> Result<Outcome, Failure> {
    let plan = plan::plan(args, input::named(&args.case)?)?;
    let manner = manner(args, &plan)?;
    match plan {
        Plan::Single(named) => one(args, &named, &manner, context),
        Plan::Several { base, cases, about } => batch::run(&base, &cases, &about, &manner, context),
    }
}

fn manner(args: &Simulate, plan: &Plan) -> Result<Manner, Failure> {
    let every = Duration::from_secs_f64(input::seconds("--checkpoint-every", &args.checkpoint_every)?);
    let end_s = args.end.as_deref().map(|text| input::seconds("--end", text)).transpose()?;
    let folder = args.out.clone().unwrap_or_else(|| default_folder(args, plan));
    check_folder(&folder)?;
    let (resume, force, frames, threads) = (args.resume, args.force, !args.no_frames, args.threads as usize);
    Ok(Manner { folder, resume, force, frames, end_s, threads, every })
}

/// The folder of a case if none is named.
fn default_folder(args: &Simulate, plan: &Plan) -> PathBuf {
    let stem = Path::new(&args.case).file_stem().unwrap_or_default().to_string_lossy();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect();
    let kind = match plan {
        Plan::Several { about: About::Uncertain(..), .. } => "uncertain",
        Plan::Several { .. } => "batch",
        Plan::Single(_) => "simulate",
    };
    PathBuf::from(format!("ibr-report/{kind}-{name}"))
}

fn one(args: &Simulate, named: &Named, manner: &Manner, context: &mut Context) -> Result<Outcome, Failure> {
    match single::run(named.load()?, manner, context)? {
        Done::Now(Finished { summary, cost }, notes) => {
            let text = summary::text(&summary) + &summary::cost_text(&cost);
            let mut answer = SUMMARY.stamped(&summary);
            answer["cost"] = json!(cost);
            answer["folder"] = json!(manner.folder.display().to_string());
            Ok(Outcome { text, json: Some(answer), notes, code: 0 })
        }
        Done::Before(Finished { summary, .. }) => {
            let mut outcome = Outcome::new(summary::text(&summary), SUMMARY.stamped(&summary));
            outcome.notes.push(format!("the run in {} is complete; nothing was done", manner.folder.display()));
            Ok(outcome)
        }
        Done::Interrupted { at: (time_s, step), mut notes } => {
            notes.push(format!(
                "interrupted at t = {time_s:.6} s, step {step}; go on with: ibr simulate {}{} --out {} --resume{}",
                args.case,
                typed_again(args),
                manner.folder.display(),
                if args.force { " --force" } else { "" }
            ));
            Ok(Outcome { notes, code: INTERRUPTED, ..Outcome::default() })
        }
    }
}

/// Options that make the case what it is.
fn typed_again(args: &Simulate) -> String {
    let mut out = String::new();
    let mut add = |option: &str, value: &str| out.push_str(&format!(" {option} {value}"));
    args.pressure.iter().for_each(|p| add("--pressure", p));
    args.mesh.iter().for_each(|m| add("--mesh", m));
    args.set.iter().for_each(|s| add("--set", s));
    out
}

/// A file of the run that cannot be written, or read back.
fn write_failure(path: &Path, cause: &std::io::Error) -> Failure {
    Failure::Write {
        path: path.display().to_string(),
        cause: cause.to_string(),
        help: "choose another folder with --out".into(),
    }
}
