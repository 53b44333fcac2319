//! Growth by eversion at the tip: pressures at which it starts and halts, speed, longest length; and retraction by the tail.
//!
//! ```text
//! tip         ½ P A = Y + T(ℓ) + C(v)         C from v = v₁ (C/1 N)ⁿ: the tip moves dx, the tail 2 dx
//! tail        dT/dx = μ (|κ| T + w sin ψ) − w cos ψ         T(0) = T₀, T ≥ 0, along its own motion
//! retraction  T(ℓ) = ½ P A + Y_b         and friction the other way: the base pulls with the largest tension
//! section     wall and pulls carry p_b A − T and M + T e (`models/src/statics.rs`)
//! column      T < π² EI/ℓ² / (1 + π² EI/(ℓ² K)),   EI = B + π R³ E t,   K = πR²p_b + πR G t
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P, A, ℓ | body pressure, area of the tube at its tip, length grown | Pa, m², m |
//! | Y, Y_b | force that turns the wall inside out, in motion and from rest | N |
//! | T, T₀ | tension of the tail, and at the base | N |
//! | μ, w, ψ | friction, weight of the tail per length, angle of the tail's motion to gravity | -, N/m, rad |
//! | e | distance of the taut tail from the axis: to the line from base to tip, at most R | m |
//!
//! The pull of the tail goes through the base, so the column carries π² EI/ℓ² as one with two pinned ends, not a quarter of it.
//! Without the effect `gravity` the robot bends in a horizontal plane, ψ = π/2. Friction of weight and of bends is added: at
//! most √2 too much where the weight is across the plane of the bend, and more where it pulls the tail off the inner side.
//!
//! **Validity**: planar robots, inextensible thin tail, quasi-static. **Left out**: what the tail's tension does to the bend, contact
//! with surroundings, the thickness of the tail, a shorter tail on the inner side of a bend, pressure lost to leaks and to flow.
//! A unit that is everted in part bends as the others. The sum of terms at the tip is published (Hawkes et al. 2017; Blumenschein et al.
//! 2017), and so is buckling in retraction (Coad et al. 2020). Derived here.

use crate::assemble::divide;
use crate::assembly::Segment;
use crate::error::{Solved, Unsolved};
use crate::model::{Model, Prediction};
use crate::root::halved;
use crate::scenario::{Growth, Scenario, Span};
use crate::term::Loads;
use crate::tip_stiffness::GAUSS;
use serde::Serialize;
use spelling::si;
use std::f64::consts::PI;

/// A stretch of the tail's path with one curvature, in the direction of its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TailArc {
    /// Length of the stretch \[m\].
    pub length_m: f64,
    /// Change of heading over it \[rad\].
    pub turn_rad: f64,
    /// Heading where the tail enters it \[rad\].
    pub heading_rad: f64,
    /// Unit vector of gravity in the plane of the headings; `None`: across it.
    pub gravity: Option<[f64; 2]>,
}

impl TailArc {
    /// The same stretch, passed from its end to its start.
    fn backwards(self) -> TailArc {
        TailArc { turn_rad: -self.turn_rad, heading_rad: self.heading_rad + self.turn_rad + PI, ..self }
    }

    /// Tension per length that weight adds at a heading, over w.
    fn of_weight(&self, friction: f64, heading_rad: f64) -> f64 {
        let Some([x, y]) = self.gravity else { return friction };
        let along = x * heading_rad.cos() + y * heading_rad.sin();
        friction * (1.0 - along * along).max(0.0).sqrt() - along
    }
}

/// Fewest sections along the robot, at whose middle the tail's place is taken.
const SECTIONS: usize = 60;
/// Halvings of the factor of the tensions at which a section folds.
const HALVINGS: usize = 12;
/// Longest piece of an arc for the quadrature, as turn times (1 + μ): exact to rounding.
const PIECE: f64 = 0.5;

