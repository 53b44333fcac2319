//! Strips of actuators round the body: a bend with a direction, and a body that shortens without bending.
//!
//! A section has three unknowns: the bend κ = (κ_y, κ_z) and the contraction ε₀ of the axis. Azimuth 0 is y, and azimuths turn from
//! y to z. Inextensible fabric lets no generator lengthen, so ε₀ ≥ R|κ|. A strip at azimuth θ, b from the axis, shortens by
//!
//! ```text
//! ε = cos²β (ε₀ + b κ·e)        e = (cos θ, sin θ),  b = D − R,  tan β = R dθ/ds
//! U(κ, ε₀) = p_b (A ε₀ + m·κ) + ½ B|κ|² + Σ U_i(ε)/cos β − M·κ − f ε        minimal, with ε₀ ≥ R|κ|
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D, R | arm of the strip from the far side, body radius | m |
//! | β | slant of a helical strip to the axis | rad |
//! | U_i | energy of the actuator per metre of strip: the terms of its [`Site`] | J/m |
//! | A, m | area of the section, and its first moment about the axis: strips that draw the wall in take of both | m², m³ |
//! | M, f | generalised forces of outer loads, per length, on κ and on the contraction ε of the centre line: `loaded.rs` | N·m, N |
//! | B | bending stiffness | N·m² |
//!
//! Where one strip pulls, ε₀ = R|κ|: the generator opposite to the bend is taut, ε = κD, and this is the planar balance. Where strips
//! pull more than p_b A together, nothing is taut: the body shortens. Two equal strips at 180° do so, and each
//! resists the other.
//!
//! Outer loads are dead forces F_k on the nodes x_k. M and f are minus the slopes of −Σ F_k·x_k, so the shape and the bends are found
//! together. The wall alone carries |M| ≤ p_b A R, less with a force that pushes along the body; beyond, B does. Without B
//! nothing does: no equilibrium.
//!
//! **Validity**: U is convex as long as the pull of a strip falls with its contraction, so there is one minimum. Each actuator's own
//! terms see the bend ε/D that its contraction would make alone. The body does not twist, whatever moment the loads have along it. A
//! bend has no shear. `hinge_curvature_per_m` softens the wall's step at κ = 0 in sections without open strips (`passive.rs`) and in
//! those with one upright strip alone, loaded in its plane; in others the step is sharp. A section with such a strip has the planar
//! balance, in which the generator opposite stays taut even where the strip pulls harder than p_b A. Derived here.

mod energies;
mod frame;
mod lever;
mod loaded;
mod loaded_section;
#[cfg(test)]
mod loaded_tests;
mod passive;
mod pulls;
mod section;
#[cfg(test)]
mod section_tests;
mod state;
mod strips;
#[cfg(test)]
mod tests;
mod tip;

use crate::assembly::{Assembly, Segment, Strip};
use crate::body::BodyLaw;
pub use crate::effects::IN_SPACE;
use crate::error::{Solved, Unsolved};
use crate::scenario::ActuatorChoice;
use crate::site::{Site, SiteState};
pub use frame::Frame;
pub(crate) use frame::{Bend, SpaceStretch, direction};
pub(crate) use lever::{Matrix, cross, inverse, of_each, outer, times};
pub(crate) use section::StripSection;
pub use state::{SectionState, StripState};
pub(crate) use state::{SpaceWork, place, stretch};
pub(crate) use tip::tip_compliance;

/// Strips of every segment; `spans` sites per strip, in the order of the strips.
pub(crate) fn around(strips: &[ActuatorChoice], radius_m: f64, spans: usize, segments: &[Segment]) -> Vec<Vec<Strip>> {
    let strip = |segment: &Segment, (i, choice): (usize, &ActuatorChoice)| Strip {
        site: i * spans + segment.site,
        azimuth_rad: choice.azimuth_at(radius_m, segment.middle_m()),
        cos_slant: choice.cos_slant(radius_m),
    };
    segments.iter().map(|segment| strips.iter().enumerate().map(|s| strip(segment, s)).collect()).collect()
}

/// Equilibrium of every section, at the strips' pressures in `work`; `states` get the size of each bend.
pub(crate) fn equilibrium(
    assembly: &Assembly,
    p_body_pa: f64,
    work: &mut SpaceWork,
    states: &mut [SiteState],
) -> Solved {
    refuse_the_rest(assembly)?;
    unloaded(assembly, p_body_pa, work)?;
    if !assembly.node_terms.is_empty() {
        loaded::equilibrium(assembly, p_body_pa, work)?;
    }
    for (state, bend) in states.iter_mut().zip(&work.bends) {
        state.curvature = bend.size();
    }
    Ok(())
}

/// Equilibrium of every section without loads.
fn unloaded(assembly: &Assembly, p_body_pa: f64, work: &mut SpaceWork) -> Solved {
    for i in 0..assembly.segments.len() {
        let alike = i > 0 && same_section(assembly, work, i);
        if alike {
            let (before, after) = work.strips.split_at_mut(i);
            after[0].copy_from_slice(&before[i - 1]);
            work.bends[i] = work.bends[i - 1];
        } else {
            let section = StripSection::new(assembly, i, p_body_pa);
            work.bends[i] = section.solve(&mut work.strips[i])?;
        }
    }
    Ok(())
}

/// Refuses parts of a model that the sections do not see.
fn refuse_the_rest(assembly: &Assembly) -> Solved {
    let any = |has: fn(&Site) -> bool| assembly.sites.iter().any(has);
    let refused = [
        (assembly.springs, "a spring at the tip"),
        (!assembly.camera.is_empty(), "an effect of the camera"),
        (any(|site| !site.body_terms.is_empty()), "an effect on the bend of the body"),
        (any(|site| site.linkage.section.is_some()), "a section that changes as it bends"),
        (any(|site| !matches!(site.body_pressure, BodyLaw::Hinge(_))), "a wall that stretches"),
    ];
    refused.iter().try_for_each(|(is_there, subject)| match is_there {
        true => Err(Unsolved::InSpace { subject }),
        false => Ok(()),
    })
}

/// Whether a segment has the design, azimuths and pressures of the one before.
fn same_section(assembly: &Assembly, work: &SpaceWork, i: usize) -> bool {
    assembly.around[i] == assembly.around[i - 1]
        && work.strips[i].iter().zip(&work.strips[i - 1]).all(|(a, b)| a.p_act_pa == b.p_act_pa)
}
