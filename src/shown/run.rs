//! A run's summary in words, and what a user should know before believing it.

use super::run_robot;
use crate::tables::table;
use fem::session::{ChamberEnd, Cost, MeshQuality, ProbeEnd, ReactionEnd, Rule, Summary};

/// The physics of a run as text.
pub fn text(s: &Summary) -> String {
    let Summary { name, elements, steps, time_s, .. } = s;
    let mut out = format!("{name}\n{elements} elements, {steps} steps to t = {time_s:.6} s\n");
    if s.began_s > 0.0 {
        out.push_str(&format!(
            "went on from the end of another run at t = {:.6} s; the energies below are those of both\n",
            s.began_s
        ));
    }
    if s.added_mass_share > 0.0 {
        let selective = if s.selective_mass { ", more to waves of a few elements" } else { "" };
        let percent = 100.0 * s.added_mass_share;
        out.push_str(&format!("mass added by scaling: {percent:.1} % of the true mass{selective}\n"));
    }
    if let Some(MeshQuality { side_mm: [min, median, max], aspect, jacobian_ratio, .. }) = &s.quality {
        out.push_str(&format!(
            "element sides {min:.2} to {max:.2} mm, median {median:.2}; worst aspect {aspect:.1}, worst Jacobian ratio {jacobian_ratio:.2}\n"
        ));
    }
    let probe =
        |p: &ProbeEnd| std::iter::once(p.set.clone()).chain(p.displacement_mm.map(|d| format!("{d:+.3}"))).collect();
    out.push_str(&section(&["probe", "dx mm", "dy mm", "dz mm"], 1, s.probes.iter().map(probe).collect()));
    let chamber =
        |c: &ChamberEnd| vec![c.name.clone(), format!("{:.3}", c.pressure_kpa), format!("{:.3}", c.volume_cm3)];
    out.push_str(&section(&["chamber", "pressure kPa", "volume cm³"], 1, s.chambers.iter().map(chamber).collect()));
    let force = |r: &ReactionEnd| {
        let held = r.force_n.map(|n| n.map_or("–".into(), signed));
        std::iter::once(r.set.clone()).chain(held).chain(r.moment_nm.map(signed)).collect()
    };
    let head = ["force of the support on", "x N", "y N", "z N", "about x N·m", "about y", "about z"];
    out.push_str(&section(&head, 1, s.reactions.iter().map(force).collect()));
    out.push_str(&s.robot.as_ref().map(run_robot::text).unwrap_or_default());
    out.push_str(&section(&["energy", "", "J"], 2, ledger(s)));
    out.push_str(&judgement(s));
    out
}

/// With its sign, unless it is zero in these digits.
fn signed(value: f64) -> String {
    let text = format!("{value:+.4}");
    if text.ends_with("0.0000") && value.abs() < 1.0 { "0".into() } else { text }
}

fn section(head: &[&str], left: usize, rows: Vec<Vec<String>>) -> String {
    if rows.is_empty() { String::new() } else { format!("\n{}", table(head, left, rows)) }
}

fn ledger(s: &Summary) -> Vec<Vec<String>> {
    let line = |name: &str, kind: &str, energy_j: f64| vec![name.into(), kind.into(), format!("{energy_j:.6}")];
    let mut rows = vec![line("kinetic", "stored", s.kinetic_j)];
    rows.extend(s.ledger.iter().map(|r| line(&r.name, &r.kind, r.energy_j)));
    rows.push(line("residual", "missing", s.residual_j));
    rows
}

fn judgement(s: &Summary) -> String {
    let percent = |v: f64| format!("{:.3} %", 100.0 * v);
    let k = &s.kinetic_share;
    let share = |v: Option<f64>| percent(v.unwrap_or(0.0));
    let rule = |title: &str, rule: &Rule| {
        let last = rule.last_broken_s.map_or(String::new(), |t| format!(", last broken at t = {t:.6} s"));
        format!("  {title}: kept at {} of {} outputs{last}\n", rule.kept_at, k.outputs)
    };
    let mut out = format!(
        "\nresidual over external work: {} at the end, {} at most\n",
        percent(s.residual_share),
        percent(s.residual_share_peak)
    );
    out.push_str(&format!(
        "kinetic share of kinetic and stored energy: median {}, end {}, peak {} at t = {:.6} s\n",
        share(k.median),
        share(k.end),
        share(k.peak),
        k.peak_time_s.unwrap_or(0.0)
    ));
    out.push_str(&rule(
        "below 10 % of internal energy (the paper's rule for a valid run)",
        &k.below_10_pct_of_internal,
    ));
    out.push_str(&rule("below 1 % of total energy (what the paper kept)", &k.below_1_pct_of_total));
    out.push_str(&format!("hourglass share of stored energy: {:.3} %\n", 100.0 * s.hourglass_share));
    s.warnings().iter().for_each(|warning| out.push_str(&format!("warning: {warning}\n")));
    if s.changed_sides.as_ref().is_some_and(|changed| changed.first.is_none()) {
        out.push_str("nodes that came through a layer: none\n");
    }
    out
}

/// What a run took, as text.
pub fn cost_text(cost: &Cost) -> String {
    format!(
        "\n{:.1} CPU seconds, {:.1} s; {:.2} million element-steps per CPU second\n",
        cost.cpu_s,
        cost.wall_s,
        cost.element_steps_per_cpu_s / 1e6
    )
}
