use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct Import {
    /// Files of a tracking program, one per run: DeepLabCut, SLEAP, Motive, Vicon Nexus, TRC, Qualisys, Tracker, Kinovea, TrackMate, ROS, Anipose, trackpy, wide or long tables
    #[arg(required_unless_present = "example")]
    pub files: Vec<PathBuf>,
    /// Folder for markers.csv, about.toml and a picture of the tracks; left out: only say what was understood
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Table of time and pressures for all runs; several: one for every file
    #[arg(long, value_name = "LOG")]
    pub pressure: Vec<PathBuf>,
    /// 3.1px/mm, 0.32mm/px, or the unit of the file's numbers: mm, cm, m; or two markers, or two places in the picture, and their
    /// distance: a:b=40mm or 10,20:300,25=90mm
    #[arg(long)]
    pub scale: Option<String>,
    /// Corners of a checkerboard in the plane of the markers, a table column,row,x,y, and the side of a square: corners.csv=25mm
    #[arg(long, value_name = "FILE=LENGTH", conflicts_with = "scale")]
    pub board: Option<String>,
    /// The robot's base: X,Y as the file counts, or a marker
    #[arg(long, value_name = "X,Y|MARKER", allow_hyphen_values = true)]
    pub base: Option<String>,
    /// Axes of the file along the robot and towards the actuator; left out: found
    #[arg(long, value_name = "ALONG,TOWARDS", allow_hyphen_values = true)]
    pub axes: Option<String>,
    /// Angle of the straight robot to its axis of the file
    #[arg(long, default_value = "0deg", allow_hyphen_values = true)]
    pub turn: String,
    /// Least likelihood of a position; left out: 0.9, for SLEAP 0.2
    #[arg(long)]
    pub likelihood: Option<f64>,
    /// Frames per second, where the file counts frames
    #[arg(long)]
    pub fps: Option<f64>,
    /// The pressure log's time minus the camera's, or find
    #[arg(long, value_name = "TIME|find", allow_hyphen_values = true)]
    pub clock_offset: Option<String>,
    /// Body pressure, where no log has it
    #[arg(long)]
    pub body_pressure: Option<String>,
    /// Pressure of the room, to subtract from readings of absolute pressure
    #[arg(long)]
    pub room: Option<String>,
    /// Unit of pressure columns that name none
    #[arg(long, value_name = "UNIT")]
    pub pressure_unit: Option<String>,
    /// Names of the columns of a pressure log that names none: t_ms,p_body_kpa,p_act_kpa
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    pub log_columns: Vec<String>,
    /// Bin a ramp by the actuator's pressure instead of finding holds, for example 2kPa
    #[arg(long)]
    pub bin: Option<String>,
    /// Shortest hold
    #[arg(long, default_value = "0.5s")]
    pub hold: String,
    /// Fewest frames of a hold
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub frames: u64,
    /// Time to leave out at the start of every hold
    #[arg(long, default_value = "0s")]
    pub settle: String,
    /// Which column holds what: t=Time,marker=Point,x=PosX,y=PosY,run=Trial,p_act=Sensor
    #[arg(long, value_delimiter = ',', value_name = "WHAT=COLUMN")]
    pub map: Vec<String>,
    /// Kind of the actuator, where the file does not say, for example epam
    #[arg(long)]
    pub actuator: Option<String>,
    /// Names of the markers in place of the file's, in their order
    #[arg(long, value_delimiter = ',')]
    pub markers: Vec<String>,
    /// Places of the markers on the undeformed body: a=90mm,b=210mm; left out: estimated at rest
    #[arg(long, value_delimiter = ',', value_name = "MARKER=LENGTH")]
    pub stations: Vec<String>,
    /// Instead, write a made-up recording of DeepLabCut and its pressure log into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["files", "out"])]
    pub example: Option<PathBuf>,
}
