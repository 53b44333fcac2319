//! What a synthetic test is like, and its camera: errors of whole runs, single holds and single samples.

use models::Prediction;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// What a synthetic test is like; `Default` is the protocol of du Pasquier et al. 2023 with plausible scatter.
#[derive(Debug, Clone, PartialEq)]
pub struct Generator {
    /// Seed of all random numbers of the scatter.
    pub seed: u64,
    /// How many runs of the protocol are made.
    pub runs: usize,
    /// How many samples each hold has.
    pub samples: usize,
    /// Time from the start to the end of each hold \[s\].
    pub hold_s: f64,
    /// Holds: body pressure, actuator pressure \[Pa\].
    pub protocol: Vec<[f64; 2]>,
    /// Of every hold the pressures of supply channels 1, 2, … \[Pa\]; empty: all channels have the actuator pressure.
    pub more_act_pa: Vec<Vec<f64>>,
    /// Camera noise of one coordinate \[m\].
    pub camera_sd_m: f64,
    /// Run-to-run relative error of the actuator pressure \[-\].
    pub pressure_sd: f64,
    /// Run-to-run shift of the camera \[m\].
    pub alignment_sd_m: f64,
    /// Run-to-run roll of the camera \[rad\].
    pub rotation_sd: f64,
    /// Scatter that differs from hold to hold of a run.
    pub per_hold: HoldScatter,
    /// A gauge at the actuator is read along.
    pub gauge: bool,
}

/// Standard deviations of the errors that differ from hold to hold of a run; all are 0 by default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HoldScatter {
    /// Relative error of the actuator pressure \[-\].
    pub pressure_sd: f64,
    /// Shift of the camera or the base along each axis \[m\].
    pub alignment_sd_m: f64,
    /// Roll of the camera about the origin \[rad\].
    pub rotation_sd: f64,
    /// Error of one coordinate of a marker that lasts through the hold, as of a tracker \[m\].
    pub lasting_sd_m: f64,
}

impl HoldScatter {
    /// As laboratories have it: a regulator that repeats to 2 %, a camera that moves by half a millimetre and half a milliradian, a
    /// tracker whose error of half a millimetre lasts through a hold.
    pub const USUAL: HoldScatter =
        HoldScatter { pressure_sd: 0.02, alignment_sd_m: 5e-4, rotation_sd: 5e-4, lasting_sd_m: 5e-4 };
}

impl Default for Generator {
    fn default() -> Self {
        Generator {
            seed: 1,
            runs: 5,
            samples: 5,
            hold_s: 5.0,
            protocol: [0.0, 10e3, 20e3, 30e3, 0.0].map(|p| [2e3, p]).to_vec(),
            more_act_pa: Vec::new(),
            camera_sd_m: 1e-3,
            pressure_sd: 0.02,
            alignment_sd_m: 0.5e-3,
            rotation_sd: 0.5e-3,
            per_hold: HoldScatter::default(),
            gauge: false,
        }
    }
}

/// A camera and the regulator's error, run by run.
pub struct SimulatedCamera<'a> {
    generator: &'a Generator,
    /// Camera noise from Student's t with 3 degrees of freedom, scaled to the same standard deviation: now and then a marker is seen
    /// far off.
    pub heavy_tails: bool,
    holds: usize,
    scatter: NormalNumbers,
    shift: [f64; 2],
    roll: f64,
    /// Draws of single holds, samples seen, and what lasts through the hold: shift, roll, and errors of the markers.
    of_holds: NormalNumbers,
    seen: usize,
    held_shift: [f64; 3],
    held_roll: f64,
    lasting: Vec<[f64; 3]>,
    /// Shift along z \[m\] and rotations about x and y \[rad\] of a robot in space.
    tilt: [f64; 3],
}

