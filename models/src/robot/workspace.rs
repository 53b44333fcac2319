//! Buffers of a prediction, allocated once per [`Prediction`](crate::Prediction).

use crate::assembly::Assembly;
use crate::history::History;
use crate::shape::Arc;
use crate::site::SiteState;
use crate::space::SpaceWork;

/// Curvatures to hold, and the missing moments there; empty where nothing is held.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct HeldCurvatures {
    pub curvatures: Vec<f64>,
    pub missing: Vec<f64>,
}

/// Buffers of a prediction; made once, so that predicting allocates nothing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Workspace {
    pub states: Vec<SiteState>,
    /// Actuator pressure per segment after the supply stage \[Pa\].
    pub p_act_pa: Vec<f64>,
    /// Node positions x₀, y₀, x₁, … \[m\].
    pub nodes: Vec<f64>,
    /// Direction (cos ψ, sin ψ) at each node.
    pub directions: Vec<[f64; 2]>,
    pub headings: Vec<f64>,
    /// What the states before have left behind.
    pub history: History,
    /// Where the robot is held instead of solved for.
    pub held: HeldCurvatures,
    /// What a robot in space has in addition.
    pub space: SpaceWork,
    pub(super) coupled: Coupled,
}

/// What only transverse loads need; empty without them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Coupled {
    pub arcs: Vec<Arc>,
    pub forces: Vec<f64>,
    /// Assumed moment per segment \[N·m\], and its Newton step.
    pub moments: Vec<f64>,
    pub step: Vec<f64>,
    /// Moment of the loads on the shape minus the assumed one.
    pub residual: Vec<f64>,
    /// ∂Gᵢ/∂κⱼ for i < j, divided by hⱼ; and ∂Gᵢ/∂κᵢ.
    pub coupling: Vec<f64>,
    pub diagonal: Vec<f64>,
    /// Shear angle per segment; empty where the wall is rigid in shear.
    pub shear: Vec<f64>,
}

impl Workspace {
    pub(crate) fn new(assembly: &Assembly) -> Workspace {
        let (segments, coupled) = (assembly.segments.len(), !assembly.node_terms.is_empty());
        let n = if coupled { segments } else { 0 };
        let shears = assembly.sites.iter().any(|site| site.wall_shear_n_per_m.is_some());
        Workspace {
            states: vec![SiteState::REST; segments],
            p_act_pa: vec![0.0; segments],
            nodes: vec![0.0; 2 * (segments + 1)],
            directions: vec![[1.0, 0.0]; segments + 1],
            headings: vec![0.0; segments + 1],
            history: History::new(assembly),
            held: HeldCurvatures::default(),
            space: SpaceWork::new(assembly),
            coupled: Coupled {
                arcs: vec![Arc::default(); n],
                forces: vec![0.0; if coupled { 2 * (n + 1) } else { 0 }],
                moments: vec![0.0; n],
                step: vec![0.0; n],
                residual: vec![0.0; n],
                coupling: vec![0.0; n],
                diagonal: vec![0.0; n],
                shear: vec![0.0; if shears { n } else { 0 }],
            },
        }
    }

    /// Tension of the outer loads along the middle of a segment \[N\].
    pub(crate) fn tension_n(&self, index: usize) -> f64 {
        let beyond = self.coupled.forces[2 * (index + 1)..].chunks_exact(2);
        let [x, y] = beyond.fold([0.0; 2], |sum, force| [sum[0] + force[0], sum[1] + force[1]]);
        let (sin, cos) = (0.5 * (self.headings[index] + self.headings[index + 1])).sin_cos();
        x * cos + y * sin
    }

    #[inline]
    pub(crate) fn shear(&self, index: usize) -> f64 {
        self.coupled.shear.get(index).copied().unwrap_or(0.0)
    }

    pub(crate) fn is_sheared(&self) -> bool {
        !self.coupled.shear.is_empty()
    }
}
