//! Where a robot in space and its units are, for drawing.

use super::Frame;
use crate::actuators::Family;
use crate::model::{Model, Prediction, locate};
use std::f64::consts::PI;

impl Model {
    /// Place and frame of the centre line at a station \[m\]; `None` of a planar robot.
    pub fn frame_at(&self, at: &Prediction, s_m: f64) -> Option<Frame> {
        let (segment, offset) = locate(&self.assembly().segments, s_m);
        self.is_spatial().then(|| self.stretch_in_space(&at.work, segment).at(offset))
    }

    /// Height of a strip's unit in its middle \[m\], at a station \[m\]: a pouch's lens, a muscle's diameter. 0 where nothing is.
    pub fn strip_height_m(&self, at: &Prediction, strip: usize, s_m: f64) -> f64 {
        let (segment, _) = locate(&self.assembly().segments, s_m);
        let here = self.assembly().around.get(segment).and_then(|strips| strips.get(strip));
        let Some(site) = here.map(|strip| &self.assembly().sites[strip.site]) else { return 0.0 };
        let (state, Some(actuator)) = (&at.work.space.strips[segment][strip], site.actuator) else { return 0.0 };
        match actuator.family {
            Family::Pouch => 2.0 * (actuator.stroke)(&site.shape, state.coordinate.max(actuator.range.0)).lift,
            Family::Mckibben if state.p_act_pa > 0.0 => 2.0 * site.shape.width_m / PI,
            Family::Mckibben => 0.0,
        }
    }
}
