//! The program's own model in the part of another simulator: its predictions without an effect, on data generated with it.

use super::{BaseTable, ForeignCorrection, judge, on_base};
use crate::diagnosis::{Diagnosis, Options, Verdict, diagnose};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::scenario_file::ScenarioFile;
use crate::study::{Generator, generate, predict_dataset};
use data::{Column, Dataset, Table, parse_correction};
use models::Scenario;
use models::effects::{Parameter, by_name};

/// Effects on which the shares are counted, and their size over the typical one.
const HIDDEN: [(&str, f64); 8] = [
    ("end_constraint", 1.0),
    ("pressure_loss", 1.0),
    ("friction", 1.0),
    ("base_clamp", 1.5),
    ("gravity", 1.0),
    ("tail_tension", 2.0),
    ("camera_scale", 1.0),
    ("initial_curvature", 1.5),
];

fn with(scenario: &Scenario, name: &str, times: f64) -> Scenario {
    let typical = |p: &Parameter| p.si * (p.neutral + times * (p.typical_for("epam") - p.neutral));
    let values: Vec<f64> = by_name(name).unwrap().parameters.iter().map(typical).collect();
    scenario.with_effect(name, &values)
}

fn robot() -> ScenarioFile {
    let stiffness = [("body.bending_stiffness_nm2".to_string(), "1.35".to_string())];
    ScenarioFile::read("epam-textbook").unwrap().with(&stiffness).unwrap()
}

/// Predictions at the holds of data, once a hold.
fn predicted(scenario: &Scenario, dataset: &Dataset) -> Table {
    let places_m = predict_dataset(scenario, dataset).unwrap().coordinates_m;
    let (mut numbers, mut markers): ([Vec<f64>; 4], Vec<String>) = Default::default();
    for (h, hold) in dataset.holds.iter().enumerate() {
        for (m, marker) in dataset.markers.iter().enumerate() {
            let at = dataset.offset(h, 0, m);
            let values = [hold.p_body_pa, hold.p_act_pa, 1e6 * places_m[at], 1e6 * places_m[at + 1]];
            numbers.iter_mut().zip(values).for_each(|(column, value)| column.push(1e-3 * value));
            markers.push(marker.name.clone());
        }
    }
    let names = ["p_body_kpa", "p_act_kpa", "x_mm", "y_mm"].map(String::from);
    let columns = names.into_iter().zip(numbers.map(Column::F64)).chain([("marker".into(), Column::Str(markers))]);
    Table { columns: columns.collect() }
}

fn table(text: &str) -> BaseTable {
    BaseTable { file: "base.csv".into(), text: text.into() }
}

fn measured(truth: &Scenario, seed: u64, pressures_kpa: &[f64]) -> Evidence {
    let protocol = pressures_kpa.iter().map(|kpa| [2e3, 1e3 * kpa]).collect();
    Evidence::of(generate(truth, "made", &Generator { seed, protocol, ..Generator::default() }).unwrap(), None)
}

const UP_AND_DOWN: [f64; 7] = [0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0];
const BETWEEN: [f64; 5] = [0.0, 7.0, 15.0, 25.0, 12.0];

fn quick() -> Options {
    Options { next_experiment: false, missing_moment: false, ..Options::default() }
}

fn found(file: &ScenarioFile, evidence: &Evidence) -> Diagnosis {
    diagnose(file, std::slice::from_ref(evidence), &quick(), &mut |_, _| ()).unwrap()
}

/// Whether the hidden effect is in the set, and the errors before and after the correction on pressures left out.
fn trial(foreign: &Scenario, own: &ScenarioFile, truth: &Scenario, name: &str, seed: u64) -> (bool, Option<[f64; 2]>) {
    let evidence = measured(truth, seed, &UP_AND_DOWN);
    let of = |evidence: &Evidence| BaseTable::of("base.csv", &predicted(foreign, &evidence.dataset)).unwrap();
    let on = [on_base(own, &evidence, &of(&evidence)).unwrap()];
    let d = found(own, &on[0]);
    if d.verdict != Some(Verdict::Effect) {
        return (false, None);
    }
    let extension = crate::extend(own, &d).unwrap();
    let text = ForeignCorrection::of(own, &extension, &on).unwrap().text().unwrap();
    let correction = parse_correction("correction.csv", &text).unwrap();
    let other = measured(truth, seed + 50, &BETWEEN);
    let judged = judge(&correction, &of(&other), &other, None).unwrap();
    assert!(!judged.fitted_to_these && judge(&correction, &of(&evidence), &evidence, None).unwrap().fitted_to_these);
    let is_named = d.indistinguishable.iter().any(|names| names.split(" + ").any(|n| n == name));
    (is_named, Some([judged.before.beyond_noise_mm, judged.after.beyond_noise_mm]))
}

