//! Work shared between machines that see one folder: `--shard K/N`, or a scheduler that runs all shards.

use crate::cli::ShardArgs;
use crate::prelude::*;
use fem::FemError;
use fem::session::{RunJob, RunSettings, Shard, is_finished, problems, simulate_all};
use sweep::schedule;

pub(super) fn shard(args: &ShardArgs) -> Result<Shard> {
    let shard = args.shard.as_deref().map_or(Ok(Shard::WHOLE), Shard::parse);
    shard.map_err(|message| Failure::usage(message, "see --help"))
}

/// The submitted job: the command as it was typed, with a shard. Its files go below `folder`.
fn job(args: &ShardArgs, options: &str, folder: &Path, context: &Context) -> Result<schedule::Job> {
    let program = std::env::current_exe()
        .map_err(|cause| Failure::usage(format!("this program cannot be found: {cause}"), "run the shards by hand"))?;
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf());
    let (shards, threads) = (args.shards as usize, context.threads.max(1));
    let (words, started_in) = (without(&context.typed), std::env::current_dir().unwrap_or_default());
    Ok(schedule::Job { program, words, started_in, folder, shards, threads, options: options.to_string() })
}

/// Options with a value that the job has and its shards have not.
const OF_THE_JOB: [&str; 5] = ["--engine", "--slurm", "--hq", "--shards", "--threads"];

/// Typed words without those that a shard gets otherwise.
fn without(typed: &[String]) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = typed.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "--script" | "--json" | "--quiet" | "-q" => {}
            other => match OF_THE_JOB.iter().find_map(|option| other.strip_prefix(option)) {
                Some("") => _ = rest.next(),
                Some(value) if value.starts_with('=') => {}
                _ => words.push(word.clone()),
            },
        }
    }
    words
}

pub(super) struct Work<'w> {
    /// Folder of the job and its logs, seen by all machines.
    pub folder: &'w Path,
    pub parts: &'w str,
    pub all: usize,
    pub missing: &'w dyn Fn() -> usize,
    /// One that fails is never there, so that a job may end with some missing.
    pub may_fail: bool,
}

/// Has a scheduler run all shards, if one was asked for. `None`: the command goes on; else what it has to say.
pub(super) fn by_scheduler(args: &ShardArgs, work: &Work, context: &mut Context) -> Result<Option<Outcome>> {
    let Some((cluster, options)) = args.cluster() else {
        let help = "add --engine slurm or --engine hq";
        return if args.script {
            Err(Failure::usage("--script prints the job of a scheduler", help))
        } else {
            Ok(None)
        };
    };
    let job = job(args, options, work.folder, context)?;
    if args.script {
        return Ok(Some(Outcome::of(job.script(cluster))));
    }
    let (all, what) = (work.all.max(1) as f64, format!("{} by the scheduler", work.parts));
    let left = context.fem(|progress| {
        job.run(cluster, work.missing, &mut |left: usize| progress(&what, Some(1.0 - left as f64 / all)))
    })?;
    if left > 0 && !work.may_fail { Err(job.useless().into()) } else { Ok(None) }
}

/// `ibr.shard`: `ibr breakdown`, `ibr simulate --seeds 8` and `ibr bench discovery`, each with `--shard K/N`, while runs or sets of other
/// shards are missing
#[derive(Serialize)]
struct ShardAnswer {
    /// Runs or sets of this shard that were made now
    made: usize,
    /// Parts of all shards that are still missing
    missing: usize,
    /// Number of parts of all shards
    runs: usize,
}

/// Makes one shard, or has a scheduler run all of them. `None`: the command goes on with all of the work, and makes the missing parts;
/// else the outcome to print. `make` returns the number of parts it made, and why others stopped.
pub(super) fn in_shards(
    args: &ShardArgs,
    work: &Work,
    context: &mut Context,
    make: impl FnOnce(Shard, &mut Context) -> Result<(usize, Vec<String>)>,
) -> Result<Option<Outcome>> {
    if args.shard.is_none() {
        return by_scheduler(args, work, context);
    }
    let shard = shard(args)?;
    let (made, stopped) = make(shard, context)?;
    let (Shard { which, of }, Work { parts, all, .. }) = (shard, work);
    let missing = (work.missing)();
    if missing == 0 {
        return Ok(None);
    }
    let text = format!(
        "{made} {parts} of shard {which}/{of} were made; {missing} of all {all} are not there. \
         The command without --shard makes them and goes on\n"
    );
    let answer = ShardAnswer { made, missing, runs: *all };
    Ok(Some(Outcome { notes: stopped, ..Outcome::answer(text, "ibr.shard", &answer) }))
}

pub(super) fn shared(
    args: &ShardArgs,
    jobs: &[RunJob],
    settings: &RunSettings,
    context: &mut Context,
) -> Result<Option<Outcome>> {
    if !args.asked() {
        return Ok(None);
    }
    let help = "leave --force out, and give another --out or remove the runs to make them again";
    let message = "--force would make the runs of all shards again in every one";
    refuse_if(settings.force, message, help)?;
    let root = settings.folder.clone().unwrap_or_default();
    let all: Vec<(&RunJob, PathBuf)> = problems(jobs, &root)?;
    let work = Work {
        folder: &root,
        parts: "runs",
        all: all.len(),
        missing: &|| all.iter().filter(|(_, folder)| !is_finished(folder)).count(),
        may_fail: true,
    };
    in_shards(args, &work, context, |shard, context| {
        let own: Vec<RunJob> =
            shard.own(&all).filter(|(_, folder)| !is_finished(folder)).map(|(job, _)| (*job).clone()).collect();
        let made = context.fem(|progress| simulate_all(&own, settings, progress))?;
        let stopped: Vec<String> =
            made.runs.iter().filter_map(|run| run.as_ref().err()).map(FemError::to_string).collect();
        Ok((made.runs.len() - stopped.len(), stopped))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shard_is_told_what_was_typed_but_for_what_it_gets_otherwise() {
        let typed = "breakdown epam --pressure 5kPa --engine slurm --threads=4 --shards 3 --slurm --mem=4G --hq=x --quiet --out a";
        let typed: Vec<String> = typed.split(' ').map(String::from).collect();
        assert_eq!(without(&typed).join(" "), "breakdown epam --pressure 5kPa --out a");
    }
}
