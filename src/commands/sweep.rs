use super::shards::{Work, by_scheduler, shard};
use crate::cli::SweepArgs;
use crate::prelude::*;
use crate::tables::TextTable;
use ::sweep::influence::{influences, pairs};
use data::Table;
use data::table::Column;
use ibr::pages::{sweep_picture_names, sweep_pictures};
use sweep::{Found, Settings, Study, SweepError, collect, parts_missing, run as compute, there};

pub(super) fn run(args: &SweepArgs, context: &mut Context) -> Result<Outcome> {
    let study = Study::read(&args.study, ibr::studies::scenario)?;
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
    let keep_runs = args.keep_runs;
    let settings = Settings { folder: folder.clone(), shard, keep_runs, threads: context.threads, maker: maker() };
    // Ctrl-C leaves the complete parts.
    let found = match args.so_far {
        true => there(&study, &folder)?,
        false => context.fem(|progress| compute(&study, &settings, progress))?,
    };
    match collect(&study, &folder, args.so_far) {
        Ok(table) => whole(args, &study, &folder, &found, table, context),
        Err(SweepError::Missing(missing)) => {
            let text = format!(
                "{} parts of shard {}/{} are there; {missing} of other shards are not yet. The last shard writes the table\n",
                found.parts, shard.which, shard.of
            );
            Ok(Outcome::answer(text, "ibr.sweep", &sweep_answer(&args.study, &study, &found, None)))
        }
        Err(damaged) => Err(damaged.into()),
    }
}

fn whole(
    args: &SweepArgs,
    study: &Study,
    folder: &Path,
    found: &Found,
    table: Table,
    context: &mut Context,
) -> Result<Outcome> {
    (context.progress)("writing the table", None);
    let mut files = sweep_pictures(study, &table)?;
    files.retire(&sweep_picture_names());
    let answer = sweep_answer(&args.study, study, found, Some(&table));
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

fn failures(table: &Table) -> Vec<(String, usize)> {
    let texts = |name: &str| match table.columns.iter().find(|column| column.0 == name) {
        Some((_, Column::Str(all))) => &all[..],
        _ => &[],
    };
    let mut counted: std::collections::BTreeMap<&str, usize> = std::collections::BTreeMap::new();
    for (status, reason) in texts("status").iter().zip(texts("reason")) {
        if status == "failed" {
            *counted.entry(reason).or_default() += 1;
        }
    }
    let mut found: Vec<(String, usize)> = counted.into_iter().map(|(why, n)| (why.to_string(), n)).collect();
    found.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
    found
}

/// How far the engines are from each other where both have a case.
fn agreement(table: &Table, (output, quantity): (&str, &str)) -> String {
    let mut off: Vec<f64> = pairs(table, output).iter().map(|[model, fe]| model - fe).collect();
    off.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (Some(middle), Some(worst)) = (off.get(off.len() / 2), off.last()) else { return String::new() };
    format!(
        "\n{} cases by both: the model's {quantity} differs by {:.1} mm in the median, {worst:+.1} mm at worst\n",
        off.len(),
        middle.abs()
    )
}

const MOST_REASONS: usize = 3;

fn swept_text(study: &Study, found: &Found, table: &Table) -> String {
    let engines: Vec<String> =
        study.engines.iter().map(|engine| format!("{} cases by {}", study.cases(*engine), engine.word())).collect();
    let name = &study.base.scenario.name;
    let mut text = format!(
        "{}: {}; {} of {} parts were there before\n",
        if name.is_empty() { &study.base.name } else { name },
        engines.join(", "),
        found.kept,
        found.parts
    );
    for engine in &study.engines {
        for (output, what) in study.heights() {
            text += &TextTable::of(influences(study, table, *engine, output))
                .words("key", |i| i.key.clone())
                .number("lowest mm", 1, |i| i.range()[0])
                .number("highest mm", 1, |i| i.range()[1])
                .under(&format!("Mean {what} over the values of each key, {}:", engine.word()));
        }
    }
    study.heights().iter().for_each(|height| text += &agreement(table, *height));
    let failed = failures(table);
    let count: usize = failed.iter().map(|f| f.1).sum();
    if count > 0 {
        text += &format!("\n{count} rows failed:\n");
    }
    let rest: usize = failed.iter().skip(MOST_REASONS).map(|f| f.1).sum();
    let named = failed.iter().take(MOST_REASONS).map(|(why, n)| format!("{n}: {why}"));
    text + &lines(
        "  - ",
        named.chain((rest > 0).then(|| format!("{rest}: other reasons, in the column reason of the table"))),
    )
}

/// `ibr.sweep`: `ibr sweep STUDY`
#[derive(Serialize)]
struct SweepAnswer<'a> {
    /// Path or name of the study as typed
    study: String,
    /// Path or name of the robot that the study varies
    scenario: &'a str,
    /// Number of cases of the study
    cases: usize,
    /// Engines that compute the cases: reduced, finite elements
    engines: Vec<&'static str>,
    #[serde(flatten)]
    found: &'a Found,
    /// Rows without numbers, by their reason
    failed: Vec<FailedRows>,
    /// Names of the columns in the table
    columns: Vec<String>,
}

/// Rows without numbers for one reason.
#[derive(Serialize)]
struct FailedRows {
    /// Message of the model or of the finite elements
    reason: String,
    /// Number of rows that have this reason
    rows: usize,
}

/// Of a study in a file; without a table only a shard was made.
fn sweep_answer<'a>(file: &Path, study: &'a Study, found: &'a Found, table: Option<&Table>) -> SweepAnswer<'a> {
    let failed = table.map_or(Vec::new(), failures).into_iter();
    SweepAnswer {
        study: file.display().to_string(),
        scenario: &study.base.name,
        cases: study.cases(sweep::Engine::Reduced),
        engines: study.engines.iter().map(|engine| engine.word()).collect(),
        found,
        failed: failed.map(|(reason, rows)| FailedRows { reason, rows }).collect(),
        columns: sweep::names(study),
    }
}
