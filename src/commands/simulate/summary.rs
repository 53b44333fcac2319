//! What a run came to.

use super::robot::{self, Robot};
use super::stepping::{Balance, Running};
use crate::commands::tables::table;
use fem::case::Case;
use models::RowKind;
use serde_json::{Value, json};
use std::time::Duration;

/// Kinetic over internal energy above which the paper's source calls a run invalid.
const TENTH: f64 = 0.10;
/// Kinetic over total energy that the paper kept its runs below.
const HUNDREDTH: f64 = 0.01;

/// A complete run in numbers.
pub struct Summary {
    /// What depends on the case alone: the same to the bit however often the run was interrupted.
    pub physics: Value,
    /// What it took.
    pub cost: Value,
}

impl Summary {
    /// Reads a run that has reached its end.
    pub fn of(case: &Case, running: &Running, robot: Option<&Robot>, wall: Duration) -> Summary {
        Summary { physics: physics(case, running, robot), cost: cost(case, running, wall) }
    }
}

fn physics(case: &Case, running: &Running, robot: Option<&Robot>) -> Value {
    let (run, mesh) = (&running.run, &case.problem.mesh);
    let ledger = run.ledger();
    let rows: Vec<Value> =
        ledger.rows.iter().map(|r| json!({"name": r.name, "kind": word(r.kind), "energy_j": r.energy_j})).collect();
    let chambers: Vec<Value> = run
        .chambers()
        .iter()
        .map(|c| json!({"name": c.name, "pressure_kpa": c.pressure_pa / 1e3, "volume_cm3": c.volume_m3 * 1e6}))
        .collect();
    let positions = run.positions();
    let probes: Vec<Value> = case
        .outputs
        .probes
        .iter()
        .filter_map(|name| {
            let moved = mean_displacement(mesh, mesh.sets.get(name)?, &positions);
            Some(json!({"set": name, "displacement_mm": moved.map(|d| d * 1e3)}))
        })
        .collect();
    let largest = running.balances.iter().fold(0.0_f64, |most, b| most.max(b.residual_share));
    let read = robot.zip(running.robot.as_ref()).map(|(robot, seen)| seen.to_json(&robot.scenario, &robot.run));
    json!({
        "schema": "ibr.simulate", "version": 1, "name": case.problem.name, "engine": fem::ENGINE, "robot": read,
        "time_s": run.time_s(), "steps": run.step(), "dt_s": run.dt_s(),
        "nodes": mesh.points.len(), "elements": run.elements(), "added_mass_share": run.added_mass(),
        "selective_mass": run.selective_mass(),
        "quality": quality(case),
        "probes": probes, "chambers": chambers,
        "ledger": rows, "kinetic_j": ledger.kinetic_j, "external_work_j": ledger.external_work_j,
        "residual_j": ledger.residual_j, "residual_share": ledger.residual_share(), "residual_share_peak": largest,
        "kinetic_share": kinetic(&running.balances), "changed_sides": changed_sides(run),
    })
}

/// Nodes that came through a layer; null without contact.
fn changed_sides(run: &fem::Simulation) -> Option<Value> {
    let changed = run.changed_sides()?;
    let first = changed.first.map(|f| {
        json!({"node": f.node, "part": f.part, "time_s": f.time_s, "place_mm": f.place_m.map(|c| c * 1e3),
            "text": f.to_string()})
    });
    Some(json!({"nodes": changed.nodes, "share": changed.share, "first": first}))
}

/// Shape of the elements; the run would not have started with a mesh that does not pass.
fn quality(case: &Case) -> Option<Value> {
    let problem = &case.problem;
    let chambers: Vec<&str> = problem.chambers.iter().map(|c| c.name.as_str()).collect();
    let open: Vec<&str> = problem.open.iter().map(String::as_str).collect();
    let quality = fem::mesh::check::check_open(&problem.mesh, &chambers, &open).ok()?;
    let side = &quality.side_m;
    Some(json!({
        "side_mm": [side.min * 1e3, side.median * 1e3, side.max * 1e3], "aspect": quality.aspect.value,
        "jacobian_ratio": quality.jacobian_ratio.value, "warpage": quality.warpage.value,
    }))
}

/// Mean displacement of a node set from where it started \[m\].
fn mean_displacement(mesh: &fem::Mesh, nodes: &[u32], positions: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for node in nodes {
        let (now, start) = (positions[*node as usize], mesh.start_of(*node as usize));
        (0..3).for_each(|k| sum[k] += (now[k] - start[k]) / nodes.len() as f64);
    }
    sum
}

/// Kinetic energy over kinetic and stored energy at the outputs after the start, held against the two rules.
fn kinetic(balances: &[Balance]) -> Value {
    let later: Vec<&Balance> = balances.iter().filter(|b| b.time_s > 0.0).collect();
    let mut shares: Vec<f64> = later.iter().map(|b| b.kinetic_share).collect();
    shares.sort_by(f64::total_cmp);
    let peak = later.iter().max_by(|a, b| a.kinetic_share.total_cmp(&b.kinetic_share));
    // K < r·U is the same as K/(K + U) < r/(1 + r).
    let rule = |limit: f64| {
        let broken: Vec<f64> = later.iter().filter(|b| b.kinetic_share >= limit).map(|b| b.time_s).collect();
        json!({"kept_at": later.len() - broken.len(), "last_broken_s": broken.last()})
    };
    json!({
        "outputs": later.len(),
        "median": shares.get(shares.len() / 2), "end": later.last().map(|b| b.kinetic_share),
        "peak": peak.map(|b| b.kinetic_share), "peak_time_s": peak.map(|b| b.time_s),
        "below_10_pct_of_internal": rule(TENTH / (1.0 + TENTH)), "below_1_pct_of_total": rule(HUNDREDTH),
    })
}

