//! What a robot in space is at equilibrium: its sections and strips.

use super::frame::{Bend, Frame, SpaceStretch};
use super::lever::LoadedSections;
use crate::assembly::{Assembly, Segment};

/// Bend, contraction and strips of one section at equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionState<'a> {
    /// Segment of the body that the section represents.
    pub segment: Segment,
    /// κ_y, κ_z: bend towards azimuth 0° and 90° of the frame that follows the body without twist \[1/m\].
    pub kappa: [f64; 2],
    /// Shortening of the axis over its length \[-\].
    pub contraction: f64,
    /// Its strips, in the order of the scenario.
    pub strips: &'a [StripState],
}

/// Pressure, coordinate and tension of one strip at equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StripState {
    /// Pressure after the supply stage \[Pa\].
    pub p_act_pa: f64,
    /// Its actuators' coordinate; 0 where they are flat.
    pub coordinate: f64,
    /// Tension along the strip, positive where it pulls \[N\].
    pub tension: f64,
    /// Whether its actuators are open, as `StripSection::acting` noted it at this pressure.
    pub(super) is_open: bool,
}

/// Buffers of a robot in space; empty for a planar one.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SpaceWork {
    pub bends: Vec<Bend>,
    pub strips: Vec<Vec<StripState>>,
    /// Place and frame at each node.
    pub frames: Vec<Frame>,
    /// What only loads on the body need; empty without them.
    pub loaded: LoadedSections,
}

impl SpaceWork {
    pub(crate) fn new(assembly: &Assembly) -> SpaceWork {
        let count = assembly.around.len();
        SpaceWork {
            bends: vec![Bend::default(); count],
            strips: assembly.around.iter().map(|strips| vec![StripState::default(); strips.len()]).collect(),
            frames: vec![Frame::BASE; if count == 0 { 0 } else { count + 1 }],
            loaded: LoadedSections::new(if assembly.node_terms.is_empty() { 0 } else { count }),
        }
    }

    /// Node positions x₀, y₀, z₀, x₁, … \[m\].
    pub(crate) fn nodes(&self) -> Vec<f64> {
        self.frames.iter().flat_map(|frame| frame.at).collect()
    }
}

pub(crate) fn stretch(assembly: &Assembly, work: &SpaceWork, segment: usize) -> SpaceStretch {
    let site = assembly.site(segment);
    let bend = work.bends[segment];
    let contraction = bend.contraction + (site.centre_line.from_taut_m - site.radius_m) * bend.size();
    SpaceStretch { from: work.frames[segment], bend, contraction }
}

pub(crate) fn place(assembly: &Assembly, work: &mut SpaceWork) {
    for (i, segment) in assembly.segments.iter().enumerate() {
        work.frames[i + 1] = stretch(assembly, work, i).at(segment.length_m);
    }
}
