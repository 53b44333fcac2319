//! Laws of a diagnosis with a gauge at the actuator. Data by the catalogue's own formulas, seeded.

use crate::diagnosis::candidates::candidates;
use crate::diagnosis::tests::{of_one, quick, robot};
use crate::diagnosis::*;
use crate::study::{Generator, generate};
use data::{About, Dataset, Direct};

fn read_along(truth: &Scenario, runs: usize, seed: u64) -> Dataset {
    let protocol = [0.0, 5e3, 10e3, 15e3, 20e3, 25e3, 30e3, 0.0].map(|p| [2e3, p]).to_vec();
    generate(truth, "read", &Generator { runs, seed, protocol, gauge: true, ..Generator::default() }).unwrap()
}

fn run(scenario: &Scenario, data: &Dataset) -> Diagnosis {
    of_one(scenario, data, None, &quick()).unwrap()
}

#[test]
fn a_gauge_names_the_law_of_the_supply() {
    let plain = robot("epam");
    for (i, name) in ["pressure_loss", "pressure_offset", "leak"].into_iter().enumerate() {
        let law = candidates(&plain).into_iter().find(|c| c.name == name).unwrap();
        let data = read_along(&law.apply(&plain, &law.at(1.0)), 5, 400 + i as u64);
        let d = run(&plain, &data);
        assert_eq!((d.verdict, d.indistinguishable[0].as_str()), (Some(Verdict::Effect), name));
        let group = |n: &String| d.ranked.iter().find(|r| r.effect == *n).unwrap().group;
        assert!(d.indistinguishable.iter().all(|n| group(n) == Group::Supply), "{:?}", d.indistinguishable);
        let gauge = &d.gauges[0];
        assert!(gauge.after_kpa < 0.25 && gauge.before_kpa > 4.0 * gauge.after_kpa, "{name}: {gauge:?}");
        let found = &d.added[0].parameters[0];
        let true_value = law.at(1.0)[0] / law.parameters[0].si;
        assert!(found.lo.unwrap() <= true_value && true_value <= found.hi.unwrap(), "{name}: {found:?}");
        // Positions are predicted at what was read: nothing of the supply is in their error.
        assert!(d.base.systematic_mm < 0.5, "{name}: {} mm", d.base.systematic_mm);
    }
}

/// Without readings an exponent is told by the form of the curve alone; with them closely.
#[test]
fn a_gauge_tells_the_exponent_of_a_loss() {
    let plain = robot("epam");
    let truth = plain.with_effect("pressure_loss", &[0.15, 0.7]);
    let d = run(&plain, &read_along(&truth, 5, 451));
    assert_eq!(d.indistinguishable[0], "pressure_loss", "{:?}", d.summary);
    let [f, n] = &d.added[0].parameters[..] else { panic!("{:?}", d.added) };
    for (found, put_in) in [(f, 0.15), (n, 0.7)] {
        assert!(found.lo.unwrap() < put_in && put_in < found.hi.unwrap(), "{put_in}: {found:?}");
    }
    let width = |p: &ParameterValue| p.lo.zip(p.hi).map_or(f64::INFINITY, |(lo, hi)| hi - lo);
    let told = width(n);
    let d = run(&plain, &generate(&truth, "made", &Generator { runs: 5, seed: 452, ..Generator::default() }).unwrap());
    let loss = d.ranked.iter().find(|r| r.effect == "pressure_loss").unwrap();
    let [f, n] = &loss.parameters[..] else { panic!("{loss:?}") };
    assert!(!f.held && !n.held && width(n) > told, "{told}: {loss:?}");
    let n = &ParameterValue { value: 1.0, lo: None, hi: None, held: true, ..n.clone() };
    let pinned = ParameterValue { lo: Some(n.value), hi: Some(n.value), held: false, ..n.clone() };
    assert_eq!(crate::diagnosis::result::words::with_interval(&pinned), "n = 1 (the end of its range)");
    assert!(
        crate::diagnosis::result::words::with_interval(n) == "n = 1 (held)"
            && !crate::diagnosis::result::words::with_interval(f).contains("held")
    );
}

#[test]
fn with_a_gauge_no_supply_is_blamed_for_the_robot() {
    let plain = robot("epam");
    let d = run(&plain, &read_along(&plain.with_effect("tail_tension", &[0.9]), 5, 411));
    assert!(d.indistinguishable.iter().any(|n| n == "tail_tension"), "{:?}", d.indistinguishable);
    let supply = |n: &String| d.ranked.iter().any(|r| r.effect == *n && r.group == Group::Supply);
    assert!(!d.indistinguishable.iter().any(supply), "{:?}", d.indistinguishable);
}

#[test]
fn what_the_scenario_says_of_the_supply_is_held_against_the_gauge() {
    let plain = robot("spam");
    let truth = plain.with_effect("pressure_loss", &[0.15, 1.0]);
    let data = read_along(&truth, 5, 421);
    let d = run(&truth, &data);
    assert_eq!(d.verdict, Some(Verdict::None), "{:?}", d.summary);
    assert!(d.gauges[0].before_kpa < 0.3 && d.base.systematic_mm < 0.5, "{:?}", d.gauges);
    let other = run(&plain.with_effect("pressure_loss", &[0.3, 1.0]), &data);
    assert!(other.verdict == Some(Verdict::OutOfCatalog) && other.gauges[0].before_kpa > 1.0, "{:?}", other.summary);
    assert!(other.lack_of_fit_after.unwrap().supply.unwrap() < 1e-3);
}

#[test]
fn a_gauge_raises_no_false_alarms() {
    let alarms = (0..24).filter(|seed| {
        let kind = ["spam", "cpam", "epam", "fpam"][*seed as usize % 4];
        let runs = [3, 5, 10][*seed as usize % 3];
        let plain = robot(kind);
        run(&plain, &read_along(&plain, runs, 500 + seed)).verdict != Some(Verdict::None)
    });
    assert!(alarms.count() <= 1);
}

#[test]
fn a_gauge_beside_a_pressure_that_is_the_actuators_own_is_left_out_with_a_word() {
    let plain = robot("epam");
    let data = read_along(&plain, 3, 431);
    let about = About { direct: Direct { pressure: true, frame: false }, ..crate::study::tests::about(&[]) };
    let d = of_one(&plain, &data, Some(&about), &quick()).unwrap();
    assert!(d.gauges.is_empty() && d.warnings.iter().any(|w| w.contains("p_gauge")), "{:?}", d.warnings);
}
