//! A robot measured: several runs with the scatter of a real test.

use super::march;
use super::robot::TrueRobot;
use compare::error::CompareError;
use compare::study::eye::SimulatedCamera;
use compare::study::generate::{Generator, Manometer, NormalNumbers, holds, markers};
use data::{Dataset, Hold};
use models::Scenario;

/// Scatter and camera faults with which a robot is measured.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measurement {
    pub generator: Generator,
    /// Camera noise from Student's t with 3 degrees of freedom, scaled to the same standard deviation: now and then a
    /// marker is seen far off.
    pub heavy_tails: bool,
    /// One in twenty markers is lost for a whole hold of a run, and the outermost one leaves the picture at the highest pressure.
    pub lost_markers: bool,
}

/// Share of (run, hold, marker) that a camera loses.
const LOST: f64 = 0.05;
/// Sets the losses apart from the scatter, which is the same without them.
const LOSSES: u64 = 0x1057;

/// Positions without any scatter, in run layout \[m\].
pub(crate) fn ideal(robot: &TrueRobot, generator: &Generator) -> Result<Vec<f64>, CompareError> {
    march::run(robot, &holds(generator), &vec![1.0; generator.protocol.len()])
}

/// Measures a robot under the protocol of its measurement; `scenario` gives what the experimenter believes: actuator and
/// marker stations.
pub(crate) fn measure(
    robot: &TrueRobot,
    scenario: &Scenario,
    name: &str,
    measurement: &Measurement,
) -> Result<Dataset, CompareError> {
    measure_holds(robot, scenario, name, measurement, holds(&measurement.generator))
}

/// Measures a robot under holds of any length.
pub(crate) fn measure_holds(
    robot: &TrueRobot,
    scenario: &Scenario,
    name: &str,
    measurement: &Measurement,
    holds: Vec<Hold>,
) -> Result<Dataset, CompareError> {
    let g = &measurement.generator;
    let mut eye = SimulatedCamera::new(g, holds.len());
    eye.heavy_tails = measurement.heavy_tails;
    let mut manometer = g.gauge.then(|| Manometer::new(g.seed));
    let (mut coordinates_m, mut readings) = (Vec::new(), Vec::new());
    for _ in 0..g.runs {
        let gains = eye.next_run();
        let positions_m = march::run(robot, &holds, &gains)?;
        let markers: Vec<[f64; 2]> = positions_m.as_chunks().0.to_vec();
        for sample in markers.chunks(scenario.markers_m.len()) {
            eye.look(sample, &mut coordinates_m);
        }
        if let Some(manometer) = &mut manometer {
            read(manometer, robot, &holds, &gains, &mut readings);
        }
    }
    let made = Dataset {
        name: name.to_string(),
        actuator: scenario.actuator.kind.name.to_string(),
        runs: (1..=g.runs).map(|r| r.to_string()).collect(),
        holds,
        markers: markers(scenario),
        samples_per_hold: g.samples,
        axes: 2,
        coordinates_m,
        gauge_pa: g.gauge.then_some(readings),
        lost: data::Lost::default(),
        pressure_units: data::IN_KPA,
        told: Vec::new(),
    };
    let made = made.checked()?;
    let cells = if measurement.lost_markers { lost(&made, g.seed) } else { Vec::new() };
    Ok(if cells.is_empty() { made } else { made.losing(&cells) })
}

fn lost(dataset: &Dataset, seed: u64) -> Vec<[usize; 3]> {
    let mut scatter = NormalNumbers::new(seed ^ LOSSES);
    let top_pa = dataset.holds.iter().fold(0.0, |top: f64, hold| top.max(hold.p_act_pa));
    let (holds, markers) = (dataset.holds.len(), dataset.markers.len());
    let cells = (0..dataset.runs.len()).flat_map(|run| (0..holds).map(move |hold| (run, hold)));
    let cells = cells.flat_map(|(run, hold)| (0..markers).map(move |marker| [run, hold, marker]));
    let mut is_lost = |[_, hold, marker]: &[usize; 3]| {
        let occluded = scatter.uniform() < LOST;
        occluded || *marker == markers - 1 && dataset.holds[*hold].p_act_pa == top_pa
    };
    cells.filter(|cell| is_lost(cell)).collect()
}

/// Readings of one run, `[hold][sample]` \[Pa\]; `gains` are its factors on the pressures of the holds.
fn read(manometer: &mut Manometer, robot: &TrueRobot, holds: &[Hold], gains: &[f64], readings: &mut Vec<f64>) {
    let mut begin_s = 0.0;
    for (hold, gain) in holds.iter().zip(gains) {
        for t_s in &hold.t_s {
            let p_pa = robot.supply.pressure(hold.p_act_pa, *gain, march::held_s(*t_s, begin_s));
            readings.push(manometer.read(p_pa));
        }
        begin_s = hold.t_s.last().copied().unwrap_or(begin_s);
    }
}
