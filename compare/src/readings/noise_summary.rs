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
    /// Whether the noise was measured from repeats, stated by the user, or is unknown.
    pub status: NoiseStatus,
    /// Number of runs that the mean is taken over.
    pub runs: usize,
    /// Number of sessions that the runs belong to.
    pub sessions: usize,
    /// Camera noise of one coordinate \[mm\].
    pub camera_mm: Option<f64>,
    /// Run-to-run pressure scatter \[% of the pressure\].
    pub pressure_pct: Option<f64>,
    /// Run-to-run alignment scatter of one coordinate \[mm\].
    pub alignment_mm: Option<f64>,
    /// Run-to-run rotation of the markers, standard deviation \[mrad\].
    pub rotation_mrad: Option<f64>,
    /// The same of single holds of a run: pressure \[%\]; like the others `None` where none is found.
    pub hold_pressure_pct: Option<f64>,
    /// Hold-to-hold scatter of the bend within a run \[% of the bend\].
    pub hold_bend_pct: Option<f64>,
    /// Hold-to-hold shift of one coordinate within a run \[mm\].
    pub hold_alignment_mm: Option<f64>,
    /// Hold-to-hold rotation of the markers within a run \[mrad\].
    pub hold_rotation_mrad: Option<f64>,
    /// Errors of a marker's coordinate that last through a hold \[mm\].
    pub lasting_mm: Option<f64>,
    /// Errors of a marker's coordinate that last through a run \[mm\].
    pub marker_mm: Option<f64>,
    /// Root-mean-square noise of one coordinate of the mean over runs, run-level part included \[mm\].
    pub noise_of_mean_mm: Option<f64>,
    /// Whether there are enough runs to form p-values.
    pub p_values: bool,
    /// The noise in words, for reports.
    pub sentence: String,
    /// A caution where the scatter differs between holds.
    pub warning: Option<String>,
}

impl NoiseSummary {
    /// Convert a noise model for printing; `holds` belong to the dataset.
    pub fn of(noise: &NoiseModel, holds: &[Hold]) -> NoiseSummary {
        let mm = |m: f64| 1e3 * m;
        let [pressure, alignment, _, rotation, ..] = noise.run_sd;
        let samples = holds.first().map_or(1, |hold| hold.t_s.len());
        let held = |kind: usize, unit: f64| noise.per_hold.is_significant[kind].then(|| unit * noise.per_hold.sd[kind]);
        let single = noise.per_hold.lasts.then(|| noise.per_hold.sample_m2.sqrt()).or(noise.sigma_m);
        let mut summary = NoiseSummary {
            status: noise.status,
            runs: noise.runs,
            sessions: noise.sessions,
            camera_mm: single.map(mm),
            pressure_pct: pressure.map(|v| 100.0 * v),
            alignment_mm: alignment.map(mm),
            rotation_mrad: rotation.map(mm),
            hold_pressure_pct: held(0, 100.0),
            hold_bend_pct: held(1, 100.0),
            hold_alignment_mm: held(2, 1e3),
            hold_rotation_mrad: held(3, 1e3),
            lasting_mm: noise.per_hold.lasting_m(samples).map(mm),
            marker_mm: held(4, 1e3),
            noise_of_mean_mm: noise.mean_square(0..noise.directions.len()).map(|v| mm(v.sqrt())),
            p_values: noise.gives_p_values(),
            sentence: String::new(),
            warning: noise.uneven_holds().map(|(loud, quiet)| {
                let [loud, quiet] = [loud, quiet].map(|h| {
                    let kpa = channels_word(&label(&holds[h]));
                    format!("{:.1} mm at {kpa} kPa", mm(noise.hold_sigma_m[h]))
                });
                let overstated = "significance is overstated where it is large";
                format!("the scatter differs between holds ({loud}, {quiet}): {overstated}")
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
    let held = hold_to_hold(s);
    let mut text = format!("camera noise {camera:.1} mm; {}{held}; noise of the mean {mean:.2} mm", run_to_run(s));
    if noise.runs < policy::FEWEST_RUNS {
        text += "; two runs only, so no significance is given";
    }
    text
}

fn hold_to_hold(s: &NoiseSummary) -> String {
    let part = |value: Option<f64>, name: &str, unit: &str| value.map(|v| format!("{name} {v:.1} {unit}"));
    let parts = [
        part(s.hold_pressure_pct, "pressure", "%"),
        part(s.hold_bend_pct, "bend", "%"),
        part(s.hold_alignment_mm, "alignment", "mm"),
        part(s.hold_rotation_mrad, "rotation", "mrad"),
    ];
    let parts = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
    let held = if parts.is_empty() { parts } else { format!("; hold-to-hold {parts}") };
    let last = |value: Option<f64>, what: &str| {
        value.map_or(String::new(), |v| format!("; marker errors of {v:.1} mm last through a {what}"))
    };
    held + &last(s.lasting_mm, "hold") + &last(s.marker_mm, "run")
}

fn run_to_run(s: &NoiseSummary) -> String {
    let mut parts = Vec::new();
    parts.extend(s.pressure_pct.map(|v| format!("pressure {v:.1} %")));
    parts.extend(s.alignment_mm.map(|v| format!("alignment {v:.1} mm")));
    let notable = |v: &f64| *v > 2e3 * policy::SENSOR_SD[3];
    parts.extend(s.rotation_mrad.filter(notable).map(|v| format!("rotation {v:.1} mrad")));
    match parts.is_empty() {
        true => "run-to-run scatter cannot be separated from it".to_string(),
        false => format!("run-to-run {}", parts.join(", ")),
    }
}
