//! The missing moment as printed: units of the report, no NaN.

use serde::Serialize;
use std::f64::consts::TAU;

/// What the model's terms miss at the bends that were measured, and what the explanations predict there.
///
/// Positive: something is missing that bends the robot further; negative: something holds it back; zero: nothing is missing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MissingMoment {
    /// One per dataset: what no law of bending can mend, and what all holds share.
    pub shapes: Vec<MeasuredShape>,
    /// Missing moments: mean over the body of every hold first, then place by place, then changes within the holds.
    pub points: Vec<MomentPoint>,
    /// What the explanations predict, a branch each; empty where none was tried.
    pub curves: Vec<MomentCurve>,
    /// What the points say, in plain language.
    pub sentences: Vec<String>,
    /// Bending stiffness of the model that the points are relative to: the scenario's, or the measured one \[N·m²\].
    pub bending_nm2: f64,
}

/// Shape of the holds of a dataset, each with separate bends and no law.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredShape {
    /// Name of the dataset that was measured.
    pub dataset: String,
    /// Stations between which bends are free \[mm\].
    pub places_mm: Vec<[f64; 2]>,
    /// What no law of bending can mend, beyond noise \[mm\].
    pub floor_mm: f64,
    /// Numbers that all holds share, such as an error of alignment.
    pub shared: Vec<SharedNumber>,
}

/// A number that all holds of a dataset share.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SharedNumber {
    /// Name of the number in words.
    pub name: String,
    /// Unit of the value and its standard deviation.
    pub unit: String,
    /// Value; zero: as in the scenario.
    pub value: f64,
    /// Standard deviation of the value, in `unit`.
    pub sd: f64,
}

/// The moment that the terms of a model miss at one measured bend.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MomentPoint {
    /// Name of the dataset that was measured.
    pub dataset: String,
    /// Number of the hold, from 1.
    pub hold: usize,
    /// Body pressure of the hold \[kPa\].
    pub p_body_kpa: f64,
    /// Actuator pressure of the hold \[kPa\].
    pub p_act_kpa: f64,
    /// How the hold was reached: `load`, `hold` or `unload`.
    pub phase: &'static str,
    /// Stretch of the body \[mm\]; `None`: mean over the body.
    pub place_mm: Option<[f64; 2]>,
    /// Number of that stretch, base first.
    #[serde(skip)]
    pub(crate) place: Option<usize>,
    /// It is the change since the first samples of the hold.
    pub is_change: bool,
    /// Mean time of the samples \[s\].
    pub t_s: f64,
    /// Curvature, or its change \[1/m\].
    #[serde(skip)]
    pub(crate) kappa: f64,
    /// Bend, as the turn of the whole body at this curvature \[°\].
    pub bend_deg: f64,
    /// Standard deviation of the bend \[°\].
    pub bend_sd_deg: f64,
    /// Missing moment, positive if the robot bends further than the model \[N·m\].
    pub moment_nm: f64,
    /// Standard deviation of the missing moment \[N·m\].
    pub moment_sd_nm: f64,
    /// Correlation of the errors of bend and moment, −1 to 1: both follow from the same fitted shape.
    pub correlation: f64,
}

/// What an explanation predicts along a path of pressures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MomentCurve {
    /// Effects, `a` or `a + b`.
    pub answer: String,
    /// It is stated by the verdict, or its attempt; others fit worse.
    pub is_told: bool,
    /// Body pressure along the curve \[kPa\].
    pub p_body_kpa: f64,
    /// Whether the curve is for falling actuator pressure.
    pub is_unloading: bool,
    /// Actuator pressure \[kPa\], bend \[°\], missing moment and the half-width of its 95 % band \[N·m\].
    pub points: Vec<[f64; 4]>,
}

const ELLIPSE: usize = 48;

/// Standard deviations from which a shared number is reported, and its least value in its unit.
const TOLD: (f64, f64) = (4.0, 1.0);

impl SharedNumber {
    /// Whether it is clearly another than the scenario's.
    pub fn is_told(&self) -> bool {
        self.value.abs() > (TOLD.0 * self.sd).max(TOLD.1)
    }
}

impl MomentPoint {
    /// Points (bend \[°\], moment \[N·m\]) of the ellipse of one standard deviation of both errors together.
    pub fn error_ellipse(&self) -> Vec<[f64; 2]> {
        let across = (1.0 - self.correlation * self.correlation).max(0.0).sqrt();
        let at = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / ELLIPSE as f64).sin_cos();
            let moment = self.correlation * cos + across * sin;
            [self.bend_deg + self.bend_sd_deg * cos, self.moment_nm + self.moment_sd_nm * moment]
        };
        (0..=ELLIPSE).map(at).collect()
    }

    /// Whether it is the mean over the body of a hold.
    pub fn is_of_hold(&self) -> bool {
        self.place_mm.is_none() && !self.is_change
    }
}

impl MissingMoment {
    /// Means over the body, hold by hold.
    pub fn of_holds(&self) -> impl Iterator<Item = &MomentPoint> {
        self.points.iter().filter(|p| p.is_of_hold())
    }

    /// All points as CSV, one row each under a header with units.
    pub fn csv(&self) -> String {
        let mut out = String::from(
            "dataset,hold,p_body_kpa,p_act_kpa,phase,from_mm,to_mm,change,t_s,bend_deg,bend_sd_deg,moment_nm,moment_sd_nm\n",
        );
        for p in &self.points {
            let [from, to] =
                p.place_mm.map_or([String::new(), String::new()], |ends| ends.map(|mm| format!("{mm:.1}")));
            let start = format!("{},{},{:.4},{:.4},{}", p.dataset, p.hold, p.p_body_kpa, p.p_act_kpa, p.phase);
            let end = [p.t_s, p.bend_deg, p.bend_sd_deg, p.moment_nm, p.moment_sd_nm].map(|v| format!("{v:.5}"));
            out += &format!("{start},{from},{to},{},{}\n", p.is_change, end.join(","));
        }
        out
    }
}
