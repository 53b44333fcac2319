//! Stops for runs whose result cannot be trusted.

use models::fabrics::InlinedFabric;
use models::{Account, Pose};

use super::clock::{give_tied_bounds, stable_step};
use super::{Ledger, Simulation, highest};
use crate::policy;
use crate::problem::Guards;
use crate::sheet::Sheet;
use crate::sheet::bound::largest;
use crate::sheet::chamber::Air;
use crate::sheet::reference::mean_stiffness;
use crate::vec3::{cross, dot, norm, sub};
use crate::{FemError, Mesh, Problem, Result, Transient};
use serde::{Deserialize, Serialize};

/// Steps between two estimates of the highest mode of the whole mesh: in the robots it changes by some hundredths in between.
const WHOLE: u64 = 8192;

/// Remedy for a shape set by hourglass control. A tenth of the coefficient alone makes a film with pleats as long as its
/// elements worse: it carries compression, which no pleat does.
pub(crate) const LESS_HOURGLASS: &str = "for a sheet that pleats, law = \"tension-field\" with the same moduli and a hundredth of \
    hourglass; else smaller elements or a tenth of hourglass";

impl Simulation {
    pub(super) fn guard(&mut self) -> Result<()> {
        let books = self.books;
        if !(books.kinetic.is_finite() && books.stored.is_finite()) {
            return Err(self.stopped(self.not_a_number()));
        }
        if let Some(air) = self.sheet.air.iter().find(|air| air.is_inside_out()) {
            let cm3 = 1e6 * air.now.volume_m3.unwrap_or(0.0);
            return Err(self.stopped(format!(
                "chamber `{}` is inside out, with {cm3:.1} cm³: its walls passed through each other. Add [contact]",
                air.name()
            )));
        }
        let ledger = self.ledger();
        self.books.scale = ledger.scale_j;
        let guards = &self.settings.guards;
        if misses_balance(guards, ledger.residual_share()) {
            return Err(self.stopped(format!(
                "the energy balance misses {:.3e} J, {:.1} % of the external work of {:.3e} J (limit {} %). {}",
                ledger.residual_j,
                100.0 * ledger.residual_share(),
                ledger.scale_j,
                100.0 * guards.residual,
                self.cause(&ledger)
            )));
        }
        self.guard_speed()
    }

    /// Judges a run that came to its end: does the fabric set its shape, or hourglass control?
    ///
    /// # Errors
    /// [`FemError::Stopped`] with the share, the limit and what to type.
    pub fn judge_end(&self) -> Result<()> {
        let share = self.ledger().hourglass_share();
        let limit = self.settings.guards.hourglass;
        if !is_its_own(&self.settings.guards, share) {
            return Ok(());
        }
        Err(self.stopped(format!(
            "cannot trust the shape: hourglass control holds {:.0} % of the stored energy (allowed up to {:.0} %). Try: {}; or raise \
             guard_hourglass and take the result as it is",
            100.0 * share,
            100.0 * limit,
            LESS_HOURGLASS
        )))
    }

    fn guard_speed(&self) -> Result<()> {
        let square = |v: &[f64; 4]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let fastest =
            (0..self.v.len()).fold(0, |best, i| if square(&self.v[i]) > square(&self.v[best]) { i } else { best });
        let speed = self.v.get(fastest).map_or(0.0, |v| square(v).sqrt());
        if speed <= self.fastest_m_s {
            return Ok(());
        }
        Err(self.stopped(format!(
            "node {} moves at {speed:.0} m/s; sound in the fabric travels at {:.0} m/s. {}",
            self.order.old[fastest] + 1,
            self.fastest_m_s,
            self.cause(&self.ledger())
        )))
    }

    fn cause(&self, ledger: &Ledger) -> String {
        cause(extent_m(&self.mesh), self.settings.dt_s, self.added_mass, ledger.share_of(Account::Contact))
    }

    fn not_a_number(&self) -> String {
        let bad = (0..self.x.len()).find(|i| !(self.x[*i].iter().chain(&self.force[*i]).all(|c| c.is_finite())));
        let place = bad.map_or("the energies are".to_string(), |i| format!("node {} is", self.order.old[i] + 1));
        format!("{place} not a number any more. Shorten the step (cfl .7 for soft fabric) or check loads and units")
    }

