//! What the law tests share: robots, effect sets, a small random generator, differences, and the total potential.

use models::actuators::ACTUATORS;
use models::assembly::Assembly;
use models::effects::{EFFECTS, Effect, Stage};
use models::site::{Linkage, Site};
use models::{Loads, Model, Pose, Prediction, Scenario, Unsolved, shipped};

pub(crate) fn actuators() -> impl Iterator<Item = &'static str> {
    ACTUATORS.iter().map(|a| a.name)
}

/// The textbook model of that actuator's robot; what the shipped one has more is visited effect by effect, and as it is where
/// a law says `full`.
pub(crate) fn robot(actuator: &str) -> Scenario {
    Scenario::parse(shipped(&format!("{actuator}-textbook")).unwrap()).unwrap()
}

/// The shipped robot of that actuator.
pub(crate) fn full(actuator: &str) -> Scenario {
    Scenario::parse(shipped(actuator).unwrap()).unwrap()
}

/// Robots with strips round the body, from the studies: two upright strips, and a helix.
pub(crate) fn in_space() -> [(&'static str, Scenario); 2] {
    let studies = [
        ("two strips", include_str!("../../../studies/epam-two-strips.toml")),
        ("helix", include_str!("../../../studies/epam-helix.toml")),
    ];
    studies.map(|(name, text)| (name, Scenario::parse(text).unwrap()))
}

/// Effects that exist for the actuator of `scenario`.
pub(crate) fn applicable(scenario: &Scenario) -> impl Iterator<Item = &'static Effect<'static>> {
    let family = scenario.actuator.kind.family;
    EFFECTS.iter().filter(move |e| e.applies_to(family))
}

/// Values of all parameters by a rule, SI.
pub(crate) fn values(effect: &Effect, pick: fn(&models::effects::Parameter) -> f64) -> Vec<f64> {
    effect.parameters.iter().map(|p| pick(p) * p.si).collect()
}

/// Every applicable effect of the balance at typical values, and a bending stiffness.
pub(crate) fn everything(actuator: &str) -> Scenario {
    let bent = robot(actuator).with_bending(0.7);
    let in_balance = |e: &&Effect| e.stage == Stage::Balance;
    let all = applicable(&bent).filter(in_balance).fold(bent.clone(), |s, e| s.with_effect(e.name, &e.typical()));
    // At typical sizes an actuator stays flat below about the body's pressure, and there is no balance to look at.
    let small = [
        ("displaced_gas", 0.02),
        ("gussets", 0.02),
        ("sealed_sides", 0.02),
        ("roofed_welds", 0.02),
        ("fold_energy", 1e-8),
        ("stuck_face", 1e-8),
    ];
    let has = |name: &str| all.effects.iter().any(|e| e.name == name);
    small.iter().filter(|(name, _)| has(name)).fold(all.clone(), |s, (name, value)| s.with_effect(name, &[*value]))
}

/// The same without what hangs on the actuator's pressure beside its work on the ideal volume: the cell of a muscle, with yarns
/// that give, glue and flat ends, and the sides and folds of a pouch.
pub(crate) fn without_cell(scenario: &Scenario) -> Scenario {
    let mut stiff = scenario.clone();
    stiff.effects.retain(|e| {
        ![
            "yarn_stretch",
            "glued_face",
            "flat_ends",
            "gussets",
            "sealed_sides",
            "roofed_welds",
            "fold_energy",
            "crimped_sides",
            "stuck_face",
            "wrinkled_sheets",
        ]
        .contains(&e.name.as_str())
    });
    stiff
}

/// A prediction, or why there is none.
pub(crate) fn predicted(model: &Model, loads: &Loads) -> Result<Prediction, Unsolved> {
    let mut out = model.prediction();
    model.predict(loads, &mut out)?;
    Ok(out)
}

/// A prediction that has to work.
pub(crate) fn predict(scenario: &Scenario, p_body_pa: f64, p_act_pa: f64) -> Prediction {
    let model = Model::new(scenario);
    predicted(&model, &Loads::uniform(p_body_pa, p_act_pa)).unwrap_or_else(|e| panic!("{}: {e}", scenario.name))
}

/// Numerical Recipes' linear congruential generator, upper bits.
pub(crate) struct Random(pub u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        (self.between(low.ln(), high.ln())).exp()
    }
}

/// Slope of `f` at `x` by Richardson-extrapolated central differences (error h⁴).
pub(crate) fn slope(mut f: impl FnMut(f64) -> f64, x: f64, h: f64) -> f64 {
    let mut central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    let (coarse, fine) = (central(h), central(0.5 * h));
    fine + (fine - coarse) / 3.0
}

/// The total potential of a robot over free coordinates: one (coordinate, curvature) pair per segment.
pub(crate) struct Potential<'a> {
    pub assembly: &'a Assembly,
    /// Pressures, the same in every channel; supply effects must be off.
    pub loads: Loads,
}

