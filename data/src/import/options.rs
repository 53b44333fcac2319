//! What the caller knows and a tracking file does not say.

/// How lengths of the file become metres.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Scale {
    /// In the unit that the file states.
    #[default]
    OfFile,
    /// The file counts pixels, so many per metre.
    PixelsPerMetre(f64),
    /// The numbers are lengths of so many metres.
    Unit(f64),
    /// Two markers, or two places in the file's units, are so far apart \[m\].
    Known([FilePlace; 2], f64),
    /// Corners of a checkerboard, each its column and row on the board and its place in the picture, and the side of a square \[m\].
    Board(Vec<[f64; 4]>, f64),
}

/// A place in the file's units or a marker.
#[derive(Debug, Clone, PartialEq)]
pub enum FilePlace {
    /// Coordinates x, y (and z) in the file's units.
    At(Vec<f64>),
    /// A marker, where it is before the actuator is filled.
    Marker(String),
}

/// How the clocks of pressure log and camera agree.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Offset {
    /// They are one; refused if movement and pressure change at other times.
    #[default]
    Same,
    /// The log shows its time this much after the camera's \[s\]; refused like [`Offset::Same`].
    Given(f64),
    /// Shift and rate from the times at which movement and pressure change; refused if several explain them.
    Find,
}

/// An axis of the file: 0, 1 or 2, and whether it is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FileAxis {
    /// x, y or z of the file.
    pub index: usize,
    /// It points against the file's axis.
    pub turned: bool,
}

/// Scale, frame, clocks and pressures of a recording, as far as the caller knows them.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// Pressure logs: none, one for all runs, or one for every file.
    pub pressure_logs: Vec<std::path::PathBuf>,
    /// How lengths of the file become metres.
    pub scale: Scale,
    /// Base of the robot; the file's origin if left out, which is refused for pixels.
    pub base: Option<FilePlace>,
    /// The file's axes along the robot and towards the actuator; found if left out.
    pub axes: Option<[FileAxis; 2]>,
    /// Rotation of the picture that puts the straight robot along an axis \[rad\].
    pub turn_rad: f64,
    /// Least likelihood of a position; each program has its own if left out.
    pub likelihood: Option<f64>,
    /// Frames per second, where the file counts frames.
    pub frames_per_s: Option<f64>,
    /// How the clocks of pressure log and camera agree.
    pub offset: Offset,
    /// Body pressure, where no log has it \[Pa\].
    pub body_pa: Option<f64>,
    /// Pressure of the room to take off, where a sensor reads absolute pressure \[Pa\].
    pub room_pa: Option<f64>,
    /// Pascals of the numbers of a pressure column that names no unit.
    pub pressure_unit_pa: Option<f64>,
    /// Bins the recording by actuator pressure instead of finding holds \[Pa\].
    pub bin_pa: Option<f64>,
    /// Shortest time at one pressure that counts as a hold \[s\].
    pub least_hold_s: f64,
    /// Fewest frames that a hold must have.
    pub least_frames: usize,
    /// Time to leave out at the start of every hold \[s\].
    pub settle_s: f64,
    /// Names of the columns of a pressure log that names none.
    pub log_columns: Vec<String>,
    /// Names of columns: a quantity (run, marker, t, x, y, p_act, p_body, actuator) and the column that holds it.
    pub columns: Vec<(String, String)>,
    /// Actuator kind, where the file does not say.
    pub actuator: Option<String>,
    /// Names of the markers in place of the file's, in order of first appearance.
    pub markers: Vec<String>,
    /// Stations of markers \[m\]; estimated from the robot at rest if left out.
    pub stations_m: Vec<(String, f64)>,
}

impl Default for ImportOptions {
    fn default() -> ImportOptions {
        ImportOptions {
            pressure_logs: Vec::new(),
            scale: Scale::OfFile,
            base: None,
            axes: None,
            turn_rad: 0.0,
            likelihood: None,
            frames_per_s: None,
            offset: Offset::Same,
            body_pa: None,
            room_pa: None,
            pressure_unit_pa: None,
            bin_pa: None,
            least_hold_s: 0.5,
            least_frames: 3,
            settle_s: 0.0,
            log_columns: Vec::new(),
            columns: Vec::new(),
            actuator: None,
            markers: Vec::new(),
            stations_m: Vec::new(),
        }
    }
}

impl ImportOptions {
    /// The column that the caller named for a quantity.
    pub(crate) fn column(&self, quantity: &str) -> Option<&str> {
        self.columns.iter().find(|(known, _)| known == quantity).map(|(_, column)| column.as_str())
    }

    /// The station that the caller gives a marker \[m\].
    pub(crate) fn station_m(&self, marker: &str) -> Option<f64> {
        self.stations_m.iter().find(|(known, _)| known == marker).map(|(_, s)| *s)
    }
}