    /// Estimates the stable step again; looks for collapsed or inverted elements.
    pub(super) fn recheck(&mut self) -> Result<()> {
        if self.settings.guards.inverted {
            self.guard_elements()?;
        }
        let pose = Pose::nodes(self.x.as_flattened());
        let mut others = vec![0.0; self.x.len()];
        self.others().for_each(|term| term.stiffness_bound(&pose, &mut others));
        // Until after the next estimate.
        let until_s = self.clock.time_s + 1000.0 * self.clock.dt_s;
        self.sheet.add_gas_bound(until_s, self.x.as_flattened(), &mut others);
        let mut bound = others.clone();
        self.sheet.stiffness_bound(&pose, &mut bound);
        give_tied_bounds(&self.mesh, &mut bound);
        let nodes = stable_step(&bound, &self.mass, self.settings.viscosity);
        if self.clock.step.is_multiple_of(WHOLE) {
            self.clock.gain = highest::gain(
                &self.sheet,
                &self.mesh.ties,
                &self.x,
                others,
                &self.mass,
                nodes,
                self.selective.as_ref(),
            );
        }
        let stable = self.clock.gain * nodes;
        match self.settings.dt_s {
            None => self.clock.dt_s = (self.settings.cfl * stable).min(self.clock.longest_s),
            Some(dt) if dt <= stable => {}
            Some(dt) => {
                return Err(self.stopped(format!(
                    "the forced step of {dt:e} s is not stable any more; the deformed mesh allows {stable:.3e} s. Leave \
                     the step out, then it adapts"
                )));
            }
        }
        Ok(())
    }

    fn guard_elements(&self) -> Result<()> {
        for (index, element) in self.sheet.elements.iter().enumerate() {
            let at = |n: usize| {
                let p = self.x[element.node[n] as usize];
                [p[0], p[1], p[2]]
            };
            let [f1, f2] = element.deformation(&self.x);
            let normal = cross(f1, f2);
            let area = dot(normal, normal).sqrt();
            let part = &self.mesh.parts[element.part].name;
            if policy::is_collapsed(area) {
                return Err(self.stopped(format!(
                    "element {} (part `{part}`) has lost its area: {:.2e} of what it was",
                    index + 1,
                    area
                )));
            }
            // A quadrilateral is inside out when most of its corners turn against its mean normal. One that is stretched in no
            // direction is fabric in folds, which has no shape; so is one of a film that wrinkles below the mesh.
            let c = [dot(f1, f1), dot(f2, f2), dot(f1, f2)];
            let wrinkles = matches!(self.sheet.fabrics[element.part].kind(), InlinedFabric::WrinklingFilm(_));
            if element.corners == 4 && !wrinkles && largest(c[0], c[1], c[2]) > 1.0 {
                let against = (0..4).filter(|n| {
                    let (here, next, last) = (at(*n), at((n + 1) % 4), at((n + 3) % 4));
                    let corner = cross(sub(next, here), sub(last, here));
                    dot(corner, normal) < 0.0
                });
                if against.count() > 1 {
                    return Err(self.stopped(format!(
                        "element {} (part `{part}`) has turned inside out. Try: a slower load, more mass_damping_1_s, smaller \
                         elements, or edges = true in [contact] where layers catch in each other",
                        index + 1
                    )));
                }
            }
        }
        Ok(())
    }

    pub(super) fn stopped(&self, reason: String) -> FemError {
        FemError::stopped(self.clock.step, self.clock.time_s, reason)
    }
}

/// Nodes that came through a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Through {
    /// Number of nodes that changed the side of a layer.
    pub nodes: usize,
    /// Their share of the nodes that were in contact.
    pub share: f64,
    /// The first node that came through; `None` if there is none.
    pub first: Option<FirstThrough>,
}

/// The first node that changed the side of a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FirstThrough {
    /// Number of the node, counted from 1.
    pub node: usize,
    /// Name of the part that it came through.
    pub part: String,
    /// Simulated time at which it came through \[s\].
    pub time_s: f64,
    /// Position x, y, z of the node then \[mm\].
    pub place_mm: [f64; 3],
    /// Node, part, place and time in one sentence.
    pub text: String,
}

