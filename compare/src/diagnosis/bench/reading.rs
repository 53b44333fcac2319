//! One row of a table: what was measured, how well, of which specimen, at what load.

use super::scatter::steadied;
use crate::bench::{Trial, is_free, measured, place};
use data::bench::BenchRow;

pub(super) struct BenchReading<'a> {
    pub row: &'a BenchRow,
    pub measured: f64,
    pub small: f64,
    /// Standard error of the mean and its degrees of freedom; of d where these are infinite.
    pub error: Option<[f64; 2]>,
    /// Pressure of the specimen, an actuator or a body \[Pa\].
    pub pressure_pa: f64,
    /// Size and number of the specimen.
    pub specimen: String,
    /// Load over collapse load, or contraction.
    pub drive: f64,
    pub at: String,
}

impl<'a> BenchReading<'a> {
    /// Error d = asinh(model/small) − asinh(measured/small).
    pub(super) fn off(&self, model: f64) -> f64 {
        (model / self.small).asinh() - (self.measured / self.small).asinh()
    }

    pub(super) fn noise(&self) -> Option<f64> {
        let [error, dof] = self.error?;
        Some(if dof.is_finite() { error / self.measured.hypot(self.small) } else { error })
    }

    pub(super) fn new(row: &'a BenchRow, trial: &Trial, small: f64, sigma: Option<f64>) -> BenchReading<'a> {
        let beam = row.get("load").is_some();
        let sized = trial.specimen(row).unwrap_or_else(|_| trial.scenario.clone());
        let sd = row.get(if beam { "deflection_sd" } else { "force_sd" }).filter(|_| !is_free(row));
        let told = sd.zip(row.get("n")).map(|(sd, n)| [sd / n.sqrt(), n - 1.0]);
        let collapse_n = std::f64::consts::PI * sized.p_body_pa * sized.radius_m.powi(3) / sized.length_m;
        let size = |key| row.get(key).map_or(String::new(), |v| format!("{:.0} mm ", 1e3 * v));
        let number = row.get("muscle").map_or(String::new(), |n| format!("muscle {n} "));
        let words = if beam { size("radius") } else { format!("{number}{}{}", size("diameter"), size("length")) };
        BenchReading {
            measured: measured(row),
            small,
            error: told.or(sigma.map(|s| [s, f64::INFINITY])),
            pressure_pa: row.get("p_body").or(row.get("p_act")).unwrap_or(0.0),
            specimen: words.trim_end().to_string(),
            drive: if beam { row.value("load") / collapse_n } else { row.value("contraction") },
            at: place(row, &sized),
            row,
        }
    }
}

/// Standard errors of rows of one kind, each steadied by the others.
pub(super) fn steady<'r, 'a: 'r>(readings: impl Iterator<Item = &'r mut BenchReading<'a>>) {
    let mut told: Vec<&mut BenchReading> =
        readings.filter(|r| r.error.is_some_and(|[_, dof]| dof.is_finite())).collect();
    let rows: Vec<[f64; 3]> = told
        .iter()
        .filter_map(|r| r.error.map(|[error, dof]| [error * (dof + 1.0).sqrt(), dof, r.measured.hypot(r.small)]))
        .collect();
    for ((r, [sd, dof]), [_, own, _]) in told.iter_mut().zip(steadied(&rows)).zip(&rows) {
        r.error = Some([sd / (own + 1.0).sqrt(), dof]);
    }
}
