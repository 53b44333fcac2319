//! The library: laws of a missing moment, each a formula with one to three numbers of order one in units of the robot's own.
//!
//! ```text
//! M₀ = π p_b R³        κ₀ = 1/R        the folded wall's moment, and a bend as sharp as the body
//! ```
//!
//! M₀ tanh(κR/0.002) is the step at no bend that the wall itself has: a robot without pressure lies straight.

use models::{Formula, Scenario};
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::sync::Arc;

/// In which unit of the robot a number is of order one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unit {
    /// π p_b R³ \[N·m\].
    Moment,
    /// π p_b R⁴ \[N·m²\].
    Stiffness,
    /// 1/R \[1/m\].
    Bend,
    /// None.
    One,
}

/// One number of a law.
#[derive(Debug, Clone, Copy)]
pub struct Number {
    /// Key in the formula.
    pub key: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// Bounds in that unit.
    pub bounds: [f64; 2],
    /// Values that are tried, in that unit, where the law is not linear in it.
    pub tried: &'static [f64],
    /// What it is.
    pub meaning: &'static str,
}

/// A law of the library.
#[derive(Debug)]
pub struct Form {
    /// What it is, in words.
    pub words: &'static str,
    /// The moment.
    pub moment: &'static str,
    /// Its numbers.
    pub numbers: &'static [Number],
    /// It has a part proportional to the bend: it takes the place of a bending stiffness that is fitted.
    pub has_spring: bool,
    /// It can be told from another only where the body's pressure changes.
    pub of_body: bool,
    /// What such a law usually is.
    pub usual: &'static str,
    /// What tells.
    pub check: &'static str,
}

const fn linear(key: &'static str, unit: Unit, meaning: &'static str) -> Number {
    Number { key, unit, bounds: [-20.0, 20.0], tried: &[], meaning }
}

const POWERS: &[f64] = &[0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0];
const POWER: Number =
    Number { key: "n", unit: Unit::One, bounds: [0.1, 4.0], tried: POWERS, meaning: "power of the bend" };
const PRESSURE: Number = Number {
    key: "q",
    unit: Unit::One,
    bounds: [0.0, 3.0],
    tried: &[0.25, 0.5, 0.75, 1.0, 1.5, 2.0],
    meaning: "power of the pressure",
};
const TOUCH: Number = Number {
    key: "k0",
    unit: Unit::Bend,
    bounds: [0.0, 0.5],
    tried: &[0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2],
    meaning: "bend at which it begins",
};

const TENSION: &str = "a steady moment: a tail or hose under tension, seams that are bent open, friction on the way up";
const TENSION_CHECK: &str = "go up and down in pressure (friction changes its sign), and repeat without hoses";
const SHARE: &str = "a share of the actuator's pull that does not arrive: sealed edges, folds that have not opened";
const SHARE_CHECK: &str = "pull one unit in a testing machine, or build one with wider units: edges then weigh less";
const SOFTENS: &str = "a resistance that softens as it bends: a wall that wrinkles or creases, layers that buckle";
const SOFTENS_CHECK: &str = "hang weights on the inflated body with the actuator vented, and plot moment over bend";

const TIP_END: &str = "an end that does not bend along: the closed end of a muscle, a cap, the last pouch's seal";
const TIP_CHECK: &str = "film the last tenth of the robot: it stays straight where the rest bends";

