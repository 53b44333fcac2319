//! From a scenario to the parts of a model.

use crate::actuators::ActuatorShape;
use crate::assembly::{Assembly, Segment};
use crate::body::{BodyLaw, BodyPressure, BodyWall, WallBending};
use crate::effects::EFFECTS;
use crate::scenario::{Scenario, Span};
use crate::site::{LineShortening, Linkage, Site};
use crate::term::CHANNELS;

pub(crate) fn assemble(scenario: &Scenario, spans: &[Span], segments: usize) -> Assembly {
    let mut sites: Vec<Site> = spans.iter().map(|span| site(scenario, span)).collect();
    // Where strips begin and end is stated for the robot as it is, whatever length it is given here.
    let own = scenario.spans();
    for strip in &scenario.more_strips {
        sites.extend(own.iter().map(|span| site(scenario, &span.of_strip(strip, scenario.radius_m))));
    }
    let segments = divide(spans, segments);
    let axes = if scenario.is_spatial() { 3 } else { 2 };
    Assembly { sites, segments, axes, ..Assembly::empty(scenario.gravity_direction) }
}

fn site(scenario: &Scenario, span: &Span) -> Site {
    let shape: ActuatorShape = span.shape;
    let linkage = Linkage {
        active_fraction: 1.0,
        stroke_fraction: 1.0,
        arm_m: span.arm_m,
        arm_growth: 0.0,
        compliance_per_n: 0.0,
        section: None,
    };
    let pressure = BodyPressure {
        radius_m: span.radius_m,
        hinge_curvature: scenario.hinge_curvature,
        share: scenario.hinge_share,
    };
    let bending = WallBending { stiffness: span.bending_stiffness };
    debug_assert!(span.channel < CHANNELS);
    let mut site = Site::new(span.radius_m, pressure, bending, linkage, span.actuator, shape, span.channel);
    site.centre_line = LineShortening::new(span.centre_line_m, scenario.hinge_curvature);
    site.wall_shear_n_per_m = scenario.wall.shear_n_per_m;
    if let Some(stiffness_n_per_m) = scenario.wall.stiffness_n_per_m {
        let wall = BodyWall { radius_m: span.radius_m, stiffness_n_per_m, share: scenario.hinge_share };
        site.body_pressure = BodyLaw::Wall(wall);
    }
    site
}

/// Segment that holds a station, and the distance from its start; the last segment takes stations beyond the tip.
pub(crate) fn locate(segments: &[Segment], station_m: f64) -> (usize, f64) {
    let index = segments.iter().rposition(|s| s.start_m <= station_m).unwrap_or(0);
    (index, station_m - segments[index].start_m)
}

/// Adds the effects of a scenario to a model under construction, in the order of the catalogue: geometry before the terms that read it.
pub(crate) fn add_effects(scenario: &Scenario, assembly: &mut Assembly) {
    for (place, chosen) in scenario.effects_in_order() {
        match (EFFECTS.get(place), scenario.formulas.get(place.saturating_sub(EFFECTS.len()))) {
            (Some(effect), _) => (effect.add)(&chosen.values, assembly),
            (None, Some(formula)) => formula.add(&chosen.values, assembly),
            (None, None) => {}
        }
    }
}

/// Every span in about `total · length/whole` equal segments, at least one.
pub(crate) fn divide(spans: &[Span], total: usize) -> Vec<Segment> {
    let whole: f64 = spans.iter().map(|s| s.length_m).sum();
    let mut segments = Vec::new();
    for (site, span) in spans.iter().enumerate() {
        let count = ((total as f64 * span.length_m / whole).round() as usize).max(1);
        let length_m = span.length_m / count as f64;
        for i in 0..count {
            segments.push(Segment { site, start_m: span.start_m + i as f64 * length_m, length_m });
        }
    }
    segments
}