impl Potential<'_> {
    pub(crate) fn is_active(&self, segment: usize) -> bool {
        let site = self.site(segment);
        site.actuator.is_some() && self.loads.actuator_pa[site.channel] > 0.0
    }

    pub(crate) fn site(&self, segment: usize) -> &Site {
        &self.assembly.sites[self.assembly.segments[segment].site]
    }

    /// Curvature of inextensible fabric at actuator coordinate `a`, and the arm there.
    pub(crate) fn geometric(&self, segment: usize, a: f64) -> (f64, f64) {
        let site = self.site(segment);
        let stroke = (site.actuator.unwrap().stroke)(&site.shape, a);
        let arm = site.linkage.arm_m + site.linkage.arm_growth * stroke.lift;
        let strain = site.linkage.stroke_fraction * stroke.contraction;
        (site.linkage.bent(turn(strain, arm, 2.0 * site.radius_m)).0, arm)
    }

    /// Π(a, κ) of one segment per length; with extensible fabric a and κ are independent, else κ must be that of `a`.
    pub(crate) fn of_segment(&self, segment: usize, a: f64, kappa: f64) -> f64 {
        let site = self.site(segment);
        let p_act_pa = self.loads.actuator_pa[site.channel];
        let s_m = self.assembly.segments[segment].middle_m();
        let pose = |q| Pose { s_m, ..Pose::new(q, self.loads.body_pa, p_act_pa) };
        let at = [kappa];
        let mut unused = [0.0; 4];
        let mut sum = site.body_pressure.add(&pose(&at), &mut unused);
        sum += models::Term::add(&site.bending, &pose(&at), &mut unused);
        sum += site.body_terms.iter().map(|t| t.add(&pose(&at), &mut unused)).sum::<f64>();
        if !self.is_active(segment) {
            return sum;
        }
        let stroke = (site.actuator.unwrap().stroke)(&site.shape, a);
        let (geometric, arm) = self.geometric(segment, a);
        let q = [a, stroke.contraction, stroke.volume, geometric];
        let stored: f64 = site.actuator_terms.iter().map(|t| t.add(&pose(&q), &mut unused)).sum();
        sum += site.linkage.active_fraction * stored;
        let compliance = site.linkage.compliance_per_n;
        if compliance > 0.0 {
            let round = |kappa| round(kappa, &site.linkage);
            sum += 0.5 * ((round(geometric) - round(kappa)) * arm).powi(2) / compliance;
        }
        sum
    }

    /// Energy of the node terms at curvatures `kappas`, the centre line integrated independently of the library.
    pub(crate) fn of_nodes(&self, kappas: &[f64]) -> f64 {
        let mut nodes = vec![0.0, 0.0];
        let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0_f64);
        for (segment, kappa) in self.assembly.segments.iter().zip(kappas) {
            let shorter = shortening(*kappa) * self.assembly.sites[segment.site].radius_m;
            let line = (1.0 - shorter) * segment.length_m;
            let half = 0.5 * kappa * segment.length_m;
            let chord = if half == 0.0 { line } else { line * half.sin() / half };
            x += chord * (heading + half).cos();
            y += chord * (heading + half).sin();
            heading += 2.0 * half;
            nodes.extend([x, y]);
        }
        let pose = Pose::new(&nodes, self.loads.body_pa, 0.0);
        self.assembly.node_terms.iter().map(|t| t.add(&pose, &mut vec![0.0; nodes.len()])).sum()
    }
}

/// Hinge curvature of the robots here \[1/m\].
const HINGE: f64 = 0.05;

/// Shortening of a line at unit distance from the generator opposite to the bend, which changes side at κ = 0.
fn shortening(kappa: f64) -> f64 {
    if kappa >= 0.0 { kappa } else { kappa + 2.0 * HINGE * (kappa / HINGE).cosh().ln() }
}

/// Curvature of a line that shortens by `strain`, by bisection where it lengthens.
fn turn(strain: f64, arm: f64, diameter: f64) -> f64 {
    let [mut low, mut high] = [-30.0, 0.0];
    for _ in 0..if strain < 0.0 { 100 } else { 0 } {
        let middle = 0.5 * (low + high);
        let of = arm * middle + 0.5 * diameter * (shortening(middle) - middle);
        *(if of > strain { &mut high } else { &mut low }) = middle;
    }
    if strain < 0.0 { 0.5 * (low + high) } else { strain / arm }
}

/// Curvature g of the body whose section stays as it is where that of `linkage` has κ, by Newton.
fn round(kappa: f64, linkage: &Linkage) -> f64 {
    let step = |(bent, slope): (f64, f64)| (bent - kappa) / slope;
    (0..60).fold(kappa, |g, _| g - step(linkage.bent(g)))
}
