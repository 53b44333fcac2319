//! Strips of actuators round the body: a bend with a direction, and a body that shortens without bending.
//!
//! A section has three unknowns: the bend κ = (κ_y, κ_z) and the contraction ε₀ of the axis. Azimuth 0 is y, and azimuths turn from
//! y to z. Inextensible fabric lets no generator lengthen, so ε₀ ≥ R|κ|. A strip at azimuth θ, b from the axis, shortens by
//!
//! ```text
//! ε = cos²β (ε₀ + b κ·e)        e = (cos θ, sin θ),  b = D − R,  tan β = R dθ/ds
//! U(κ, ε₀) = p_b (A ε₀ + m·κ) + ½ B|κ|² + Σ U_i(ε)/cos β        minimal, with ε₀ ≥ R|κ|
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D, R | arm of the strip from the far side, body radius | m |
//! | β | slant of a helical strip to the axis | rad |
//! | U_i | energy of the actuator per metre of strip: the terms of its [`Site`] | J/m |
//! | A, m | area of the section, and its first moment about the axis: strips that draw the wall in take of both | m², m³ |
//! | B | bending stiffness | N·m² |
//!
//! Where one strip pulls, ε₀ = R|κ|: the generator opposite to the bend is taut, ε = κD, and this is the planar balance. Where strips
//! pull more than p_b A together, nothing is taut: the body shortens. Two equal strips at 180° do so, and each
//! resists the other.
//!
//! **Validity**: U is convex as long as the pull of a strip falls with its contraction, so there is one minimum. Each actuator's own
//! terms see the bend ε/D that its contraction would make alone. The body does not twist. A bend has no shear. The wall's step at
//! κ = 0 is sharp: `hinge_curvature_per_m` acts in sections with one upright strip alone. Derived here.

mod drawn;
mod frame;
mod model;
mod section;
#[cfg(test)]
mod tests;

use crate::assembly::{Assembly, Segment};
use crate::body::BodyLaw;
use crate::error::Unsolved;
use crate::robot::Workspace;
use crate::scenario::ActuatorChoice;
#[cfg(doc)]
use crate::site::Site;
pub use frame::Frame;
pub(crate) use frame::Stretch;
pub use model::SectionState;
use section::Section;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Effects that act with strips round the body: those inside an actuator, and on its supply. Others are refused.
pub const IN_SPACE: &[&str] = &[
    "chord_arm",
    "weld_width",
    "end_constraint",
    "arm_growth",
    "fabric_stretch",
    "shear_stiffness",
    "shear_lock",
    "seam_stiffness",
    "displaced_gas",
    "gussets",
    "sealed_sides",
    "fold_energy",
    "crimped_sides",
    "pressure_offset",
    "pressure_loss",
    "body_pressure_offset",
];

/// A strip of actuators where it passes a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strip {
    /// Index of its site.
    pub site: usize,
    /// Azimuth in the middle of the segment, from y towards z \[rad\].
    pub azimuth_rad: f64,
    /// cos β of its slant to the axis.
    pub cos_slant: f64,
}

