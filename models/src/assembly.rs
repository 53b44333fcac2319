//! A model under construction: what effects change.

use crate::actuators::Family;
use crate::site::Site;
use crate::term::{CHANNELS, Term};
use serde::Serialize;
use spelling::si;

/// When and where a supply law is asked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moment {
    /// Time for which the set pressures have been held \[s\].
    pub held_s: f64,
    /// Time since the start of the protocol \[s\].
    pub t_s: f64,
    /// The last change of the set actuator pressure was downwards.
    pub falling: bool,
    /// Middle of the segment along the taut generator \[m\].
    pub s_m: f64,
}

/// Set pressure \[Pa\] → pressure in the actuator \[Pa\].
pub type SupplyLaw = Box<dyn Fn(f64, &Moment) -> f64 + Send + Sync>;
/// Set body pressure and largest set actuator pressure \[Pa\] → body pressure \[Pa\].
pub type BodySupplyLaw = Box<dyn Fn(f64, f64, &Moment) -> f64 + Send + Sync>;
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
    /// Time since the start of the protocol \[s\].
    pub t_s: f64,
}

/// A stretch of the robot in which the curvature is constant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Segment {
    /// Index into [`Assembly::sites`] of the site that the segment belongs to.
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
    /// Index into [`Assembly::sites`] of the site whose actuator the strip carries here.
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
    /// Coordinates of a node: 2, or 3 with strips round the body.
    pub axes: usize,
    /// Terms whose coordinates are the positions of all nodes, in J of the whole robot.
    pub node_terms: Vec<Box<dyn Term>>,
    /// Whether a node term depends on where the nodes are: its load is not dead.
    pub springs: bool,
    /// Laws from set to actuator pressure, applied one after the other at every segment.
    pub supply: Vec<SupplyLaw>,
    /// Laws of the body pressure in order.
    pub body: Vec<BodySupplyLaw>,
    /// Laws from true to seen marker positions, applied one after the other to every marker.
    pub camera: Vec<CameraLaw>,
    /// Whether a law depends on time.
    pub timed: bool,
    /// Lag τ \[s\] and rate error ρ of the camera's clock: it shows at t what was at t − τ − ρ t.
    pub clock: [f64; 2],
    /// Whether a term depends on the place along the body: then stretches of equal design are divided too.
    pub varies: bool,
    /// Unit vector of gravity; its z acts with strips round the body.
    pub gravity_direction: [f64; 3],
}

impl Assembly {
    /// Starts a planar assembly without sites, segments, terms or laws.
    pub fn empty(gravity_direction: [f64; 3]) -> Assembly {
        Assembly {
            sites: Vec::new(),
            segments: Vec::new(),
            around: Vec::new(),
            axes: 2,
            node_terms: Vec::new(),
            springs: false,
            supply: Vec::new(),
            body: Vec::new(),
            camera: Vec::new(),
            timed: false,
            clock: [0.0; 2],
            varies: false,
            gravity_direction,
        }
    }

    /// Sites whose actuator is of that family.
    pub fn active_sites(&mut self, family: Family) -> impl Iterator<Item = &mut Site> {
        self.sites.iter_mut().filter(move |site| site.actuator.is_some_and(|a| a.family == family))
    }

    /// Site of a segment.
    #[inline]
    pub(crate) fn site(&self, segment: usize) -> &Site {
        &self.sites[self.segments[segment].site]
    }

    /// Pressure in the actuator of a site at the channels' set pressures \[Pa\].
    #[inline]
    pub(crate) fn supplied(&self, site: &Site, set_pa: &[f64; CHANNELS], at: &Moment) -> f64 {
        let set = if site.actuator.is_some() { set_pa[site.channel] } else { 0.0 };
        self.supply.iter().fold(set, |p, law| law(p, at))
    }

    /// Length of the taut generator \[m\].
    pub fn length_m(&self) -> f64 {
        self.segments.iter().map(|segment| segment.length_m).sum()
    }

    /// Length of body that each node represents \[m\]: half of the segments on both sides.
    pub fn node_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.segments.len() + 1];
        for (i, segment) in self.segments.iter().enumerate() {
            lengths[i] += 0.5 * segment.length_m;
            lengths[i + 1] += 0.5 * segment.length_m;
        }
        lengths
    }
}
