//! One file per command; each returns what to print.

mod add;
mod bench;
mod bench_discovery;
mod bench_fem;
mod breakdown;
mod challenge;
mod characterize;
mod compare;
mod data;
mod data_fem;
mod demo;
mod diagnose;
mod diagnose_bench;
mod engines;
mod extend;
mod held;
mod inputs;
mod ladder;
mod limits;
mod list;
mod paper;
mod predict;
mod published;
mod simulate;
mod tables;
mod together;
mod tradeoff;
mod validate;
mod verify;
mod verify_fem;

use crate::cli::Command;
use crate::failure::Failure;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

/// What a command may use of the outside.
pub struct Context<'a> {
    /// JSON is wanted.
    pub json: bool,
    /// Told what is being done, and which share of the whole is done if known.
    pub progress: &'a mut (dyn FnMut(&str, Option<f64>) + Send),
    /// Held while files are written; true once they are.
    pub written: &'a Mutex<bool>,
    /// For commands that end themselves on Ctrl-C.
    pub interrupt: &'a Interrupt,
}

/// Signals within this time are one.
const ONE_REQUEST: Duration = Duration::from_secs(1);

/// How Ctrl-C reaches a command that saves where it stands before it ends.
#[derive(Debug)]
pub struct Interrupt {
    /// Runs that will end themselves.
    awaited: AtomicUsize,
    /// When it was asked first.
    asked: OnceLock<Instant>,
}

impl Interrupt {
    /// Nobody waits for it yet.
    pub const fn new() -> Interrupt {
        Interrupt { awaited: AtomicUsize::new(0), asked: OnceLock::new() }
    }

    /// One more run will end itself when asked, from now on.
    fn await_one(&self) {
        self.awaited.fetch_add(1, Ordering::SeqCst);
    }

    /// One less.
    fn let_one_go(&self) {
        self.awaited.fetch_sub(1, Ordering::SeqCst);
    }

    /// Asks the command to end; false if it will not, or was asked before. Who asks again at once asks once: `timeout` and job
    /// schedulers signal a program and its group, and a checkpoint shall still be written.
    pub fn ask(&self) -> bool {
        self.awaited.load(Ordering::SeqCst) > 0 && self.asked.get_or_init(Instant::now).elapsed() < ONE_REQUEST
    }

    /// Whether the command shall end.
    pub fn asked(&self) -> bool {
        self.asked.get().is_some()
    }
}

/// What a command has to say.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Text for standard output.
    pub text: String,
    /// The same as JSON.
    pub json: Option<serde_json::Value>,
    /// Lines for standard error.
    pub notes: Vec<String>,
    /// Exit code.
    pub code: u8,
}

impl Outcome {
    fn new(text: String, json: serde_json::Value) -> Outcome {
        Outcome { text, json: Some(json), notes: Vec::new(), code: 0 }
    }

    /// The result stands, and what failed after it is said below it.
    fn fail(&mut self, failure: &Failure) {
        self.notes.push(failure.render().trim_end().to_string());
        self.code = failure.code();
    }
}

/// Runs a command.
pub fn run(command: &Command, context: &mut Context) -> Result<Outcome, Failure> {
    match command {
        Command::Demo(out) => demo::run(&out.out, context),
        Command::Predict(args) => predict::run(args, context),
        Command::Compare(args) if args.paper => paper::run(args, context),
        Command::Compare(args) if args.engines => engines::run(args, context),
        Command::Compare(args) => compare::run(args, context),
        Command::Diagnose(args) => diagnose::run(args, context),
        Command::Add(args) => add::run(args, context),
        Command::Ladder(args) => ladder::run(args, context),
        Command::Validate(args) => validate::run(args, context),
        Command::Breakdown(args) => breakdown::run(args, context),
        Command::Simulate(args) => simulate::run(args, context),
        Command::Characterize(args) => characterize::run(args, context),
        Command::Data(args) => data::run(args, context),
        Command::Challenge(command) => challenge::run(command, context),
        Command::List { what } => list::run(what.as_deref()),
        Command::New { kind } => list::new(kind),
        Command::Tradeoff(args) => tradeoff::run(args, context),
        Command::Verify(args) => verify::run(args, context),
        Command::Bench(args) if args.what == "fem" => bench_fem::run(args.all, context),
        Command::Bench(args) if args.what == "discovery" => {
            bench_discovery::run(args.sets as usize, args.seed, context)
        }
        Command::Bench(_) => bench::run(context),
        Command::Completions { shell } => Ok(completions(*shell)),
        Command::Man { out } => man(out.as_deref(), context),
    }
}

fn completions(shell: clap_complete::Shell) -> Outcome {
    let mut bytes = Vec::new();
    clap_complete::generate(shell, &mut crate::cli::command(), "ibr", &mut bytes);
    Outcome { text: String::from_utf8_lossy(&bytes).into_owned(), ..Outcome::default() }
}

fn man(out: Option<&std::path::Path>, context: &mut Context) -> Result<Outcome, Failure> {
    let page = |command: clap::Command| {
        let mut bytes = Vec::new();
        clap_mangen::Man::new(command).render(&mut bytes).map(|()| bytes)
    };
    let failed = |e: std::io::Error| Failure::usage(format!("the manual cannot be made: {e}"), "report this");
    let Some(folder) = out else {
        let bytes = page(crate::cli::command()).map_err(failed)?;
        return Ok(Outcome { text: String::from_utf8_lossy(&bytes).into_owned(), ..Outcome::default() });
    };
    let mut files = ::compare::study::pages::Files::default();
    files.files.push(("ibr.1".into(), page(crate::cli::command()).map_err(failed)?));
    for sub in crate::cli::command().get_subcommands() {
        let name = format!("ibr-{}", sub.get_name());
        files.files.push((format!("{name}.1"), page(sub.clone().name(name)).map_err(failed)?));
    }
    crate::output::write_files(folder, &files, &[], context)?;
    Ok(Outcome { text: format!("{} pages in {}\n", files.files.len(), folder.display()), ..Outcome::default() })
}
