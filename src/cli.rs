//! Command line as data: one type per command, parsed by clap.

mod data;
mod discover;
mod export;
mod groups;
mod import;
mod sweep;

use clap::{Args, Parser, Subcommand};
use compare::study::Knob;
pub(crate) use data::{CharacterizeArgs, DataCommand, DataFemArgs, GenerateArgs, ScatterArgs};
pub(crate) use discover::{
    AddArgs, BreakdownArgs, ChallengeCommand, ChallengeNewArgs, DiagnoseArgs, LadderArgs, TradeoffArgs, ValidateArgs,
};
pub(crate) use export::{ExportArgs, ExportCommand, LinearArgs, RigidArgs};
pub(crate) use groups::{asked, command, parsed};
pub(crate) use import::Import;
use std::path::PathBuf;
pub(crate) use sweep::{DesignArgs, ShardArgs, SweepArgs};

/// Models of pneumatic bending actuators on inflated-beam robots, compared with measurements.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100)]
#[command(
    after_help = "A SCENARIO is a TOML file or a shipped robot: spam, cpam, epam, fpam, epam-textbook and more (ibr list robots).\n\
    A CASE is a TOML file with kind = \"fem\" or a shipped case: pillow, tube; robots run too (ibr list cases).\n\
    A DATA is a CSV or Parquet file, a folder with markers.csv and about.toml, or an embedded set (ibr list datasets).\n\
    Exit codes: 0 done, 1 a threshold was missed, 2 wrong usage, 3 bad input or output file, 4 no solution, 130 interrupted."
)]
pub(crate) struct Cli {
    /// Print one JSON object instead of text
    #[arg(long, global = true)]
    pub json: bool,
    /// No progress
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Threads; 0: one per core. Results do not depend on it
    #[arg(long, global = true, default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=1024))]
    pub threads: u64,
    /// Replace existing files; a finished run stays until the new one is complete
    #[arg(long, global = true)]
    pub force: bool,
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// The whole story on embedded data, with a report
    Demo {
        /// Folder for the report, plots and tables
        #[arg(long, default_value = "ibr-report/demo")]
        out: PathBuf,
    },
    /// Shape and markers at given pressures, or the pressure for a target tip
    Predict(PredictArgs),
    /// How far and how fast a robot grows by eversion, and whether its tail retracts it
    Grow(GrowArgs),
    /// A robot for a controller: tables as C code, or its linear form
    #[command(subcommand)]
    Export(ExportCommand),
    /// Sewing pattern of a robot, true to size: SVG, pages to print, DXF for a cutter
    Pattern(PatternArgs),
    /// Hold a model against measurements: how far off, and where
    Compare(CompareArgs),
    /// Which physical effect is missing, which fit equally well, what to measure next
    Diagnose(DiagnoseArgs),
    /// Write a new scenario with one more effect, fitted on data or given
    Add(AddArgs),
    /// Diagnose and add until only noise is left, and show the fall of the error
    Ladder(LadderArgs),
    /// Does an added effect help on data that it was not fitted to?
    Validate(ValidateArgs),
    /// Where the reduced model parts from finite elements, and which energy carries it
    Breakdown(BreakdownArgs),
    /// Run a finite element case through time: ParaView frames, energy balance, checkpoints
    Simulate(SimulateArgs),
    /// Many cases of one robot, a row each: keys that vary, in shards or on a cluster
    Sweep(SweepArgs),
    /// The robot for a target shape: sizes and pressures within your ranges, ready to cut
    Design(DesignArgs),
    /// From tensile tests of a fabric to its moduli, curves and a table for cases
    Characterize(CharacterizeArgs),
    /// Look at, list or make marker data
    #[command(subcommand)]
    Data(DataCommand),
    /// Data with a hidden effect, sealed: for teaching, for reviewers
    #[command(subcommand)]
    Challenge(ChallengeCommand),
    /// Actuators, effects, datasets and finite element cases with their formulas
    List {
        /// robots, actuators, effects, datasets or cases; all if left out
        #[arg(value_parser = ["robots", "actuators", "effects", "datasets", "cases"])]
        what: Option<String>,
    },
    /// Print a shipped scenario or finite element case as a start for your own
    New {
        /// A robot of ibr list robots, or a case of ibr list cases
        kind: String,
    },
    /// Run time against accuracy of every model present
    Tradeoff(TradeoffArgs),
    /// Hold closed forms and finite elements against known numbers
    Verify(VerifyArgs),
    /// Measure the speed on this machine, or how often a diagnosis is right
    Bench(BenchArgs),
    /// The page of web/ for the browser of this machine, with finite elements behind it
    Studio(StudioArgs),
    /// Shell completions on standard output
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
    /// Manual page on standard output, or one per command in a folder
    Man {
        /// Folder for the pages
        #[arg(long)]
        out: Option<PathBuf>,
    },
}

