//! A robot held in a shape: the moment that would have to join the model's own for it to rest there.
//!
//! At equilibrium the moments of all terms cancel at every place. At another curvature they do not, and their sum is
//! the **missing moment**
//!
//! ```text
//! M(κ) = ∂U/∂κ − N D − G          positive: something is missing that bends the robot towards its actuator
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ∂U/∂κ | moment of the wall and of the body's gas | N·m |
//! | N D | pull of the actuator times its arm, at the coordinate that the curvature asks for | N·m |
//! | G | moment of the loads across the body on the shape that is held | N·m |
//!
//! A curvature that the actuator cannot reach under pressure (its stroke ends, or its fabric would have to stretch) has
//! no such moment: it is NaN there.

use crate::assembly::Segment;
use crate::error::Solved;
use crate::follow::{Each, Step};
use crate::model::{Model, Prediction};
use crate::robot::{HeldCurvatures, bend};
use crate::scenario::{Scenario, Span};
use crate::term::Loads;

impl Model {
    /// A scenario put together with the body cut at stations \[m\] too: each piece between two cuts is one segment, which can be
    /// held at its own curvature.
    pub fn in_pieces(scenario: &Scenario, stations_m: &[f64]) -> Model {
        let spans = scenario.spans();
        Model::with_segments(scenario, &spans, Some(pieces(&spans, stations_m)))
    }

    /// Pieces that can be held, base to tip.
    pub fn segments(&self) -> &[Segment] {
        &self.assembly().segments
    }

    /// Whether a piece has an actuator.
    pub fn is_active(&self, segment: usize) -> bool {
        self.assembly().sites[self.segments()[segment].site].actuator.is_some()
    }

    /// Markers and tip of the shape of a planar robot with these curvatures \[1/m\], one per segment; nothing has to balance.
    pub fn bend(&self, loads: &Loads, curvatures: &[f64], out: &mut Prediction) {
        self.supply(loads, &mut out.work);
        bend(self.assembly(), self.body_pa(loads, &out.work), &mut out.work, curvatures);
        self.show(out);
    }

    /// Walks a protocol as [`Model::follow`] does, the robot held at given curvatures in every step \[1/m\], one per segment;
    /// what remembers, remembers these. [`Prediction::missing_moments`] gives the moments that would have to be added.
    ///
    /// ```
    /// use models::{Loads, Model, Scenario, Step, shipped};
    /// let robot = Scenario::parse(shipped("epam-textbook").unwrap()).unwrap().with_bending(1.0);
    /// // A robot with 0.2 N·m less than the model knows, seen by that model.
    /// let real = Model::new(&robot.with_effect("tail_tension", &[0.2]));
    /// let steps = [Step { t_s: 0.0, loads: Loads::uniform(2e3, 20e3) }];
    /// let mut bent = Vec::new();
    /// let keep = &mut |_: usize, at: &models::Prediction| bent.push(real.states(at).iter().map(|s| s.curvature).collect());
    /// real.follow(&steps, &mut real.prediction(), keep).unwrap();
    /// let model = Model::new(&robot);
    /// let mut state = model.prediction();
    /// model.hold(&steps, &bent, &mut state, &mut |_, at| assert!((at.missing_moments()[0] + 0.2).abs() < 1e-6)).unwrap();
    /// ```
    ///
    /// # Errors
    /// A pressure or a time that is negative or not finite.
    pub fn hold(&self, steps: &[Step], curvatures: &[Vec<f64>], out: &mut Prediction, each: Each) -> Solved {
        self.planar("holding a robot at curvatures")?;
        out.work.held.missing = vec![0.0; self.segments().len()];
        let walked = self.walk(steps, Some(curvatures), out, each);
        out.work.held = HeldCurvatures::default();
        walked
    }
}

impl Prediction {
    /// Moment per segment that would have to be added to the moments of the model's terms for it to rest where it is held
    /// ([`Model::hold`]) \[N·m\]; positive bends towards the actuator. NaN where the actuator cannot have this curvature.
    pub fn missing_moments(&self) -> &[f64] {
        &self.work.held.missing
    }
}

/// Stretches shorter than this are two cuts meant to be one \[m\].
const MERGE_BELOW_M: f64 = 1e-6;

fn pieces(spans: &[Span], stations_m: &[f64]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (site, span) in spans.iter().enumerate() {
        let end_m = span.start_m + span.length_m;
        let inside = |s: &&f64| **s > span.start_m + MERGE_BELOW_M && **s < end_m - MERGE_BELOW_M;
        let mut cuts: Vec<f64> = stations_m.iter().filter(inside).copied().collect();
        cuts.extend([span.start_m, end_m]);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let piece = |pair: &[f64]| Segment { site, start_m: pair[0], length_m: pair[1] - pair[0] };
        segments.extend(cuts.windows(2).map(piece));
    }
    segments
}
