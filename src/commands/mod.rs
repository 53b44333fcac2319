//! One file per command; each returns what to print.

mod add;
mod bench;
mod bench_tables;
mod breakdown;
mod challenge;
mod characterize;
mod compare;
mod data;
mod data_fem;
mod data_import;
mod demo;
mod design;
mod diagnose;
mod engines;
mod export;
mod export_table;
mod fem_inputs;
mod grow;
pub(crate) mod import_options;
mod inputs;
mod ladder;
mod list;
mod paper;
mod pattern;
mod predict;
mod published;
mod shards;
mod simulate;
mod studio;
mod sweep;
mod tradeoff;
mod validate;
mod verify;

use crate::cli::Command;
pub(crate) use crate::context::{Context, Outcome};
use crate::failure::{Failure, Result};

pub(crate) fn run(command: &Command, context: &mut Context) -> Result<Outcome> {
    match command {
        Command::Demo { out } => demo::run(out, context),
        Command::Predict(args) => predict::run(args, context),
        Command::Grow(args) => grow::run(args),
        Command::Export(command) => export::run(command, context),
        Command::Pattern(args) => pattern::run(args, context),
        Command::Compare(args) if args.paper => paper::run(args, context),
        Command::Compare(args) if args.engines => engines::run(args, context),
        Command::Compare(args) => compare::run(args, context),
        Command::Diagnose(args) => diagnose::run(args, context),
        Command::Add(args) => add::run(args, context),
        Command::Ladder(args) => ladder::run(args, context),
        Command::Validate(args) => validate::run(args, context),
        Command::Breakdown(args) => breakdown::run(args, context),
        Command::Simulate(args) => simulate::run(args, context),
        Command::Sweep(args) => sweep::run(args, context),
        Command::Design(args) => design::run(args, context),
        Command::Characterize(args) => characterize::run(args, context),
        Command::Data(args) => data::run(args, context),
        Command::Challenge(command) => challenge::run(command, context),
        Command::List { what } => list::run(what.as_deref()),
        Command::New { kind } => list::new(kind),
        Command::Studio(args) => studio::run(args, context),
        Command::Tradeoff(args) => tradeoff::run(args, context),
        Command::Verify(args) => verify::run(args, context),
        Command::Bench(args) => bench::run(args, context),
        Command::Completions { shell } => Ok(completions(*shell)),
        Command::Man { out } => man(out.as_deref(), context),
    }
}

fn completions(shell: clap_complete::Shell) -> Outcome {
    let mut bytes = Vec::new();
    clap_complete::generate(shell, &mut crate::cli::command(), "ibr", &mut bytes);
    Outcome::of(String::from_utf8_lossy(&bytes).into_owned())
}

fn man(out: Option<&std::path::Path>, context: &mut Context) -> Result<Outcome> {
    let page = |command: clap::Command| {
        let mut bytes = Vec::new();
        clap_mangen::Man::new(command).render(&mut bytes).map(|()| bytes)
    };
    let failed = |e: std::io::Error| Failure::usage(format!("the manual cannot be made: {e}"), "report this");
    let Some(folder) = out else {
        let bytes = page(crate::cli::command()).map_err(failed)?;
        return Ok(Outcome::of(String::from_utf8_lossy(&bytes).into_owned()));
    };
    let mut files = ibr::pages::Files::default();
    files.files.push(("ibr.1".into(), page(crate::cli::command()).map_err(failed)?));
    for sub in crate::cli::command().get_subcommands() {
        let name = format!("ibr-{}", sub.get_name());
        files.files.push((format!("{name}.1"), page(sub.clone().name(name)).map_err(failed)?));
    }
    crate::output::write_files(folder, &files, &[], context)?;
    Ok(Outcome::of(format!("{} pages in {}\n", files.files.len(), folder.display())))
}
