//! The robots: from a scenario of the reduced model and its actuator's sewing pattern to a finite element problem.
//!
//! The body is a cylinder along x, its base ring pinned at x = 0, a flat cap at the tip; the actuator is on the side of
//! +y, so that the robot bends towards +y, or at the azimuths of the scenario's strips. The actuator's sheet is meshed panel by panel
//! over the same grid lines, layers `layer_gap_m` apart; welds are shared nodes.
//!
//! | part | what | chambers (front, back) |
//! |---|---|---|
//! | `wall`, `tip_cap` | the body | –, body |
//! | `face` | the wall under the pouches, with the sheets stuck to it | actuator, body |
//! | `margin` | the wall with the taped sheet beyond its welds stuck to it | –, body |
//! | `seam_2`, `seam_4` … | welds with a width: so many layers | –, body |
//! | by the pattern: `top`, `gusset_1_left` … | the sheet | –, actuator |
//! | `face_2`, `top_2` … | the parts of the second strip | actuator_2, … |
//!
//! | set | nodes |
//! |---|---|
//! | `base` | pinned ring; with `encastre` the row next to it is held too |
//! | `tip`, `marker_1` … | rings of the body at its end and at (or next to) the scenario's stations |
//! | `far_generator` | the taut line opposite the actuator of a robot with one strip along y |
//!
//! Where elements around are of one size, the mean of a ring is the centre line; [`sections`] gives it for any mesh.

mod assumed;
mod inflated;
mod keys;
mod lines;
mod loading;
mod loads;
mod plies;
mod reading;
mod rest;
mod seams;
mod settings;
mod sew;
mod snaps;
mod table;
mod waviness;

pub use assumed::{ASSUMED, Assumed, ValueSpacing, hypercube, latin};
pub use inflated::InflatedPouch;
pub use keys::{KEYS, NUMERICAL, OTHERS};
pub use loading::{HoldEnd, Load, RobotRun, RobotStart};
pub use reading::Reading;
pub(crate) use reading::RobotGauge;
pub use rest::Rest;
pub(crate) use rest::Settling;
pub use seams::{SeamForce, Seams};
pub use settings::{Preset, RobotSettings};
pub(crate) use snaps::Watch;
pub use snaps::{Sample, Snap, snaps};
pub use table::with_fem;

use models::Scenario;
use models::actuators::pattern::Pattern;
use models::scenario::ActuatorChoice;

use crate::case::{Outputs, encastre};
use crate::mesh::check::check_open;
pub use crate::output::centre_line::CentreLine;
use crate::output::picture::Viewpoint;
use crate::policy;
use crate::problem::{Amplitude, Chamber, Contact, Guards, MassScaling, Patience, Settings, Support};
use crate::run;
use crate::sheet::reference::mean_stiffness;
use crate::vec3::{area, norm, where_so};
use crate::{FemError, Mesh, Problem, Result};
use lines::GridLines;
use plies::Plies;

/// Mass damping over ω of [`Settling`]: half of the critical damping of the ePAM, whose tip then overshoots by a sixth.
const DAMPING: f64 = 1.4;

/// The robot of a scenario as a problem, ready to run.
///
/// # Errors
/// [`FemError::Problem`] with the number that is wrong: a pattern that cannot be sewn on this body, a pressure below the
/// body's, a marker off the robot, elements too large for the pouch; [`FemError::Mesh`] if the mesh is not fit to run.
///
/// ```
/// let scenario = models::Scenario::parse(models::shipped("epam").unwrap()).unwrap();
/// let problem = fem::robot::problem(&scenario, &fem::robot::RobotSettings::default())?;
/// assert_eq!(problem.chambers.len(), 2);
/// # Ok::<(), fem::FemError>(())
/// ```
pub fn problem(scenario: &Scenario, settings: &RobotSettings) -> Result<Problem> {
    let bias = scenario.actuator.shape.bias_rad;
    if bias != models::actuators::BIAS {
        let message = format!(
            "a muscle with yarns at +{0:.1} and -{0:.1} degrees cannot be cut from a weave; write bias_deg = 45 or leave it out",
            bias.to_degrees()
        );
        return Err(FemError::Problem(message));
    }
    let pattern = |strip: &ActuatorChoice| {
        let pattern = (strip.kind.pattern)(&strip.shape);
        if settings.taped_at_seams && pattern.is_taped() { pattern.taped_at_seams() } else { pattern }
    };
    sewn(scenario, &scenario.strips().map(pattern).collect::<Vec<_>>(), settings)
}

/// A robot that comes with the program, by name, and its problem.
///
/// # Errors
/// [`FemError::Problem`] for a name that `models::shipped` does not know; else like [`problem`].
pub fn shipped(name: &str, settings: &RobotSettings) -> Result<(Scenario, Problem)> {
    let text = models::shipped(name).ok_or_else(|| FemError::Problem(format!("unknown scenario `{name}`")))?;
    let scenario = Scenario::parse(text).map_err(|e| FemError::Problem(e.to_string()))?;
    let problem = problem(&scenario, settings)?;
    Ok((scenario, problem))
}

