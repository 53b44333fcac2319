//! The command `ibr`: parse, run, print, exit code. No logic here.

mod cli;
mod commands;
mod context;
mod extended;
mod failure;
mod output;
mod printable;
mod studies;

use context::{Context, Interrupt, Outcome};
use printable::printable;
use std::io::Write;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

/// Held while files are written: an interrupt then waits, so that no result is left half written. True once results
/// are written.
static WRITTEN: Mutex<bool> = Mutex::new(false);
/// For a command that saves where it stands before it ends.
static INTERRUPT: Interrupt = Interrupt::new();

fn main() -> ExitCode {
    if let Err(error) = ctrlc::set_handler(interrupt) {
        say(&format!("warning: an interrupt cannot be caught here: {error}\n"));
    }
    let cli = cli::parsed();
    let bar = (!cli.quiet && !cli.json).then(progress_bar);
    let mut tell = |text: &str, share: Option<f64>| {
        if let Some(bar) = &bar {
            bar.set_message(printable(text));
            bar.set_position((1000.0 * share.unwrap_or(0.0)) as u64);
        }
    };
    let mut context = Context { json: cli.json, progress: &mut tell, written: &WRITTEN, interrupt: &INTERRUPT };
    let result = commands::run(&cli.command, &mut context);
    if let Some(bar) = &bar {
        bar.finish_and_clear();
    }
    match result {
        Ok(outcome) => finish(&outcome, cli.json),
        Err(error) => {
            say(&error.render());
            ExitCode::from(error.code())
        }
    }
}

/// Ends the program on Ctrl-C, after files that are being written. A command that wants to end itself is asked first; the
/// second Ctrl-C ends it at once.
fn interrupt() {
    if INTERRUPT.ask() {
        return;
    }
    let written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    let what = match (*written, INTERRUPT.asked()) {
        (true, _) => "the results were already complete",
        (false, true) => "--resume goes on from the last checkpoint",
        (false, false) => "nothing was written",
    };
    say(&format!("\ninterrupted; {what}\n"));
    std::process::exit(failure::INTERRUPTED.into());
}

/// Prints an outcome; a closed pipe (`| head`) is the reader's choice, not an error.
fn finish(outcome: &Outcome, json: bool) -> ExitCode {
    let text = match (&outcome.json, json) {
        (Some(value), true) => format!("{value:#}\n"),
        _ => printable(&outcome.text),
    };
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
    outcome.notes.iter().for_each(|note| say(&format!("{}\n", printable(note))));
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            say(&format!("cannot print: {error}\n"));
            ExitCode::from(failure::BAD_INPUT)
        }
        _ => ExitCode::from(outcome.code),
    }
}

/// To standard error, which may be closed as well (`2>&1 | head`).
fn say(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Appears on terminals only, after the first quarter of a second.
fn progress_bar() -> indicatif::ProgressBar {
    let bar = indicatif::ProgressBar::new(1000);
    let style = indicatif::ProgressStyle::with_template("{spinner} {elapsed} {bar:24} {msg}");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(250));
    bar
}
