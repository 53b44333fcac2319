//! What a formula may say, what is refused and where.

use super::*;
use crate::effects::PLAIN;
use crate::{Loads, Model, Scenario, shipped};

fn parameter(key: &str, unit: &str, typical: f64) -> FormulaParameter {
    let (si, _) = units::parse(unit).unwrap();
    let (key, unit, meaning) = (key.to_string(), unit.to_string(), String::new());
    FormulaParameter { key, unit, meaning, numbers: Parameter { si, typical, upper: 10.0 * typical, ..PLAIN } }
}

fn made(moment: &str, parameters: &[(&str, &str)]) -> Checked<Formula> {
    let texts = ["own", moment, "", "", ""].map(str::to_string);
    Formula::new(texts, parameters.iter().map(|(key, unit)| parameter(key, unit, 0.5)).collect())
}

/// Value of a formula of `x` alone, whatever its unit.
fn value(text: &str, x: f64) -> f64 {
    let names = [Name { name: "x", dimension: Dimension::NONE }];
    run(&compile(text, &names).unwrap_or_else(|e| panic!("{text}: {e:?}")).program, &[x])
}

#[test]
fn a_formula_means_what_mathematics_means() {
    let x: f64 = 0.7;
    for (text, expected) in [
        ("-x^2", -x * x),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("1 - 2 - 3", -4.0),
        ("8/4/2", 1.0),
        ("-(x - 1)*2 + 3", -(x - 1.0) * 2.0 + 3.0),
        ("exp(-x)*tanh(3*x)", (-x).exp() * (3.0 * x).tanh()),
        ("sqrt(abs(-x))", x.sqrt()),
        ("min(x, 0.5) + max(x, 0.5)", 1.2),
        ("step(x - 0.5)*pos(x) + sign(-x)", x - 1.0),
        ("x^0.5 + 1e-3 + 2.5E+1", x.sqrt() + 25.001),
        ("+x + --x", 2.0 * x),
        ("sin(x)^2 + cos(x)^2", 1.0),
        ("(-x)^3", -x * x * x),
        ("x^(1+1)", x * x),
    ] {
        assert!((value(text, x) - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{text}: {}", value(text, x));
    }
}

/// Sixty-four parentheses, far from the depth of any stack.
#[test]
fn parentheses_nest_sixty_four_deep_and_no_deeper() {
    let nested = |depth: usize| made(&format!("{}k{}", "(".repeat(depth), ")".repeat(depth)), &[("k", "N m")]);
    let deepest = (1..200).take_while(|depth| nested(*depth).is_ok()).count();
    assert_eq!(deepest, 64);
}

#[test]
fn a_formula_has_up_to_eight_parameters() {
    let with = |count: usize| {
        let keys: Vec<String> = (0..count).map(|k| format!("k{k}")).collect();
        let tables =
            keys.iter().map(|k| format!("[formula.parameters.{k}]\nunit = \"N m\"\ntypical = 0.5\nbounds = [0, 20]\n"));
        let text = format!(
            "{}[[formula]]\nname = \"own\"\nmoment = \"{}\"\n",
            shipped("epam-textbook").unwrap(),
            keys.join(" + ")
        );
        Scenario::parse(&(text + &tables.collect::<String>())).err().map_or(String::new(), |error| error.to_string())
    };
    assert_eq!(with(8), "");
    assert!(with(9).contains("1 to 8 parameters, not 9"), "{}", with(9));
}

#[test]
fn each_slip_is_refused_with_its_place() {
    for (moment, unit, place, message) in [
        ("-k*theta^", "N m", "", "ends too early"),
        ("-k*(theta", "N m", "(", "not closed"),
        ("-k*phi", "N m", "phi", "not known"),
        ("-k*theta theta", "N m", "theta", "not expected"),
        ("-k*sinus(theta)", "N m", "sinus", "unknown function"),
        ("-k**theta", "N m", "*", "not expected"),
        ("-k*1.2.3", "N m", "1.2.3", "not a number"),
        ("-k*theta^kappa", "N m", "kappa", "pure number"),
        ("-k*kappa^theta", "N m", "kappa^theta", "has no unit"),
        ("-k*sin(kappa)", "N m", "kappa", "needs a pure number"),
        ("-k*theta + kappa", "N m", "-k*theta + kappa", "cannot be added"),
        ("-k*theta^3", "N", "-k*theta^3", "comes out in N, not in N m"),
        ("-k*kappa", "N m/rad", "-k*kappa", "comes out in N"),
        ("-B*kappa", "N m", "-B*kappa", "does not occur"),
        ("-k*theta - B*kappa", "N m", "-k*theta - B*kappa", "neutral"),
        ("-k/theta", "N m", "-k/theta", "NaN"),
        ("-k*min(theta)", "N m", "min(theta", "two arguments"),
        ("-k*theta§2", "N m", "§", "not expected"),
        ("", "N m", "", "ends too early"),
    ] {
        let slip = made(moment, &[("k", unit)]).unwrap_err();
        let at = &moment[slip.span.unwrap().0..slip.span.unwrap().1];
        assert!(slip.message.contains(message) && !slip.help.as_ref().unwrap().is_empty(), "{moment}: {slip:?}");
        assert_eq!(at, place, "{moment}: {slip:?}");
    }
    for deep in [format!("{}k", "(".repeat(500)), format!("{}k", "-".repeat(500)), format!("k{}", "^2".repeat(500))] {
        assert!(made(&deep, &[("k", "N m")]).is_err());
    }
    assert!(made(&format!("{}k*theta", "k+(".repeat(60)), &[("k", "N m")]).is_err());
}

#[test]
fn no_prefix_of_a_formula_panics() {
    let text = "-k*step(kappa - k0)*(kappa - k0)^1.5*max(R, s)^0.5/tanh(p_act/p_body) + 1e-3*é";
    for end in (0..=text.len()).filter(|end| text.is_char_boundary(*end)) {
        let _ = made(&text[..end], &[("k", "N m2"), ("k0", "1/m")]);
    }
}

#[test]
fn a_misspelt_variable_or_function_is_answered_with_what_was_meant() {
    for (moment, meant) in [("-k*kapa", "did you mean kappa? known: kappa, "), ("-k*sqr(theta)", "did you mean sqrt?")]
    {
        let slip = made(moment, &[("k", "N m")]).unwrap_err();
        assert!(slip.help.as_ref().unwrap().starts_with(meant), "{slip:?}");
    }
}

/// The formula on an ePAM, at 20 kPa, and why there is no equilibrium.
fn unsolved(moment: &str, typical: f64) -> String {
    let text = shipped("epam-textbook").unwrap().to_string()
        + &format!(
            "[[formula]]\nname = \"own\"\nmoment = \"{moment}\"\n\
             [formula.parameters.k]\nunit = \"N m\"\ntypical = {typical}\nbounds = [0, 100]\n"
        );
    let scenario = Scenario::parse(&text).unwrap().with_bending(1.0);
    let model = Model::new(&scenario.with_effect("own", &[typical]));
    model.predict(&Loads::uniform(2e3, 20e3), &mut model.prediction()).unwrap_err().to_string()
}

#[test]
fn a_formula_that_leaves_no_equilibrium_is_named_with_the_state_where_it_is_not_finite() {
    let at_20_kpa = unsolved("-k*theta/(p_act/p_body - 10)", 0.5);
    assert!(at_20_kpa.contains("the formula own gives no finite moment"), "{at_20_kpa}");
    for moment in ["-k/(theta - 1)", "k/(theta - 1)^2"] {
        let pole = unsolved(moment, 50.0);
        assert!(pole.contains("no finite moment") && pole.contains("theta = 1.000"), "{moment}: {pole}");
    }
    let strong = unsolved("k*(1 + theta)", 50.0);
    assert!(strong.contains("the formula own gives ") && strong.contains("e1 N·m at kappa = 12."), "{strong}");
}

#[test]
fn the_force_is_minus_the_slope_of_the_energy_also_at_corners() {
    for (moment, parameters) in [
        ("-k*theta^3", vec![("k", "N m")]),
        ("-k*pos(kappa - k0)", vec![("k", "N m2"), ("k0", "1/m")]),
        ("-k*step(kappa - k0)", vec![("k", "N m"), ("k0", "1/m")]),
        ("-k*tanh(20*theta)*p_act/p_body*exp(-s/R)", vec![("k", "N m")]),
        ("-k*sqrt(abs(theta))*sign(theta)", vec![("k", "N m")]),
    ] {
        let formula = made(moment, &parameters).unwrap_or_else(|e| panic!("{moment}: {e:?}"));
        let robot = Scenario::parse(shipped("epam-textbook").unwrap()).unwrap();
        let mut assembly = crate::assemble::assemble(&robot, &robot.spans(), 12);
        formula.add(&vec![0.5; parameters.len()], &mut assembly);
        let term = assembly.sites[0].body_terms.last().unwrap();
        let energy = |kappa: f64| {
            let q = [kappa];
            let mut force = [0.0];
            (term.add(&Pose { s_m: 0.05, ..Pose::new(&q, 2e3, 2e4) }, &mut force), force[0])
        };
        for kappa in [-3.0, -0.3, 0.2, 0.45, 0.55, 2.0, 7.0] {
            let h = 1e-4 * f64::abs(kappa);
            let slope = (energy(kappa + h).0 - energy(kappa - h).0) / (2.0 * h);
            let force = energy(kappa).1;
            assert!((slope + force).abs() < 1e-6 * (1.0 + force.abs()), "{moment} at {kappa}: {slope} {force}");
        }
        assert_eq!(energy(0.0).0, 0.0);
    }
}

#[test]
fn a_formula_of_the_catalogues_law_predicts_the_same() {
    let text = shipped("epam-textbook").unwrap().to_string()
        + "[[formula]]\nname = \"own_tension\"\nmoment = \"-m*tanh(kappa/k0)\"\n\
           [formula.parameters.m]\nunit = \"N m\"\ntypical = 0.45\nbounds = [-1, 2]\n\
           [formula.parameters.k0]\nunit = \"1/m\"\nneutral = 0.05\ntypical = 0.05\nbounds = [0.01, 1]\n";
    let scenario = Scenario::parse(&text).unwrap().with_bending(1.0);
    let catalogue = scenario.catalogue();
    let own = catalogue.by_name("own_tension").unwrap();
    assert_eq!(own.parameters.iter().map(|p| p.key).collect::<Vec<_>>(), ["m", "k0"]);
    let at = |scenario: &Scenario| {
        let model = Model::new(scenario);
        let mut out = model.prediction();
        let loads = Loads::uniform(2e3, 20e3);
        model.predict(&loads, &mut out).unwrap();
        let ledger: f64 = model.ledger(&loads, &out).iter().map(|line| line.energy_j).sum();
        (out.tip.y_m, ledger)
    };
    let (own, listed) =
        (at(&scenario.with_effect("own_tension", &[0.45, 0.05])), at(&scenario.with_effect("tail_tension", &[0.45])));
    assert!((own.0 - listed.0).abs() < 1e-12 && (own.1 - listed.1).abs() < 1e-12, "{own:?} {listed:?}");
    let neutral = at(&scenario.with_effect("own_tension", &[0.0, 0.05]));
    assert_eq!(neutral.0.to_bits(), at(&scenario).0.to_bits());
}

/// The robot with `moment` over the share `a`, at these values.
fn pulled(robot: &Scenario, kind: &str, moment: &str, values: &[f64]) -> Scenario {
    let text = format!(
        "{}[[formula]]\nname = \"own\"\nmoment = \"{moment}\"\n\
         [formula.parameters.a]\nunit = \"-\"\ntypical = 0.5\nbounds = [0, 1]\n",
        shipped(kind).unwrap()
    );
    Scenario { formulas: Scenario::parse(&text).unwrap().formulas, ..robot.clone() }.with_effect("own", values)
}

#[test]
fn a_share_of_the_pull_is_that_share_of_the_pressure() {
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let robot = Scenario::parse(shipped(kind).unwrap()).unwrap().bare().with_bending(0.5);
        let bend = |scenario: &Scenario, p: f64| {
            let model = Model::new(scenario);
            let mut state = model.prediction();
            model.predict(&Loads::uniform(2e3, p), &mut state).unwrap();
            model.states(&state)[0].curvature
        };
        for p in [8e3, 20e3, 40e3] {
            let (with, without) = (bend(&pulled(&robot, kind, "-a*pull", &[0.3]), p), bend(&robot, 0.7 * p));
            assert!((with - without).abs() < 1e-9 * without, "{kind} at {p}: {with} {without}");
        }
    }
}

#[test]
fn the_force_of_a_share_of_the_pull_is_minus_the_slope_of_its_energy() {
    for kind in ["epam", "fpam", "spam"] {
        let robot = Scenario::parse(shipped(kind).unwrap()).unwrap();
        let scenario = pulled(&robot, kind, "-a*(1 - theta)*pull*exp(-s/R)", &[0.4]);
        let mut assembly = crate::assemble::assemble(&robot, &robot.spans(), 12);
        scenario.formulas[0].add(&[0.4], &mut assembly);
        let term = assembly.sites[0].actuator_terms.last().unwrap();
        let energy = |a: f64| {
            let (q, mut force) = ([a, 0.0, 0.0, 0.0], [0.0; 4]);
            (term.add(&Pose { s_m: 0.05, ..Pose::new(&q, 2e3, 2e4) }, &mut force), force[0])
        };
        for a in [0.02, 0.08, 0.15] {
            let h = 1e-4 * a;
            let slope = (energy(a + h).0 - energy(a - h).0) / (2.0 * h);
            let force = energy(a).1;
            assert!(force != 0.0 && (slope + force).abs() < 1e-6 * force.abs(), "{kind} at {a}: {slope} {force}");
        }
    }
}
