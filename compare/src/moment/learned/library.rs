//! The library: laws of a missing moment, each a formula with one to three numbers of order one in units of the robot's own.
//!
//! ```text
//! M₀ = π p_b R³        κ₀ = 1/R        the folded wall's moment, and a bend as sharp as the body
//! ```
//!
//! M₀ tanh(κR/0.002) is the step at no bend that the wall itself has: a robot without pressure is straight.

use models::{Formula, Scenario};
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::sync::Arc;

/// In which unit of the robot a number is of order one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NaturalUnit {
    /// Moment of the gas in the body, π p_b R³ \[N·m\].
    Moment,
    /// 10 π p_b R⁴ \[N·m²\]: that moment at a tenth of the sharpest bend.
    Stiffness,
    /// Curvature 1/R, the sharpest bend of a body \[1/m\].
    Bend,
    /// Dimensionless number that needs no scale.
    One,
}

/// A number of a law, with its unit, bounds and meaning.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Number {
    pub key: &'static str,
    pub unit: NaturalUnit,
    pub bounds: [f64; 2],
    /// Values that are tried, in that unit, where the law is not linear in it.
    pub tried: &'static [f64],
    pub meaning: &'static str,
}

/// A law of the library as a formula of bend and pressures.
#[derive(Debug)]
pub(crate) struct LawFormula {
    pub words: &'static str,
    /// The moment; `TIP` is half of the length over the radius.
    pub moment: &'static str,
    pub numbers: &'static [Number],
    /// What such a law usually is, and which check decides.
    pub usual: Usual,
}

/// What laws of a shape usually are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Usual {
    pub words: &'static str,
    pub check: &'static str,
}

const TENSION: Usual = Usual {
    words: "a steady moment: a hose or tail under tension, seams that are bent open, friction on the way up",
    check: "go up and down in pressure, where friction changes its sign, and repeat without hoses",
};
const STIFFNESS: Usual = Usual {
    words: "a bending stiffness that the scenario lacks",
    check: "bend the inflated body with the actuator vented",
};
const SHARE: Usual = Usual {
    words: "a share of the actuator's pull that does not arrive: sealed edges, or folds that unfold as it bends",
    check: "pull one unit in a testing machine, or build one with wider units, whose edges weigh less",
};
const SOFTENS: Usual = Usual {
    words: "a resistance that softens as the robot bends: a wall that wrinkles or creases, layers that buckle",
    check: "hang weights on the inflated body with the actuator vented, and plot moment over bend",
};
const STOP: Usual = Usual {
    words: "a stop: pouches or folds that meet, a clamp, a yarn that is drawn taut",
    check: "film the side view: from the stop on the bend of one unit hardly grows",
};
const ENDS: Usual = Usual {
    words: "ends that bend otherwise than the rest: a clamp, a cap, the closed end of a muscle",
    check: "film both ends: compare their bend with the bend of the middle",
};
const BODY: Usual = Usual {
    words: "gas of the body that is pressed out as it bends: pouches in the wall, a section that flattens",
    check: "repeat at another body pressure, and watch the body's regulator while the robot bends",
};