impl Simulation {
    /// Nodes that ever were behind the closest face of another layer by more than `thickness_m`, counted from 1; `None` without contact.
    pub fn changed_sides(&self) -> Option<Through> {
        let (nodes, could, first) = self.contact.as_ref()?.passed();
        let first = first.map(|(passage, part)| {
            let node = self.order.old[passage.node as usize] as usize + 1;
            let part = &self.mesh.parts[part as usize].name;
            let (place_mm, time_s) = (passage.place_m.map(|c| c * 1e3), passage.time_s);
            let [x, y, z] = place_mm;
            let text = format!("node {node} through part `{part}` at ({x:.2}, {y:.2}, {z:.2}) mm, t = {time_s:.6} s");
            FirstThrough { node, part: part.clone(), time_s, place_mm, text }
        });
        Some(Through { nodes, share: nodes as f64 / could.max(1) as f64, first })
    }

    /// Stops a run in which more nodes changed side than are allowed.
    pub(super) fn guard_sides(&self) -> Result<()> {
        let Some(Through { nodes, share, first: Some(first) }) = self.changed_sides() else { return Ok(()) };
        let limit = self.settings.guards.sides;
        if !passes_through(&self.settings.guards, share) {
            return Ok(());
        }
        Err(self.stopped(format!(
            "{nodes} nodes, {:.1} % of those in contact, changed side of a layer (limit {:.1} %), the first: {}. With \
             edges = true in [contact] nothing passes through anything; smaller elements help, too. To go on nevertheless, \
             raise guard_sides",
            100.0 * share,
            100.0 * limit,
            first.text
        )))
    }
}

/// The likely cause of a stop, and what to do about it: the first that there is evidence of.
fn cause(extent_m: f64, forced_dt_s: Option<f64>, added_mass: f64, contact: f64) -> String {
    if policy::is_huge(extent_m) {
        return format!("The mesh is {extent_m:.0} m long: if that is millimetres, write the mesh in metres");
    }
    if let Some(dt_s) = forced_dt_s {
        return format!("The step is forced to {dt_s:e} s: leave dt_s out, then it adapts");
    }
    if policy::is_pressed(contact) {
        return format!(
            "Contact holds {:.0} % of the stored energy: layers start too deep in each other, or press harder than \
            their elements can carry; start them farther apart (gap_mm), or make the elements smaller",
            100.0 * contact
        );
    }
    if policy::is_heavy(added_mass) {
        return format!(
            "{:.0} % of mass were added for a longer step: ask for a shorter one, or load more slowly",
            100.0 * added_mass
        );
    }
    "Look for a load in the wrong unit, for elements that are too coarse for what they do, or shorten the step (cfl)"
        .into()
}

/// Longest side of the box round the free shape \[m\].
fn extent_m(mesh: &Mesh) -> f64 {
    crate::vec3::extent(mesh.points.iter().copied()).into_iter().fold(0.0, f64::max)
}

/// What the residual is judged against at least \[J\], before the loads have done work:
/// `STRAIN_FLOOR`² · Σ ½ A·a₁₁ + `TURNED_OVER` · (Σ p V + m g L + Σ F L).
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | A, a₁₁ | area and mean stiffness of the elements | m², N/m |
/// | p, g, F | largest pressure, gravity and force of the whole run | Pa, m/s², N |
/// | V | volume of a sphere of the chamber's fabric, (Σ A)^(3/2)/(6 √π) | m³ |
/// | m, L | true mass, longest side of the mesh | kg, m |
pub(super) fn least_scale_j(problem: &Problem, mesh: &Mesh, sheet: &Sheet, mass_kg: &[f64]) -> f64 {
    let area = |of: &dyn Fn(usize) -> f64| sheet.elements.iter().map(|e| of(e.part) * e.reference.area).sum::<f64>();
    let stiffness: Vec<f64> = sheet.fabrics.iter().map(|fabric| mean_stiffness(&**fabric)).collect();
    let strained = 0.5 * policy::STRAIN_FLOOR * policy::STRAIN_FLOOR * area(&|part| stiffness[part]);
    let blown = |air: &Air| {
        let faces =
            |part: usize| [&mesh.parts[part].front, &mesh.parts[part].back].map(|c| c.as_deref() == Some(air.name()));
        let around = area(&|part| f64::from(u8::from(faces(part).contains(&true))));
        air.peak_pa() * around.powf(1.5) / (6.0 * std::f64::consts::PI.sqrt())
    };
    let pressed: f64 = sheet.air.iter().map(blown).sum();
    let weight = problem.gravity.iter().map(|g| g.amplitude.peak() * norm(g.g_m_s2) * mass_kg.iter().sum::<f64>());
    let forces = problem.forces.iter().map(|f| f.amplitude.peak() * norm(f.total_n));
    strained + policy::TURNED_OVER * (pressed + extent_m(mesh) * weight.chain(forces).sum::<f64>())
}

