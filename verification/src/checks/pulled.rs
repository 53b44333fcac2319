//! A flat strip pulled along x: what the checks of fabrics share.

use super::setup::*;
use models::Fabric;

/// A flat strip that two clamps pull along x.
pub(super) struct PulledStrip {
    pub size_m: [f64; 2],
    pub elements: [usize; 2],
    pub fabric: Arc<dyn Fabric>,
    /// Angle of the warp to the pull \[rad\].
    pub warp_rad: f64,
    /// Displacement of the right clamp over time \[s, m\], smooth in between.
    pub pull: Vec<(f64, f64)>,
    pub damping_1_s: f64,
}

/// What a strip does at one moment.
pub(super) struct StripReading {
    /// Strain between two marks in the middle fifth.
    pub strain: f64,
    /// Force on the right clamp over the unstrained cross-section \[Pa\].
    pub stress_pa: f64,
}

impl PulledStrip {
    /// The run, both clamps holding all three axes.
    pub(super) fn start(&self) -> Result<Simulation, FemError> {
        let [length, width] = self.size_m;
        let mesh = generate::plate(length, width, self.elements[0], self.elements[1], None)?;
        let mut sheet = section(self.fabric.clone(), 0.0);
        sheet.plies[0].angle_rad = self.warp_rad;
        let mut problem = problem("strip", mesh, sheet, vec![]);
        problem.supports =
            vec![hold("left", [true; 3]), drive("right", [true; 3], 0, Amplitude::Smooth(self.pull.clone()))];
        problem.settings.mass_damping_1_s = self.damping_1_s;
        Simulation::new(&problem)
    }

    /// Steps to a time and reads strain and stress.
    pub(super) fn read(&self, run: &mut Simulation, time_s: f64) -> Result<StripReading, FemError> {
        advance(run, time_s)?;
        let marks = [0.4, 0.6].map(|share| (share * self.elements[0] as f64).round());
        let apart = (marks[1] - marks[0]) * self.size_m[0] / self.elements[0] as f64;
        let strain = (self.mean_x(run, marks[1]) - self.mean_x(run, marks[0])) / apart - 1.0;
        let force = pull_n(run, "right");
        Ok(StripReading { strain, stress_pa: force / (self.size_m[1] * self.fabric.thickness_m()) })
    }

    /// Mean place of a column of nodes \[m\].
    fn mean_x(&self, run: &Simulation, column: f64) -> f64 {
        let x = run.positions();
        let [along, across] = self.elements;
        let rows = 0..=across;
        rows.map(|j| x[j * (along + 1) + column as usize][0]).sum::<f64>() / (across + 1) as f64
    }
}
