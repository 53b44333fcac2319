//! Predictions of a [`Model`] for a robot in space.

use super::{Model, Prediction, Tip, post};
use crate::assembly::Segment;
use crate::error::{Solved, Unsolved};
use crate::robot::Workspace;
use crate::space::{Bend, SectionState, SpaceStretch, StripSection, StripState, place, stretch};
use crate::term::{CHANNELS, Row, RowKind};

impl Model {
    /// Whether strips run round the body: see [`crate::space`].
    pub fn is_spatial(&self) -> bool {
        !self.assembly().around.is_empty()
    }

    pub(crate) fn planar(&self, subject: &'static str) -> Solved {
        if self.is_spatial() { Err(Unsolved::InSpace { subject }) } else { Ok(()) }
    }

    /// Sections of a robot in space, base to tip; none of a planar one.
    pub fn sections<'a>(&'a self, at: &'a Prediction) -> impl Iterator<Item = SectionState<'a>> + 'a {
        let work = &at.work.space;
        let section = |(segment, (bend, strips)): (&Segment, (&Bend, &'a Vec<StripState>))| SectionState {
            segment: *segment,
            kappa: bend.kappa,
            contraction: bend.contraction,
            strips,
        };
        self.assembly().segments.iter().zip(work.bends.iter().zip(&work.strips)).map(section)
    }

    pub(crate) fn stretch_in_space(&self, work: &Workspace, segment: usize) -> SpaceStretch {
        stretch(self.assembly(), &work.space, segment)
    }

    pub(crate) fn point(&self, work: &Workspace, segment: usize, offset_m: f64) -> [f64; 3] {
        if self.is_spatial() {
            return self.stretch_in_space(work, segment).at(offset_m).at;
        }
        let ([x, y], _) = self.stretch(work, segment).at(offset_m);
        [x, y, 0.0]
    }

    pub(crate) fn place_in_space(&self, out: &mut Prediction) {
        place(self.assembly(), &mut out.work.space);
        let mut turned = 0.0;
        for (i, segment) in self.assembly().segments.iter().enumerate() {
            let end = out.work.space.frames[i + 1];
            turned += out.work.space.bends[i].size() * segment.length_m;
            out.work.nodes[2 * i + 2] = end.at[0];
            out.work.nodes[2 * i + 3] = end.at[1];
            out.work.headings[i + 1] = turned;
        }
        let [x_m, y_m, z_m] = out.work.space.frames[self.assembly().segments.len()].at;
        out.tip = Tip { x_m, y_m, z_m, angle_rad: turned };
    }

    /// Markers on the centre line: effects of the camera are refused in space.
    pub(crate) fn see_in_space(&self, places: &[(usize, f64)], out: &mut Prediction) {
        for (i, (segment, offset)) in places.iter().enumerate() {
            let [x, y, z] = self.stretch_in_space(&out.work, *segment).at(*offset).at;
            (out.markers[i], out.markers_z_m[i]) = ([x, y], z);
        }
    }

    pub(crate) fn supply_strips(&self, actuator_pa: &[f64; CHANNELS], work: &mut Workspace) {
        let assembly = self.assembly();
        for (states, strips) in work.space.strips.iter_mut().zip(&assembly.around) {
            for (state, strip) in states.iter_mut().zip(strips) {
                state.p_act_pa = assembly.supplied(&assembly.sites[strip.site], actuator_pa, &work.history.moment);
            }
        }
    }

    pub(crate) fn ledger_in_space(&self, body_pa: f64, at: &Prediction, rows: &mut Vec<Row>) {
        for (i, segment) in self.assembly().segments.iter().enumerate() {
            let section = StripSection::new(self.assembly(), i, body_pa);
            section.energies(&at.work.space.bends[i], &at.work.space.strips[i], &mut |line, energy| {
                post(rows, line, RowKind::Stored, energy * segment.length_m);
            });
        }
        self.node_energies(&at.work.space.nodes(), body_pa, rows);
    }
}
