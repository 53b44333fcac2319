//! Experiments that may be proposed, for any robot: its own pressures scaled, not ours.

use crate::diagnosis::known::BenchTest;
use crate::diagnosis::source::{DiagnosisSource, body_pressures, seen_rolled};
use crate::policy;
use data::{Dataset, Direct, Hold, Lost, Phase};
use models::Scenario;

pub(crate) const TIP_FORCE_N: f64 = 0.3;
const LONG_HOLD_S: f64 = 60.0;

/// Standard deviation that is expected of a bending test, as a share of the stiffness. Assumed.
pub const BENDING_TEST: f64 = 0.1;
/// Name of the experiment that measures B alone.
pub const BENDING_TEST_NAME: &str = "bending test";

/// An experiment: one or more parts, each a protocol under loads, or a bending test of the body alone.
pub(crate) struct Plan {
    pub name: String,
    pub sentence: String,
    /// Parts, each measured as often as the data at hand; none of a bending test.
    pub parts: Vec<DiagnosisSource>,
    /// Separate tests in addition to the parts.
    pub tests: Vec<&'static BenchTest>,
}

pub(crate) fn bending_test() -> Plan {
    Plan { name: BENDING_TEST_NAME.into(), sentence: data::BENDING_TEST.into(), parts: Vec::new(), tests: Vec::new() }
}