impl Growth {
    /// Tension of the tail where it leaves an arc \[N\]: `T e^{μ|φ|}` and what its weight adds, never below zero.
    ///
    /// ```
    /// use models::{TailArc, scenario::Growth};
    /// let tube = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\n[growth]\ntip_force_n = 2\nfriction = 0.3";
    /// let growth = models::Scenario::parse(tube).unwrap().growth.unwrap();
    /// let quarter = TailArc { length_m: 1.0, turn_rad: 1.5708, heading_rad: 0.0, gravity: None };
    /// assert!((growth.behind(&quarter, 2.0) - 2.0 * f64::exp(0.3 * 1.5708)).abs() < 1e-12);
    /// ```
    pub fn behind(&self, arc: &TailArc, tension_n: f64) -> f64 {
        let (mu, weight) = (self.friction, self.tail_weight_n_per_m);
        let count = (arc.turn_rad.abs() * (1.0 + mu) / PIECE).ceil().max(1.0);
        let (length_m, turn) = (arc.length_m / count, arc.turn_rad / count);
        (0..count as usize).fold(tension_n, |tension_n, piece| {
            let added = GAUSS.iter().map(|(point, share)| {
                let x = 0.5 + 0.5 * point;
                let of_weight = arc.of_weight(mu, arc.heading_rad + turn * (piece as f64 + x));
                0.5 * share * of_weight * (mu * turn.abs() * (1.0 - x)).exp()
            });
            (tension_n * (mu * turn.abs()).exp() + weight * length_m * added.sum::<f64>()).max(0.0)
        })
    }

    /// Steady speed of the tip at a driving force ½ P A and a tension of the tail there \[m/s\]. From rest it is 0 up to the
    /// break-away force, in motion up to the halt. `None` without `speed_at_1n_m_per_s`.
    pub fn speed_m_per_s(&self, driving_n: f64, tail_n: f64, is_moving: bool) -> Option<f64> {
        let beyond_n = |resistance_n: f64| driving_n - tail_n - resistance_n;
        let starts = is_moving || beyond_n(self.break_away_n) >= 0.0;
        let force_n = if starts { beyond_n(self.tip_force_n).max(0.0) } else { 0.0 };
        self.speed_at_1n_m_per_s.map(|speed| speed * force_n.powf(self.exponent))
    }

    /// Tensions behind each of the arcs \[N\].
    fn tensions(&self, arcs: impl Iterator<Item = TailArc>, first_n: f64) -> Vec<f64> {
        let mut tension_n = first_n;
        let next = |arc| {
            tension_n = self.behind(&arc, tension_n);
            tension_n
        };
        arcs.map(next).collect()
    }
}

/// What happens when the tail is pulled back at the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Retraction {
    /// The tip inverts before the body folds or buckles.
    Possible,
    /// A section folds first: the tail takes more than gas and wall carry there.
    Folds,
    /// The body buckles as a column first.
    Buckles,
    /// No section folds; buckling needs the stiffness of the wall, which the scenario lacks.
    Unknown,
}

/// A robot that has grown to a length, at its body pressure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Grown {
    /// Length grown \[m\].
    #[serde(rename = "length_mm", serialize_with = "si::mm")]
    pub length_m: f64,
    /// Turn of the tail on its way, all bends added \[rad\].
    #[serde(rename = "turn_deg", serialize_with = "si::deg")]
    pub turn_rad: f64,
    /// Tension of the tail at the tip while it grows \[N\].
    pub tail_n: f64,
    /// Body pressure at and below which it halts, with the bend at the present pressure \[Pa\].
    #[serde(rename = "halts_kpa", serialize_with = "si::kpa")]
    pub halts_pa: f64,
    /// Body pressure at which it starts from rest \[Pa\].
    #[serde(rename = "starts_kpa", serialize_with = "si::kpa")]
    pub starts_pa: f64,
    /// Whether a tip in motion goes on at the present pressure.
    pub grows: bool,
    /// Steady speed of the moving tip \[m/s\], 0 where it halts; null without a measured speed.
    #[serde(rename = "speed_mm_per_s", serialize_with = "si::mm")]
    pub speed_m_per_s: Option<f64>,
    /// Station of the section that folds while it grows \[m\]; null: none.
    #[serde(rename = "growing_folds_mm", serialize_with = "si::mm")]
    pub growing_folds_m: Option<f64>,
    /// Pull at the base that inverts the tip from rest \[N\].
    pub retraction_n: f64,
    /// Pull at which the body buckles as a column \[N\]; null without a stiffness of the wall.
    pub buckling_n: Option<f64>,
    /// What that pull does.
    pub retraction: Retraction,
    /// Station of the section that folds first while the pull rises \[m\]; null: none.
    #[serde(rename = "retraction_folds_mm", serialize_with = "si::mm")]
    pub retraction_folds_m: Option<f64>,
}

