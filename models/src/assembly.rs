//! A model under construction: what effects change.

use crate::actuators::Family;
use crate::site::Site;
use crate::term::Term;

/// Set pressure → pressure in the actuator \[Pa\].
pub type SupplyLaw = Box<dyn Fn(f64) -> f64 + Send + Sync>;
/// Changes what the camera sees of one marker.
pub type CameraLaw = Box<dyn Fn(&mut Sighting) + Send + Sync>;

/// One marker as seen: true position and heading first, what the camera reports last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Position \[m\]; a camera effect changes it.
    pub xy: [f64; 2],
    /// Heading of the body at the marker \[rad\].
    pub heading: f64,
}

/// A stretch of the robot in which the curvature is constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Index of its site.
    pub site: usize,
    /// Start along the taut generator \[m\].
    pub start_m: f64,
    /// Length of its taut generator \[m\].
    pub length_m: f64,
}

/// Everything a model is made of.
pub struct Assembly {
    /// One per stretch of equal design, base to tip.
    pub sites: Vec<Site>,
    /// Division of the body, base to tip.
    pub segments: Vec<Segment>,
    /// Terms over node positions, J.
    pub node_terms: Vec<Box<dyn Term>>,
    /// Supply laws in order.
    pub supply: Vec<SupplyLaw>,
    /// Camera laws in order.
    pub camera: Vec<CameraLaw>,
    /// Unit vector of gravity in the x–y plane.
    pub gravity_direction: [f64; 2],
}

impl Assembly {
    /// Sites whose actuator is of that family.
    pub fn active_sites(&mut self, family: Family) -> impl Iterator<Item = &mut Site> {
        self.sites.iter_mut().filter(move |site| site.actuator.is_some_and(|a| a.family == family))
    }

    /// Length of body that each node stands for \[m\]: half of the segments on both sides.
    pub fn node_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.segments.len() + 1];
        for (i, segment) in self.segments.iter().enumerate() {
            lengths[i] += 0.5 * segment.length_m;
            lengths[i + 1] += 0.5 * segment.length_m;
        }
        lengths
    }
}