/// Laws, those with fewer numbers first.
pub const LIBRARY: &[Form] = &[
    Form {
        words: "a steady moment",
        moment: "-m*tanh(kappa*R/0.002)",
        numbers: &[linear("m", Unit::Moment, "moment that holds back")],
        has_spring: false,
        of_body: false,
        usual: TENSION,
        check: TENSION_CHECK,
    },
    Form {
        words: "a spring",
        moment: "-k*kappa",
        numbers: &[linear("k", Unit::Stiffness, "stiffness")],
        has_spring: true,
        of_body: false,
        usual: "a bending stiffness that the scenario lacks",
        check: "bend the inflated body with the actuator vented",
    },
    Form {
        words: "a share of the pull",
        moment: "-a*pull",
        numbers: &[linear("a", Unit::One, "share of the pull that is lost")],
        has_spring: false,
        of_body: false,
        usual: SHARE,
        check: SHARE_CHECK,
    },
    Form {
        words: "a moment in step with the actuator's pressure",
        moment: "-a*p_act*R^3*tanh(kappa*R/0.002)",
        numbers: &[linear("a", Unit::One, "moment over P R³")],
        has_spring: false,
        of_body: false,
        usual: SHARE,
        check: SHARE_CHECK,
    },
    Form {
        words: "a moment in step with the body's pressure",
        moment: "-a*p_body*R^3*tanh(kappa*R/0.002)",
        numbers: &[linear("a", Unit::One, "moment over p_b R³")],
        has_spring: false,
        of_body: true,
        usual: "gas of the body that is pressed out as it bends: pouches in the wall, a section that flattens",
        check: "weigh the gas or watch the body's regulator while it bends, at two body pressures",
    },
    Form {
        words: "a resistance that falls with bend",
        moment: "-m*tanh(kappa*R/0.002) + k*kappa",
        numbers: &[
            linear("m", Unit::Moment, "moment at small bends"),
            linear("k", Unit::Stiffness, "by how much it falls per bend"),
        ],
        has_spring: true,
        of_body: false,
        usual: SOFTENS,
        check: SOFTENS_CHECK,
    },
    Form {
        words: "a power of the bend",
        moment: "-m*(pos(kappa)*R)^n",
        numbers: &[linear("m", Unit::Moment, "moment at a bend of 1/R"), POWER],
        has_spring: true,
        of_body: false,
        usual: SOFTENS,
        check: SOFTENS_CHECK,
    },
    Form {
        words: "a stop",
        moment: "-k*pos(kappa - k0)",
        numbers: &[Number { bounds: [0.0, 200.0], ..linear("k", Unit::Stiffness, "stiffness beyond it") }, TOUCH],
        has_spring: false,
        of_body: false,
        usual: "a stop: pouches or folds that meet, a clamp, a yarn that is drawn taut",
        check: "film the side view: the bend of one pouch stays where the stop begins",
    },
    Form {
        words: "a share of the pull that changes with bend",
        moment: "-(a + b*theta)*pull",
        numbers: &[
            linear("a", Unit::One, "share of the pull that is lost at small bends"),
            linear("b", Unit::One, "change of that share per radian of one unit"),
        ],
        has_spring: false,
        of_body: false,
        usual: SHARE,
        check: SHARE_CHECK,
    },
    Form {
        words: "a moment in step with the actuator's pressure that changes with bend",
        moment: "-(a - b*kappa*R)*p_act*R^3*tanh(kappa*R/0.002)",
        numbers: &[
            linear("a", Unit::One, "moment over P R³ at small bends"),
            Number { bounds: [-200.0, 200.0], ..linear("b", Unit::One, "by how much it falls per κR") },
        ],
        has_spring: false,
        of_body: false,
        usual: SHARE,
        check: SHARE_CHECK,
    },
    Form {
        words: "a share of the pull that is lost towards the tip",
        moment: "-a*pull*exp(0.5*s/R - TIP)",
        numbers: &[linear("a", Unit::One, "share of the pull that is lost at the tip")],
        has_spring: false,
        of_body: false,
        usual: TIP_END,
        check: TIP_CHECK,
    },
    Form {
        words: "a steady moment at the tip",
        moment: "-m*tanh(kappa*R/0.002)*exp(0.5*s/R - TIP)",
        numbers: &[linear("m", Unit::Moment, "moment that holds the tip back")],
        has_spring: false,
        of_body: false,
        usual: TIP_END,
        check: TIP_CHECK,
    },
    Form {
        words: "a share of the pull, another at the tip",
        moment: "-(a + b*exp(0.5*s/R - TIP))*pull",
        numbers: &[
            linear("a", Unit::One, "share of the pull that is lost"),
            linear("b", Unit::One, "share more at the tip"),
        ],
        has_spring: false,
        of_body: false,
        usual: TIP_END,
        check: TIP_CHECK,
    },
    Form {
        words: "a steady moment, another at the tip",
        moment: "-(m + n*exp(0.5*s/R - TIP))*tanh(kappa*R/0.002)",
        numbers: &[
            linear("m", Unit::Moment, "moment that holds back"),
            linear("n", Unit::Moment, "moment more at the tip"),
        ],
        has_spring: false,
        of_body: false,
        usual: TIP_END,
        check: TIP_CHECK,
    },
    Form {
        words: "a resistance that falls with bend, and a steady moment at the tip",
        moment: "-(m + n*exp(0.5*s/R - TIP))*tanh(kappa*R/0.002) + k*kappa",
        numbers: &[
            linear("m", Unit::Moment, "moment at small bends"),
            linear("n", Unit::Moment, "moment more at the tip"),
            linear("k", Unit::Stiffness, "by how much it falls per bend"),
        ],
        has_spring: true,
        of_body: false,
        usual: SOFTENS,
        check: SOFTENS_CHECK,
    },
    Form {
        words: "a share of the pull that changes with bend, another at the tip",
        moment: "-(a + b*theta + c*exp(0.5*s/R - TIP))*pull",
        numbers: &[
            linear("a", Unit::One, "share of the pull that is lost at small bends"),
            linear("b", Unit::One, "change of that share per radian of one unit"),
            linear("c", Unit::One, "share more at the tip"),
        ],
        has_spring: false,
        of_body: false,
        usual: SHARE,
        check: SHARE_CHECK,
    },
    Form {
        words: "a power of bend and pressure",
        moment: "-m*(p_act/p_body)^q*(pos(kappa)*R)^n",
        numbers: &[linear("m", Unit::Moment, "moment at a bend of 1/R and P = p_b"), POWER, PRESSURE],
        has_spring: true,
        of_body: false,
        usual: SOFTENS,
        check: SOFTENS_CHECK,
    },
];

