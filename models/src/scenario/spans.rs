//! The body cut into stretches of equal design.

use super::choice::ActuatorChoice;
use super::stated::{Scenario, Zone};
use crate::actuators::{Actuator, ActuatorShape};

/// Stretch of the body with the same design everywhere in it.
#[derive(Debug, Clone, Copy)]
pub struct Span {
    /// Station at which it starts along the undeformed body \[m\].
    pub start_m: f64,
    /// Length along the undeformed body \[m\].
    pub length_m: f64,
    /// Radius R of the inflated body there \[m\].
    pub radius_m: f64,
    /// Distance of the centre line from the taut generator \[m\].
    pub centre_line_m: f64,
    /// Effective bending stiffness B there \[N·m²\].
    pub bending_stiffness: f64,
    /// Kind of the actuator there; `None` on a passive stretch.
    pub actuator: Option<&'static Actuator>,
    /// Dimensions of one actuator unit there.
    pub shape: ActuatorShape,
    /// Arm from the taut generator \[m\].
    pub arm_m: f64,
    /// Supply channel that fills the actuator there.
    pub channel: usize,
}

/// Stretches shorter than this are rounding of two boundaries meant to be one \[m\].
const MERGE_BELOW_M: f64 = 1e-9;

impl Scenario {
    /// Stretches of equal design, base to tip.
    pub fn spans(&self) -> Vec<Span> {
        cuts(self).windows(2).map(|pair| span(self, pair[0], pair[1])).collect()
    }
}

fn active(strip: &ActuatorChoice, radius_m: f64) -> (f64, f64) {
    (strip.start_m, strip.start_m + strip.covered_m(radius_m))
}

impl Span {
    /// The same stretch where another strip passes it.
    pub(crate) fn of_strip(&self, strip: &ActuatorChoice, radius_m: f64) -> Span {
        let (from, to) = active(strip, radius_m);
        let middle = self.start_m + 0.5 * self.length_m;
        Span {
            actuator: (from < middle && middle < to).then_some(strip.kind),
            shape: strip.shape,
            arm_m: strip.arm_m.unwrap_or_else(|| (strip.kind.arm)(self.radius_m, &strip.shape)),
            channel: strip.channel,
            ..*self
        }
    }
}

fn cuts(scenario: &Scenario) -> Vec<f64> {
    let mut cuts = vec![0.0, scenario.length_m];
    cuts.extend(scenario.strips().flat_map(|strip| <[f64; 2]>::from(active(strip, scenario.radius_m))));
    cuts.extend(scenario.zones.iter().flat_map(|z| [z.from_m, z.to_m]));
    cuts.retain(|c| *c <= scenario.length_m + MERGE_BELOW_M);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < MERGE_BELOW_M);
    // The body's own end wins over a boundary that differs from it by rounding.
    if let Some(last) = cuts.last_mut() {
        *last = scenario.length_m;
    }
    cuts
}

fn span(scenario: &Scenario, start_m: f64, end_m: f64) -> Span {
    let middle = 0.5 * (start_m + end_m);
    let inside = |from: f64, to: f64| from < middle && middle < to;
    let a = &scenario.actuator;
    let (from, to) = active(a, scenario.radius_m);
    let mut radius_m = scenario.radius_m;
    let mut arm_m = a.arm_m;
    let mut built = Span {
        start_m,
        length_m: end_m - start_m,
        radius_m,
        centre_line_m: 0.0,
        bending_stiffness: scenario.bending_stiffness,
        actuator: inside(from, to).then_some(a.kind),
        shape: a.shape,
        arm_m: 0.0,
        channel: a.channel,
    };
    for zone in scenario.zones.iter().filter(|z| inside(z.from_m, z.to_m)) {
        override_span(&mut built, zone, a.kind);
        radius_m = zone.radius_m.unwrap_or(radius_m);
        arm_m = zone.arm_m.or(arm_m);
    }
    built.radius_m = radius_m;
    built.centre_line_m = scenario.centre_line_m.unwrap_or(radius_m);
    built.arm_m = arm_m.unwrap_or_else(|| (a.kind.arm)(radius_m, &built.shape));
    built
}

fn override_span(span: &mut Span, zone: &Zone, kind: &'static Actuator) {
    span.bending_stiffness = zone.bending_stiffness.unwrap_or(span.bending_stiffness);
    span.channel = zone.channel.unwrap_or(span.channel);
    span.shape.length_m = zone.unit_length_m.unwrap_or(span.shape.length_m);
    span.shape.width_m = zone.width_m.unwrap_or(span.shape.width_m);
    span.shape.fold_m = zone.fold_m.unwrap_or(span.shape.fold_m);
    match zone.passive {
        Some(true) => span.actuator = None,
        Some(false) => span.actuator = Some(kind),
        None => {}
    }
}