fn cost(case: &Case, running: &Running, wall: Duration) -> Value {
    let (run, cpu_s) = (&running.run, running.cpu_s());
    let element_steps = (run.step() - running.began.0) as f64 * run.elements() as f64;
    json!({
        "cpu_s": cpu_s, "cpu_s_of_all_sessions": running.cpu_before_s + cpu_s, "wall_s": wall.as_secs_f64(),
        "threads": case.problem.settings.threads, "resumed_at_step": running.began.0,
        "element_steps_per_cpu_s": if cpu_s > 0.0 { element_steps / cpu_s } else { 0.0 },
    })
}

fn word(kind: RowKind) -> &'static str {
    match kind {
        RowKind::Stored => "stored",
        RowKind::Dissipated => "dissipated",
        RowKind::Supplied => "supplied",
    }
}

/// The physics of a run as text.
pub fn text(s: &Value) -> String {
    let mut out = format!(
        "{}\n{} elements, {} steps to t = {:.6} s\n",
        s["name"].as_str().unwrap_or_default(),
        s["elements"],
        s["steps"],
        number(&s["time_s"])
    );
    if number(&s["added_mass_share"]) > 0.0 {
        out.push_str(&format!(
            "mass added by scaling: {:.1} % of the true mass{}\n",
            100.0 * number(&s["added_mass_share"]),
            if s["selective_mass"] == true { ", more to waves of a few elements" } else { "" }
        ));
    }
    if let [Some(min), Some(median), Some(max)] = [0, 1, 2].map(|i| s["quality"]["side_mm"][i].as_f64()) {
        out.push_str(&format!(
            "element sides {min:.2} to {max:.2} mm, median {median:.2}; worst aspect {:.1}, worst Jacobian ratio {:.2}\n",
            number(&s["quality"]["aspect"]),
            number(&s["quality"]["jacobian_ratio"])
        ));
    }
    let rows = list(&s["probes"]).map(|p| {
        let moved = list(&p["displacement_mm"]).map(|d| format!("{:+.3}", number(d)));
        std::iter::once(name(&p["set"])).chain(moved).collect()
    });
    out.push_str(&section(&["probe", "dx mm", "dy mm", "dz mm"], 1, rows.collect()));
    let rows = list(&s["chambers"]).map(|c| {
        let volume = number(&c["volume_cm3"]);
        vec![name(&c["name"]), format!("{:.3}", number(&c["pressure_kpa"])), format!("{volume:.3}")]
    });
    out.push_str(&section(&["chamber", "pressure kPa", "volume cm³"], 1, rows.collect()));
    out.push_str(&robot::text(s));
    out.push_str(&section(&["energy", "", "J"], 2, ledger(s)));
    out.push_str(&judgement(s));
    out
}

fn section(head: &[&str], left: usize, rows: Vec<Vec<String>>) -> String {
    if rows.is_empty() { String::new() } else { format!("\n{}", table(head, left, rows)) }
}

fn ledger(s: &Value) -> Vec<Vec<String>> {
    let line = |name: String, kind: &str, energy: &Value| vec![name, kind.into(), format!("{:.6}", number(energy))];
    let mut rows = vec![line("kinetic".into(), "stored", &s["kinetic_j"])];
    rows.extend(list(&s["ledger"]).map(|r| line(name(&r["name"]), r["kind"].as_str().unwrap_or(""), &r["energy_j"])));
    rows.push(line("residual".into(), "missing", &s["residual_j"]));
    rows
}

fn judgement(s: &Value) -> String {
    let percent = |v: &Value| format!("{:.3} %", 100.0 * number(v));
    let k = &s["kinetic_share"];
    let rule = |title: &str, rule: &Value| {
        let last = rule["last_broken_s"].as_f64().map_or(String::new(), |t| format!(", last broken at t = {t:.6} s"));
        format!("  {title}: kept at {} of {} outputs{last}\n", rule["kept_at"], k["outputs"])
    };
    let mut out = format!(
        "\nresidual over external work: {} at the end, {} at most\n",
        percent(&s["residual_share"]),
        percent(&s["residual_share_peak"])
    );
    out.push_str(&format!(
        "kinetic share of kinetic and stored energy: median {}, end {}, peak {} at t = {:.6} s\n",
        percent(&k["median"]),
        percent(&k["end"]),
        percent(&k["peak"]),
        number(&k["peak_time_s"])
    ));
    out.push_str(&rule(
        "below 10 % of internal energy (the paper's rule for a valid run)",
        &k["below_10_pct_of_internal"],
    ));
    out.push_str(&rule("below 1 % of total energy (what the paper kept)", &k["below_1_pct_of_total"]));
    if let Some(first) = s["changed_sides"]["first"]["text"].as_str() {
        out.push_str(&format!(
            "warning: nodes that came through a layer: {}, {} of those in contact; the first: {first}. Smaller elements, or \
             edges = true in [contact], hold them\n",
            s["changed_sides"]["nodes"],
            percent(&s["changed_sides"]["share"])
        ));
    } else if s["changed_sides"].is_object() {
        out.push_str("nodes that came through a layer: none\n");
    }
    out
}

/// What a run took, as text.
pub fn cost_text(cost: &Value) -> String {
    format!(
        "\n{:.1} CPU seconds, {:.1} s; {:.2} million element-steps per CPU second\n",
        number(&cost["cpu_s"]),
        number(&cost["wall_s"]),
        number(&cost["element_steps_per_cpu_s"]) / 1e6
    )
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn name(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_string()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}
