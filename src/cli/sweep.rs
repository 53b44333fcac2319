//! `ibr sweep`, `ibr design`, and how many runs are shared

use clap::Args;
use std::path::PathBuf;
use sweep::schedule::Cluster;

#[derive(Debug, Args)]
pub(crate) struct ShardArgs {
    /// Compute only every N-th part, from the K-th on; shards may run anywhere that sees the folder
    #[arg(long, value_name = "K/N", conflicts_with_all = ["engine", "script"])]
    pub shard: Option<String>,
    /// Let a scheduler run the shards: submit them, watch, collect
    #[arg(long, value_name = "SCHEDULER", value_parser = ["slurm", "hq"])]
    pub engine: Option<String>,
    /// Options of sbatch, for example "--time=2:00:00 --mem-per-cpu=2G --partition=long"; implies --engine slurm
    #[arg(long, value_name = "OPTIONS", value_parser = one_line, allow_hyphen_values = true, conflicts_with_all = ["hq", "shard"])]
    pub slurm: Option<String>,
    /// Options of hq submit, for example "--time-limit 2h --resource mem=sum(2G)"; implies --engine hq
    #[arg(long, value_name = "OPTIONS", value_parser = one_line, allow_hyphen_values = true, conflicts_with_all = ["slurm", "shard"])]
    pub hq: Option<String>,
    /// With a scheduler: shards of the job
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub shards: u64,
    /// With a scheduler: print what would be submitted
    #[arg(long)]
    pub script: bool,
}

/// Options that stand in one line of a job's script.
fn one_line(text: &str) -> Result<String, String> {
    match text.contains(['\n', '\r']) {
        true => Err("write all options in one line".into()),
        false => Ok(text.trim().to_string()),
    }
}

impl ShardArgs {
    pub(crate) fn asked(&self) -> bool {
        self.shard.is_some() || self.cluster().is_some()
    }

    /// The scheduler that was asked for, and its own options.
    pub(crate) fn cluster(&self) -> Option<(Cluster, &str)> {
        let named = match self.engine.as_deref() {
            Some("slurm") => Some((Cluster::Slurm, "")),
            Some(_) => Some((Cluster::HyperQueue, "")),
            None => None,
        };
        let slurm = self.slurm.as_deref().map(|options| (Cluster::Slurm, options));
        slurm.or(self.hq.as_deref().map(|options| (Cluster::HyperQueue, options))).or(named)
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
    #[arg(long, conflicts_with_all = ["shard", "engine", "slurm", "hq", "script"])]
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
