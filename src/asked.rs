//! A command asked by a caller in the same process, such as the Python package: its text and its JSON instead of prints.

use crate::cli::asked;
use crate::commands;
use crate::context::{Context, Interrupt};
use crate::failure::Failure;
use crate::import_typed::refused;
use compare::CompareError;
use fem::session::Progress;
use std::sync::Mutex;

/// Answer of a command.
#[derive(Debug, Default)]
pub struct CommandAnswer {
    /// For readers.
    pub text: String,
    /// For programs; null of a command that has none.
    pub json: serde_json::Value,
    /// Cautions.
    pub warnings: Vec<String>,
}

/// Runs the words after the name of the program, `["pattern", "epam", "--out", "pattern.svg"]`. It prints nothing, leaves Ctrl-C
/// alone and never ends the process. `progress` may end finite element runs.
///
/// ```
/// let typed = ["list", "actuators"].map(String::from);
/// let found = ibr::ask(&typed, &mut |_, _| std::ops::ControlFlow::Continue(()))?;
/// assert_eq!(found.json["schema"], "ibr.list");
/// assert!(ibr::ask(&["lits".to_string()], &mut |_, _| std::ops::ControlFlow::Continue(())).is_err());
/// # Ok::<(), ibr::Error>(())
/// ```
///
/// # Errors
/// A command or an option that is not known; the errors of the command.
pub fn ask(typed: &[String], progress: Progress) -> Result<CommandAnswer, CompareError> {
    let cli = asked(typed).map_err(|error| refused(&error, "see ibr --help"))?;
    let (written, interrupt) = (Mutex::new(false), Interrupt::new());
    let mut context = Context {
        typed: typed.to_vec(),
        json: true,
        threads: cli.threads as usize,
        force: cli.force,
        progress: &mut |what, share| {
            if progress(what, share).is_break() {
                interrupt.ask();
            }
        },
        say: &mut |_| (),
        written: &written,
        interrupt: &interrupt,
    };
    let outcome = commands::run(&cli.command, &mut context).map_err(|failure| match failure {
        Failure::Compare(error) => error,
        Failure::Fem(error) => error.into(),
        other => CompareError::refused(other.to_string(), other.help().unwrap_or_default()),
    })?;
    let warnings = outcome.notes.iter().filter_map(|note| note.strip_prefix("warning: ")).map(String::from).collect();
    Ok(CommandAnswer { text: outcome.text, json: outcome.json.unwrap_or_default(), warnings })
}
