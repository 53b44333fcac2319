//! Datasets with known truth for the tests: an arc whose curvature depends on P/p, seen by an imperfect camera.

use data::{Dataset, Hold, Marker, Phase};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Standard deviations of the noise put into a dataset.
#[derive(Clone, Copy)]
pub(crate) struct SyntheticNoise {
    /// Camera noise of one coordinate of one sample \[m\].
    pub sigma_m: f64,
    /// Relative pressure, one value per run.
    pub pressure: f64,
    /// Alignment, one coordinate, one value per run \[m\].
    pub alignment_m: f64,
}

pub(crate) const CAMERA: SyntheticNoise = SyntheticNoise { sigma_m: 1e-3, pressure: 0.0, alignment_m: 0.0 };
/// The handbook case: camera 1 mm, pressure 2 %, alignment 0.5 mm.
pub(crate) const TYPICAL: SyntheticNoise = SyntheticNoise { sigma_m: 1e-3, pressure: 0.02, alignment_m: 5e-4 };

/// A noise-free robot under a protocol.
#[derive(Clone)]
pub(crate) struct SyntheticRobot {
    /// (actuator, body) pressure of each hold \[kPa\]; a hold below its predecessor is unloading.
    pub pressures_kpa: Vec<(f64, f64)>,
    pub samples: usize,
    /// Markers at 30, 90, 150, … mm.
    pub markers: usize,
    /// Curvature approached at high pressure \[1/m\].
    pub curvature_per_m: f64,
    /// Extra resistance, as a body pressure \[kPa\]; not zero breaks the P/p law.
    pub resistance_kpa: f64,
}

impl SyntheticRobot {
    /// The paper's protocol, 0-10-20-30-0 kPa at 2 kPa, 5 samples, 6 markers; tip about 60 mm at 30 kPa.
    pub(crate) fn paper() -> SyntheticRobot {
        let pressures_kpa = [0.0, 10.0, 20.0, 30.0, 0.0].map(|p| (p, 2.0)).to_vec();
        SyntheticRobot { pressures_kpa, samples: 5, markers: 6, curvature_per_m: 1.6, resistance_kpa: 0.0 }
    }

    /// Positions in run layout \[m\] with all actuator pressures multiplied by `factor`.
    pub(crate) fn shape(&self, factor: f64) -> Vec<f64> {
        let mut xy = Vec::new();
        for &(p, body) in &self.pressures_kpa {
            let ratio = p * factor / (body + self.resistance_kpa);
            let curvature = self.curvature_per_m * ratio / (ratio + 6.0);
            for i in 0..self.samples * self.markers {
                xy.extend(arc(curvature, 0.03 + 0.06 * (i % self.markers) as f64));
            }
        }
        xy
    }

    /// ∂f/∂ln p in run layout \[m\], central difference.
    pub(crate) fn slope(&self) -> Vec<f64> {
        let h = 1e-4_f64;
        let (up, down) = (self.shape(h.exp()), self.shape((-h).exp()));
        up.iter().zip(down).map(|(u, d)| (u - d) / (2.0 * h)).collect()
    }

    /// Runs of this robot seen with noise.
    pub(crate) fn measured(&self, runs: usize, noise: SyntheticNoise, seed: u64) -> Dataset {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut coordinates_m = Vec::new();
        for _ in 0..runs {
            let shape = self.shape((noise.pressure * normal(&mut rng)).exp());
            let offset = [noise.alignment_m * normal(&mut rng), noise.alignment_m * normal(&mut rng)];
            coordinates_m
                .extend(shape.iter().enumerate().map(|(i, v)| v + offset[i % 2] + noise.sigma_m * normal(&mut rng)));
        }
        Dataset {
            name: "synthetic".to_string(),
            actuator: "test".to_string(),
            runs: (1..=runs).map(|r| r.to_string()).collect(),
            holds: self.holds(),
            markers: (0..self.markers).map(marker).collect(),
            samples_per_hold: self.samples,
            coordinates_m,
            axes: 2,
            gauge_pa: None,
            lost: data::Lost::default(),
            pressure_units: data::IN_KPA,
            told: Vec::new(),
        }
    }

    fn holds(&self) -> Vec<Hold> {
        let mut before = 0.0;
        let hold = |&(p, body): &(f64, f64)| {
            let phase = if p < before { Phase::Unload } else { Phase::Load };
            before = p;
            let t_s = (0..self.samples).map(|s| s as f64).collect();
            Hold { p_body_pa: 1e3 * body, p_act_pa: 1e3 * p, more_act_pa: Vec::new(), phase, occurrence: 0, t_s }
        };
        self.pressures_kpa.iter().map(hold).collect()
    }
}

/// Add a displacement to every run of a dataset; `by` gets (hold, sample, marker) and returns \[m\].
pub(crate) fn displace(dataset: &mut Dataset, by: impl Fn(usize, usize, usize) -> [f64; 2]) {
    let n = dataset.values_per_run();
    for run in 0..dataset.runs.len() {
        for hold in 0..dataset.holds.len() {
            for sample in 0..dataset.samples_per_hold {
                for marker in 0..dataset.markers.len() {
                    let at = run * n + dataset.offset(hold, sample, marker);
                    let d = by(hold, sample, marker);
                    dataset.coordinates_m[at] += d[0];
                    dataset.coordinates_m[at + 1] += d[1];
                }
            }
        }
    }
}

pub(crate) fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let uniform = |rng: &mut ChaCha8Rng| (f64::from(rng.next_u32()) + 0.5) / 4294967296.0;
    let (a, b) = (uniform(rng), uniform(rng));
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

fn arc(curvature: f64, s: f64) -> [f64; 2] {
    if curvature.abs() < 1e-9 {
        return [s, 0.0];
    }
    [(curvature * s).sin() / curvature, 2.0 * (0.5 * curvature * s).sin().powi(2) / curvature]
}

fn marker(m: usize) -> Marker {
    Marker { name: format!("P{}", m + 1), station_m: Some(0.03 + 0.06 * m as f64) }
}