/// Whether the balance misses more of the work done than a run may.
fn misses_balance(guards: &Guards, share: f64) -> bool {
    share > guards.residual
}

/// Whether hourglass control holds so much of the stored energy that the shape is its own.
fn is_its_own(guards: &Guards, share: f64) -> bool {
    share > guards.hourglass
}

/// Whether too many of the nodes in contact changed side of a layer.
fn passes_through(guards: &Guards, share: f64) -> bool {
    share > guards.sides
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::mesh::generate;
    use crate::problem::{Amplitude, Chamber, Gravity, NodalForce, Ply, Pressure, Section};
    use models::fabrics::Orthotropic;

    #[test]
    fn a_run_stops_at_two_per_cent_of_its_work_and_at_the_shares_it_is_allowed() {
        let usual = Guards::default();
        assert_eq!([0.0198, 0.0202].map(|share| misses_balance(&usual, share)), [false, true]);
        assert_eq!([0.149, 0.151].map(|share| is_its_own(&usual, share)), [false, true]);
        assert_eq!([0.0495, 0.0505].map(|share| passes_through(&usual, share)), [false, true]);
    }

    #[test]
    fn the_balance_is_judged_on_the_loads_of_the_run_and_the_stretch_of_its_fabric() {
        // 0.08 m² of 10 kN/m, 8 g.
        let film = Arc::new(Orthotropic::isotropic(1e8, 0.0, 1e-4));
        let plies = vec![Ply { fabric: film, angle_rad: 0.0 }];
        let section =
            Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor: 0.0, rest_curvature: false };
        let air = Chamber { name: "air".into(), pressure: Pressure::Set(Amplitude::Constant(0.0)), open_axis: None };
        let mesh = generate::pillow(0.2, 4, 0.0).unwrap();
        let mut problem = Problem::new("pillow", mesh, vec![section.clone(), section], vec![air]);
        let mut least = |change: &dyn Fn(&mut Problem)| {
            change(&mut problem);
            Simulation::new(&problem).unwrap().books.scale
        };
        let mut exact = 0.5 * 0.08 * 1e4 * 1e-10;
        let mut near = |found: f64, added: f64| {
            exact += added;
            assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
        };
        near(least(&|_| ()), 0.0);
        near(
            least(&|p| p.gravity = Some(Gravity { g_m_s2: [6.0, 0.0, 8.0], amplitude: Amplitude::Constant(1.0) })),
            5e-3 * 0.016,
        );
        let (set, amplitude) = ("corners".to_string(), Amplitude::Constant(2.0));
        let force = NodalForce { set, total_n: [0.0, 3.0, 4.0], amplitude };
        near(least(&|p| p.forces = vec![force.clone()]), 5e-3 * 2.0);
        let volume = 0.08_f64.powf(1.5) / (36.0 * std::f64::consts::PI).sqrt();
        let ramp = || Pressure::Set(Amplitude::Smooth(vec![(0.0, 0.0), (0.1, 5e3)]));
        near(least(&|p| p.chambers[0].pressure = ramp()), 5e-3 * 5e3 * volume);
    }

    #[test]
    fn a_stop_names_what_the_run_shows_and_not_always_the_step() {
        for (cause, words) in [
            (cause(0.4, None, 0.3, 0.01), "load in the wrong unit"),
            (cause(360.0, None, 0.3, 0.01), "The mesh is 360 m long"),
            (cause(0.4, Some(1e-5), 0.3, 0.01), "leave dt_s out"),
            (cause(0.4, None, 0.3, 0.4), "Contact holds 40 %"),
            (cause(0.4, None, 4.0, 0.01), "400 % of mass were added"),
        ] {
            assert!(cause.contains(words), "{cause}");
        }
    }
}
