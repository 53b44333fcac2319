//! `ibr verify`: the closed forms against their known numbers, then the engine against the closed forms.

use crate::cli::VerifyArgs;
use crate::prelude::*;
use verification::checks::{Choice, Figure, verify};
use verification::{Error, Findings, Printed};

pub(super) fn run(args: &VerifyArgs, context: &mut Context) -> Result<Outcome> {
    let choice = Choice { slow: args.slow, only: &args.only };
    let (answer, figures) = verify(&choice, &mut |what, share| (context.progress)(what, share))?;
    let mut outcome = show(answer);
    if let Some(folder) = &args.plots {
        let drawn = figures.iter().map(|(name, figure)| Ok((format!("{name}.png"), draw(figure)?)));
        let files = Files { files: drawn.collect::<Result<_>>()?, ..Files::default() };
        crate::output::write_files(folder, &files, &[], context)?;
        outcome.text.push_str(&format!("{} figures in {}\n", files.files.len(), folder.display()));
    }
    Ok(outcome)
}

pub(super) fn show(answer: Findings) -> Outcome {
    let part = |part: Printed| match part {
        Printed::Text(text) => text,
        Printed::Table { head, left, rows } => TextTable::finished(head, left, rows).text(),
    };
    let text = answer.parts.into_iter().map(part).collect();
    Outcome { code: if answer.missed { MISSED } else { 0 }, ..Outcome::new(text, answer.json) }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        match error {
            Error::Fem(error) => error.into(),
            Error::Unsolved(error) => error.into(),
            Error::Compare(error) => error.into(),
            Error::Kept(error) => error.into(),
            Error::NoCheck { name, known } => {
                Failure::usage(format!("check `{name}` does not exist"), format!("write one of {known}"))
            }
        }
    }
}

fn draw(figure: &Figure) -> Result<Vec<u8>> {
    let known = figure.curves.iter().filter(|c| c.exact).count();
    let paired = 2 * known == figure.curves.len();
    let mut seen = [0, 0];
    let series = figure.curves.iter().map(|curve| {
        let place = &mut seen[usize::from(curve.exact)];
        *place += 1;
        let style = if curve.exact { LineStyle::Line } else { LineStyle::Points };
        let line = LineSeries::new(&curve.label, style, curve.points.clone());
        // An engine's marks have the colour of the line that they belong to.
        if paired { line.coloured(*place - 1) } else { line }
    });
    let lines = Lines::new(&figure.title, &figure.x, &figure.y, series.collect());
    Ok(report::lines(&lines)?.png)
}
