//! An actuator alone in a testing machine: its pull at a contraction, its contraction without load.
//!
//! ```text
//! N = −η ∂U/∂a / (η_ε dε/da)        e = η_ε ε(a) − c N/W
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | N, e | pull, contraction of the line between the grips | N, – |
//! | U, a, ε | energy per flat length of all terms of the actuator, its coordinate, its contraction | J/m, rad or –, – |
//! | η, η_ε, c/W | active shares of volume and stroke, compliance of the fabric: the linkage's | –, –, 1/N |
//!
//! The terms of the robot act, held straight, without a body: no arm, no wall to be glued to, no body pressure. Effects that
//! act through these change nothing here. **Validity**: one unit, slow pull; pressures as set, after the supply's laws.

use crate::actuators::Actuator;
use crate::assemble::{add_effects, assemble};
use crate::assembly::Assembly;
use crate::root::halved;
use crate::scenario::Scenario;
use crate::site::{Site, SiteLoads};

/// An actuator clamped between two grips, without a robot's balance of moments.
pub struct Machine {
    assembly: Assembly,
    place: usize,
    actuator: &'static Actuator,
}

/// Halvings of the coordinate's range: to rounding.
const HALVINGS: usize = 60;

impl Machine {
    /// The first actuator of a scenario; `None` if it has none.
    pub fn new(scenario: &Scenario) -> Option<Machine> {
        let mut assembly = assemble(scenario, &scenario.spans(), 1);
        add_effects(scenario, &mut assembly);
        for site in &mut assembly.sites {
            (site.weave.wall_n_per_m, site.weave.drawn_in_m2) = (0.0, 0.0);
            crate::muscle::complete(site);
        }
        let place = assembly.sites.iter().position(|site| site.actuator.is_some())?;
        let actuator = assembly.sites[place].actuator?;
        Some(Machine { assembly, place, actuator })
    }

    /// Pull \[N\] at a set pressure \[Pa\] and a contraction; `None` where the law has no such contraction.
    pub fn pull_n(&self, set_pa: f64, contraction: f64) -> Option<f64> {
        let loads = self.loads(set_pa);
        if !self.site().is_open(0.0, loads.p_act_pa) {
            return Some(0.0);
        }
        let a = self.root(&|a| self.at(a, &loads)[0] > contraction);
        let [reached, pull] = self.at(a, &loads);
        ((reached - contraction).abs() < CLOSE && pull.is_finite()).then_some(pull)
    }

    /// Contraction without load at a set pressure \[Pa\].
    pub fn free_contraction(&self, set_pa: f64) -> f64 {
        let loads = self.loads(set_pa);
        if !self.site().is_open(0.0, loads.p_act_pa) {
            return 0.0;
        }
        self.at(self.root(&|a| self.at(a, &loads)[1] < 0.0), &loads)[0]
    }

    fn site(&self) -> &Site {
        &self.assembly.sites[self.place]
    }

    fn loads(&self, set_pa: f64) -> SiteLoads {
        let p_act_pa = self.assembly.supply.iter().fold(set_pa, |p, law| law(p, &Default::default()));
        SiteLoads::new(0.0, p_act_pa)
    }

    /// Contraction and pull at a coordinate.
    fn at(&self, a: f64, loads: &SiteLoads) -> [f64; 2] {
        let (site, stroke) = (self.site(), (self.actuator.stroke)(&self.site().shape, a));
        let slope = site.linkage.active_fraction * site.actuator_slope(a, &stroke, 0.0, 0.0, loads);
        let pull = -slope / (site.linkage.stroke_fraction * stroke.d_contraction);
        [site.linkage.stroke_fraction * stroke.contraction - site.linkage.compliance_per_n * pull, pull]
    }

    /// Coordinate from which on something holds.
    fn root(&self, holds: &dyn Fn(f64) -> bool) -> f64 {
        let [low, high] = halved(self.actuator.range.into(), HALVINGS, |a| !holds(a));
        0.5 * (low + high)
    }
}

const CLOSE: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Loads, Model, shipped};

    fn robot(name: &str) -> Scenario {
        Scenario::parse(shipped(name).unwrap()).unwrap()
    }

    /// In a robot the line's tension is the machine's pull at the line's contraction, whatever acts in the actuator.
    #[test]
    fn the_pull_is_that_of_the_same_actuator_in_a_robot() {
        let effects: [(&str, &str, &[f64]); 5] = [
            ("fpam", "shear_stiffness", &[60.0]),
            ("fpam", "end_fittings", &[0.6]),
            ("fpam", "yarn_stretch", &[1e-4]),
            ("epam-textbook", "fabric_stretch", &[2e-4]),
            ("spam-textbook", "pressure_loss", &[0.1, 1.0]),
        ];
        for (name, effect, values) in effects {
            let robot = robot(name).bare().with_effect(effect, values);
            let model = Model::new(&robot);
            let mut out = model.prediction();
            model.predict(&Loads::uniform(robot.p_body_pa, 2e4), &mut out).unwrap();
            let (segment, state) =
                model.assembly().segments.iter().zip(model.states(&out)).find(|(_, s)| s.tension > 0.0).unwrap();
            let line = state.curvature * model.assembly().sites[segment.site].linkage.arm_m;
            let pull = Machine::new(&robot).unwrap().pull_n(2e4, line).unwrap();
            assert!((pull / state.tension - 1.0).abs() < 1e-6, "{effect}: {pull} {}", state.tension);
        }
    }

    #[test]
    fn a_wall_that_is_not_there_holds_no_muscle_and_a_beam_has_none() {
        let bare = robot("fpam").bare();
        let [with, without] =
            [bare.with_effect("glued_face", &[4e4]), bare].map(|s| Machine::new(&s).unwrap().pull_n(3e4, 0.1));
        assert!((with.unwrap() / without.unwrap() - 1.0).abs() < 1e-12);
        let beam = "[body]\nradius_mm = 80\nlength_mm = 1000\npressure_kpa = 30\n[markers]\ns_mm = [1000]\n";
        assert!(Machine::new(&Scenario::parse(&format!("name = \"beam\"\n{beam}")).unwrap()).is_none());
    }
}
