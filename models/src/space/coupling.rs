//! Buffers of sections that are coupled through loads: what `loaded.rs` computes.

use super::lever::{Matrix, Vector};

/// Generalised forces of outer loads per length of body: on κ_y and κ_z \[N·m\] and on the contraction of the centre line \[N\].
pub(crate) type Outer = [f64; 3];

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Loaded {
    pub(super) sections: Vec<Coupling>,
    pub(super) nodes: Vec<f64>,
    pub(super) forces: Vec<f64>,
}

/// Loads of a section that the rest of the robot decides, and their slopes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Coupling {
    /// Loads assumed, and their Newton step.
    pub(super) outer: Outer,
    pub(super) step: Outer,
    /// Loads of the shape less the assumed ones.
    pub(super) residual: Vector,
    pub(super) compliance: Matrix,
    /// Turn of the body beyond, per change of q; one a row.
    pub(super) turn: Matrix,
    /// ∂G/∂φ of the segments before, times the length.
    pub(super) turned: Matrix,
    /// ∂G/∂q of itself, times the length.
    pub(super) own: Matrix,
    pub(super) slope: Matrix,
}

impl Loaded {
    pub(super) fn new(segments: usize) -> Loaded {
        let nodes = if segments == 0 { 0 } else { 3 * (segments + 1) };
        Loaded { sections: vec![Coupling::default(); segments], nodes: vec![0.0; nodes], forces: vec![0.0; nodes] }
    }

    /// Loads on a section: moments on κ_y and κ_z \[N·m\], and the force that shortens the centre line \[N\].
    pub(crate) fn outer(&self, section: usize) -> Outer {
        self.sections[section].outer
    }
}
