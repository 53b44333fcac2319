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
//! [direct]                           # optional: what an instrument of its own measured, so that no model of it is needed
//! pressure = true                    # p_act is that of a gauge at the actuator, not the regulator's
//! frame = true                       # positions in the base's frame: fiducials on the clamp, a checkerboard in the
//!                                    # markers' plane, their distance from the axis by caliper
//! [bending]                          # optional: bending stiffness of this robot, measured by itself, at the first body pressure
//! stiffness_nm2 = 1.35
//! sd_nm2 = 0.15                      # its standard deviation
//! [measured.gravity]                 # optional: parameters of effects, each measured by a test of its own (here a scale)
//! weight_n_per_m = [1.5, 0.1]        # as the scenario has them: value and standard deviation
//! [[run]]                            # optional; runs not named have no tip force
//! id = "1"
//! tip_force_n = [0, 0.3]
//! session = "monday"
//! ```

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::error::{DataError, Fault, Location};

/// How numbers came to be; the layers of truth are never mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Provenance {
    /// Measured on a robot.
    Measured,
    /// Read off a printed figure.
    Digitised,
    /// Made by a generator.
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
}

/// Description of a dataset, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// One line.
    pub title: String,
    /// How the numbers came to be.
    pub provenance: Provenance,
    /// Who or what they come from.
    pub source: String,
    /// Terms of use.
    pub licence: String,
    /// Actuator kind, lower case; `None` for a set about several kinds.
    pub actuator: Option<String>,
    /// Dimensions of the robot.
    pub geometry: Option<Geometry>,
    /// Markers and their stations; empty if not described.
    pub markers: Vec<MarkerStation>,
    /// Unit vector of gravity in the x–y plane; `None` if gravity does not act in it.
    pub gravity_direction: Option<[f64; 2]>,
    /// What was measured directly.
    pub direct: Direct,
    /// Bending stiffness of this robot at the first body pressure, measured by itself, and its standard deviation \[N·m²\].
    pub bending_nm2: Option<[f64; 2]>,
    /// Parameters of effects that were measured by themselves.
    pub measured: Vec<MeasuredValue>,
    /// Runs with a tip force or a session of their own.
    pub runs: Vec<AboutRun>,
    /// Free text.
    pub notes: Option<String>,
}

/// What an instrument of its own measured: nothing between set and true value is left to be explained in these data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Direct {
    /// The actuator's pressure is that of a gauge at the actuator: whatever the supply does is in it.
    pub pressure: bool,
    /// Positions are in the frame of the base: fiducials on the clamp, a checkerboard in the plane of the markers, their
    /// distance from the axis by caliper.
    pub frame: bool,
}

/// A parameter of an effect that a test of its own measured: a strip of fabric, a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredValue {
    /// Effect, as in scenarios.
    pub effect: String,
    /// Its parameter, with the unit in its name.
    pub key: String,
    /// What was found, in that unit.
    pub value: f64,
    /// Its standard deviation.
    pub sd: f64,
}

/// Dimensions of the robot \[m\].
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

/// A marker named in `about.toml`.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerStation {
    /// Label as in the `marker` column.
    pub name: String,
    /// Place on the undeformed body from its base \[m\].
    pub station_m: f64,
}

/// A run named in `about.toml`.
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
    /// Known tip force of a run \[N\]; zero if `about.toml` does not name it.
    pub fn tip_force_n(&self, run: &str) -> [f64; 2] {
        self.runs.iter().find(|about| about.id == run).map_or([0.0; 2], |about| about.tip_force_n)
    }
}

/// Reads an `about.toml`.
///
/// # Errors
/// File not readable; unknown key, wrong type, missing key; a length not positive; a direction that is no unit vector.
pub fn read_about(path: &Path) -> Result<About, DataError> {
    let shown = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|cause| {
        let help = "check the path; the file must be UTF-8 text";
        DataError::File(Box::new(Fault::of_file(&shown, format!("cannot read the file: {cause}"), help)))
    })?;
    parse_about(&shown, &text)
}

