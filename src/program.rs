//! The command line as one call: parse, run, print, exit code. No logic here.

use crate::context::{Context, Interrupt, Outcome};
use crate::meter::Meter;
pub use crate::output::maker;
use crate::words::printable;
use crate::{cli, commands, failure};
use std::ffi::OsString;
use std::io::Write;
use std::sync::{Mutex, PoisonError};

/// Held while files are written: an interrupt then waits, so that no result is left half written. True once results
/// are written.
static WRITTEN: Mutex<bool> = Mutex::new(false);
/// For a command that saves its state before it ends.
static INTERRUPT: Interrupt = Interrupt::new();

/// Runs what was typed, the name of the program first, prints, and returns the exit code. It takes over Ctrl-C and ends the
/// process itself on `--help`, on wrong usage and on an interrupt: call it once, from a program that does nothing else.
pub fn run(typed: impl IntoIterator<Item = OsString>) -> u8 {
    if let Err(error) = on_interrupt(interrupt) {
        say(&format!("warning: an interrupt cannot be caught here: {error}\n"));
    }
    silence_parquet();
    let typed: Vec<OsString> = typed.into_iter().collect();
    let words = typed.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let cli = cli::parsed(&typed);
    let bar = Meter::new(!cli.quiet && !cli.json);
    let mut context = Context {
        typed: words,
        json: cli.json,
        threads: cli.threads as usize,
        force: cli.force,
        progress: &mut |what, share| bar.tell(what, share),
        say: &mut |text| {
            if !cli.json {
                // Who closed the pipe has read enough.
                let _ = bar.apart(|| std::io::stdout().write_all(printable(text).as_bytes()));
            }
        },
        written: &WRITTEN,
        interrupt: &INTERRUPT,
    };
    let result = commands::run(&cli.command, &mut context);
    bar.clear();
    match result {
        Ok(outcome) => finish(&outcome, cli.json),
        Err(error) => {
            say(&error.render());
            if cli.json {
                let _ = writeln!(std::io::stdout(), "{:#}", error.json());
            }
            error.code()
        }
    }
}

#[cfg(not(target_family = "wasm"))]
fn on_interrupt(call: fn()) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(call)
}

#[cfg(target_family = "wasm")]
fn on_interrupt(_: fn()) -> Result<(), std::convert::Infallible> {
    Ok(())
}

/// A panic of the library that reads Parquet files is reported as an error of the file, and not as one of this program.
fn silence_parquet() {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let name = std::thread::current().name().unwrap_or_default().to_string();
        if name != data::table::PARQUET_READER && !name.starts_with("polars") {
            loud(panic);
        }
    }));
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
fn finish(outcome: &Outcome, json: bool) -> u8 {
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
            failure::BAD_INPUT
        }
        _ => outcome.code,
    }
}

/// To standard error, which may be closed as well (`2>&1 | head`).
fn say(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}