/// Bounds of a number the law is linear in: no law is so much larger than the robot's own moments.
const FAR: [f64; 2] = [-50.0, 50.0];
const M: Number = linear("m", NaturalUnit::Moment, "moment that holds back, at small bends");
const M_END: Number = linear("e", NaturalUnit::Moment, "moment more at an end");
const K: Number = linear("k", NaturalUnit::Stiffness, "stiffness");
const FALL: Number = linear("k", NaturalUnit::Stiffness, "by how much the moment falls per bend");
const A: Number = linear("a", NaturalUnit::One, "share of the pull that is lost, at small bends");
const A_BEND: Number = linear("b", NaturalUnit::One, "change of that share per radian of one unit");
const A_END: Number = linear("e", NaturalUnit::One, "share more at an end");
const P: Number = linear("a", NaturalUnit::One, "moment over P R³, at small bends");
const P_BEND: Number = linear("b", NaturalUnit::One, "by how much it falls per bend of a tenth of 1/R");
const P_BODY: Number = linear("a", NaturalUnit::One, "moment over p_b R³");
const N: Number = Number {
    key: "n",
    unit: NaturalUnit::One,
    bounds: [0.1, 4.0],
    tried: &[0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0],
    meaning: "power of the bend",
};
const Q: Number = Number {
    key: "q",
    unit: NaturalUnit::One,
    bounds: [0.0, 3.0],
    tried: &[0.25, 0.5, 0.75, 1.0, 1.5, 2.0],
    meaning: "power of the pressure",
};
const TOUCH: Number = Number {
    key: "k0",
    unit: NaturalUnit::Bend,
    bounds: [0.0, 0.5],
    tried: &[0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2],
    meaning: "bend at which it begins",
};

const fn linear(key: &'static str, unit: NaturalUnit, meaning: &'static str) -> Number {
    Number { key, unit, bounds: FAR, tried: &[], meaning }
}

const fn law(words: &'static str, moment: &'static str, numbers: &'static [Number], usual: Usual) -> LawFormula {
    LawFormula { words, moment, numbers, usual }
}

pub(crate) const PULL: LawFormula = law("a share of the pull", "-a*pull", &[A], SHARE);

/// Laws, those with fewer numbers first.
pub(crate) const LIBRARY: &[LawFormula] = &[
    law("a steady moment", "-m*tanh(kappa*R/0.002)", &[M], TENSION),
    law("a spring", "-k*kappa", &[K], STIFFNESS),
    PULL,
    law("a moment in step with the actuator's pressure", "-a*p_act*R^3*tanh(kappa*R/0.002)", &[P], SHARE),
    law("a moment in step with the body's pressure", "-a*p_body*R^3*tanh(kappa*R/0.002)", &[P_BODY], BODY),
    law("a share of the pull that is lost towards the tip", "-e*pull*exp(0.5*s/R - TIP)", &[A_END], ENDS),
    law("a steady moment at the tip", "-e*tanh(kappa*R/0.002)*exp(0.5*s/R - TIP)", &[M_END], ENDS),
    law("a resistance that falls with bend", "-m*tanh(kappa*R/0.002) + k*kappa", &[M, FALL], SOFTENS),
    law("a power of the bend", "-m*(pos(kappa)*R)^n", &[M, N], SOFTENS),
    law("a stop", "-k*pos(kappa - k0)", &[Number { bounds: [0.0, 50.0], ..K }, TOUCH], STOP),
    law("a share of the pull that changes with bend", "-(a + b*theta)*pull", &[A, A_BEND], SHARE),
    law(
        "a moment in step with the actuator's pressure that falls with bend",
        "-(a - 10*b*kappa*R)*p_act*R^3*tanh(kappa*R/0.002)",
        &[P, P_BEND],
        SHARE,
    ),
    law("a share of the pull, another at the tip", "-(a + e*exp(0.5*s/R - TIP))*pull", &[A, A_END], ENDS),
    law(
        "a share of the pull, another at both ends",
        "-(a + e*(exp(-0.5*s/R) + exp(0.5*s/R - TIP)))*pull",
        &[A, A_END],
        ENDS,
    ),
    law(
        "a steady moment, another at both ends",
        "-(m + e*(exp(-0.5*s/R) + exp(0.5*s/R - TIP)))*tanh(kappa*R/0.002)",
        &[M, M_END],
        ENDS,
    ),
    law(
        "a resistance that falls with bend, and a moment at both ends",
        "-(m + e*(exp(-0.5*s/R) + exp(0.5*s/R - TIP)))*tanh(kappa*R/0.002) + k*kappa",
        &[M, M_END, FALL],
        SOFTENS,
    ),
    law(
        "a resistance that falls with bend, and a moment at the tip",
        "-(m + e*exp(0.5*s/R - TIP))*tanh(kappa*R/0.002) + k*kappa",
        &[M, M_END, FALL],
        SOFTENS,
    ),
    law(
        "a share of the pull that changes with bend, another at the tip",
        "-(a + b*theta + e*exp(0.5*s/R - TIP))*pull",
        &[A, A_BEND, A_END],
        SHARE,
    ),
    law("a power of bend and pressure", "-m*(p_act/p_body)^q*(pos(kappa)*R)^n", &[M, N, Q], SOFTENS),
];