/// The robot with a pattern for each of its strips.
fn sewn(scenario: &Scenario, patterns: &[Pattern], settings: &RobotSettings) -> Result<Problem> {
    settings.check()?;
    fits(scenario, patterns, settings)?;
    let weld_m = lines::weld_m(settings);
    let patterns: Vec<Pattern> = patterns.iter().map(|pattern| pattern.between_welds(weld_m)).collect();
    let lines = GridLines::of(scenario, &patterns, settings)?;
    rows(&lines, &patterns[0], settings)?;
    let mut mesh = sew::sew(scenario, &patterns, settings, &lines)?;
    mesh.membrane = waviness::wavy(&mesh.points, settings.waviness_m, settings.seed);
    let chambers = chambers(scenario, settings);
    let names: Vec<&str> = chambers.iter().map(|chamber| chamber.name.as_str()).collect();
    check_open(&mesh, &names, &[sew::BASE])?;
    let slant_rad = scenario.actuator.sin_slant(scenario.radius_m).asin();
    let wrinkles = plies::Wrinkles::of(scenario, &patterns, settings);
    let plies = Plies::of(&patterns[0], slant_rad, settings, wrinkles)?;
    let sections = mesh.parts.iter().map(|part| plies.section(sew::plain(&part.name))).collect();
    let mut problem = Problem::new(&scenario.name, mesh, sections, chambers);
    problem.open = vec![sew::BASE.into()];
    let set = if settings.encastre { encastre(&mut problem.mesh, sew::BASE) } else { sew::BASE.into() };
    problem.supports = vec![Support { set, axes: [true; 3], motion: None }];
    problem.contact = contact(&problem.mesh, &patterns[0], settings);
    let pace_1_s = pace_1_s(scenario, &problem);
    problem.settings = numerics(&problem, settings, pace_1_s);
    Ok(problem)
}

/// Centre line of the body at stations along it \[m\]: centroids of the wall's sections, the actuator's sheet left out.
///
/// # Errors
/// [`FemError::Problem`] for a station off the robot.
pub fn sections(mesh: &Mesh, stations_m: &[f64]) -> Result<CentreLine> {
    CentreLine::new(mesh, &body_parts(mesh), [1.0, 0.0, 0.0], stations_m)
}

/// Points of the wall where markers stick at stations along it \[m\], at the height of the axis, where a camera at the side of the
/// robot sees them.
///
/// # Errors
/// [`FemError::Problem`] for a station off the robot.
pub(crate) fn marker_points(mesh: &Mesh, stations_m: &[f64]) -> Result<CentreLine> {
    CentreLine::seen(mesh, &body_parts(mesh), [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], stations_m)
}

/// What a run of a robot writes: the tip, the centre line at the markers and the tip, frames and a side view.
pub fn outputs(scenario: &Scenario, mesh: &Mesh) -> Outputs {
    let mut stations_m = scenario.markers_m.clone();
    if stations_m.last().is_none_or(|s| *s < scenario.length_m) {
        stations_m.push(scenario.length_m);
    }
    Outputs {
        probes: vec!["tip".into()],
        stations_m,
        station_parts: body_parts(mesh),
        station_axis: [1.0, 0.0, 0.0],
        frames: true,
        pictures: true,
        view: Viewpoint::Side,
    }
}

fn body_parts(mesh: &Mesh) -> Vec<String> {
    let body =
        |name: &str| [sew::WALL, sew::FACE, sew::MARGIN].contains(&sew::plain(name)) || name.starts_with(sew::SEAM);
    mesh.parts.iter().map(|p| p.name.clone()).filter(|name| body(name)).collect()
}

/// Refuses what the scenario and the pattern do not allow together.
fn fits(scenario: &Scenario, patterns: &[Pattern], settings: &RobotSettings) -> Result<()> {
    let refuse = |message: String| Err(FemError::Problem(format!("robot: {message}")));
    for (strip, pattern) in scenario.strips().zip(patterns) {
        let taped_m = where_so(pattern.is_taped(), settings.tape_margin_m);
        if let Err(fault) = scenario.fits(strip, pattern, settings.weld_m, taped_m) {
            return refuse(fault);
        }
    }
    if !scenario.zones.is_empty() {
        return refuse(format!("{} zones; zones exist in the reduced model only, remove them", scenario.zones.len()));
    }
    if settings.actuator_pa < scenario.p_body_pa {
        let [actuator, body] = [settings.actuator_pa, scenario.p_body_pa].map(|p| p * 1e-3);
        return refuse(format!("an actuator at {actuator} kPa in a body at {body} kPa stays flat; raise actuator_pa"));
    }
    Ok(())
}

