use super::RobotArgs;
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Subcommand)]
pub(crate) enum ExportCommand {
    /// Tip, markers, slope and inverse over the actuator pressure as C99 for a microcontroller, with their error bounds
    C(ExportArgs),
    /// Stiffness, damping and drive of a chain of joints about a working point, for simulators and linear control
    Linear(LinearArgs),
    /// The same chain as a model for MuJoCo, with the pressures as controls
    Mjcf(RigidArgs),
    /// The same chain as a robot for ROS and other simulators; stiffness and drive of a joint are in comments
    Urdf(RigidArgs),
    /// The table and the supply line as a unit for co-simulation (FMI 3.0)
    Fmu(ExportArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    pub robot: RobotArgs,
    /// File to write; default: robot.c, with its header next to it, or robot.fmu. Names in it begin with the file's
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Actuator pressures from:to, for example 0:40kPa; default: 0 to the scenario's max_pressure_kpa
    #[arg(long, short, allow_hyphen_values = true, value_name = "FROM:TO")]
    pub pressure: Option<String>,
    /// A robot with history (friction, creep): its first loading from rest, which the file then states
    #[arg(long)]
    pub loading: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RigidArgs {
    #[command(flatten)]
    pub chain: LinearArgs,
    /// File to write; default: robot.xml or robot.urdf
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Mass per length in kg/m; default: the weight of the effect gravity, else 0.1
    #[arg(long, value_name = "KG_PER_M")]
    pub mass: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct LinearArgs {
    #[command(flatten)]
    pub robot: RobotArgs,
    /// Actuator pressure of the working point, `/` separates supply channels; default: the scenario's middle one
    #[arg(long, short, allow_hyphen_values = true)]
    pub pressure: Option<String>,
    /// Joints, of equal length; default: one per actuator unit, or 5
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub joints: Option<u64>,
}
