//! Measurements: fabric tests and marker data.

use super::{RunsArgs, SeedArgs};
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CharacterizeArgs {
    /// CSV files of tensile tests: strain_pct,stress_mpa or displacement_mm,force_n, several specimens each
    #[arg(required_unless_present = "example")]
    pub files: Vec<String>,
    /// Direction of the pull in degrees to the warp where a file does not say: 0, 45, 90, or between (a check of the law)
    #[arg(long, allow_hyphen_values = true)]
    pub direction: Option<f64>,
    /// Width of the specimens where a file does not say, for example 20mm
    #[arg(long, allow_hyphen_values = true)]
    pub width: Option<String>,
    /// Free length between the grips where a file does not say, for example 250mm
    #[arg(long, allow_hyphen_values = true)]
    pub length: Option<String>,
    /// Thickness where a file does not say, for example 0.05mm
    #[arg(long, allow_hyphen_values = true)]
    pub thickness: Option<String>,
    /// Names of the columns in place of those in the files, for example displacement_mm,force_n
    #[arg(long, value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Strain up to which a modulus is taken along yarns, in per cent; twice that at 45 degrees
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true, value_name = "PERCENT")]
    pub modulus_to: f64,
    /// Accept moduli that no coated fabric has
    #[arg(long)]
    pub any_modulus: bool,
    /// Name of the fabric in fabric.toml
    #[arg(long, default_value = "fabric")]
    pub name: String,
    /// Folder for plots, tables and fabric.toml
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Instead, write made-up tests of a fabric with known truth into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["files", "out"])]
    pub example: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum DataCommand {
    /// Read data and describe them
    Check {
        /// Marker data
        data: String,
        /// The robot's scenario, whose model is asked whether a column of pressures is in another unit; default: the one in the folder of the data
        scenario: Option<String>,
    },
    /// Embedded datasets
    List,
    /// Make marker data from the files of a tracking program and a pressure log
    Import(Box<super::Import>),
    /// Make a synthetic dataset from a scenario
    Generate(GenerateArgs),
    /// Make marker data from finite element runs of a robot, with the scatter of a real test
    Fem(DataFemArgs),
}

#[derive(Debug, Args)]
pub(crate) struct DataFemArgs {
    /// Robot's scenario file or shipped robot: the truth of the data
    pub scenario: String,
    /// Folder for markers.csv, about.toml and truth.toml
    #[arg(long)]
    pub out: PathBuf,
    #[command(flatten)]
    pub fem: RunsArgs,
    /// Runs, each with other random imperfections
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub seeds: u64,
    /// Actuator pressures, rising
    #[arg(long, short, default_value = "5kPa,10kPa,15kPa,20kPa,25kPa,30kPa", allow_hyphen_values = true)]
    pub pressure: String,
    /// Body pressure; left out: the scenario's
    #[arg(long, allow_hyphen_values = true)]
    pub body_pressure: Option<String>,
    #[command(flatten)]
    pub scatter: ScatterArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ScatterArgs {
    /// Camera noise of one coordinate
    #[arg(long, default_value = "1mm", allow_hyphen_values = true)]
    pub sigma: String,
    /// Another scatter: pressure=2% and alignment=0.5mm of the camera from run to run; hold_pressure=2% and hold_alignment=0.5mm from
    /// hold to hold; lasting=0.5mm of a marker through a hold, as of a tracker; white: nothing from hold to hold, nothing that lasts
    #[arg(long, value_delimiter = ',', value_name = "KEY=VALUE")]
    pub scatter: Vec<String>,
    #[command(flatten)]
    pub random: SeedArgs,
}

#[derive(Debug, Args)]
pub(crate) struct GenerateArgs {
    /// Scenario file or shipped robot: the truth of the data
    pub scenario: String,
    /// Folder for markers.csv, about.toml and truth.toml
    #[arg(long)]
    pub out: PathBuf,
    /// Runs
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub runs: u64,
    /// Actuator pressures in kPa at a body pressure in kPa; a slash separates supply channels: 0/0,10/20@2
    #[arg(long, default_value = "0,10,20,30,0@2")]
    pub protocol: String,
    /// A gauge at the actuator is read along: column p_gauge_kpa
    #[arg(long)]
    pub gauge: bool,
    #[command(flatten)]
    pub scatter: ScatterArgs,
}
