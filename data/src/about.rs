//! `about.toml`: what a marker table does not say itself.
//!
//! ```toml
//! title = "ePAM, five runs"
//! provenance = "measured"            # measured | digitised | synthetic | published
//! source = "our laboratory, camera 3"
//! licence = "CC-BY-4.0"
//! actuator = "epam"                  # optional: must agree with the table
//! notes = "free text"                # optional
//! [geometry]                         # optional; body_radius_mm and body_length_mm are needed in it
//! body_radius_mm = 40
//! body_length_mm = 360
//! pouch_length_mm = 60               # optional, as pouch_width_mm, pouches, fold_mm, arm_mm
//! [markers]                          # optional
//! names = ["1", "2"]
//! s_mm = [60, 120]
//! [gravity]                          # absent: gravity does not act in the bending plane
//! direction = [0, -1]                # unit vector in the x–y plane
//! [direct]                           # optional: measured directly, so that no model of it is needed
//! pressure = true                    # p_act was read by a gauge at the actuator, not at the regulator
//! frame = true                       # positions in the base's frame: fiducials on the clamp, a checkerboard in the
//!                                    # markers' plane, their distance from the axis by caliper
//! [bending]                          # optional: bending stiffness of this robot, measured separately, at the first body pressure
//! stiffness_nm2 = 1.35
//! sd_nm2 = 0.15                      # its standard deviation
//! [measured.gravity]                 # optional: parameters of effects, each measured by a separate test (here a scale)
//! weight_n_per_m = [1.5, 0.1]        # as the scenario has them: value and standard deviation
//! [[run]]                            # optional; runs not named have no tip force
//! id = "1"
//! tip_force_n = [0, 0.3]
//! session = "monday"
//! ```

mod checks;
mod read;

use serde::{Deserialize, Serialize};

pub(crate) use read::parse_toml;
pub use read::{parse_about, read_about};

/// How numbers came to be; the layers of truth are never mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Provenance {
    /// Measured on a robot, neither printed nor generated.
    #[default]
    Measured,
    /// Read off a printed figure of a publication.
    Digitised,
    /// Made by a generator, without a robot.
    Synthetic,
    /// Printed as a number in a publication.
    Published,
}

impl Provenance {
    /// The word used in TOML, JSON and tables.
    pub fn word(self) -> &'static str {
        match self {
            Provenance::Measured => "measured",
            Provenance::Digitised => "digitised",
            Provenance::Synthetic => "synthetic",
            Provenance::Published => "published",
        }
    }

    /// The one of this word, in upper or lower case.
    ///
    /// ```
    /// use data::Provenance;
    /// assert_eq!(Provenance::of("Measured").map(Provenance::word), Some("measured"));
    /// assert_eq!(Provenance::of("guessed"), None);
    /// ```
    pub fn of(word: &str) -> Option<Provenance> {
        let all = [Provenance::Measured, Provenance::Digitised, Provenance::Synthetic, Provenance::Published];
        all.into_iter().find(|provenance| provenance.word().eq_ignore_ascii_case(word))
    }
}

/// How the bending stiffness is measured, as every part of the program asks for it.
pub const BENDING_TEST: &str = "measure the bending stiffness separately, to 10 %: hang a known force on the tip of the inflated body, \
                                actuator vented, and write it as stiffness_nm2 into [bending] of the data's about.toml";

/// Description of a dataset, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// Title of the dataset in one line.
    pub title: String,
    /// How the numbers came to be.
    pub provenance: Provenance,
    /// Who or what they come from.
    pub source: String,
    /// Licence under which the data may be passed on.
    pub licence: String,
    /// Actuator kind, lower case; `None` for a set about several kinds.
    pub actuator: Option<String>,
    /// Dimensions of the robot; `None` if not described.
    pub geometry: Option<Geometry>,
    /// Markers and their stations; empty if not described.
    pub markers: Vec<MarkerStation>,
    /// Unit vector of gravity in the x–y plane; `None` if gravity does not act in it.
    pub gravity_direction: Option<[f64; 2]>,
    /// Whether pressure and frame were measured directly in the same runs.
    pub direct: Direct,
    /// Bending stiffness of this robot at the first body pressure, measured separately, and its standard deviation \[N·m²\].
    pub bending_nm2: Option<[f64; 2]>,
    /// Parameters of effects that were measured by themselves.
    pub measured: Vec<MeasuredValue>,
    /// Runs with a tip force or a session of their own.
    pub runs: Vec<AboutRun>,
    /// Remarks of the author in free text.
    pub notes: Option<String>,
}

/// Direct measurements: nothing between set and true value is left to be explained in these data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Direct {
    /// The actuator's pressure was read by a gauge at the actuator, so the supply is in it.
    pub pressure: bool,
    /// Positions are in the frame of the base: fiducials on the clamp, a checkerboard in the plane of the markers, their
    /// distance from the axis by caliper.
    pub frame: bool,
}

/// A parameter of an effect that a separate test measured: a strip of fabric, a scale.
#[derive(Debug, Clone)]
pub struct MeasuredValue {
    /// Effect that has the parameter, as scenarios write it.
    pub effect: String,
    /// Its parameter, with the unit in its name.
    pub key: String,
    /// What was found, in that unit.
    pub value: f64,
    /// Standard deviation of the value, in the same unit.
    pub sd: f64,
    /// Where it is written, `about.toml:27`; empty for a value from elsewhere.
    pub place: String,
}

/// The same finding, wherever it is written.
impl PartialEq for MeasuredValue {
    fn eq(&self, other: &MeasuredValue) -> bool {
        (&self.effect, &self.key, self.value, self.sd) == (&other.effect, &other.key, other.value, other.sd)
    }
}

/// Dimensions of the robot in metres, as they were measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Radius of the inflated body R.
    pub body_radius_m: f64,
    /// Length of the body from clamp to tip.
    pub body_length_m: f64,
    /// Length of one pouch (of the muscle for an fPAM) along the body.
    pub pouch_length_m: Option<f64>,
    /// Width of a pouch across the body, flat.
    pub pouch_width_m: Option<f64>,
    /// Number of pouches in a row.
    pub pouches: Option<usize>,
    /// Depth of the fold of a cPAM.
    pub fold_m: Option<f64>,
    /// Arm of the actuator about the centre line.
    pub arm_m: Option<f64>,
}

/// A marker named in `about.toml`, with its station.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerStation {
    /// Label as in the `marker` column.
    pub name: String,
    /// Place on the undeformed body from its base \[m\].
    pub station_m: f64,
}

/// A run named in `about.toml`, with its force or session.
#[derive(Debug, Clone, PartialEq)]
pub struct AboutRun {
    /// Label as in the `run` column.
    pub id: String,
    /// Known force on the tip \[N\], components along x and y.
    pub tip_force_n: [f64; 2],
    /// Runs of one session share a set-up (camera, mount, regulator).
    pub session: Option<String>,
}

impl About {
    /// The marker of a label.
    pub(crate) fn marker(&self, name: &str) -> Option<&MarkerStation> {
        self.markers.iter().find(|marker| marker.name == name)
    }

    /// Known tip force of a run \[N\]; zero if `about.toml` does not name it.
    pub fn tip_force_n(&self, run: &str) -> [f64; 2] {
        self.runs.iter().find(|about| about.id == run).map_or([0.0; 2], |about| about.tip_force_n)
    }
}