impl Number {
    /// Its unit in SI, on a robot.
    pub fn scale(&self, robot: &Scenario) -> f64 {
        let (r, moment) = (robot.radius_m, PI * robot.p_body_pa * robot.radius_m.powi(3));
        match self.unit {
            Unit::Moment => moment,
            Unit::Stiffness => moment * r,
            Unit::Bend => 1.0 / r,
            Unit::One => 1.0,
        }
    }

    /// How it is written.
    pub fn unit_text(&self) -> &'static str {
        match self.unit {
            Unit::Moment => "N m",
            Unit::Stiffness => "N m2",
            Unit::Bend => "1/m",
            Unit::One => "-",
        }
    }

    /// Whether the law is linear in it: then it vanishes without it.
    pub fn is_linear(&self) -> bool {
        self.tried.is_empty()
    }
}

impl Form {
    /// The moment on a robot, whose tip lies so many diameters away.
    pub fn moment_of(&self, robot: &Scenario) -> String {
        self.moment.replace("TIP", &tidy(0.5 * robot.length_m / robot.radius_m).to_string())
    }

    /// As a `[[formula]]` of a scenario.
    pub fn toml(&self, name: &str, robot: &Scenario) -> String {
        let Form { words, usual, check, .. } = self;
        let moment = self.moment_of(robot);
        let mut out = format!(
            "[[formula]]\nname = \"{name}\"\nmoment = \"{moment}\"\n\
             sentence = \"Learned from data: {words}. Usually {usual}.\"\nremedy = \"To tell: {check}.\"\n"
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

    /// Compiled, for a robot.
    pub fn formula(&self, name: &str, robot: &Scenario) -> Option<Arc<Formula>> {
        let body = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\n";
        Scenario::parse(&format!("{body}{}", self.toml(name, robot))).ok()?.formulas.pop()
    }
}

/// Three digits.
fn tidy(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}
