//! Experiments that may be proposed, for any robot: its own pressures scaled, not ours.

use crate::comparison::ZERO_PRESSURE_PA;
use data::{Dataset, Hold, Phase};
use models::Scenario;

/// Known force hung on the tip \[N\].
const TIP_FORCE_N: f64 = 0.3;
/// Length of a long hold \[s\].
const LONG_HOLD_S: f64 = 60.0;

/// An experiment: one or more parts, each a protocol under loads.
pub struct Plan {
    /// Short name.
    pub name: &'static str,
    /// What to do.
    pub sentence: String,
    /// Parts, each measured as often as the data at hand.
    pub parts: Vec<Part>,
}

/// A protocol under loads.
pub struct Part {
    /// The base with the loads of this part.
    pub scenario: Scenario,
    /// Protocol and markers; one run without values.
    pub dataset: Dataset,
}

/// All experiments for the robot and the protocol of the data at hand.
pub fn plans(scenario: &Scenario, dataset: &Dataset) -> Vec<Plan> {
    let top = dataset.holds.iter().map(|h| h.p_act_pa).fold(ZERO_PRESSURE_PA, f64::max);
    let body = dataset.holds[0].p_body_pa;
    let steps = |n: usize| (0..=n).map(|i| top * i as f64 / n as f64).collect::<Vec<f64>>();
    let then_zero = |mut p: Vec<f64>| {
        p.push(0.0);
        p
    };
    let standard = then_zero(steps(3));
    let fine = then_zero(steps(6));
    let up_down: Vec<f64> = steps(3).into_iter().chain(steps(3).into_iter().rev().skip(1)).collect();
    let one = |pressures: &[f64], body: f64, hold_s: f64| {
        vec![Part { scenario: scenario.clone(), dataset: protocol(dataset, pressures, body, hold_s) }]
    };
    let usual = hold_length_s(dataset);
    let flipped = Scenario { gravity_direction: scenario.gravity_direction.map(|g| -g), ..scenario.clone() };
    let turned = vec![Part { scenario: flipped, dataset: protocol(dataset, &standard, body, usual) }];
    let other_body = second_body(dataset, body);
    let plan = |name, sentence: String, parts| Plan { name, sentence, parts };
    vec![
        plan("finer pressures", format!("repeat in steps of {:.1} kPa", top / 6e3), one(&fine, body, usual)),
        plan(
            "second body pressure",
            format!("repeat at {:.1} kPa body pressure", other_body / 1e3),
            one(&standard, other_body, usual),
        ),
        plan("up and down", "lower the pressure in the same steps as it was raised".into(), one(&up_down, body, usual)),
        plan(
            "tip force",
            format!("repeat with ±{TIP_FORCE_N} N on the tip, across the body"),
            tipped(scenario, dataset, &standard, body),
        ),
        plan("turned over", "repeat with the robot rolled by 180°, so that gravity is reversed".into(), turned),
        plan("long hold", format!("hold every pressure for {LONG_HOLD_S:.0} s"), one(&standard, body, LONG_HOLD_S)),
        plan("repeat", "repeat the same protocol as often again".into(), one(&standard, body, usual)),
    ]
}

/// `0,10,20,30,0@2`, as `ibr data generate --protocol` takes it.
pub fn protocol_text(plan: &Plan) -> String {
    let holds = &plan.parts[0].dataset.holds;
    let kpa = |p: f64| format!("{}", (p / 100.0).round() / 10.0);
    let list: Vec<String> = holds.iter().map(|h| kpa(h.p_act_pa)).collect();
    format!("{}@{}", list.join(","), kpa(holds[0].p_body_pa))
}

fn tipped(scenario: &Scenario, dataset: &Dataset, pressures: &[f64], body: f64) -> Vec<Part> {
    let known = scenario.effects.iter().find(|e| e.name == "tip_load").map_or([0.0; 2], |e| [e.values[0], e.values[1]]);
    let part = |force: f64| Part {
        scenario: scenario.with_effect("tip_load", &[known[0], known[1] + force]),
        dataset: protocol(dataset, pressures, body, hold_length_s(dataset)),
    };
    vec![part(TIP_FORCE_N), part(-TIP_FORCE_N)]
}

/// Twice the first body pressure, or the middle of the two that are there.
fn second_body(dataset: &Dataset, body: f64) -> f64 {
    let other = super::case::body_pressures(dataset).get(1).copied();
    other.map_or(2.0 * body, |other| 0.5 * (other + body))
}

/// Usual length of a hold \[s\].
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
        phase: if i > 0 && *p < pressures[i - 1] { Phase::Unload } else { Phase::Load },
        occurrence: 0,
        t_s: (0..samples).map(|k| hold_s * (i as f64 + (k + 1) as f64 / samples as f64)).collect(),
    };
    let holds: Vec<Hold> = pressures.iter().enumerate().map(hold).collect();
    let mut planned = Dataset { runs: vec!["1".into()], holds, xy_m: Vec::new(), ..dataset.clone() };
    planned.xy_m = vec![0.0; planned.values_per_run()];
    planned
}
