//! Tables made from the model with something hidden, and without; published ones.

use super::*;
use crate::bench::modelled;
use data::bench::bench;
use data::parse_bench;

const BEAM: &str = "name = \"beam\"\n[body]\nradius_mm = 80\nlength_mm = 1000\npressure_kpa = 30\n[markers]\ns_mm = [1000]\n\
                    [predict]\npressures_kpa = [0]\nsegments = 40\n";

/// Normal enough: twelve uniform numbers of a linear congruence.
struct Chance(u64);

impl Chance {
    fn normal(&mut self) -> f64 {
        let mut uniform = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

/// A table of means of `n` tests that scatter by a share, with the standard deviation that they show.
fn made(head: &str, rows: &[String], truth: &Scenario, (share, n, seed): (f64, usize, u64)) -> Bench {
    let beam = head.starts_with("p_body");
    let column = if beam { "deflection_mm,deflection_sd_mm" } else { "force_n,force_sd_n" };
    let mut chance = Chance(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let mut text = format!("{head},{column},n\n");
    for row in rows {
        let bare = parse_bench("a.csv", &format!("{},{}\n{row},1\n", head, column.split(',').next().unwrap()));
        let bench = bare.unwrap().unwrap();
        let trial = crate::bench::Trial { scenario: truth.clone(), bias_rad: None };
        let specimen = trial.specimen(&bench.rows[0]).unwrap();
        let exact = modelled(&bench.rows[0], &specimen).unwrap() * if beam { 1e3 } else { 1.0 };
        let tests: Vec<f64> = (0..n).map(|_| exact * (1.0 + share * chance.normal())).collect();
        let mean = tests.iter().sum::<f64>() / n as f64;
        let variance = tests.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / (n - 1) as f64;
        text.push_str(&format!("{row},{mean:e},{:e},{n}\n", variance.sqrt()));
    }
    parse_bench("a.csv", &text).unwrap().unwrap()
}

fn beams() -> Vec<String> {
    let of = |p: u32| [0.15, 0.3, 0.45, 0.6, 0.75, 0.85].map(|share| format!("{p},{}", share * f64::from(p) * 1.608));
    [20, 30, 50].iter().flat_map(|p| of(*p)).collect()
}

fn muscles() -> Vec<String> {
    [10, 20, 40].iter().flat_map(|p| [0, 2, 4, 6, 8].map(|e| format!("{p},{e}"))).collect()
}

fn fpam() -> Scenario {
    Scenario::parse(models::shipped("fpam").unwrap()).unwrap().bare()
}

/// In the set, and its value in the interval.
fn is_named(d: &BenchDiagnosis, effect: &str, value: f64) {
    let seen: Vec<_> = d.ranked.iter().map(|r| (&r.effect, r.parameters[0].value, r.off, r.gain, r.in_set)).collect();
    assert!(d.verdict == Some(Verdict::Effect) && d.set().count() < 5, "{:?} {seen:?}", d.summary);
    let named = d.set().find(|r| r.effect == effect);
    let named = named.unwrap_or_else(|| panic!("{effect}: {:?} {seen:?}", d.summary));
    let p = &named.parameters[0];
    assert!(p.lo.unwrap() <= value && value <= p.hi.unwrap(), "{effect}: {p:?}");
    assert!(p.hi.unwrap() - p.lo.unwrap() < value.abs(), "{effect}: {p:?}");
    assert!(named.off < 0.5 * d.off && named.left_out.iter().all(|l| l.off < 0.7 * d.off), "{named:?}");
}

#[test]
fn what_was_hidden_in_a_beam_is_named_with_its_value() {
    let beam = Scenario::parse(BEAM).unwrap();
    let mut stretches = beam.clone();
    stretches.wall.stiffness_n_per_m = Some(6e4);
    let head = "p_body_kpa,load_n";
    let table = made(head, &beams(), &stretches, (0.03, 5, 1));
    is_named(&diagnose_bench(&table, Some(&beam), &BenchOptions::default()).unwrap(), "wall_stiffness", 6e4);
    let table = made(head, &beams(), &stretches.with_effect("body_pressure_offset", &[-2e3]), (0.01, 5, 6));
    is_named(
        &diagnose_bench(&table, Some(&stretches), &BenchOptions::default()).unwrap(),
        "body_pressure_offset",
        -2.0,
    );
}

#[test]
fn what_was_hidden_in_a_muscle_is_named_with_its_value() {
    for (effect, value) in [("shear_stiffness", 60.0), ("end_fittings", 0.5), ("yarn_stretch", 1.5e-4)] {
        let table = made("p_act_kpa,contraction_pct", &muscles(), &fpam().with_effect(effect, &[value]), (0.01, 5, 3));
        is_named(&diagnose_bench(&table, Some(&fpam()), &BenchOptions::default()).unwrap(), effect, value);
    }
    let mut steeper = fpam();
    steeper.actuator.shape.bias_rad = 40_f64.to_radians();
    let table = made("p_act_kpa,contraction_pct", &muscles(), &steeper, (0.02, 5, 4));
    is_named(&diagnose_bench(&table, Some(&fpam()), &BenchOptions::default()).unwrap(), "bias_angle", 40.0);
}

/// An interval of 95 % misses in one of twenty, and few tests a row do not make it smaller than it is.
#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let truth = fpam().with_effect("shear_stiffness", &[60.0]);
    let holds = |seed: &u64| {
        let scatter = (0.03, 3 + 2 * (*seed as usize % 2), 200 + seed);
        let table = made("p_act_kpa,contraction_pct", &muscles(), &truth, scatter);
        let d = diagnose_bench(&table, Some(&fpam()), &BenchOptions::default()).unwrap();
        let named = d.ranked.into_iter().find(|r| r.effect == "shear_stiffness").unwrap();
        let p = &named.parameters[0];
        p.lo.unwrap() <= 60.0 && 60.0 <= p.hi.unwrap()
    };
    let holds = (0..40).filter(holds).count();
    assert!((34..=40).contains(&holds), "{holds} of 40");
}

/// Scatter that three or five tests show of themselves gives no alarm: at α = 0.01 less than one in 60 is expected.
#[test]
fn where_nothing_was_hidden_nothing_is_missing() {
    let truth = fpam().with_effect("shear_stiffness", &[60.0]);
    let alarms = (0..60).filter(|seed| {
        let table =
            made("p_act_kpa,contraction_pct", &muscles(), &truth, (0.03, 3 + 2 * (*seed as usize % 2), 100 + seed));
        let d = diagnose_bench(&table, Some(&truth), &BenchOptions::default()).unwrap();
        d.verdict != Some(Verdict::None)
    });
    let alarms = alarms.count();
    assert!(alarms <= 3, "{alarms} of 60");
    let beam = Scenario::parse(BEAM).unwrap();
    let table = made("p_body_kpa,load_n", &beams(), &beam, (0.03, 4, 5));
    let d = diagnose_bench(&table, Some(&beam), &BenchOptions::default()).unwrap();
    assert!(d.verdict == Some(Verdict::None) && d.summary[1].contains("agrees"), "{:?}", d.summary);
}

#[test]
fn what_no_effect_explains_is_said_to_be_outside_with_its_place() {
    let mut text = "p_act_kpa,contraction_pct,force_n,force_sd_n,n\n".to_string();
    for p in [10_u32, 20, 40] {
        for (e, factor) in [(0, 1.0), (3, 1.0), (6, 1.4), (9, 0.7), (12, 1.0)] {
            let exact = models::Machine::new(&fpam()).unwrap().pull_n(1e3 * f64::from(p), 0.01 * f64::from(e)).unwrap();
            text.push_str(&format!("{p},{e},{},{},4\n", factor * exact, 0.01 * exact));
        }
    }
    let table = parse_bench("a.csv", &text).unwrap().unwrap();
    let d = diagnose_bench(&table, Some(&fpam()), &BenchOptions::default()).unwrap();
    assert_eq!((d.verdict, d.explains), (Some(Verdict::OutOfCatalog), false), "{:?}", d.summary);
    assert!(d.summary.iter().any(|s| s.contains("No single effect of the catalogue explains it")), "{:?}", d.summary);
    assert!(d.where_it_fails.iter().any(|s| s.contains("9.0 %: force N")), "{:?}", d.where_it_fails);
}

#[test]
fn published_tables_are_ranked_without_a_verdict_and_with_one_where_their_scatter_is_told() {
    let diagnosed = |set: &str, options: &BenchOptions| {
        let bench = bench(set).unwrap().unwrap();
        let scenario = bench.scenario.as_ref().map(|(_, text)| Scenario::parse(text).unwrap());
        let scenario = scenario.map(|s| Scenario { segments: 30, ..s });
        diagnose_bench(&bench, scenario.as_ref(), options).unwrap()
    };
    let festo = data::bench::bench("festo-bolen-2026").unwrap().unwrap();
    let textbook = Scenario::parse(models::shipped("fpam-textbook").unwrap()).unwrap();
    let found = diagnose_bench(&festo, Some(&textbook), &BenchOptions::default()).unwrap();
    assert_eq!((found.verdict, found.set().next().unwrap().effect.as_str()), (None, "end_fittings"));
    let told = diagnosed("festo-bolen-2026", &BenchOptions { sigma: Some(0.05), ..BenchOptions::default() });
    assert!(told.verdict.is_some() && told.p_value.is_some(), "{:?}", told.summary);
    let free = diagnosed("mckibben-free", &BenchOptions::default());
    assert!(free.base.len() == 1 && free.unsized_laws.iter().any(|l| l == "shear_stiffness"), "{:?}", free.summary);
    let beams = diagnosed("breukels-2011-beams", &BenchOptions::default());
    assert!(beams.set().any(|r| r.effect == "wall_stiffness") && beams.left_out.len() == 2, "{:?}", beams.summary);
}

#[test]
fn what_a_model_cannot_have_is_refused_with_line_and_remedy() {
    let refused = |text: &str, scenario: Option<&Scenario>, words: &[&str]| {
        let table = parse_bench("a.csv", text).unwrap().unwrap();
        let error = diagnose_bench(&table, scenario, &BenchOptions::default()).unwrap_err().to_string();
        assert!(words.iter().all(|w| error.contains(w)), "{error}");
    };
    let muscle = "p_act_kpa,contraction_pct,force_n\n20,5,30\n";
    refused(muscle, None, &["a.csv", "line 2", "a muscle needs its size", "diameter_mm"]);
    refused(muscle, Some(&Scenario::parse(BEAM).unwrap()), &["line 2", "no actuator"]);
    let epam = Scenario::parse(models::shipped("epam").unwrap()).unwrap();
    refused(
        "# bias_deg: 25\n# diameter_mm: 10\np_act_kpa,contraction_pct,force_n\n20,5,30\n",
        Some(&epam),
        &["pouch", "fpam"],
    );
    refused("p_body_kpa,load_n,deflection_mm\n20,5,3\n", None, &["a beam needs a scenario", "scenario.toml"]);
    refused("p_act_kpa,contraction_pct,force_n\n20,75,3\n", Some(&fpam()), &["no answer", "contraction"]);
    refused("# areal_mass_g_m2: 155\noverhang_mm,droop_deg\n60,41\n", None, &["characterize"]);
}