/// Reads the text of an `about.toml`; `file` names it in errors.
///
/// # Errors
/// As [`read_about`].
pub fn parse_about(file: &str, text: &str) -> Result<About, DataError> {
    let raw: RawAbout = parse_toml(file, text)?;
    let check = Check { file, text };
    let geometry = raw.geometry.map(|geometry| check.geometry(geometry)).transpose()?;
    Ok(About {
        markers: raw.markers.map_or(Ok(Vec::new()), |markers| check.markers(markers))?,
        gravity_direction: raw.gravity.map(|gravity| check.direction(&gravity.direction)).transpose()?,
        direct: raw.direct,
        bending_nm2: raw.bending.map(|bending| check.bending(&bending)).transpose()?,
        measured: check.measured(raw.measured)?,
        runs: check.runs(raw.run)?,
        title: check.filled("title", &raw.title)?,
        source: check.filled("source", &raw.source)?,
        licence: check.filled("licence", &raw.licence)?,
        provenance: raw.provenance,
        actuator: raw.actuator.map(|kind| kind.trim().to_lowercase()),
        geometry,
        notes: raw.notes,
    })
}

/// Parses TOML into a struct with the place of every fault.
pub(crate) fn parse_toml<T: serde::de::DeserializeOwned>(file: &str, text: &str) -> Result<T, DataError> {
    toml::from_str(text).map_err(|cause| {
        let span = cause.span().map(|span| (span.start, span.end));
        let message = cause.message().trim().replace('\n', "; ");
        let help = "the keys and an example are in the documentation of `data::about`".to_string();
        DataError::About(Box::new(Fault::of_text(file, text, span, message, help)))
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawAbout {
    title: Spanned<String>,
    provenance: Provenance,
    source: Spanned<String>,
    licence: Spanned<String>,
    actuator: Option<String>,
    notes: Option<String>,
    geometry: Option<RawGeometry>,
    markers: Option<RawMarkers>,
    gravity: Option<RawGravity>,
    #[serde(default)]
    direct: Direct,
    bending: Option<RawBending>,
    #[serde(default)]
    measured: BTreeMap<String, BTreeMap<String, Spanned<[f64; 2]>>>,
    #[serde(default)]
    run: Vec<RawRun>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGeometry {
    body_radius_mm: Spanned<f64>,
    body_length_mm: Spanned<f64>,
    pouch_length_mm: Option<Spanned<f64>>,
    pouch_width_mm: Option<Spanned<f64>>,
    pouches: Option<usize>,
    fold_mm: Option<Spanned<f64>>,
    arm_mm: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMarkers {
    names: Spanned<Vec<String>>,
    s_mm: Spanned<Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGravity {
    direction: Spanned<[f64; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBending {
    stiffness_nm2: Spanned<f64>,
    sd_nm2: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawRun {
    id: Spanned<String>,
    tip_force_n: Option<Spanned<[f64; 2]>>,
    session: Option<String>,
}

/// The text being checked, for the place of faults.
struct Check<'a> {
    file: &'a str,
    text: &'a str,
}

impl Check<'_> {
    fn fault<T>(&self, key: &str, value: &Spanned<T>, message: &str, help: &str) -> DataError {
        let span = value.span();
        let at = Some((span.start, span.end));
        let mut fault = Fault::of_text(self.file, self.text, at, format!("{key}: {message}"), help.to_string());
        let cell = self.text.get(span).map(str::to_string);
        fault.location = Location { cell, ..fault.location };
        DataError::About(Box::new(fault))
    }

    fn filled(&self, key: &str, value: &Spanned<String>) -> Result<String, DataError> {
        let text = value.get_ref().trim();
        if text.is_empty() {
            return Err(self.fault(key, value, "is empty", "write one line; every dataset says where it comes from"));
        }
        Ok(text.to_string())
    }

    /// A length in mm, positive and not so small that it must be metres, in metres.
    fn length_m(&self, key: &str, value: &Spanned<f64>) -> Result<f64, DataError> {
        let length_mm = *value.get_ref();
        if !(length_mm.is_finite() && length_mm > 0.0) {
            return Err(self.fault(key, value, "must be a positive length", "give it in millimetres, for example 60"));
        }
        if key.starts_with("body") && length_mm < 2.0 {
            return Err(self.fault(key, value, "looks like metres", "give it in millimetres: multiply by 1000"));
        }
        Ok(length_mm / 1e3)
    }

    fn geometry(&self, raw: RawGeometry) -> Result<Geometry, DataError> {
        let optional = |key: &str, value: Option<Spanned<f64>>| value.map(|v| self.length_m(key, &v)).transpose();
        Ok(Geometry {
            body_radius_m: self.length_m("body_radius_mm", &raw.body_radius_mm)?,
            body_length_m: self.length_m("body_length_mm", &raw.body_length_mm)?,
            pouch_length_m: optional("pouch_length_mm", raw.pouch_length_mm)?,
            pouch_width_m: optional("pouch_width_mm", raw.pouch_width_mm)?,
            pouches: raw.pouches,
            fold_m: optional("fold_mm", raw.fold_mm)?,
            arm_m: optional("arm_mm", raw.arm_mm)?,
        })
    }

    fn markers(&self, raw: RawMarkers) -> Result<Vec<MarkerStation>, DataError> {
        let (names, s_mm) = (raw.names.get_ref(), raw.s_mm.get_ref());
        if names.len() != s_mm.len() {
            let message = format!("has {} values, names has {}", s_mm.len(), names.len());
            return Err(self.fault("s_mm", &raw.s_mm, &message, "give one station per marker, in the same order"));
        }
        if let Some(twice) = (1..names.len()).find(|&i| names[..i].contains(&names[i])) {
            let message = format!("marker {} is there twice", names[twice]);
            return Err(self.fault("names", &raw.names, &message, "name every marker once"));
        }
        if s_mm.iter().any(|s| !s.is_finite() || *s < 0.0) {
            return Err(self.fault(
                "s_mm",
                &raw.s_mm,
                "holds a value below zero",
                "stations count from the base in mm",
            ));
        }
        let farthest = s_mm.iter().copied().fold(0.0, f64::max);
        if farthest > 0.0 && farthest < 2.0 {
            return Err(self.fault("s_mm", &raw.s_mm, "looks like metres", "give millimetres: multiply by 1000"));
        }
        let pair = |(name, s): (&String, &f64)| MarkerStation { name: name.clone(), station_m: s / 1e3 };
        Ok(names.iter().zip(s_mm).map(pair).collect())
    }

    fn direction(&self, value: &Spanned<[f64; 2]>) -> Result<[f64; 2], DataError> {
        let direction = *value.get_ref();
        // Written so that NaN is refused as well.
        if (direction[0].hypot(direction[1]) - 1.0).abs() <= 1e-3 {
            return Ok(direction);
        }
        let help = "write for example direction = [0, -1]; leave [gravity] out if it does not act in the x-y plane";
        Err(self.fault("direction", value, "must be a unit vector", help))
    }

    fn bending(&self, raw: &RawBending) -> Result<[f64; 2], DataError> {
        let (stiffness, sd) = (*raw.stiffness_nm2.get_ref(), *raw.sd_nm2.get_ref());
        if !(stiffness >= 0.0 && stiffness.is_finite()) {
            let help = "give it in N·m², for example 1.35";
            return Err(self.fault("stiffness_nm2", &raw.stiffness_nm2, "must not be negative", help));
        }
        // Nothing is measured better than to a thousandth: such a number would overrule all markers.
        if !(sd >= 1e-3 * stiffness && sd > 0.0 && sd.is_finite()) {
            let help = "give its standard deviation in N·m², from repeats of the bending test";
            return Err(self.fault("sd_nm2", &raw.sd_nm2, "must be above a thousandth of the stiffness", help));
        }
        Ok([stiffness, sd])
    }

    fn measured(
        &self,
        raw: BTreeMap<String, BTreeMap<String, Spanned<[f64; 2]>>>,
    ) -> Result<Vec<MeasuredValue>, DataError> {
        let mut all = Vec::new();
        for (effect, parameters) in raw {
            for (key, pair) in parameters {
                let [value, sd] = *pair.get_ref();
                // Nothing is measured better than to a thousandth: such a number would overrule all markers.
                if !(value.is_finite() && sd.is_finite() && sd > 0.0 && sd >= 1e-3 * value.abs()) {
                    let help = "write [value, standard deviation], the latter from repeats of the test";
                    let message = "needs a finite value and a standard deviation above a thousandth of it";
                    return Err(self.fault(&key, &pair, message, help));
                }
                all.push(MeasuredValue { effect: effect.clone(), key, value, sd });
            }
        }
        Ok(all)
    }

    fn runs(&self, raw: Vec<RawRun>) -> Result<Vec<AboutRun>, DataError> {
        let mut runs: Vec<AboutRun> = Vec::with_capacity(raw.len());
        for run in raw {
            if runs.iter().any(|known| known.id == *run.id.get_ref()) {
                return Err(self.fault("id", &run.id, "this run is there twice", "describe every run once"));
            }
            let tip_force_n = run.tip_force_n.as_ref().map_or([0.0; 2], |force| *force.get_ref());
            if let Some(force) = run.tip_force_n.as_ref().filter(|_| !tip_force_n.iter().all(|f| f.is_finite())) {
                return Err(self.fault("tip_force_n", force, "must be two finite numbers", "give [fx, fy] in newton"));
            }
            runs.push(AboutRun { id: run.id.into_inner(), tip_force_n, session: run.session });
        }
        Ok(runs)
    }
}
