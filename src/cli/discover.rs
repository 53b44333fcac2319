//! The commands around a missing effect: diagnose, add, ladder, validate, breakdown, challenge.

use super::ShardArgs;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `ibr diagnose`
#[derive(Debug, Args)]
pub struct DiagnoseArgs {
    /// Scenario file or shipped robot; a table of bench tests that has its own may stand alone
    #[arg(value_name = "SCENARIO")]
    pub scenario: String,
    /// Marker data, or a table of bench tests: load_deflection of a beam, force_contraction of a muscle
    pub data: Option<String>,
    /// Further data of the same robot, each with its own protocol, loads and direct measurements (about.toml), fitted along;
    /// may be given several times
    #[arg(long, value_name = "DATA", conflicts_with = "published")]
    pub also: Vec<String>,
    /// Instead of data: which effects alone meet the one displacement that the paper printed of this robot
    #[arg(long, conflicts_with_all = ["data", "refit", "keep_bending", "sigma", "tolerance"])]
    pub published: bool,
    /// Also fit the values of the effects that the scenario already has
    #[arg(long)]
    pub refit: bool,
    /// Keep the scenario's bending stiffness instead of fitting it: it was measured separately
    #[arg(long)]
    pub keep_bending: bool,
    /// An effect that cannot be here, and is left out; or pressure_slip: the pressures are right although they look wrong; may be given
    /// several times
    #[arg(long, value_name = "EFFECT", conflicts_with = "published")]
    pub not: Vec<String>,
    /// Camera noise of one coordinate, for data of a single run, for example 1mm; of a table of bench tests what a row without a
    /// standard deviation scatters by, for example 3%
    #[arg(long, allow_hyphen_values = true)]
    pub sigma: Option<String>,
    /// What an answer may leave, and a misfit that is too small to matter; default: the larger of 0.15 mm and 0.5 % of the largest deflection
    #[arg(long, allow_hyphen_values = true)]
    pub tolerance: Option<String>,
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

/// `ibr ladder`
#[derive(Debug, Args)]
pub struct LadderArgs {
    /// Scenario file or shipped robot; it is not changed
    pub scenario: String,
    /// Marker data
    pub data: String,
    /// Further data of the same robot, fitted along; may be given several times
    #[arg(long, value_name = "DATA")]
    pub also: Vec<String>,
    /// Keep the scenario's bending stiffness instead of fitting it: it was measured separately
    #[arg(long)]
    pub keep_bending: bool,
    /// An effect that cannot be here, and is left out; may be given several times
    #[arg(long, value_name = "EFFECT")]
    pub not: Vec<String>,
    /// Differences up to this are good enough; default: the larger of 0.15 mm and 0.5 % of the largest deflection
    #[arg(long, allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Folder for the waterfall and the scenario of every step; default: ibr-report/ladder-<data>, with --json: none
    #[arg(long)]
    pub out: Option<PathBuf>,
}

/// `ibr add`
#[derive(Debug, Args)]
pub struct AddArgs {
    /// Scenario file or shipped robot; it is not changed
    pub scenario: String,
    /// NAME is fitted on the data; NAME=VALUE or NAME:key=value[,key=value] is taken as given; `best` is what the diagnosis adds,
    /// `learned` a formula that is learned where the catalogue has none
    pub effect: String,
    /// Marker data: the value is fitted on them, B with it, and the error is shown before and after
    pub data: Option<String>,
    /// Further data of the same robot, fitted along; may be given several times
    #[arg(long, value_name = "DATA", requires = "data")]
    pub also: Vec<String>,
    /// New scenario; default: <scenario>-<effect>.toml
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    pub force: bool,
    /// Keep the scenario's bending stiffness instead of fitting it: it was measured separately
    #[arg(long)]
    pub keep_bending: bool,
    /// An effect that cannot be here, and is left out; may be given several times
    #[arg(long, value_name = "EFFECT")]
    pub not: Vec<String>,
    /// Camera noise of one coordinate, for data of a single run, for example 1mm
    #[arg(long, allow_hyphen_values = true)]
    pub sigma: Option<String>,
}

/// `ibr validate`
#[derive(Debug, Args)]
pub struct ValidateArgs {
    /// Scenario file with the added effect
    pub scenario: String,
    /// Other data: another pressure, another size of actuator, another body pressure
    #[arg(required = true)]
    pub data: Vec<String>,
    /// Effect to judge; default: those written by ibr add; repeatable
    #[arg(long, value_name = "EFFECT")]
    pub without: Vec<String>,
    /// Camera noise of one coordinate, for data of a single run, for example 1mm
    #[arg(long, allow_hyphen_values = true)]
    pub sigma: Option<String>,
}

/// `ibr breakdown`
#[derive(Debug, Args)]
pub struct BreakdownArgs {
    /// Scenario files or shipped robots; default: the four of the paper
    #[arg(value_name = "SCENARIO")]
    pub scenarios: Vec<String>,
    /// Folder for maps and tables
    #[arg(long, default_value = "ibr-report/breakdown")]
    pub out: PathBuf,
    /// Only the runs that come with the program, one seed each: nothing is simulated
    #[arg(long, conflicts_with_all = ["runs", "pressure", "body_pressure", "pouch", "mesh"])]
    pub stored: bool,
    /// Folder of finished runs; missing ones are made there
    #[arg(long, default_value = "ibr-report/runs")]
    pub runs: PathBuf,
    /// Actuator pressures
    #[arg(long, short, default_value = "5kPa,10kPa,15kPa,20kPa,25kPa,30kPa", allow_hyphen_values = true)]
    pub pressure: String,
    /// Body pressures beside the scenario's own
    #[arg(long, default_value = "1kPa,4kPa", allow_hyphen_values = true)]
    pub body_pressure: String,
    /// Lengths of a pouch beside the scenario's own, at its body pressure
    #[arg(long, default_value = "45mm,90mm", allow_hyphen_values = true)]
    pub pouch: String,
    /// Element size, or those of body and actuator, for example 8mm/4mm; default: the scenario's
    #[arg(long, value_name = "[BODY/]ACTUATOR", allow_hyphen_values = true)]
    pub mesh: Option<String>,
    /// Run every robot with a tenth of its bending stiffness and of the load of compressed sheets too: which of them carries a departure
    #[arg(long, conflicts_with = "stored")]
    pub carriers: bool,
    /// Machines beside each other
    #[command(flatten)]
    pub shards: ShardArgs,
    /// Threads; 0: one per core
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=1024))]
    pub threads: u64,
}

/// `ibr challenge`
#[derive(Debug, Subcommand)]
pub enum ChallengeCommand {
    /// Make data of a robot with something hidden, and seal what it is
    New(ChallengeNewArgs),
    /// Open the seal, check that nothing was changed, and score a diagnosis
    Reveal {
        /// Folder of the challenge
        folder: PathBuf,
        /// What `ibr diagnose SCENARIO DATA --json` printed
        #[arg(long, value_name = "JSON")]
        diagnosis: Option<PathBuf>,
    },
    /// Everything that can be hidden, with its law
    List,
}

/// `ibr challenge new`
#[derive(Debug, Clone, Args)]
pub struct ChallengeNewArgs {
    /// Folder for scenario.toml, markers.csv, about.toml and seal.toml
    #[arg(long)]
    pub out: PathBuf,
    /// Makes the same challenge again; without it nobody can guess what is hidden
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
    /// Replace existing files
    #[arg(long)]
    pub force: bool,
}
