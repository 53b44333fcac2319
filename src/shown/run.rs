//! A run's summary in words, and what a user should know before believing it.

use crate::prelude::*;
use fem::robot::{Reading, Snap};
use fem::session::{Cost, MeshQuality, ProbeEnd, RobotSummary, Rule, Summary};

/// The physics of a run as text.
pub fn text(s: &Summary) -> String {
    let Summary { name, elements, steps, time_s, .. } = s;
    let mut out = format!("{name}\n{elements} elements, {steps} steps to t = {time_s:.6} s\n");
    if s.began_s > 0.0 {
        out.push_str(&format!(
            "went on from the end of another run at t = {:.6} s; the energies below include both\n",
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
    let moved = |p: &ProbeEnd, k: usize| p.displacement_mm[k];
    out += &below(
        TextTable::of(&s.probes)
            .words("probe", |p| &p.set)
            .signed("dx mm", 3, |p| moved(p, 0))
            .signed("dy mm", 3, |p| moved(p, 1))
            .signed("dz mm", 3, |p| moved(p, 2)),
    );
    out += &below(
        TextTable::of(&s.chambers).words("chamber", |c| &c.name).number("pressure kPa", 3, |c| c.pressure_kpa).number(
            "volume cm³",
            3,
            |c| c.volume_cm3,
        ),
    );
    let mut forces = TextTable::of(&s.reactions).words("force of the support on", |r| &r.set);
    for (k, head) in ["x N", "y N", "z N"].into_iter().enumerate() {
        forces = forces.right(head, |r| r.force_n[k].map_or("–".into(), signed));
    }
    for (k, head) in ["about x N·m", "about y", "about z"].into_iter().enumerate() {
        forces = forces.right(head, |r| signed(r.moment_nm[k]));
    }
    out += &below(forces);
    out += &s.robot.as_ref().map(robot_text).unwrap_or_default();
    let ledger = s.ledger.iter().map(|r| (r.name.as_str(), r.kind.as_str(), r.energy_j));
    let (first, last) = (("kinetic", "stored", s.kinetic_j), ("residual", "missing", s.residual_j));
    out += &below(
        TextTable::of(std::iter::once(first).chain(ledger).chain([last]))
            .words("energy", |(name, ..)| *name)
            .words("", |(_, kind, _)| *kind)
            .number("J", 6, |(.., energy_j)| *energy_j),
    );
    out + &judgement(s)
}

/// A table after an empty line; nothing without rows.
fn below<R>(table: TextTable<R>) -> String {
    if table.is_empty() { String::new() } else { format!("\n{}", table.text()) }
}

/// With its sign, unless it is zero in these digits.
fn signed(value: f64) -> String {
    let text = format!("{value:+.4}");
    if text.ends_with("0.0000") && value.abs() < 1.0 { "0".into() } else { text }
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
    out += &lines("warning: ", s.warnings());
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

const MM: f64 = 1e3;

fn robot_text(robot: &RobotSummary) -> String {
    let readings = &robot.readings;
    let Some(last) = readings.last() else { return String::new() };
    let title = match robot.is_spatial {
        true => "Displacement of the sections [mm] along y and z; the turn is the turn of the tip's normal",
        false => "Displacement towards the actuator [mm]: section at the station; at the tip also the mean of its ring",
    };
    let axes = if robot.is_spatial { &[("y", 1), ("z", 2)][..] } else { &[("", 1)] };
    let rows = readings.iter().flat_map(|r| axes.iter().map(move |(name, axis)| (r, *name, *axis)));
    let mut moved = TextTable::of(rows)
        .right("actuator kPa", |(r, ..)| pressures(r))
        .when(robot.is_spatial, |table| table.right("along", |(_, name, _)| *name));
    for (k, s) in last.stations_m.iter().enumerate() {
        moved = moved.number(format!("s = {:.0}", s * MM), 1, |(r, _, axis)| r.moved_m.get(k).map(|d| d[*axis] * MM));
    }
    let aside = |r: &Reading, k: usize| r.out_of_plane_m()[k] * MM;
    let moved = moved
        .number("tip ring", 1, |(r, _, axis)| r.ring_moved_m.last().map(|d| d[*axis] * MM))
        .number("tip x", 1, |(r, ..)| r.moved_m.last().map(|d| d[0] * MM))
        .number("turn deg", 1, |(r, ..)| r.tip_angle_rad.to_degrees())
        .when(!robot.is_spatial, |table| {
            table.number("tip z", 1, |(r, ..)| aside(r, 0)).number("most z", 1, |(r, ..)| aside(r, 1))
        });
    format!("{}\n{}{}", moved.under(title), state(readings), buckling(&robot.snaps))
}

/// Of all strips, or one number where they are alike \[kPa\].
fn pressures(r: &Reading) -> String {
    let alike = r.strips_pa.iter().all(|pa| *pa == r.actuator_pa);
    let strips = if alike { &[r.actuator_pa][..] } else { &r.strips_pa };
    strips.iter().map(|pa| format!("{:.0}", pa * 1e-3)).collect::<Vec<_>>().join("/")
}

fn state(readings: &[Reading]) -> String {
    let at_rest = |r: &&Reading| match (r.is_at_rest, r.ahead_m) {
        (true, _) => "yes".into(),
        (false, Some(ahead_m)) => format!("no, {:.1} mm ahead", ahead_m * MM),
        (false, None) => "not known".into(),
    };
    let strength = readings.iter().any(|r| r.seam_share.is_some());
    TextTable::of(readings)
        .right("actuator kPa", |r| pressures(r))
        .number("body cm³", 1, |r| r.body_m3 * 1e6)
        .number("actuator cm³", 1, |r| r.actuator_m3 * 1e6)
        .number("von Mises MPa", 1, |r| r.von_mises_pa * 1e-6)
        .right("in", |r| &r.von_mises_part)
        .number("at mm", 0, |r| r.von_mises_at_m * MM)
        .number("weld N/m", 0, |r| r.seam_n_per_m)
        .right("in", |r| &r.seam_part)
        .number("at mm", 0, |r| r.seam_at_m * MM)
        .number("kinetic %", 2, |r| 100.0 * r.kinetic_share)
        .right("at rest", at_rest)
        .when(strength, |t| t.right("weld", |r| &r.seam).number("of its strength", 2, |r| r.seam_share))
        .text()
}

fn buckling(found: &[Snap]) -> String {
    if found.is_empty() {
        return "\nno buckling event while the actuator is filled\n".into();
    }
    let mut largest: Vec<&Snap> = found.iter().collect();
    largest.sort_by(|a, b| b.released_j.total_cmp(&a.released_j));
    let released_mj: f64 = found.iter().map(|s| s.released_j * 1e3).sum();
    let mut out = format!("\n{} buckling events, {released_mj:.0} mJ released in all; the largest:\n", found.len());
    out += &TextTable::of(largest.into_iter().take(8))
        .number("time s", 3, |s| s.time_s)
        .number("at mm", 0, |s| s.place_m * MM)
        .number("released mJ", 1, |s| s.released_j * 1e3)
        .number("walls' kinetic peak mJ", 1, |s| s.kinetic_j * 1e3)
        .text();
    out
}
