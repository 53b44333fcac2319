//! Lines of a robot, for drawing.

use crate::actuators::Family;
use crate::assemble::locate;
use crate::model::{Model, Prediction};
use crate::robot::Workspace;
use crate::space::Frame;
use std::f64::consts::PI;

impl Model {
    /// `count` stations from base to tip: segment, and distance from its start \[m\].
    fn stations(&self, count: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (segments, last) = (&self.assembly().segments, (count.max(2) - 1) as f64);
        let length: f64 = segments.iter().map(|s| s.length_m).sum();
        (0..count).map(move |i| locate(segments, length * i as f64 / last))
    }

    /// `count` points of the centre line from base to tip \[m\], for drawing.
    pub fn centre_line(&self, at: &Prediction, count: usize) -> Vec<[f64; 2]> {
        if self.is_spatial() {
            return self.centre_line_in_space(at, count).into_iter().map(|[x, y, _]| [x, y]).collect();
        }
        self.stations(count).map(|(segment, offset)| self.stretch(&at.work, segment).at(offset).0).collect()
    }

    /// Both sides of the body in the plane of bending at `count` stations from base to tip \[m\], the actuator's first, for drawing.
    pub fn outline(&self, at: &Prediction, count: usize) -> [Vec<[f64; 2]>; 2] {
        let mut sides = [Vec::with_capacity(count), Vec::with_capacity(count)];
        for (segment, offset) in self.stations(count) {
            let radius = self.assembly().site(segment).radius_m;
            let ([x, y], across) = match self.is_spatial() {
                true => self.side_in_space(&at.work, segment, offset),
                false => {
                    let (at, heading) = self.stretch(&at.work, segment).at(offset);
                    (at, [-heading.sin(), heading.cos()])
                }
            };
            let across = across.map(|part| radius * part);
            sides[0].push([x + across[0], y + across[1]]);
            sides[1].push([x - across[0], y - across[1]]);
        }
        sides
    }

    /// `count` points of the centre line from base to tip \[m\].
    pub fn centre_line_in_space(&self, at: &Prediction, count: usize) -> Vec<[f64; 3]> {
        if !self.is_spatial() {
            return self.centre_line(at, count).into_iter().map(|[x, y]| [x, y, 0.0]).collect();
        }
        self.stations(count).map(|(segment, offset)| self.stretch_in_space(&at.work, segment).at(offset).at).collect()
    }

    /// A point of the centre line and the direction of azimuth 0 there, both seen along z.
    fn side_in_space(&self, work: &Workspace, segment: usize, offset: f64) -> ([f64; 2], [f64; 2]) {
        let frame = self.stretch_in_space(work, segment).at(offset);
        ([frame.at[0], frame.at[1]], [frame.sides[0][0], frame.sides[0][1]])
    }

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