/// State of a robot that has grown to a length, at pressures of body and actuators.
///
/// # Errors
/// As [`Model::predict`]; strips round the body; a length that is not above 0 and at most the robot's.
pub fn grown(scenario: &Scenario, growth: &Growth, loads: &Loads, length_m: f64) -> Solved<Grown> {
    if scenario.is_spatial() {
        return Err(Unsolved::InSpace { subject: "growth" });
    }
    if !(length_m > 0.0 && length_m <= scenario.length_m) {
        return Err(Unsolved::BadAim { what: "a grown length is above 0 and at most the length of the robot" });
    }
    let segments = scenario.segments.max(SECTIONS);
    let part = Scenario { length_m, segments, markers_m: Vec::new(), ..scenario.clone() };
    let spans = part.spans();
    let model = Model::without_starts(&part, &spans, Some(divide(&spans, segments)));
    let mut at = model.prediction();
    model.predict(loads, &mut at)?;
    let arcs = tail_arcs(&part, &model, &at);
    let p_body_pa = model.body_pa(loads, &at.work);
    let area_m2 = spans.last().map_or(0.0, |span| PI * span.radius_m.powi(2));
    let driving_n = 0.5 * p_body_pa * area_m2;

    let forth = growth.tensions(arcs.iter().copied(), growth.base_tension_n);
    let tail_n = forth.last().copied().unwrap_or(growth.base_tension_n);
    let first_n = driving_n + growth.break_away_n;
    let mut back = growth.tensions(arcs.iter().rev().map(|arc| arc.backwards()), first_n);
    back.reverse();
    let retraction_n = back.first().copied().unwrap_or(first_n);

    let folds = |tensions: &[f64]| fold_m(&model, loads, &at, tensions);
    let (retraction_folds_m, buckling_n) = (folds(&back), column_n(&part, p_body_pa));
    let retraction = match (retraction_folds_m, buckling_n) {
        (Some(_), _) => Retraction::Folds,
        (None, None) => Retraction::Unknown,
        (None, Some(column_n)) if retraction_n < column_n => Retraction::Possible,
        _ => Retraction::Buckles,
    };
    Ok(Grown {
        length_m,
        turn_rad: arcs.iter().map(|arc| arc.turn_rad.abs()).sum(),
        tail_n,
        halts_pa: 2.0 * (growth.tip_force_n + tail_n) / area_m2,
        starts_pa: 2.0 * (growth.break_away_n + tail_n) / area_m2,
        grows: driving_n > growth.tip_force_n + tail_n,
        speed_m_per_s: growth.speed_m_per_s(driving_n, tail_n, true),
        growing_folds_m: folds(&forth),
        retraction_n,
        buckling_n,
        retraction,
        retraction_folds_m,
    })
}

fn tail_arcs(scenario: &Scenario, model: &Model, at: &Prediction) -> Vec<TailArc> {
    let [x, y, _] = scenario.gravity_direction;
    let gravity = scenario.effects.iter().any(|effect| effect.name == "gravity").then_some([x, y]);
    let arc = |((segment, curvature), heading_rad): ((Segment, f64), &f64)| {
        let length_m = segment.length_m;
        TailArc { length_m, turn_rad: curvature * length_m, heading_rad: *heading_rad, gravity }
    };
    model.curvatures(at).zip(&at.work.headings).map(arc).collect()
}

/// Middle of the segment that folds first while the tail's tensions rise together to these; `None` if no segment does \[m\].
fn fold_m(model: &Model, loads: &Loads, at: &Prediction, tensions: &[f64]) -> Option<f64> {
    let worst = |factor: f64| {
        let share =
            |(i, n): (usize, &f64)| (i, model.carried_share(loads, at, i, [factor * n, tail_at_m(model, at, i)]));
        tensions.iter().enumerate().rev().map(share).max_by(|a, b| a.1.total_cmp(&b.1))
    };
    // Written so that NaN counts as a fold.
    let is_within = |factor: f64| worst(factor).is_none_or(|(_, share)| share < 1.0);
    if is_within(1.0) {
        return None;
    }
    let first = halved([0.0, 1.0], HALVINGS, is_within)[1];
    worst(first).map(|(i, _)| model.assembly().segments[i].middle_m())
}