/// All experiments for the robot and the protocol of the data at hand; then the same with what may be measured directly and by separate
/// tests, if that is more than in those data.
pub(crate) fn plans(
    scenario: &Scenario,
    dataset: &Dataset,
    at_hand: Direct,
    (direct, tests): (Direct, Vec<&'static BenchTest>),
) -> Vec<Plan> {
    let all = Direct { pressure: at_hand.pressure || direct.pressure, frame: at_hand.frame || direct.frame };
    let mut plans = protocols(scenario, dataset, at_hand);
    if all != at_hand || !tests.is_empty() {
        let (name, sentence) = with_instruments(at_hand, all, &tests);
        plans.extend(protocols(scenario, dataset, all).into_iter().map(|plan| Plan {
            name: format!("{}, {name}", plan.name),
            sentence: format!("{}, {sentence}", plan.sentence),
            tests: tests.clone(),
            ..plan
        }));
    }
    plans.extend((!tests.is_empty()).then(|| alone(tests)));
    plans
}

fn alone(tests: Vec<&'static BenchTest>) -> Plan {
    let all = |what: fn(&BenchTest) -> &'static str| tests.iter().map(|test| what(test)).collect::<Vec<_>>();
    Plan {
        name: all(|test| test.name).join(", "),
        sentence: format!("measure separately: {}", all(|test| test.sentence).join("; ")),
        parts: Vec::new(),
        tests,
    }
}

/// Words, short and long, for quantities measured directly or by a separate test for the first time.
fn with_instruments(before: Direct, now: Direct, tests: &[&BenchTest]) -> (String, String) {
    let pressure = (now.pressure && !before.pressure)
        .then_some(("gauge", "with a gauge read at the actuator itself (column p_gauge_kpa)"));
    let frame = (now.frame && !before.frame)
        .then_some(("frame", "with fiducials on the clamp and a checkerboard in the markers' plane"));
    let direct = [pressure, frame].into_iter().flatten().map(|(name, words)| (name, words.to_string()));
    let tests = tests.iter().map(|test| (test.name, format!("with {}", test.sentence)));
    let (names, words): (Vec<&str>, Vec<String>) = direct.chain(tests).unzip();
    (names.join(", "), words.join(" and "))
}

fn protocols(scenario: &Scenario, dataset: &Dataset, direct: Direct) -> Vec<Plan> {
    let top = dataset.holds.iter().map(|h| h.p_act_pa).fold(policy::ZERO_PRESSURE_PA, f64::max);
    let body = dataset.holds[0].p_body_pa;
    let steps = |n: usize| (0..=n).map(|i| top * i as f64 / n as f64).collect::<Vec<f64>>();
    let [standard, fine] = [3, 6].map(|n| [&steps(n)[..], &[0.0]].concat());
    let up_down: Vec<f64> = steps(3).into_iter().chain(steps(3).into_iter().rev().skip(1)).collect();
    let part = |scenario: &Scenario, pressures: &[f64], body: f64, hold_s: f64| {
        let planned = protocol(dataset, pressures, body, hold_s);
        DiagnosisSource { direct, ..DiagnosisSource::of(scenario.clone(), planned, None) }
    };
    let one = |pressures: &[f64], body: f64, hold_s: f64| vec![part(scenario, pressures, body, hold_s)];
    let usual = hold_length_s(dataset);
    let [gravity_x, gravity_y, gravity_z] = scenario.gravity_direction;
    let rolled = Scenario { gravity_direction: [gravity_x, -gravity_y, -gravity_z], ..seen_rolled(scenario) };
    let turned = vec![part(&rolled, &standard, body, usual)];
    let tipped = [TIP_FORCE_N, -TIP_FORCE_N].map(|force| part(&tipped(scenario, force), &standard, body, usual)).into();
    let other_body = second_body(dataset, body);
    let plan = |name: &str, sentence: String, parts| Plan { name: name.into(), sentence, parts, tests: Vec::new() };
    let mut plans = vec![
        plan("finer pressures", format!("repeat in steps of {:.1} kPa", top / 6e3), one(&fine, body, usual)),
        plan(
            "second body pressure",
            format!("repeat at {:.1} kPa body pressure", other_body / 1e3),
            one(&standard, other_body, usual),
        ),
        plan("up and down", "lower the pressure in the same steps as it was raised".into(), one(&up_down, body, usual)),
        plan("tip force", format!("repeat with ±{TIP_FORCE_N} N on the tip, across the body"), tipped),
        plan(
            "turned over",
            "repeat with the robot rolled by 180°: gravity, forces from outside and the camera's roll then act the other way"
                .into(),
            turned,
        ),
        plan("long hold", format!("hold every pressure for {LONG_HOLD_S:.0} s"), one(&standard, body, LONG_HOLD_S)),
        plan("repeat", "repeat the same protocol as often again".into(), one(&standard, body, usual)),
    ];
    if scenario.is_spatial() {
        // The most informative direction of a load across such a robot is not searched for.
        plans.retain(|plan| !["tip force", "turned over"].contains(&plan.name.as_str()));
        plans.iter_mut().for_each(|plan| plan.sentence += ", with the same pressure in all supply channels");
    }
    plans
}

/// `0,10,20,30,0@2`, as `ibr data generate --protocol` takes it; empty of a bending test.
pub(crate) fn protocol_text(plan: &Plan) -> String {
    let Some(part) = plan.parts.first() else { return String::new() };
    let holds = &part.dataset.holds;
    let kpa = |p: f64| format!("{}", (p / 100.0).round() / 10.0);
    let list: Vec<String> = holds.iter().map(|h| kpa(h.p_act_pa)).collect();
    format!("{}@{}", list.join(","), kpa(holds[0].p_body_pa))
}

fn tipped(scenario: &Scenario, force_n: f64) -> Scenario {
    let known = scenario.effects.iter().find(|e| e.name == "tip_load");
    let [x, y, z] = known.map_or([0.0; 3], |e| [e.values[0], e.values[1], e.values[2]]);
    scenario.with_effect("tip_load", &[x, y + force_n, z])
}

/// Twice the first body pressure, or the middle of the two that are there.
fn second_body(dataset: &Dataset, body: f64) -> f64 {
    let other = body_pressures([dataset]).get(1).copied();
    other.map_or(2.0 * body, |other| 0.5 * (other + body))
}

fn hold_length_s(dataset: &Dataset) -> f64 {
    let starts: Vec<f64> = dataset.holds.iter().filter_map(|h| h.t_s.first().copied()).collect();
    let mut gaps: Vec<f64> = starts.windows(2).map(|w| w[1] - w[0]).filter(|g| *g > 0.0).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / 2).copied().unwrap_or(5.0)
}

/// A run of a protocol with the markers of the data, without values.
fn protocol(dataset: &Dataset, pressures: &[f64], body: f64, hold_s: f64) -> Dataset {
    let samples = dataset.samples_per_hold;
    let hold = |(i, p): (usize, &f64)| Hold {
        p_body_pa: body,
        p_act_pa: *p,
        more_act_pa: Vec::new(),
        phase: if i > 0 && *p < pressures[i - 1] { Phase::Unload } else { Phase::Load },
        occurrence: 0,
        t_s: (0..samples).map(|k| hold_s * (i as f64 + (k + 1) as f64 / samples as f64)).collect(),
    };
    let holds: Vec<Hold> = pressures.iter().enumerate().map(hold).collect();
    let mut planned = Dataset {
        runs: vec!["1".into()],
        holds,
        coordinates_m: Vec::new(),
        gauge_pa: None,
        lost: Lost::default(),
        ..dataset.clone()
    };
    planned.coordinates_m = vec![0.0; planned.values_per_run()];
    planned
}
