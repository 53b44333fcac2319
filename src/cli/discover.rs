//! The commands around a missing effect: diagnose, add, ladder, validate, breakdown, challenge.

use super::{FitArgs, NoiseArgs, RunsArgs, ShardArgs};
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct DiagnoseArgs {
    /// Scenario file or shipped robot; a table of bench tests that has its own may stand alone
    #[arg(value_name = "SCENARIO")]
    pub scenario: String,
    /// Marker data, or a table of bench tests: load_deflection of a beam, force_contraction of a muscle
    pub data: Option<String>,
    /// Instead of data: which effects alone meet the one displacement that the paper printed of this robot
    #[arg(long, conflicts_with_all = ["data", "refit", "also", "base", "keep_bending", "not", "sigma", "tolerance"])]
    pub published: bool,
    /// Also fit the values of the effects that the scenario already has
    #[arg(long)]
    pub refit: bool,
    #[command(flatten)]
    pub fit: FitArgs,
    /// Folder of finite element runs of the robot, as `compare --engines` makes them; default: those that come with the
    /// program
    #[arg(long, conflicts_with = "published")]
    pub runs: Option<PathBuf>,
    /// Print every effect, pair and experiment with its numbers
    #[arg(long, conflicts_with = "published")]
    pub tables: bool,
    /// Folder for the report, plots and diagnosis.json
    #[arg(long)]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct LadderArgs {
    /// Scenario file or shipped robot; it is not changed
    pub scenario: String,
    /// Marker data
    pub data: String,
    #[command(flatten)]
    pub fit: FitArgs,
    /// Folder for the waterfall and the scenario of every step; default: ibr-report/ladder-<data>, with --json: none
    #[arg(long)]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct AddArgs {
    /// Scenario file or shipped robot; it is not changed
    pub scenario: String,
    /// NAME is fitted on the data; NAME=VALUE or NAME:key=value[,key=value] is taken as given; `best` is what the diagnosis adds,
    /// `learned` a formula that is learned where the catalogue has none
    pub effect: String,
    /// Marker data: the value is fitted on them, B with it, and the error is shown before and after
    pub data: Option<String>,
    /// New scenario; default: <scenario>-<effect>.toml. With --base also a .csv: what to add to the other simulator's predictions
    #[arg(long)]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub fit: FitArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ValidateArgs {
    /// Scenario file with the added effect, or a correction (.csv) of another simulator's predictions
    pub scenario: String,
    /// Other data: another pressure, another size of actuator, another body pressure
    #[arg(required = true)]
    pub data: Vec<String>,
    /// Effect to judge; default: those written by ibr add; repeatable
    #[arg(long, value_name = "EFFECT")]
    pub without: Vec<String>,
    /// Of a correction: the other simulator's predictions for the data; one for each
    #[arg(long, value_name = "TABLE", conflicts_with = "without")]
    pub base: Vec<String>,
    #[command(flatten)]
    pub noise: NoiseArgs,
}

#[derive(Debug, Args)]
pub(crate) struct BreakdownArgs {
    /// Scenario files or shipped robots; default: the four of the paper
    #[arg(value_name = "SCENARIO")]
    pub scenarios: Vec<String>,
    /// Folder for maps and tables
    #[arg(long, default_value = "ibr-report/breakdown")]
    pub out: PathBuf,
    #[command(flatten)]
    pub runs: RunsArgs,
    /// Actuator pressures
    #[arg(
        long,
        short,
        default_value = "5kPa,10kPa,15kPa,20kPa,25kPa,30kPa",
        conflicts_with = "stored",
        allow_hyphen_values = true
    )]
    pub pressure: String,
    /// Body pressures in addition to the scenario's own
    #[arg(long, default_value = "1kPa,4kPa", conflicts_with = "stored", allow_hyphen_values = true)]
    pub body_pressure: String,
    /// Lengths of a pouch in addition to the scenario's own, at its body pressure
    #[arg(long, default_value = "45mm,90mm", conflicts_with = "stored", allow_hyphen_values = true)]
    pub pouch: String,
    /// Element size, or body and actuator, for example 8mm/4mm; default: the scenario's
    #[arg(long, value_name = "[BODY/]ACTUATOR", allow_hyphen_values = true, conflicts_with = "stored")]
    pub mesh: Option<String>,
    /// Run every robot with a tenth of its bending stiffness and of the load of compressed sheets too: which of them carries a departure
    #[arg(long, conflicts_with = "stored")]
    pub carriers: bool,
    #[command(flatten)]
    pub shards: ShardArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum ChallengeCommand {
    /// Make data of a robot with something hidden, and seal what it is
    New(ChallengeNewArgs),
    /// Open the seal, check that nothing was changed, and score a diagnosis
    Reveal {
        /// Folder of the challenge
        folder: PathBuf,
        /// What `ibr diagnose SCENARIO DATA --json` printed
        #[arg(value_name = "JSON")]
        diagnosis: Option<PathBuf>,
    },
    /// Many blind cases with their rules, as plain files that any tool can enter
    Export {
        /// Folder for the cases, README.md, effects.csv, entry.csv and entry.py
        #[arg(long)]
        out: PathBuf,
        /// Cases
        #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=999))]
        cases: u64,
        /// Makes the same cases again; without it the hidden effects cannot be guessed
        #[arg(long)]
        seed: Option<u64>,
    },
    /// Open the seals of exported cases and score an entry
    Score {
        /// Folder of the cases
        folder: PathBuf,
        /// Table case,verdict,names
        #[arg(value_name = "ENTRY.csv")]
        entry: PathBuf,
    },
    /// Everything that can be hidden, with its law
    List,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct ChallengeNewArgs {
    /// Folder for scenario.toml, markers.csv, about.toml and seal.toml
    #[arg(long)]
    pub out: PathBuf,
    /// Makes the same challenge again; without it the hidden effect cannot be guessed
    #[arg(long)]
    pub seed: Option<u64>,
    /// What to hide: random (the default), none, or NAME[=times its typical size]; repeatable
    #[arg(long, short)]
    pub effect: Vec<String>,
    /// spam, cpam, epam or fpam; drawn if left out
    #[arg(long)]
    pub actuator: Option<String>,
    /// Runs; 3, 5 or 10 drawn if left out
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub runs: Option<u64>,
    /// Camera noise of one coordinate, for example 1mm; 0.5, 1 or 2 mm drawn if left out
    #[arg(long, allow_hyphen_values = true)]
    pub sigma: Option<String>,
    /// Actuator pressures in kPa at a body pressure in kPa; default: 0,10,20,30,0@2
    #[arg(long)]
    pub protocol: Option<String>,
    /// white: camera noise and scatter of runs alone, nothing from hold to hold, nothing that lasts
    #[arg(long, value_parser = ["white"])]
    pub scatter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct TradeoffArgs {
    /// Folder for plots and tables
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Folder of finished finite element runs; default: those that come with the program
    #[arg(long)]
    pub runs: Option<PathBuf>,
}