impl<'a> SimulatedCamera<'a> {
    /// A camera for runs of so many holds.
    pub fn new(generator: &'a Generator, holds: usize) -> SimulatedCamera<'a> {
        SimulatedCamera {
            generator,
            heavy_tails: false,
            holds,
            scatter: NormalNumbers::new(generator.seed),
            shift: [0.0; 2],
            roll: 0.0,
            of_holds: NormalNumbers::new(generator.seed ^ 0x401D),
            seen: 0,
            held_shift: [0.0; 3],
            held_roll: 0.0,
            lasting: Vec::new(),
            tilt: [0.0; 3],
        }
    }

    /// Sets the robot up again; returns true over set pressure of every hold.
    pub fn next_run(&mut self) -> Vec<f64> {
        let (g, scatter) = (self.generator, &mut self.scatter);
        let gain = 1.0 + g.pressure_sd * scatter.normal();
        self.shift = [scatter.normal(), scatter.normal()].map(|n| n * g.alignment_sd_m);
        self.roll = g.rotation_sd * scatter.normal();
        (0..self.holds).map(|_| gain * (1.0 + g.per_hold.pressure_sd * self.of_holds.normal())).collect()
    }

    /// Draws the errors of a hold, at its first sample.
    fn hold(&mut self, markers: usize) {
        if self.seen.is_multiple_of(self.generator.samples.max(1)) {
            let (g, scatter) = (&self.generator.per_hold, &mut self.of_holds);
            let mut three = |sd: f64| [0.0; 3].map(|_: f64| sd * scatter.normal());
            self.held_shift = three(g.alignment_sd_m);
            self.lasting = (0..markers).map(|_| three(g.lasting_sd_m)).collect();
            self.held_roll = g.rotation_sd * scatter.normal();
        }
        self.seen += 1;
    }

    /// Sets up what a planar robot does not show.
    pub(super) fn tilt(&mut self) {
        let g = self.generator;
        self.tilt = [g.alignment_sd_m, g.rotation_sd, g.rotation_sd].map(|sd| sd * self.scatter.normal());
    }

    /// One sample of all markers, in space with z.
    pub(super) fn look_at(&mut self, at: &Prediction, is_spatial: bool, coordinates_m: &mut Vec<f64>) {
        if !is_spatial {
            return self.look(&at.markers, coordinates_m);
        }
        let [shift_z, about_x, about_y] = self.tilt;
        let mut xy_m = Vec::with_capacity(2 * at.markers.len());
        self.look(&at.markers, &mut xy_m);
        let shift_z = shift_z + self.held_shift[2];
        for (i, (seen, ([x, y], z))) in xy_m.chunks_exact(2).zip(at.markers.iter().zip(&at.markers_z_m)).enumerate() {
            let noise = self.generator.camera_sd_m * self.scatter.normal() + self.lasting[i][2];
            let z_m = z + about_x * y - about_y * x + shift_z + noise;
            coordinates_m.extend([seen[0] + about_y * z, seen[1] - about_x * z, z_m]);
        }
    }

    /// Appends x and y of all markers as the camera sees them once \[m\].
    pub fn look(&mut self, markers: &[[f64; 2]], coordinates_m: &mut Vec<f64>) {
        self.hold(markers.len());
        let (shift, held) = (self.shift, self.held_shift);
        let (shift, roll) = ([shift[0] + held[0], shift[1] + held[1]], self.roll + self.held_roll);
        for ([x, y], lasting) in markers.iter().zip(&self.lasting) {
            let noise = [0, 1].map(|_| self.generator.camera_sd_m * self.scatter.camera(self.heavy_tails));
            coordinates_m.push(x - roll * y + shift[0] + noise[0] + lasting[0]);
            coordinates_m.push(y + roll * x + shift[1] + noise[1] + lasting[1]);
        }
    }
}

/// Standard normal numbers by the polar method, from a generator whose stream is fixed by its definition.
pub struct NormalNumbers {
    rng: ChaCha8Rng,
    spare: Option<f64>,
}

/// Degrees of freedom of heavy-tailed noise: the least with a variance.
const HEAVY_DOF: usize = 3;

impl NormalNumbers {
    /// A random number of mean 0 and variance 1.
    pub(super) fn camera(&mut self, heavy_tails: bool) -> f64 {
        let normal = self.normal();
        if !heavy_tails {
            return normal;
        }
        let chi2: f64 = (0..HEAVY_DOF).map(|_| self.normal().powi(2)).sum();
        // t = n/√(χ²/3) has the variance 3.
        normal / chi2.sqrt()
    }

    /// Random numbers that follow from the seed alone.
    pub fn new(seed: u64) -> NormalNumbers {
        NormalNumbers { rng: ChaCha8Rng::seed_from_u64(seed), spare: None }
    }

    /// A uniform random number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        // 53 random bits: every double in [0, 1) of that spacing.
        (self.rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A standard normal random number, by the polar method.
    pub fn normal(&mut self) -> f64 {
        if let Some(value) = self.spare.take() {
            return value;
        }
        loop {
            let (u, v) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let s = u * u + v * v;
            if s > 0.0 && s < 1.0 {
                let factor = (-2.0 * s.ln() / s).sqrt();
                self.spare = Some(v * factor);
                return u * factor;
            }
        }
    }
}