#[derive(Debug, Args)]
pub(crate) struct StudioArgs {
    /// Port on 127.0.0.1; 0 for a free one
    #[arg(long, default_value_t = 0)]
    pub port: u16,
}

#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// Also the finite element checks that take long, some minutes in all
    #[arg(long)]
    pub slow: bool,
    /// Only these finite element checks, by name
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Draw the checks that have curves into this folder
    #[arg(long, value_name = "FOLDER")]
    pub plots: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// model; fem; runs: fem and whole runs, pillows of the nodes of up to 80 000 triangles and the four robots, about two minutes;
    /// discovery: how often a diagnosis is right on data with hidden effects
    #[arg(value_parser = ["model", "fem", "runs", "discovery"], default_value = "model")]
    pub what: String,
    /// With discovery: sets without and with one hidden effect; the default takes seconds, 200 are the full bench
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub sets: u64,
    #[command(flatten)]
    pub random: SeedArgs,
    /// With discovery: the library of laws by which the hidden effects act; the second was written without the diagnosis in view
    #[arg(long, value_name = "WHICH", value_parser = ["first", "second"], default_value = "first")]
    pub laws: String,
    /// With discovery: folder where every answer is kept, so that an interrupted bench goes on and shards share it
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub shards: ShardArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SetArgs {
    /// Another value of a key of the robot's scenario, in `simulate` of its [fem] too: body.radius_mm=45, strip.1.azimuth_deg=120,
    /// bond=0.5; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct SeedArgs {
    /// Seed of everything random
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

#[derive(Debug, Args)]
pub(crate) struct RobotArgs {
    /// Scenario file or shipped robot
    pub scenario: String,
    /// Body pressure with unit, for example 2kPa; default: the scenario's
    #[arg(long, short, allow_hyphen_values = true)]
    pub body_pressure: Option<String>,
    #[command(flatten)]
    pub changes: SetArgs,
    /// Without the scenario's own effects; --effect adds to that
    #[arg(long)]
    pub bare: bool,
    /// Add an effect or change its values: name or name:key=value[,key=value]; repeatable
    #[arg(long, short)]
    pub effect: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct PredictArgs {
    #[command(flatten)]
    pub robot: RobotArgs,
    /// Actuator pressures with unit, for example 10kPa,20kPa, or from 0 to 30 in steps: 0:30:0.01kPa; `/` separates supply
    /// channels; or a CSV file with a line for each pose, whose first names the columns: p_kpa, or p0_kpa,p1_kpa; also
    /// p_body_kpa. With an effect that has history (friction, creep, plastic_set, leak) they are one path in this order, 5 s
    /// each, from rest
    #[arg(long, short, allow_hyphen_values = true)]
    pub pressure: Option<String>,
    /// Find the pressure instead: tip=100mm (height) or angle=60deg (total bend); or 300mm,120mm: the pressures of all supply
    /// channels that bring the tip nearest to this x, y
    #[arg(long, short, conflicts_with = "pressure")]
    pub inverse: Option<String>,
    /// How long the robot may grow before gravity and tip_load fold it, straight and at each pressure
    #[arg(long, conflicts_with_all = ["inverse", "out"])]
    pub limits: bool,
    /// Read lines of time and pressures from standard input, answer each at once with a line of the tip; the first line
    /// names the columns, for example t_s,p_kpa or t_s,p0_kpa,p1_kpa
    #[arg(long, conflicts_with_all = ["pressure", "inverse", "limits", "out"])]
    pub follow: bool,
    /// Print a row of numbers per pressure: tip and markers in mm
    #[arg(long, conflicts_with_all = ["limits", "follow", "json"])]
    pub csv: bool,
    /// Folder for a plot of the shapes
    #[arg(long)]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct GrowArgs {
    #[command(flatten)]
    pub robot: RobotArgs,
    /// Actuator pressures with unit, as for ibr predict; default: 0
    #[arg(long, short, allow_hyphen_values = true)]
    pub pressure: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct PatternArgs {
    /// Scenario file or shipped robot
    pub scenario: String,
    /// File to write: .svg, or .dxf for a cutter
    #[arg(long, default_value = "pattern.svg")]
    pub out: PathBuf,
    /// Also cut into pages of this paper, to print without scaling: a4, a3, letter or tabloid
    #[arg(long, value_parser = ["a4", "a3", "letter", "tabloid"])]
    pub page: Option<String>,
    /// Width of the welds, for example 3mm; default: the scenario's weld_width, else 3 mm
    #[arg(long, allow_hyphen_values = true)]
    pub weld: Option<String>,
    /// Fabric beyond welds and ends, and the overlap of tubes
    #[arg(long, default_value = "10mm", allow_hyphen_values = true)]
    pub allowance: String,
    /// Width that the cutter removes, for example 0.2mm: cut lines are half of it outside the edges
    #[arg(long, default_value = "0mm", allow_hyphen_values = true)]
    pub kerf: String,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// Scenario file or shipped robot, then marker data; with --engines any number of scenarios, the paper's if none
    #[arg(value_name = "SCENARIO DATA")]
    pub inputs: Vec<String>,
    /// Hold the reduced model and finite element runs against each other and against the published numbers
    #[arg(long, conflicts_with_all = ["calibrate", "effect", "sigma", "max_error"])]
    pub engines: bool,
    /// The paper's finite elements, reproduced: runs with its own modelling choices, compared with what it prints
    #[arg(long, conflicts_with_all = ["engines", "calibrate", "effect", "sigma", "max_error"])]
    pub paper: bool,
    #[command(flatten)]
    pub runs: RunsArgs,
    /// With --engines: runs of every robot, with other random imperfections each
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub seeds: u64,
    /// Actuator pressures of the runs; default: the scenario's
    #[arg(long, allow_hyphen_values = true)]
    pub pressure: Option<String>,
    /// Also fit the bending stiffness B to these data, or with =body-pressure the body's pressure, and show what that brings
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true, default_missing_value = "bending")]
    pub calibrate: Option<Knob>,
    /// Also hold the model with this effect against the data: name or name:key=value[,key=value]; repeatable, cumulative
    #[arg(long, short)]
    pub effect: Vec<String>,
    #[command(flatten)]
    pub noise: NoiseArgs,
    /// Exit with code 1 if the error beyond noise of the last model exceeds this, for example 5mm
    #[arg(long, allow_hyphen_values = true)]
    pub max_error: Option<String>,
    /// Folder for the report, plots and tables; default: ibr-report/compare-<data>, with --json: none
    #[arg(long)]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct RunsArgs {
    /// Folder of finished runs; missing ones are made there. Default: ibr-report/runs; with --paper only those that are there are
    /// read, as ibr simulate epam-paper makes them; default: the runs that come with the program
    #[arg(long)]
    pub runs: Option<PathBuf>,
    /// Only the runs that come with the program: nothing is simulated
    #[arg(long, conflicts_with = "runs")]
    pub stored: bool,
}

impl RunsArgs {
    pub(crate) fn folder(&self) -> PathBuf {
        self.runs.clone().unwrap_or_else(|| PathBuf::from("ibr-report/runs"))
    }
}

#[derive(Debug, Args)]
pub(crate) struct NoiseArgs {
    /// Camera noise of one coordinate, for data of a single run, for example 1mm; for a table of bench tests the scatter of a row
    /// without a standard deviation, for example 3%
    #[arg(long, allow_hyphen_values = true)]
    pub sigma: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct FitArgs {
    /// Further data of the same robot, each with its own protocol, loads and direct measurements (about.toml), fitted along; repeatable
    #[arg(long, value_name = "DATA")]
    pub also: Vec<String>,
    /// Predictions of another simulator for the data (marker, p_act_kpa or t_s, x_mm, y_mm) take the place of the scenario's, whose
    /// effects are then changes of them; one for the data and one for each --also
    #[arg(long, value_name = "TABLE")]
    pub base: Vec<String>,
    /// Keep the scenario's bending stiffness instead of fitting it: it was measured separately
    #[arg(long)]
    pub keep_bending: bool,
    /// An effect that cannot be here, and is left out; or pressure_slip: the pressures are right although they look wrong; repeatable
    #[arg(long, value_name = "EFFECT")]
    pub not: Vec<String>,
    #[command(flatten)]
    pub noise: NoiseArgs,
    /// Differences up to this are good enough; default: the larger of 0.15 mm and 0.5 % of the largest deflection
    #[arg(long, allow_hyphen_values = true)]
    pub tolerance: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct SimulateArgs {
    /// Case file or robot's scenario, or a shipped one: pillow, tube, spam, cpam, epam, fpam
    pub case: String,
    /// Folder of the run; default: ibr-report/simulate-<case>
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Go on with the interrupted run in the folder, or with a complete one to a later --end; the result is the same to the bit
    #[arg(long)]
    pub resume: bool,
    /// Go on from the end of the complete run in this folder, with other loads: a robot's pressures and loads begin there, the
    /// times of a case count on
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["uncertain", "seeds", "export"])]
    pub from: Option<PathBuf>,
    /// Simulated time, for example 0.15s or 150ms; default: the case's
    #[arg(long, allow_hyphen_values = true)]
    pub end: Option<String>,
    /// Real time between checkpoints; more where they would take over a fiftieth of it
    #[arg(long, default_value = "30s", allow_hyphen_values = true)]
    pub checkpoint_every: String,
    /// Write no ParaView frames
    #[arg(long)]
    pub no_frames: bool,
    /// Run nothing: write mesh, sections, loads and step for another solver (.inp), or the mesh alone (.vtu)
    #[arg(long, value_name = "FILE")]
    pub export: Option<PathBuf>,
    /// Who reads the .inp of --export; default: abaqus
    #[arg(long = "for", value_name = "SOLVER", value_parser = ["abaqus", "calculix"], requires = "export")]
    pub solver: Option<String>,
    /// Robots: actuator pressures in one ramp with a hold at each, for example 10kPa,20kPa,30kPa; `/` separates supply channels
    #[arg(long, short, allow_hyphen_values = true)]
    pub pressure: Option<String>,
    /// Robots: as many runs with other random imperfections, and their mean and spread
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub seeds: Option<u64>,
    /// Robots: element size, or body and actuator, for example 8mm/3mm; several (8mm/4mm,8mm/3mm) are several runs
    #[arg(long, value_name = "[BODY/]ACTUATOR", allow_hyphen_values = true)]
    pub mesh: Option<String>,
    #[command(flatten)]
    pub changes: SetArgs,
    #[command(flatten)]
    pub shards: ShardArgs,
    /// Robots: so many robots (30) whose assumed numbers fill their intervals as a Latin hypercube: median and 80 % interval of every
    /// marker, and which number to measure first
    #[arg(long, num_args = 0..=1, default_missing_value = "30", value_name = "ROBOTS",
          value_parser = clap::value_parser!(u64).range(5..=1000), conflicts_with = "seeds")]
    pub uncertain: Option<u64>,
    /// Robots: the run again with every numerical setting a third and three times as large and the mesh half as large: how far the
    /// tip depends on the numerics
    #[arg(long, conflicts_with_all = ["uncertain", "seeds", "from", "export"])]
    pub numerics: bool,
}