/// Distance of a taut tail from the axis in the middle of a segment, towards the actuator \[m\].
fn tail_at_m(model: &Model, at: &Prediction, index: usize) -> f64 {
    let assembly = model.assembly();
    let radius_m = assembly.site(index).radius_m;
    let [x, y, _] = model.point(&at.work, index, 0.5 * assembly.segments[index].length_m);
    let (along, across) = (at.tip.x_m, at.tip.y_m);
    let chord_m = along.hypot(across);
    // Base and tip of a closed ring meet: the tail is on the inner side.
    if chord_m < radius_m && assembly.length_m() > PI * radius_m {
        return radius_m.copysign(at.work.states[index].curvature);
    }
    ((across * x - along * y) / chord_m).clamp(-radius_m, radius_m)
}

/// Pull through base and tip at which a straight body buckles in its weakest stretch \[N\].
fn column_n(scenario: &Scenario, p_body_pa: f64) -> Option<f64> {
    let wall = &scenario.wall;
    let of = |span: &Span| {
        let r = span.radius_m;
        let stiffness = span.bending_stiffness + PI * r.powi(3) * wall.stiffness_n_per_m.unwrap_or(0.0);
        let euler_n = stiffness * (PI / scenario.length_m).powi(2);
        let per_shear = wall.shear_n_per_m.map_or(0.0, |shear| 1.0 / (PI * r * (r * p_body_pa + shear)));
        (stiffness > 0.0).then_some(euler_n / (1.0 + euler_n * per_shear))
    };
    scenario.spans().iter().map(of).try_fold(f64::INFINITY, |least, n| Some(least.min(n?)))
}

/// Lengths that are tried, and relative width to which one is narrowed.
const STEPS: usize = 40;
const NARROW: f64 = 1e-6;

/// First length at which a grown robot `fails`; one without an equilibrium does. The robot's own where none does.
fn first_m(scenario: &Scenario, growth: &Growth, loads: &Loads, fails: impl Fn(&Grown) -> bool) -> Solved<f64> {
    let whole_m = scenario.length_m;
    let at = |length_m: f64| grown(scenario, growth, loads, length_m);
    let fails = |length_m: f64| match at(length_m) {
        Err(error @ (Unsolved::InSpace { .. } | Unsolved::BadPressure { .. })) => Err(error),
        found => Ok(found.map_or(true, |grown| fails(&grown))),
    };
    let mut low = 0.0;
    for step in 1..=STEPS {
        let mut high = whole_m * step as f64 / STEPS as f64;
        if fails(high)? {
            while high - low > NARROW * whole_m {
                let middle = 0.5 * (low + high);
                if fails(middle)? { high = middle } else { low = middle }
            }
            return Ok(low);
        }
        low = high;
    }
    Ok(whole_m)
}

/// Length to which a moving robot grows at these pressures: there it halts or folds, or the tube ends \[m\].
///
/// Straight, with w across the motion, it is (½ P A − Y − T₀)/(μ w); in a bend of radius ρ without weight ρ ln((½ P A − Y)/T₀)/μ.
///
/// # Errors
/// Strips round the body, a pressure out of its bounds.
pub fn longest_grown_m(scenario: &Scenario, growth: &Growth, loads: &Loads) -> Solved<f64> {
    first_m(scenario, growth, loads, |grown| !grown.grows || grown.growing_folds_m.is_some())
}

/// Length up to which the tail retracts the robot without a fold and without buckling \[m\]; errors as [`longest_grown_m`].
///
/// Straight, without weight, it is π √(EI (1/T − 1/K)), T = ½ P A + Y_b.
pub fn longest_retractable_m(scenario: &Scenario, growth: &Growth, loads: &Loads) -> Solved<f64> {
    let fails = |grown: &Grown| matches!(grown.retraction, Retraction::Folds | Retraction::Buckles);
    first_m(scenario, growth, loads, fails)
}

#[cfg(test)]
#[path = "growth_tests.rs"]
mod tests;
