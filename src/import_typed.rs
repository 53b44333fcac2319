//! Files of a tracking program, with options as they are typed after `ibr data import`.

use crate::cli::Import;
use crate::commands::import_options::options;
use crate::failure::Failure;
use clap::{Args, Command, FromArgMatches};
use compare::CompareError;
use data::import::{Imported, import};

/// Imports files with the options of `ibr data import`: `["run1.csv", "--scale", "3.1px/mm"]`. Nothing is written.
///
/// # Errors
/// An option that is not known or not understood; as [`import`].
pub fn import_typed(typed: &[String]) -> Result<Imported, CompareError> {
    let refused = |error| refused(&error, "see ibr data import --help");
    let command = Import::augment_args(Command::new("import").no_binary_name(true));
    let matches = command.try_get_matches_from(typed).map_err(refused)?;
    let args = Import::from_arg_matches(&matches).map_err(refused)?;
    let options = options(&args).map_err(|failure| match failure {
        Failure::Compare(error) => error,
        other => CompareError::refused(other.to_string(), "see ibr data import --help"),
    })?;
    Ok(import(&args.files, &options, &mut |_, _| ())?)
}

/// The wrong words, and the words that were probably meant.
pub(crate) fn refused(error: &clap::Error, help: &str) -> CompareError {
    let text = error.to_string();
    let (message, more) = text.trim_start_matches("error: ").split_once('\n').unwrap_or((&text, ""));
    let hint = more.lines().map(str::trim).find(|line| line.starts_with("tip")).unwrap_or(help);
    CompareError::refused(message.trim(), hint.trim_start_matches("tip: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_is_that_of_the_command() {
        let told =
            |typed: &[&str]| import_typed(&typed.iter().map(ToString::to_string).collect::<Vec<_>>()).unwrap_err();
        let slip = told(&["run1.csv", "--scal=3px/mm"]);
        assert!(slip.to_string().contains("--scal") && slip.help().unwrap().contains("--scale"), "{slip:?}");
        assert!(told(&["run1.csv", "--scale=3"]).to_string().starts_with("--scale: `3` is not understood"));
        assert!(told(&["nowhere.csv"]).to_string().contains("nowhere.csv"));
    }
}
