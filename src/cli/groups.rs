//! `ibr --help`: the commands by what they are for.

use super::Cli;
use crate::failure::Failure;
use clap::{CommandFactory, FromArgMatches};
use std::ffi::OsString;
use std::io::Write;

/// Every command once, in the order of a session.
const GROUPS: &[(&str, &[&str])] = &[
    ("Start here", &["demo", "new", "list", "studio"]),
    ("Predict", &["predict", "grow", "export", "simulate", "sweep", "design", "pattern"]),
    ("Measurements", &["data", "characterize"]),
    ("Which effect is missing?", &["compare", "diagnose", "add", "validate", "ladder"]),
    ("Both engines", &["breakdown", "tradeoff"]),
    ("Trust it?", &["verify", "bench", "challenge"]),
    ("For your shell", &["completions", "man", "help"]),
];

pub(crate) fn command() -> clap::Command {
    let mut command = Cli::command();
    command.build();
    let line = |name: &&str| {
        let found = command.find_subcommand(name);
        format!("  {name:<14}{}\n", found.and_then(|c| c.get_about()).map(ToString::to_string).unwrap_or_default())
    };
    let group = |(title, names): &(&str, &[&str])| format!("{title}\n{}", names.iter().map(line).collect::<String>());
    let groups = GROUPS.iter().map(group).collect::<Vec<_>>().join("\n");
    let template =
        format!("{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}\nOptions:\n{{options}}{{after-help}}");
    Cli::command().help_template(template)
}

/// What was typed, the name of the program first; ends the program with help or an error.
pub(crate) fn parsed(typed: &[OsString]) -> Cli {
    let matches = command().try_get_matches_from(typed);
    matches.and_then(|matches| Cli::from_arg_matches(&matches)).unwrap_or_else(|error| {
        if error.use_stderr() && typed.iter().any(|word| word == "--json") {
            let text = error.to_string();
            let (message, help) = text.split_once("\n\n").unwrap_or((&text, ""));
            let failure = Failure::usage(message.trim_start_matches("error: "), help.trim());
            let _ = writeln!(std::io::stdout(), "{:#}", failure.json());
        }
        error.exit()
    })
}

/// The same without the name of the program; a wrong word is an error.
pub(crate) fn asked(typed: &[String]) -> Result<Cli, clap::Error> {
    let matches = command().no_binary_name(true).try_get_matches_from(typed)?;
    Cli::from_arg_matches(&matches)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_in_one_group_and_every_line_fits() {
        let mut command = Cli::command();
        command.build();
        let mut there: Vec<&str> = command.get_subcommands().map(|c| c.get_name()).collect();
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|g| g.1.iter().copied()).collect();
        there.sort_unstable();
        grouped.sort_unstable();
        assert_eq!(there, grouped);
        let help = super::command().render_help().to_string();
        let wide: Vec<&str> = help.lines().filter(|line| line.chars().count() > 100).collect();
        assert!(wide.is_empty() && help.contains("\nWhich effect is missing?\n  compare"), "{wide:?}\n{help}");
    }
}