impl Number {
    /// Its unit in SI, on a robot.
    pub(crate) fn scale(&self, robot: &Scenario) -> f64 {
        let r = robot.radius_m;
        let moment = PI * robot.p_body_pa * r.powi(3);
        match self.unit {
            NaturalUnit::Moment => moment,
            NaturalUnit::Stiffness => 10.0 * moment * r,
            NaturalUnit::Bend => 1.0 / r,
            NaturalUnit::One => 1.0,
        }
    }

    pub(crate) fn unit_text(&self) -> &'static str {
        match self.unit {
            NaturalUnit::Moment => "N m",
            NaturalUnit::Stiffness => "N m2",
            NaturalUnit::Bend => "1/m",
            NaturalUnit::One => "-",
        }
    }

    /// Whether the law is linear in it: then it vanishes without it.
    pub(crate) fn is_linear(&self) -> bool {
        self.tried.is_empty()
    }
}

impl LawFormula {
    /// Whether a part is proportional to the bend: it takes the place of a bending stiffness that is fitted.
    pub(crate) fn has_spring(&self) -> bool {
        self.moment.contains("k*kappa") || self.moment.contains("^n")
    }

    /// Whether only a change of the body's pressure separates it from another.
    pub(crate) fn is_of_body(&self) -> bool {
        self.usual.words == BODY.words
    }

    /// Whether it is a bending stiffness and nothing else.
    pub(crate) fn is_stiffness(&self) -> bool {
        self.usual.words == STIFFNESS.words
    }

    /// The moment on a robot, whose tip is so many diameters away.
    pub(crate) fn moment_of(&self, robot: &Scenario) -> String {
        self.moment.replace("TIP", &tidy(0.5 * robot.length_m / robot.radius_m).to_string())
    }

    /// As a `[[formula]]` of a scenario.
    pub(crate) fn toml(&self, name: &str, robot: &Scenario) -> String {
        let (words, moment) = (&self.words, self.moment_of(robot));
        let (usual, check) = (&self.usual.words, &self.usual.check);
        let mut out = format!(
            "[[formula]]\nname = \"{name}\"\nmoment = \"{moment}\"\n\
             sentence = \"Learned from data: {words}. Usually {usual}.\"\nremedy = \"To check: {check}.\"\n"
        );
        for n in self.numbers {
            let scale = n.scale(robot);
            let [low, high] = n.bounds.map(|b| tidy(b * scale));
            let typical = tidy(scale * if n.is_linear() { 1.0 } else { n.tried[n.tried.len() / 2] });
            let neutral = if n.is_linear() { String::new() } else { format!("neutral = {typical}\n") };
            _ = write!(
                out,
                "\n[formula.parameters.{}]\nunit = \"{}\"\n{neutral}typical = {typical}\nbounds = [{low}, {high}]\nmeaning = \"{}\"\n",
                n.key,
                n.unit_text(),
                n.meaning
            );
        }
        out
    }

    /// The law compiled as a formula for this robot; `None` if it cannot be parsed.
    pub(crate) fn formula(&self, name: &str, robot: &Scenario) -> Option<Arc<Formula>> {
        let body = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\n";
        Scenario::parse(&format!("{body}{}", self.toml(name, robot))).ok()?.formulas.pop()
    }
}

fn tidy(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}
