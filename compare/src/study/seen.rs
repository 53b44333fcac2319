//! Marker data from finite element runs: what a camera would see of them, with the scatter of a real test.
//!
//! Every run of the data is one finite element run with its own imperfections. Markers stick on the wall at the height of the
//! axis, on the side that faces the camera. Between the pressures at which a run was read, and up to a tenth past the highest,
//! they lie on straight lines over pressure:
//!
//! ```text
//! r(P) = r_k + (r_{k+1} − r_k) (P − P_k)/(P_{k+1} − P_k)       P = set pressure · (1 + ε), one ε per run
//! ```
//!
//! The scatter is what [`generate`](super::generate()) adds to a reduced model: pressure error, shift and roll of the
//! camera per run, camera noise per sample. Seeded: the same call gives the same bytes. **Validity**: first loading only.

use super::engines::EngineRun;
use super::eye::SimulatedCamera;
use super::generate::{Generator, holds};
use crate::error::CompareError;
use crate::policy;
use data::{Dataset, Marker};

/// Makes a dataset from runs of one robot, one run of the dataset for each; the generator's number of runs is not used.
///
/// # Errors
/// No runs, runs without markers or of different robots, a pressure they do not reach.
///
/// ```
/// use compare::study::{Generator, engines::{ensemble, stored}, published::textbook_scenario, seen::seen};
/// let scenario = textbook_scenario("epam")?;
/// let runs = ensemble(&stored()?, &scenario);
/// let data = seen(&runs.runs, "mine", &Generator::default())?;
/// assert_eq!(data.runs.len(), runs.runs.len());
/// # Ok::<(), compare::CompareError>(())
/// ```
pub fn seen(runs: &[EngineRun], name: &str, generator: &Generator) -> Result<Dataset, CompareError> {
    let refuse = |problem: String| CompareError::NotSimulated { problem };
    let first = runs.first().ok_or_else(|| refuse("no finite element run was given".into()))?;
    if first.stations_mm.is_empty() {
        return Err(refuse("the finite element runs kept no markers".into()));
    }
    if runs.iter().any(|run| run.actuator != first.actuator || run.stations_mm != first.stations_mm) {
        return Err(refuse("the finite element runs are of different robots".into()));
    }
    let mut eye = SimulatedCamera::new(generator, generator.protocol.len());
    let mut coordinates_m = Vec::new();
    for run in runs {
        let gains = eye.next_run();
        for ([body_pa, actuator_pa], gain) in generator.protocol.iter().zip(gains) {
            if (body_pa * 1e-3 - run.body_kpa).abs() > 1e-6 {
                let (target, there) = (body_pa * 1e-3, run.body_kpa);
                return Err(refuse(format!("a body at {target} kPa; the runs are at {there} kPa")));
            }
            let markers = at(run, actuator_pa * 1e-3 * gain)?;
            (0..generator.samples).for_each(|_| eye.look(&markers, &mut coordinates_m));
        }
    }
    let marker = |(i, s): (usize, &f64)| Marker { name: (i + 1).to_string(), station_m: Some(s * 1e-3) };
    Ok(Dataset {
        name: name.to_string(),
        actuator: first.actuator.clone(),
        runs: (1..=runs.len()).map(|r| r.to_string()).collect(),
        holds: holds(generator),
        markers: first.stations_mm.iter().enumerate().map(marker).collect(),
        samples_per_hold: generator.samples,
        axes: 2,
        coordinates_m,
        gauge_pa: None,
        lost: data::Lost::default(),
        pressure_units: data::IN_KPA,
        told: Vec::new(),
    })
}

fn at(run: &EngineRun, kpa: f64) -> Result<Vec<[f64; 2]>, CompareError> {
    let mut states: Vec<_> = run.states.iter().filter(|s| s.seen_mm.len() == run.stations_mm.len()).collect();
    let rising = states.windows(2).take_while(|pair| pair[1].actuator_kpa > pair[0].actuator_kpa).count();
    states.truncate(rising + 1);
    let top = states.last().map_or(0.0, |s| s.actuator_kpa);
    if rising == 0 || policy::is_beyond(kpa, top) {
        let problem = format!("an actuator at {kpa:.1} kPa; the runs were read up to {top:.1} kPa");
        return Err(CompareError::NotSimulated { problem });
    }
    let k = states[1..rising].partition_point(|s| s.actuator_kpa < kpa);
    let (low, high) = (states[k], states[k + 1]);
    let share = (kpa - low.actuator_kpa) / (high.actuator_kpa - low.actuator_kpa);
    let place = |i: usize| {
        let of = |axis: usize| low.seen_mm[i][axis] + share * (high.seen_mm[i][axis] - low.seen_mm[i][axis]);
        [(run.stations_mm[i] + of(0)) * 1e-3, of(1) * 1e-3]
    };
    Ok((0..run.stations_mm.len()).map(place).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::engines::EngineState;

    /// A run whose only marker rises by 2 mm per kPa and shifts by −1.
    fn run(slope: f64) -> EngineRun {
        let seen_mm = |kpa: f64| vec![[-kpa, slope * kpa]];
        let state = |kpa: f64| EngineState { actuator_kpa: kpa, seen_mm: seen_mm(kpa), ..EngineState::default() };
        EngineRun {
            actuator: "epam".into(),
            scenario: "a robot".into(),
            body_kpa: 2.0,
            stations_mm: vec![330.0],
            known: "assumed".into(),
            states: [0.0, 10.0, 20.0, 30.0].map(state).to_vec(),
            ..EngineRun::default()
        }
    }

    fn quiet() -> Generator {
        Generator {
            samples: 1,
            protocol: [0.0, 5.0, 20.0, 30.0].map(|p| [2e3, p * 1e3]).to_vec(),
            camera_sd_m: 0.0,
            pressure_sd: 0.0,
            alignment_sd_m: 0.0,
            rotation_sd: 0.0,
            ..Generator::default()
        }
    }

    #[test]
    fn without_scatter_the_camera_sees_the_markers_of_the_runs() {
        let data = seen(&[run(2.0), run(3.0)], "d", &quiet()).unwrap();
        let mm: Vec<f64> = data.coordinates_m.iter().map(|v| (v * 1e6).round() * 1e-3).collect();
        assert_eq!(mm[..8], [330.0, 0.0, 325.0, 10.0, 310.0, 40.0, 300.0, 60.0]);
        assert_eq!(mm[8 + 6..], [300.0, 90.0]);
    }

    #[test]
    fn an_error_of_the_pressure_moves_the_markers_of_a_run_together() {
        let data = seen(&[run(2.0)], "d", &Generator { pressure_sd: 0.02, ..quiet() }).unwrap();
        let gain = data.coordinates_m[7] / 0.060;
        assert!(gain != 1.0 && (gain - 1.0).abs() < 0.1);
        assert!(
            (data.coordinates_m[3] / 0.010 - gain).abs() < 1e-12
                && (data.coordinates_m[5] / 0.040 - gain).abs() < 1e-12
        );
    }

    #[test]
    fn what_the_runs_do_not_hold_is_refused() {
        let high = Generator { protocol: vec![[2e3, 40e3]], ..quiet() };
        let body = Generator { protocol: vec![[4e3, 10e3]], ..quiet() };
        for (runs, generator, words) in [
            (vec![run(2.0)], high, "up to 30.0 kPa"),
            (vec![run(2.0)], body, "a body at 4 kPa"),
            (vec![], quiet(), "no finite element run"),
            (vec![EngineRun { stations_mm: vec![], ..run(2.0) }], quiet(), "kept no markers"),
        ] {
            let error = seen(&runs, "d", &generator).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
