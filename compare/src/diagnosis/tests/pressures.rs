//! Slips of a pressure column against the robot's own model; what cannot be here; a stiffness that moved.

use crate::diagnosis::tests::{measured, of_one, quick, robot, run};
use crate::diagnosis::*;
use crate::study::published::shipped_scenario;
use data::{Dataset, Hold};

type Spoil = fn(&mut Hold);

fn slipped(data: &Dataset, spoil: Spoil) -> Dataset {
    let mut slipped = data.clone();
    slipped.holds.iter_mut().for_each(spoil);
    slipped
}

#[test]
fn another_unit_is_told_with_what_to_type_and_withholds_the_verdict() {
    let slips: [(&str, Spoil, [&str; 2]); 4] = [
        (
            "epam",
            |hold| hold.p_act_pa /= 6.894_757,
            ["psi under a name of kPa: with 6.8948 times", "p_act_psi in place of p_act_kpa"],
        ),
        (
            "spam",
            |hold| hold.p_act_pa *= 10.0,
            ["look as if they were mbar under a name of kPa", "p_act_mbar in place of p_act_kpa"],
        ),
        ("fpam", |hold| hold.p_body_pa /= 6.894_757, ["the body pressures", "p_body_psi in place of p_body_kpa"]),
        ("cpam", |hold| hold.p_act_pa += 101_325.0, ["look absolute: with 101.3 kPa subtracted", "subtract 101.3 kPa"]),
    ];
    for (kind, spoil, words) in slips {
        let (plain, data) = (robot(kind), measured(&robot(kind), 5, 501));
        assert_eq!(run(&plain, &data).pressure_slip, None, "{kind}");
        let wrong = slipped(&data, spoil);
        let d = run(&plain, &wrong);
        let found = d.pressure_slip.clone().unwrap_or_else(|| panic!("{kind}: {:?}", d.summary));
        assert!(words.iter().all(|words| found.words.contains(words)), "{}", found.words);
        assert!(found.after_mm.unwrap() < 0.5 && d.slips[0] == found.words && d.warnings[0] == found.words);
        assert!(d.verdict.is_none() && d.added.is_empty() && d.indistinguishable.is_empty() && d.attempt.is_empty());
        assert!(d.summary[1].contains("--not pressure_slip"), "{:?}", d.summary);
        // Who says that the pressures are right gets the verdict.
        let not = vec![PRESSURES_ARE_RIGHT.to_string()];
        let d = of_one(&plain, &wrong, None, &Options { not, ..quick() }).unwrap();
        assert!(d.pressure_slip.is_none() && d.verdict.is_some());
    }
}

#[test]
fn exchanged_columns_leave_no_equilibrium_or_a_slip() {
    let (plain, data) = (robot("epam"), measured(&robot("epam"), 5, 502));
    let wrong = slipped(&data, |hold| std::mem::swap(&mut hold.p_act_pa, &mut hold.p_body_pa));
    let words = match of_one(&plain, &wrong, None, &quick()) {
        Ok(d) => d.pressure_slip.unwrap().words,
        Err(error) => error.to_string(),
    };
    assert!(words.contains("look exchanged") && words.contains("exchange the names"), "{words}");
}

/// Diagnosed with a model that does not fit: the shipped robot with data of one without its mechanisms, and numbers that prove a slip.
#[test]
fn a_slip_is_seen_with_a_scenario_that_is_made_otherwise_too() {
    let (whole, plain) = (shipped_scenario("epam").unwrap(), robot("epam"));
    let data = measured(&plain, 5, 504);
    let options = Options { other_design: true, ..quick() };
    let slips: [(Spoil, &str); 6] = [
        (|hold| hold.p_act_pa /= 6.894_757, "psi under a name of kPa"),
        (|hold| hold.p_act_pa *= 10.0, "mbar under a name of kPa"),
        (|hold| hold.p_act_pa /= 0.249_089, "inches of water under a name of kPa"),
        (|hold| hold.p_act_pa /= 100.0, "look"),
        (|hold| hold.p_act_pa += 101_325.0, "look absolute"),
        (|hold| hold.p_body_pa += 101_325.0, "look absolute"),
    ];
    for (spoil, words) in slips {
        for scenario in [&whole, &plain] {
            let told = match of_one(scenario, &slipped(&data, spoil), None, &options) {
                Ok(d) => {
                    assert!(d.verdict.is_none() && d.added.is_empty(), "{words}: {:?}", d.summary);
                    d.pressure_slip.map(|slip| slip.words).unwrap_or_default()
                }
                Err(error) => error.to_string(),
            };
            assert!(told.contains(words), "{words}: {told}");
        }
    }
    assert!(of_one(&whole, &data, None, &options).unwrap().pressure_slip.is_none());
}