/// Unit vector (y, z) at an azimuth, exact at quarter turns.
pub(crate) fn direction(azimuth_rad: f64) -> [f64; 2] {
    let quarters = (azimuth_rad / FRAC_PI_2).round();
    let (sin, cos) = (azimuth_rad - quarters * FRAC_PI_2).sin_cos();
    match (quarters as i64).rem_euclid(4) {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

impl ActuatorChoice {
    /// Length along the strip, all units \[m\].
    pub fn strip_m(&self) -> f64 {
        self.count as f64 * self.shape.length_m
    }

    /// Length of body that it covers, on a body of radius `radius_m` \[m\]: a helix is longer than that. NaN where so many turns
    /// need a longer strip.
    pub fn covered_m(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 {
            return self.strip_m();
        }
        (self.strip_m().powi(2) - (TAU * radius_m * self.turns).powi(2)).sqrt()
    }

    /// Azimuth at a station \[rad\].
    pub fn azimuth_at(&self, radius_m: f64, s_m: f64) -> f64 {
        if self.turns == 0.0 {
            return self.azimuth_rad;
        }
        self.azimuth_rad + TAU * self.turns * (s_m - self.start_m) / self.covered_m(radius_m)
    }

    /// cos β of the slant to the axis.
    pub fn cos_slant(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 { 1.0 } else { self.covered_m(radius_m) / self.strip_m() }
    }

    /// sin β, positive from y towards z.
    pub fn sin_slant(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 { 0.0 } else { TAU * radius_m * self.turns / self.strip_m() }
    }
}

/// Strips of every segment; `spans` sites per strip, those of the first strip first.
pub(crate) fn around(strips: &[ActuatorChoice], radius_m: f64, spans: usize, segments: &[Segment]) -> Vec<Vec<Strip>> {
    let strip = |segment: &Segment, (i, choice): (usize, &ActuatorChoice)| Strip {
        site: i * spans + segment.site,
        azimuth_rad: choice.azimuth_at(radius_m, segment.middle_m()),
        cos_slant: choice.cos_slant(radius_m),
    };
    segments.iter().map(|segment| strips.iter().enumerate().map(|s| strip(segment, s)).collect()).collect()
}

/// A strip at equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StripState {
    /// Pressure after the supply stage \[Pa\].
    pub p_act_pa: f64,
    /// Its actuators' coordinate; 0 where they are flat.
    pub coordinate: f64,
    /// Tension along the strip \[N\].
    pub tension: f64,
}

/// Buffers of a robot in space; empty for a planar one.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SpaceWork {
    /// Per segment.
    pub bends: Vec<Bend>,
    /// Per segment and strip.
    pub strips: Vec<Vec<StripState>>,
    /// Place and frame at each node.
    pub frames: Vec<Frame>,
}

/// Bend and contraction of a section.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Bend {
    /// κ_y, κ_z per unpressurised length \[1/m\].
    pub kappa: [f64; 2],
    /// Contraction ε₀ of the axis.
    pub contraction: f64,
}

impl Bend {
    /// |κ| \[1/m\].
    pub fn size(&self) -> f64 {
        self.kappa[0].hypot(self.kappa[1])
    }
}

impl SpaceWork {
    pub fn new(assembly: &Assembly) -> SpaceWork {
        let count = assembly.around.len();
        SpaceWork {
            bends: vec![Bend::default(); count],
            strips: assembly.around.iter().map(|strips| vec![StripState::default(); strips.len()]).collect(),
            frames: vec![Frame::BASE; if count == 0 { 0 } else { count + 1 }],
        }
    }
}

/// Equilibrium of every section, at the strips' pressures in `work`.
pub(crate) fn equilibrium(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Result<(), Unsolved> {
    refuse_the_rest(assembly)?;
    for i in 0..assembly.segments.len() {
        let alike = i > 0 && same_section(assembly, &work.space, i);
        if alike {
            let (before, after) = work.space.strips.split_at_mut(i);
            after[0].copy_from_slice(&before[i - 1]);
            work.space.bends[i] = work.space.bends[i - 1];
        } else {
            let section = Section::new(assembly, i, p_body_pa);
            work.space.bends[i] = section.solve(&mut work.space.strips[i])?;
        }
        work.states[i].curvature = work.space.bends[i].size();
    }
    Ok(())
}

/// Refuses parts of a model that the sections do not see.
fn refuse_the_rest(assembly: &Assembly) -> Result<(), Unsolved> {
    let what = match () {
        _ if !assembly.node_terms.is_empty() => "a load on the body",
        _ if !assembly.camera.is_empty() => "an effect of the camera",
        _ if assembly.sites.iter().any(|site| !site.body_terms.is_empty()) => "an effect on the bend of the body",
        _ if assembly.sites.iter().any(|site| site.linkage.section.is_some()) => "a section that changes as it bends",
        _ if assembly.sites.iter().any(|site| !matches!(site.body_pressure, BodyLaw::Hinge(_))) => {
            "a wall that stretches"
        }
        _ => return Ok(()),
    };
    Err(Unsolved::InSpace { what })
}

/// Whether a segment has the design, azimuths and pressures of the one before.
fn same_section(assembly: &Assembly, work: &SpaceWork, i: usize) -> bool {
    assembly.around[i] == assembly.around[i - 1]
        && work.strips[i].iter().zip(&work.strips[i - 1]).all(|(a, b)| a.p_act_pa == b.p_act_pa)
}