fn rows(lines: &GridLines, pattern: &Pattern, settings: &RobotSettings) -> Result<()> {
    let along = lines.strips.iter().flat_map(|strip| strip.welds.windows(2)).map(|w| w[1][0].saturating_sub(w[0][1]));
    let across = lines.strips.iter().map(|strip| strip.s_m.len() - 1);
    let fewest = along.chain(across).min().unwrap_or(0);
    if policy::is_fine(fewest) {
        return Ok(());
    }
    Err(FemError::Problem(format!(
        "robot: a pouch of {fewest} elements; lower actuator_mesh_mm from {} or ring_spacing from {} so that it has {} or more",
        settings.actuator_size_m * 1e3,
        lines::spacing(pattern, settings),
        policy::FEWEST_ROWS
    )))
}

fn chambers(scenario: &Scenario, settings: &RobotSettings) -> Vec<Chamber> {
    let filled = settings.body_ramp_s;
    let full = filled + settings.actuator_ramp_s;
    let body = Amplitude::Smooth(vec![(0.0, 0.0), (filled, scenario.p_body_pa)]);
    let actuator = settings.rise(vec![(filled, 0.0), (full, settings.actuator_pa)]);
    let strip = |i: usize| Chamber::of(&sew::of_strip(sew::ACTUATOR, i), actuator.clone());
    std::iter::once(Chamber::of(sew::BODY, body)).chain((0..scenario.strips().count()).map(strip)).collect()
}

/// Contact of everything but the cap, where the pattern folds.
fn contact(mesh: &Mesh, pattern: &Pattern, settings: &RobotSettings) -> Option<Contact> {
    let wanted = settings.contact.unwrap_or(pattern.folds());
    let parts = mesh.parts.iter().map(|p| p.name.clone()).filter(|name| name != "tip_cap").collect();
    wanted.then(|| Contact {
        friction: settings.layer_friction,
        gap_m: 0.5 * settings.layer_gap_m,
        parts,
        ..Contact::default()
    })
}

/// Estimate ω of the tip's lowest frequency, for [`Settling`] \[1/s\].
fn pace_1_s(scenario: &Scenario, problem: &Problem) -> f64 {
    let parts = problem.mesh.parts.iter().zip(&problem.sections);
    let mass_kg = parts.map(|(part, section)| {
        let area_m2: f64 = (0..part.len()).map(|i| norm(area(&problem.mesh.places(part.nodes(i))))).sum();
        area_m2 * section.density_kg_m3 * section.plies.iter().map(|ply| ply.fabric.thickness_m()).sum::<f64>()
    });
    let pull_n = scenario.p_body_pa * std::f64::consts::PI * scenario.radius_m.powi(2);
    (4.0 * pull_n / (mass_kg.sum::<f64>() * scenario.length_m)).sqrt()
}

fn numerics(problem: &Problem, settings: &RobotSettings, pace_1_s: f64) -> Settings {
    let speed = |section: &crate::problem::Section| {
        let stiffness: f64 = section.plies.iter().map(|p| mean_stiffness(&*p.fabric)).sum();
        let mass: f64 = section.plies.iter().map(|p| p.fabric.thickness_m()).sum::<f64>() * section.density_kg_m3;
        (stiffness / mass).sqrt()
    };
    let fastest = problem.sections.iter().map(speed).fold(0.0, f64::max);
    let smallest = settings.body_size_m.min(settings.actuator_size_m);
    let is_fine = smallest < settings::FINE_M;
    let mass_passes = settings.mass_passes.unwrap_or(if is_fine { 6 } else { 2 });
    let mass_factor = settings.mass_factor_for(problem.contact.is_some());
    let allowed = if settings.selective_mass { run::gain(mass_passes) } else { 1.0 };
    Settings {
        end_s: settings.body_ramp_s + settings.actuator_ramp_s + settings.hold_s,
        mass_scaling: MassScaling::TargetStep((mass_factor * allowed).sqrt() * smallest / fastest),
        selective_mass: settings.selective_mass,
        mass_passes,
        cfl: settings.cfl,
        viscosity: settings.viscosity,
        mass_damping_1_s: settings.mass_damping_1_s.unwrap_or(DAMPING * pace_1_s),
        hourglass: settings.hourglass,
        imperfection: settings.imperfection,
        seed: settings.seed,
        patience: Some(Patience {
            creep: settings.creep,
            longest_s: settings.longest_rest_s(),
            window_s: rest::WINDOW / pace_1_s,
        }),
        // Crumpled gussets pass each other between nodes; every run reports their number, and no robot is stopped for it.
        guards: Guards { sides: 1.0, hourglass: settings.guard_hourglass, ..Guards::default() },
        ..Settings::default()
    }
}

#[cfg(test)]
mod run_tests;
#[cfg(test)]
mod space_tests;
#[cfg(test)]
mod tests;
