//! `ibr bench`: speed of the model, of the finite elements, and how often a diagnosis is right, beside what is wanted.

use super::verify::show;
use super::{Context, Outcome};
use crate::cli::BenchArgs;
use crate::failure::Failure;
use crate::output::machine;
use challenge::Laws;
use verification::speed::{discovery, engine, model};

pub fn run(args: &BenchArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let progress = &mut |what: &str, share| (context.progress)(what, share);
    let laws = if args.laws == "second" { Laws::Second } else { Laws::First };
    let answer = match args.what.as_str() {
        "fem" => engine::measure(args.all, &machine(), progress),
        "discovery" => discovery::measure(args.sets as usize, args.seed, laws, &machine()),
        _ => model::measure(&machine(), progress),
    };
    Ok(show(answer?))
}
