//! `ibr sweep`, `ibr design`, and how many runs are shared

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ShardArgs {
    /// Compute only every N-th part, from the K-th on; shards may run anywhere that sees the folder
    #[arg(long, value_name = "K/N", conflicts_with_all = ["engine", "script"])]
    pub shard: Option<String>,
    /// Let a scheduler run the shards: submit them, watch, collect
    #[arg(long, value_name = "SCHEDULER", value_parser = ["slurm", "hq"])]
    pub engine: Option<String>,
    /// With --engine: shards of the job
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub shards: u64,
    /// With --engine: print what would be submitted
    #[arg(long, requires = "engine")]
    pub script: bool,
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
    /// Folder of the table, the pictures and of what is computed; what is there already is kept.
    /// Default: ibr-report/sweep-<study>
    #[arg(long)]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub shards: ShardArgs,
    /// Write table.parquet in place of table.csv
    #[arg(long)]
    pub parquet: bool,
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
