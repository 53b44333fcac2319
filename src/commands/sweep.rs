//! `ibr sweep`

use super::shards::{Work, by_scheduler, shard};
use crate::cli::SweepArgs;
use crate::prelude::*;
use crate::shown::swept::{SweepAnswer, swept_text};
use data::Table;
use ibr::pages::{sweep_picture_names, sweep_pictures};
use sweep::{Found, Settings, Study, SweepError, collect, parts_missing, run as compute};

pub(super) fn run(args: &SweepArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let study = Study::read(&args.study, ibr::studies::scenario_in_space)?;
    let stem = args.study.file_stem().unwrap_or_default().to_string_lossy();
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("ibr-report/sweep-{stem}")));
    check_folder(&folder)?;
    let missing = || parts_missing(&study, &folder);
    let (all, may_fail) = (missing(), false);
    let work = Work { folder: &folder, parts: "parts", all, missing: &missing, may_fail };
    if let Some(script) = by_scheduler(&args.shards, &work, context)? {
        return Ok(script);
    }
    let shard = shard(&args.shards)?;
    let runs = fem::session::Settings {
        frames: false,
        threads: context.threads,
        maker: maker(),
        ..fem::session::Settings::default()
    };
    let settings = Settings { folder: folder.clone(), shard, threads: context.threads, runs };
    // Ctrl-C leaves what is complete.
    let found = context.fem(|progress| compute(&study, &settings, progress))?;
    match collect(&study, &folder) {
        Ok(table) => whole(args, &study, &folder, &found, table, context),
        Err(SweepError::Missing(missing)) => {
            let text = format!(
                "{} parts of shard {}/{} are there; {missing} of other shards are not yet. The last shard writes the table\n",
                found.parts, shard.which, shard.of
            );
            Ok(Outcome::answer(text, "ibr.sweep", &SweepAnswer::of(&args.study, &study, &found, None)))
        }
        Err(damaged) => Err(damaged.into()),
    }
}

/// Table, pictures and what is printed.
fn whole(
    args: &SweepArgs,
    study: &Study,
    folder: &Path,
    found: &Found,
    table: Table,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    (context.progress)("writing the table", None);
    let mut files = sweep_pictures(study, &table)?;
    files.retire(&sweep_picture_names());
    let answer = SweepAnswer::of(&args.study, study, found, Some(&table));
    let mut outcome = Outcome::answer(swept_text(study, found, &table), "ibr.sweep", &answer);
    let name = if args.parquet { "table.parquet" } else { "table.csv" };
    match args.parquet {
        true => files.parquet.push((name.into(), table)),
        false => {
            let mut csv = Vec::new();
            table.to_csv(&mut csv)?;
            files.files.push((name.into(), csv));
        }
    }
    let inputs = [read_input(&args.study), Input::of(&study.base.name, study.base.text.as_bytes())];
    write_files(folder, &files, &inputs, context)?;
    outcome.notes.push(format!("table: {}", folder.join(name).display()));
    Ok(outcome)
}
