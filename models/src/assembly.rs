//! A model under construction: what effects change.

use crate::actuators::Family;
use crate::site::Site;
use crate::term::Term;
use serde::Serialize;
use spelling::si;

/// Set pressure \[Pa\], and for how long it has been held \[s\] → pressure in the actuator \[Pa\].
pub type SupplyLaw = Box<dyn Fn(f64, f64) -> f64 + Send + Sync>;
/// Changes what the camera sees of one marker.
pub type CameraLaw = Box<dyn Fn(&mut Sighting) + Send + Sync>;

/// One marker as seen: true position and heading first, what the camera reports last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Position \[m\]; a camera effect changes it.
    pub xy: [f64; 2],
    /// Heading of the body at the marker \[rad\].
    pub heading: f64,
    /// Largest pressure in any actuator \[Pa\].
    pub p_act_pa: f64,
}

/// A stretch of the robot in which the curvature is constant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Segment {
    /// Index of its site.
    #[serde(skip)]
    pub site: usize,
    /// Start along the taut generator \[m\].
    #[serde(rename = "s_mm", serialize_with = "si::mm")]
    pub start_m: f64,
    /// Length of its taut generator \[m\].
    #[serde(rename = "length_mm", serialize_with = "si::mm")]
    pub length_m: f64,
}

impl Segment {
    /// Middle of its taut generator \[m\].
    pub fn middle_m(&self) -> f64 {
        self.start_m + 0.5 * self.length_m
    }
}

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

/// Everything a model is made of.
pub struct Assembly {
    /// One per stretch of equal design, base to tip.
    pub sites: Vec<Site>,
    /// Division of the body, base to tip.
    pub segments: Vec<Segment>,
    /// Strips of actuators round the body, per segment; empty: one strip towards y, and the robot is planar.
    pub around: Vec<Vec<Strip>>,
    /// Terms over node positions, J.
    pub node_terms: Vec<Box<dyn Term>>,
    /// Supply laws in order.
    pub supply: Vec<SupplyLaw>,
    /// Set body pressure that does not arrive \[Pa\].
    pub body_offset_pa: f64,
    /// Camera laws in order.
    pub camera: Vec<CameraLaw>,
    /// Whether a supply law depends on the time in a hold.
    pub timed: bool,
    /// Whether a term depends on the place along the body: then stretches of equal design are divided too.
    pub varies: bool,
    /// Unit vector of gravity in the x–y plane.
    pub gravity_direction: [f64; 2],
}

impl Assembly {
    /// Without any part.
    pub fn empty(gravity_direction: [f64; 2]) -> Assembly {
        Assembly {
            sites: Vec::new(),
            segments: Vec::new(),
            around: Vec::new(),
            node_terms: Vec::new(),
            supply: Vec::new(),
            body_offset_pa: 0.0,
            camera: Vec::new(),
            timed: false,
            varies: false,
            gravity_direction,
        }
    }

    /// Sites whose actuator is of that family.
    pub fn active_sites(&mut self, family: Family) -> impl Iterator<Item = &mut Site> {
        self.sites.iter_mut().filter(move |site| site.actuator.is_some_and(|a| a.family == family))
    }

    /// Length of the taut generator \[m\].
    pub fn length_m(&self) -> f64 {
        self.segments.iter().map(|segment| segment.length_m).sum()
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
