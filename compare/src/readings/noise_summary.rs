//! The noise model as printed: millimetres, per cent, one plain sentence.

use crate::noise::{NoiseModel, NoiseStatus};
use crate::policy;
use crate::residuals::label;
use crate::wording::channels_word;
use data::Hold;
use serde::Serialize;

/// What a reader needs to know about the noise of a dataset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoiseSummary {
    /// How well it is known.
    pub status: NoiseStatus,
    /// Runs.
    pub runs: usize,
    /// Sessions.
    pub sessions: usize,
    /// Camera noise of one coordinate \[mm\].
    pub camera_mm: Option<f64>,
    /// Run-to-run pressure scatter \[% of the pressure\].
    pub pressure_pct: Option<f64>,
    /// Run-to-run alignment scatter of one coordinate \[mm\].
    pub alignment_mm: Option<f64>,
    /// Run-to-run rotation scatter \[mrad\].
    pub rotation_mrad: Option<f64>,
    /// Root-mean-square noise of one coordinate of the mean over runs, run-level part included \[mm\].
    pub noise_of_mean_mm: Option<f64>,
    /// Whether p-values are given.
    pub p_values: bool,
    /// All of this in words.
    pub sentence: String,
    /// A caution where the scatter differs between holds.
    pub warning: Option<String>,
}

impl NoiseSummary {
    /// Convert a noise model for printing; `holds` are those of the dataset.
    pub fn of(noise: &NoiseModel, holds: &[Hold]) -> NoiseSummary {
        let mm = |m: f64| 1e3 * m;
        let [pressure, alignment, _, rotation, ..] = noise.run_sd;
        let mut summary = NoiseSummary {
            status: noise.status,
            runs: noise.runs,
            sessions: noise.sessions,
            camera_mm: noise.sigma_m.map(mm),
            pressure_pct: pressure.map(|v| 100.0 * v),
            alignment_mm: alignment.map(mm),
            rotation_mrad: rotation.map(mm),
            noise_of_mean_mm: noise.mean_square(0..noise.directions.len()).map(|v| mm(v.sqrt())),
            p_values: noise.gives_p_values(),
            sentence: String::new(),
            warning: noise.uneven_holds().map(|(loud, quiet)| {
                let part = |h: usize| {
                    format!("{:.1} mm at {} kPa", mm(noise.hold_sigma_m[h]), channels_word(&label(&holds[h])))
                };
                let (loud, quiet) = (part(loud), part(quiet));
                format!(
                    "the scatter differs between holds ({loud}, {quiet}): significance is overstated where it is large"
                )
            }),
        };
        summary.sentence = sentence(noise, &summary);
        summary
    }
}

fn sentence(noise: &NoiseModel, s: &NoiseSummary) -> String {
    let (Some(camera), Some(mean)) = (s.camera_mm, s.noise_of_mean_mm) else {
        return "noise unknown: one run only, so no significance can be given; repeat the protocol at least 3 times, or \
                give the camera noise"
            .to_string();
    };
    if noise.status == NoiseStatus::Supplied {
        return format!(
            "camera noise {camera:.1} mm as given, run-to-run scatter not measured (one run): no significance can be \
             given; noise at least {mean:.2} mm"
        );
    }
    if noise.runs_identical {
        return format!(
            "the {} runs are identical to a micrometre: copies of one run, or data without noise; significance means \
             nothing here",
            s.runs
        );
    }
    let mut text = format!("camera noise {camera:.1} mm; {}; noise of the mean {mean:.2} mm", run_to_run(s));
    if noise.runs < policy::FEWEST_RUNS {
        text += "; two runs only, so no significance is given";
    }
    text
}

fn run_to_run(s: &NoiseSummary) -> String {
    let mut parts = Vec::new();
    parts.extend(s.pressure_pct.map(|v| format!("pressure {v:.1} %")));
    parts.extend(s.alignment_mm.map(|v| format!("alignment {v:.1} mm")));
    let notable = |v: &f64| *v > 2e3 * policy::SENSOR_SD[3];
    parts.extend(s.rotation_mrad.filter(notable).map(|v| format!("rotation {v:.1} mrad")));
    match parts.is_empty() {
        true => "run-to-run scatter cannot be told from it".to_string(),
        false => format!("run-to-run {}", parts.join(", ")),
    }
}
