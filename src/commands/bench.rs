//! `ibr bench`: speed of the model, of the finite elements, and how often a diagnosis is right, compared with their targets.

use super::shards::{Work, in_shards};
use super::verify::show;
use crate::cli::BenchArgs;
use crate::prelude::*;
use challenge::Laws;
use challenge::bench::DiscoveryOptions;
use fem::session::Shard;
use verification::speed::{discovery, engine, model};

pub(super) fn run(args: &BenchArgs, context: &mut Context) -> Result<Outcome> {
    if args.what == "discovery" {
        return discovery(args, context);
    }
    let message = format!("the bench of {} keeps nothing", args.what);
    let help = "leave --out, --shard and --engine out, or write ibr bench discovery";
    refuse_if(args.out.is_some() || args.shards.asked(), message, help)?;
    let progress = &mut |what: &str, share| (context.progress)(what, share);
    let answer = match args.what.as_str() {
        "model" => model::measure(&machine(), progress),
        what => engine::measure(what == "runs", &machine(), progress),
    };
    Ok(show(answer?))
}

fn discovery(args: &BenchArgs, context: &mut Context) -> Result<Outcome> {
    let laws = if args.laws == "second" { Laws::Second } else { Laws::First };
    let options = DiscoveryOptions { seed: args.random.seed, sets: args.sets as usize, laws };
    let message = "shards need a folder that all of them see";
    let help = "add --out FOLDER";
    refuse_if(args.out.is_none() && args.shards.asked(), message, help)?;
    let (threads, program) = (context.threads, args.out.as_ref().map(|_| this_program()).transpose()?);
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let bench = discovery::DiscoveryWork::plan(options, args.out.as_deref().zip(program.as_deref()))?;
    if let Some(folder) = &args.out {
        let missing = || bench.missing(Shard::WHOLE);
        let work = Work { folder, parts: "sets", all: bench.pieces(), missing: &missing, may_fail: false };
        let told = in_shards(&args.shards, &work, context, |shard, context| {
            let made = bench.missing(shard);
            context.fem(|progress| bench.answers(shard, threads, progress))?;
            Ok((made, Vec::new()))
        })?;
        if let Some(told) = told {
            return Ok(told);
        }
    }
    let answers = context.fem(|progress| bench.answers(Shard::WHOLE, threads, progress))?;
    Ok(show(bench.findings(answers, &machine())?))
}

/// Fingerprint of this program: whoever changes a diagnosis must not be shown the answers of the one before.
fn this_program() -> Result<String> {
    let unread = |cause: std::io::Error| {
        Failure::usage(format!("this program cannot be read: {cause}"), "leave --out out, or copy the program")
    };
    let path = std::env::current_exe().map_err(unread)?;
    Ok(sha256(&std::fs::read::<&Path>(&path).map_err(unread)?))
}
