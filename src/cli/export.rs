//! `ibr export`

use super::RobotArgs;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// What a robot is written as.
#[derive(Debug, Subcommand)]
pub enum ExportCommand {
    /// Tip, markers, slope and inverse over the actuator pressure as C99 for a microcontroller, with their error bounds
    C(ExportArgs),
}

/// `ibr export c`
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// The robot
    #[command(flatten)]
    pub robot: RobotArgs,
    /// C file to write, with its header beside it; names in it begin with the file's
    #[arg(long, default_value = "robot.c")]
    pub out: PathBuf,
    /// Actuator pressures from:to, for example 0:40kPa; default: 0 to the scenario's max_pressure_kpa
    #[arg(long, short, allow_hyphen_values = true, value_name = "FROM:TO")]
    pub pressure: Option<String>,
    /// A robot with history (friction, creep): its first loading from rest, which the file then says
    #[arg(long)]
    pub loading: bool,
}
