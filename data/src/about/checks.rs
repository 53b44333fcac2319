//! What the values of an `about.toml` must be, each fault with its place.

use std::collections::BTreeMap;

use serde::Deserialize;
use spelling::Exactly;
use toml::Spanned;

use super::{AboutRun, Direct, Geometry, MarkerStation, MeasuredValue, Provenance};
use crate::cells::label;
use crate::error::{DataError, Fault, Location, Result};
use crate::policy::{LARGEST_TIP_FORCE_N, SAME_STATION, one_station};
use spelling::units::Range;

const MOST_POUCHES: usize = 10_000;

/// The text being checked, for the place of faults.
pub(super) struct CheckedText<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

impl CheckedText<'_> {
    fn fault<T>(&self, key: &str, value: &Spanned<T>, message: &str, help: &str) -> DataError {
        let span = value.span();
        let at = Some((span.start, span.end));
        let mut fault = Fault::of_text(self.file, self.text, at, format!("{key}: {message}"), help.to_string());
        let cell = self.text.get(span).map(str::to_string);
        fault.location = Location { cell, ..fault.location };
        fault.into()
    }

    pub(super) fn filled(&self, key: &str, value: &Spanned<String>) -> Result<String> {
        let text = value.get_ref().trim();
        if text.is_empty() {
            let help = "write one line: every dataset states its source";
            return Err(self.fault(key, value, "is empty", help));
        }
        Ok(text.to_string())
    }

    /// A length in mm, positive and not so small that it must be metres, in metres.
    fn length_m(&self, key: &str, value: &Spanned<f64>) -> Result<f64> {
        let length_mm = *value.get_ref();
        if !(length_mm.is_finite() && length_mm > 0.0) {
            let help = "give it in millimetres, for example 60";
            return Err(self.fault(key, value, "must be a positive length", help));
        }
        if key.starts_with("body") && length_mm < 2.0 {
            let help = "give it in millimetres: multiply by 1000";
            return Err(self.fault(key, value, "looks like metres", help));
        }
        Ok(length_mm / 1e3)
    }

    pub(super) fn geometry(&self, raw: RawGeometry) -> Result<Geometry> {
        let optional = |key: &str, value: Option<Spanned<f64>>| value.map(|v| self.length_m(key, &v)).transpose();
        Ok(Geometry {
            body_radius_m: self.length_m("body_radius_mm", &raw.body_radius_mm)?,
            body_length_m: self.length_m("body_length_mm", &raw.body_length_mm)?,
            pouch_length_m: optional("pouch_length_mm", raw.pouch_length_mm)?,
            pouch_width_m: optional("pouch_width_mm", raw.pouch_width_mm)?,
            pouches: raw.pouches.map(|count| self.pouches(&count)).transpose()?,
            fold_m: optional("fold_mm", raw.fold_mm)?,
            arm_m: optional("arm_mm", raw.arm_mm)?,
        })
    }

    fn pouches(&self, count: &Spanned<usize>) -> Result<usize> {
        match *count.get_ref() {
            found @ 1..=MOST_POUCHES => Ok(found),
            found => {
                let message = format!("must be from 1 to {MOST_POUCHES}, not {found}");
                let help = "write how many pouches are in a row, for example 6";
                Err(self.fault("pouches", count, &message, help))
            }
        }
    }

    pub(super) fn markers(&self, raw: RawMarkers) -> Result<Vec<MarkerStation>> {
        let (names, s_mm) = (raw.names.get_ref(), raw.s_mm.get_ref());
        if names.len() != s_mm.len() {
            let message = format!("has {} values, names has {}", s_mm.len(), names.len());
            let help = "give one station per marker, in the same order";
            return Err(self.fault("s_mm", &raw.s_mm, &message, help));
        }
        if let Some(twice) = (1..names.len()).find(|&i| names[..i].contains(&names[i])) {
            let message = format!("marker {} is there twice", names[twice]);
            return Err(self.fault("names", &raw.names, &message, "name every marker once"));
        }
        let farthest = s_mm.iter().copied().fold(0.0, f64::max);
        if farthest > 0.0 && farthest < 2.0 {
            let help = "give millimetres: multiply by 1000";
            return Err(self.fault("s_mm", &raw.s_mm, "looks like metres", help));
        }
        let bounds = Range::STATION;
        let stations_m = s_mm.iter().map(|s| bounds.si(bounds.name, *s)).collect::<Result<Vec<f64>, _>>();
        let stations_m = stations_m.map_err(|(message, help)| self.fault("s_mm", &raw.s_mm, &message, help))?;
        if let Some(message) = one_station(&stations_m) {
            return Err(self.fault("s_mm", &raw.s_mm, &message, SAME_STATION));
        }
        let pair = |(name, s): (&String, &f64)| MarkerStation { name: label(name).to_string(), station_m: s / 1e3 };
        Ok(names.iter().zip(s_mm).map(pair).collect())
    }

    pub(super) fn direction(&self, value: &Spanned<Exactly<2>>) -> Result<[f64; 2]> {
        let direction = **value.get_ref();
        // Written so that NaN is refused as well.
        if (direction[0].hypot(direction[1]) - 1.0).abs() <= 1e-3 {
            return Ok(direction);
        }
        let help = "write for example direction = [0, -1]; leave [gravity] out if it does not act in the x-y plane";
        Err(self.fault("direction", value, "must be a unit vector", help))
    }

    pub(super) fn bending(&self, raw: &RawBending) -> Result<[f64; 2]> {
        let (stiffness, sd) = (*raw.stiffness_nm2.get_ref(), *raw.sd_nm2.get_ref());
        if !(stiffness >= 0.0 && stiffness.is_finite()) {
            let help = "give it in N·m², for example 1.35";
            let message = "must not be negative";
            return Err(self.fault("stiffness_nm2", &raw.stiffness_nm2, message, help));
        }
        // Nothing is measured better than to a thousandth: such a number would overrule all markers.
        if !(sd >= 1e-3 * stiffness && sd > 0.0 && sd.is_finite()) {
            let help = "give its standard deviation in N·m², from repeats of the bending test";
            let message = "must be above a thousandth of the stiffness";
            return Err(self.fault("sd_nm2", &raw.sd_nm2, message, help));
        }
        Ok([stiffness, sd])
    }

    pub(super) fn measured(
        &self,
        raw: BTreeMap<String, BTreeMap<String, Spanned<Exactly<2>>>>,
    ) -> Result<Vec<MeasuredValue>> {
        let mut all = Vec::new();
        for (effect, parameters) in raw {
            for (key, pair) in parameters {
                let [value, sd] = **pair.get_ref();
                // Nothing is measured better than to a thousandth: such a number would overrule all markers.
                if !(value.is_finite() && sd.is_finite() && sd > 0.0 && sd >= 1e-3 * value.abs()) {
                    let help = "write [value, standard deviation], the latter from repeats of the test";
                    let message = "needs a finite value and a standard deviation above a thousandth of it";
                    return Err(self.fault(&key, &pair, message, help));
                }
                let line = self.text.get(..pair.span().start).map_or(0, |before| before.matches('\n').count()) + 1;
                let place = format!("{}:{line}", self.file);
                all.push(MeasuredValue { effect: effect.clone(), key, value, sd, place });
            }
        }
        Ok(all)
    }

    pub(super) fn runs(&self, raw: Vec<RawRun>) -> Result<Vec<AboutRun>> {
        let mut runs: Vec<AboutRun> = Vec::with_capacity(raw.len());
        for run in raw {
            if runs.iter().any(|known| known.id == *run.id.get_ref()) {
                let help = "describe every run once";
                return Err(self.fault("id", &run.id, "this run is there twice", help));
            }
            let tip_force_n = run.tip_force_n.as_ref().map_or([0.0; 2], |force| **force.get_ref());
            if let Some(force) =
                run.tip_force_n.as_ref().filter(|_| !tip_force_n.iter().all(|f| f.abs() <= LARGEST_TIP_FORCE_N))
            {
                let message = format!("must be two finite numbers up to {LARGEST_TIP_FORCE_N} N");
                let help = "give [fx, fy] in newton, for example [0, -0.3]";
                return Err(self.fault("tip_force_n", force, &message, help));
            }
            runs.push(AboutRun { id: label(run.id.get_ref()).to_string(), tip_force_n, session: run.session });
        }
        Ok(runs)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAbout {
    pub title: Spanned<String>,
    pub provenance: Provenance,
    pub source: Spanned<String>,
    pub licence: Spanned<String>,
    pub actuator: Option<String>,
    pub notes: Option<String>,
    pub geometry: Option<RawGeometry>,
    pub markers: Option<RawMarkers>,
    pub gravity: Option<RawGravity>,
    #[serde(default)]
    pub direct: Direct,
    pub bending: Option<RawBending>,
    #[serde(default)]
    pub measured: BTreeMap<String, BTreeMap<String, Spanned<Exactly<2>>>>,
    #[serde(default)]
    pub run: Vec<RawRun>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGeometry {
    pub body_radius_mm: Spanned<f64>,
    pub body_length_mm: Spanned<f64>,
    pub pouch_length_mm: Option<Spanned<f64>>,
    pub pouch_width_mm: Option<Spanned<f64>>,
    pub pouches: Option<Spanned<usize>>,
    pub fold_mm: Option<Spanned<f64>>,
    pub arm_mm: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMarkers {
    pub names: Spanned<Vec<String>>,
    pub s_mm: Spanned<Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGravity {
    pub direction: Spanned<Exactly<2>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBending {
    pub stiffness_nm2: Spanned<f64>,
    pub sd_nm2: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRun {
    pub id: Spanned<String>,
    pub tip_force_n: Option<Spanned<Exactly<2>>>,
    pub session: Option<String>,
}
