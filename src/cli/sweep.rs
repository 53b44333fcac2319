//! `ibr sweep`, `ibr design`, and how many runs are shared

use clap::Args;
use std::path::PathBuf;
use sweep::schedule::Cluster;

#[derive(Debug, Args)]
pub(crate) struct ShardArgs {
    /// Compute only every N-th part, from the K-th on; shards may run anywhere that sees the folder
    #[arg(long, value_name = "K/N", conflicts_with_all = ["engine", "script"])]
    pub shard: Option<String>,
    /// Let slurm or hq run the shards: submit them, watch, collect. With options of sbatch or hq submit:
    /// "slurm --time=2:00:00 --mem-per-cpu=2G", "hq --time-limit 2h --resource mem=sum(2G)"
    #[arg(long, value_name = "SCHEDULER", value_parser = scheduler)]
    pub engine: Option<(Cluster, String)>,
    /// With a scheduler: shards of the job
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub shards: u64,
    /// With a scheduler: print what would be submitted
    #[arg(long)]
    pub script: bool,
}

/// A scheduler and its own options, which stand in one line of a job's script.
fn scheduler(text: &str) -> Result<(Cluster, String), String> {
    let (name, options) = text.split_once(' ').unwrap_or((text, ""));
    match name {
        _ if text.contains(['\n', '\r']) => Err("write all options in one line".into()),
        "slurm" => Ok((Cluster::Slurm, options.trim().to_string())),
        "hq" => Ok((Cluster::HyperQueue, options.trim().to_string())),
        _ => Err("write slurm or hq, and options of it behind a space".into()),
    }
}

impl ShardArgs {
    pub(crate) fn asked(&self) -> bool {
        self.shard.is_some() || self.engine.is_some()
    }
}

#[derive(Debug, Args)]
pub(crate) struct SweepArgs {
    /// Study: a TOML file of what varies (docs/sweep.md)
    pub study: PathBuf,
    /// Folder of the table, the pictures and the computed parts; parts already there are kept.
    /// Default: ibr-report/sweep-<study>
    #[arg(long)]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub shards: ShardArgs,
    /// Write table.parquet in place of table.csv
    #[arg(long)]
    pub parquet: bool,
    /// Keep a folder for every finite element run, with summary and pictures
    #[arg(long)]
    pub keep_runs: bool,
    /// Compute nothing: write the table of the parts that are there, also while others run
    #[arg(long, conflicts_with_all = ["shard", "engine", "script"])]
    pub so_far: bool,
}

#[derive(Debug, Args)]
pub(crate) struct DesignArgs {
    /// Wish: a TOML file of the target and of what may be chosen (docs/design.md)
    pub wish: PathBuf,
    /// Folder of the robot, its picture and its pattern. Default: ibr-report/design-<wish>
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Without the finite element run that checks the answer
    #[arg(long)]
    pub no_check: bool,
    /// Designs after the first, at most: while finite elements miss the wish, the model is corrected by
    /// how far it was off from them, searches again near the last design, and that one is checked
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with = "no_check")]
    #[arg(value_parser = clap::value_parser!(u64).range(0..=20))]
    pub correct: u64,
}