/// A hose that takes half of the pressure, a muscle that drags, a robot of finite elements: no factor of a unit.
#[test]
fn effects_of_any_size_and_other_robots_are_no_slips() {
    let plain = robot("epam");
    for (effect, values) in [("pressure_loss", vec![0.5, 1.0]), ("tail_tension", vec![1.4]), ("friction", vec![0.5])] {
        let d = run(&plain, &measured(&plain.with_effect(effect, &values), 5, 503));
        assert_eq!((d.pressure_slip, d.verdict), (None, Some(Verdict::Effect)), "{effect}");
    }
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let evidence = Evidence::read(&format!("fem-{kind}")).unwrap();
        for scenario in [shipped_scenario(kind).unwrap(), shipped_scenario(kind).unwrap().bare()] {
            assert_eq!(pressure_slip(&scenario, &evidence, &quick()).unwrap(), None, "{kind}");
        }
    }
    let arm = crate::ScenarioFile::beside("jitosho-2023-arm").unwrap().unwrap();
    assert_eq!(pressure_slip(&arm, &Evidence::read("jitosho-2023-arm").unwrap(), &quick()).unwrap(), None);
}

#[test]
fn what_cannot_be_here_is_left_out_and_said_so() {
    let plain = robot("epam");
    let data = measured(&plain.with_effect("tail_tension", &[0.9]), 5, 504);
    let with = |not: &[&str]| {
        let not = not.iter().map(|name| name.to_string()).collect();
        of_one(&plain, &data, None, &Options { not, ..quick() })
    };
    let d = with(&["tail_tension", "seam_stiffness"]).unwrap();
    let all = d.ranked.iter().map(|r| &r.effect).chain(d.pairs.iter().flat_map(|pair| &pair.effects));
    assert!(all.into_iter().all(|name| name != "tail_tension" && name != "seam_stiffness"));
    assert!(d.summary.iter().any(|s| s.contains("cannot be here: tail_tension and seam_stiffness")), "{:?}", d.summary);
    let error = with(&["tail_tensoin"]).unwrap_err();
    assert!(error.to_string().contains("tail_tensoin") && error.help().unwrap().contains("tail_tension"), "{error}");
    let own = plain.with_effect("friction", &[0.1]);
    let error = of_one(&own, &data, None, &Options { not: vec!["friction".into()], ..quick() }).unwrap_err();
    assert!(error.to_string().contains("the scenario has this effect"), "{error}");
}

#[test]
fn a_stiffness_that_moved_is_an_alarm_of_its_own_that_leads_to_a_bending_test() {
    let plain = robot("epam");
    let data = measured(&plain, 5, 505);
    assert_eq!(run(&plain, &data).bending_alarm, None);
    let told = plain.with_bending(2.0 * plain.bending_stiffness);
    let d = run(&told, &data);
    let alarm = d.bending_alarm.clone().unwrap();
    assert!(
        alarm.words.contains("[bending] of the data's about.toml") && d.summary.contains(&alarm.words),
        "{:?}",
        d.summary
    );
    assert!((alarm.answer_nm2 / plain.bending_stiffness - 1.0).abs() < 0.2 && alarm.told_nm2 == told.bending_stiffness);
    assert_eq!(of_one(&told, &data, None, &Options { keep_bending: true, ..quick() }).unwrap().bending_alarm, None);
}