/// The foreign model is stiffer by 4 %: its base is not exactly the scenario.
#[test]
fn eight_hidden_effects_are_named_and_the_correction_helps_at_pressures_left_out() {
    let own = robot();
    let foreign = own.scenario.with_bending(1.35 * 1.04);
    let (mut in_set, mut tried) = (0, 0);
    for (i, (name, times)) in HIDDEN.into_iter().enumerate() {
        let truth = with(&foreign, name, times);
        for seed in [100, 200] {
            let (named, errors) = trial(&foreign, &own, &truth, name, seed + i as u64);
            tried += 1;
            in_set += usize::from(named);
            println!("{name} {named} {errors:?}");
            assert!(errors.is_none_or(|[before, after]| after < before), "{name}: {errors:?}");
        }
    }
    assert!(10 * in_set >= 8 * tried, "{in_set} of {tried}");
}

#[test]
fn a_base_that_lacks_nothing_gets_no_name() {
    let own = robot();
    let foreign = with(&own.scenario.with_bending(1.35 * 1.04), "end_constraint", 1.0);
    let alarms = [1, 2, 3, 4].map(|seed| {
        let evidence = measured(&foreign, seed, &UP_AND_DOWN);
        let base = BaseTable::of("base.csv", &predicted(&foreign, &evidence.dataset)).unwrap();
        let d = found(&own, &on_base(&own, &evidence, &base).unwrap());
        usize::from(d.verdict != Some(Verdict::None))
    });
    assert!(alarms.iter().sum::<usize>() <= 1, "{alarms:?}");
}

#[test]
fn the_scenario_as_base_is_the_diagnosis_of_the_scenario() {
    let own = robot();
    let evidence = measured(&own.with_effect("friction", &[0.3]), 3, &UP_AND_DOWN);
    let base = BaseTable::of("base.csv", &predicted(&own, &evidence.dataset)).unwrap();
    let [plain, on] = [evidence.clone(), on_base(&own, &evidence, &base).unwrap()].map(|one| found(&own, &one));
    assert_eq!(plain.indistinguishable, on.indistinguishable);
    assert!((plain.base.systematic_mm - on.base.systematic_mm).abs() < 1e-9);
    assert_eq!(plain.evidence, on.evidence, "the hash is the hash of the measurements");
    assert!(on.foreign_bases[0].from_scenario_mm < 1e-9 && on.summary[0].starts_with("The base is base.csv"));
}

#[test]
fn a_table_that_is_not_for_the_data_is_refused_with_line_and_remedy() {
    let own = robot();
    let evidence = measured(&own, 1, &[0.0, 10.0, 20.0, 30.0]);
    let mut text = Vec::new();
    predicted(&own, &evidence.dataset).to_csv(&mut text).unwrap();
    let good = String::from_utf8(text).unwrap();
    let read = |text: &str| on_base(&own, &evidence, &table(text));
    read(&good).unwrap();
    let refused = |text: String, place: &str, says: &str| match read(&text) {
        Err(error @ CompareError::Data(_)) => {
            let words = format!("{error} {}", error.help().unwrap_or_default());
            assert!(words.starts_with(place) && words.contains(says), "{words}");
        }
        other => panic!("{place} {says}: {:?}", other.map(|found| found.base)),
    };
    let columns = |change: &dyn Fn(&mut Vec<String>)| {
        let changed = |(i, line): (usize, &str)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
            if i > 0 {
                change(&mut cells);
            }
            cells.join(",")
        };
        good.lines().enumerate().map(changed).collect::<Vec<_>>().join("\n")
    };
    let times = |cell: &str, by: f64| (cell.parse::<f64>().unwrap() * by).to_string();
    refused(good.replace("p_act_kpa", "p_set_kpa"), "base.csv:1", "add p_act_kpa");
    refused(good.replace("x_mm", "x"), "base.csv:1, column x", "name it x_mm");
    refused(good.replacen("\n2,30,", "\n2,33,", 1), "base.csv:20, column p_act_kpa", "30.0 kPa actuator");
    let without_30: Vec<&str> = good.lines().filter(|line| !line.starts_with("2,30,")).collect();
    refused(without_30.join("\n"), "base.csv:19", "no row has the pressures of the hold at 30.0 kPa");
    let without_one: Vec<&str> = good.lines().enumerate().filter(|(i, _)| *i != 9).map(|(_, line)| line).collect();
    refused(without_one.join("\n"), "base.csv:8", "marker 3 has no prediction at 10.0 kPa");
    refused(format!("{good}2,10,100,0,1\n"), "base.csv:26", "another prediction for the same hold in line 8");
    refused(good.replacen(",1\n", ",one\n", 1), "base.csv:2, column marker", "its markers are 1, 2, 3");
    refused(good.replacen("2,30,", "2,30,one", 1), "base.csv:20, column x_mm", "number");
    refused(
        columns(&|cells| (2..4).for_each(|k| cells[k] = times(&cells[k], 1e-3))),
        "base.csv:",
        "metres under a header of mm",
    );
    refused(columns(&|cells| cells.swap(2, 3)), "base.csv:", "x and y look exchanged");
    refused(columns(&|cells| cells[3] = times(&cells[3], -1.0)), "base.csv:25", "write -y");
    let exchanged = |cells: &mut Vec<String>| {
        let other = match cells[4].as_str() {
            "3" => "4",
            "4" => "3",
            same => same,
        };
        cells[4] = other.to_string();
    };
    refused(columns(&exchanged), "base.csv:", "markers 3 and 4 look exchanged");
}
