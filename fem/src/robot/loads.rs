//! Loads of a robot in addition to its pressures: one for the whole run, or one at every pressure.
//!
//! A list has an entry for every pressure, and the load goes from one to the next while the pressure does: a pressure written twice,
//! `pressures_kpa = [30, 30]` with `tip_force_n = [[0, 0, 0], [0, -0.5, 0]]`, loads the robot at pressure. All steps are of fifth
//! order ([`Amplitude::Smooth`]).

use super::loading::{Load, RobotRun};
use crate::case::range::{Checked, FreeTable, POSITION, Range, find, number, plain, plain_number, refuse};
use crate::problem::{Amplitude, Gravity, NodalForce};
use crate::vec3::V3;
use crate::{FemError, Problem, Result};
use toml::{Spanned, Value};

pub(super) fn numbers(name: &str, value: &Spanned<Value>, range: &Range) -> Checked<Vec<f64>> {
    let Some(list) = value.get_ref().as_array() else {
        let message = format!("{name} must be a list");
        let help = "write numbers in brackets: [10, 20, 30]";
        return refuse(message, help, value.span());
    };
    let one =
        |v: &Value| number(name, plain_number(name, &Spanned::new(value.span(), v.clone()))?, value.span(), range);
    list.iter().map(one).collect()
}

pub(super) fn triple(name: &str, value: &Spanned<Value>, range: &Range) -> Checked<V3> {
    let found = numbers(name, value, range)?;
    found.try_into().or_else(|_| refuse(format!("{name} needs three numbers"), range.too_large, value.span()))
}

/// Keys of lists with an entry for every pressure.
const LISTS: [&str; 3] = ["tip_force_n", "gravity_m_s2", "obstacle_moves_mm"];
pub(super) const PRESSURES: &str = "write for example [10, 20, 30], or with channels [[20, 10], [30, 15]]";
const FORCE: Range = plain(-1e4, 1e4, "write newtons: [x, y, z], or [[x, y, z], …] with one for every pressure");
const ACCELERATION: Range =
    plain(-1e3, 1e3, "write m/s²: [0, -9.81, 0], or [[0, 0, 0], …] with one for every pressure");

pub(super) fn read(run: &mut RobotRun, name: &str, value: &Spanned<Value>) -> Checked<()> {
    let each = |range: &Range| -> Checked<Vec<[f64; 3]>> {
        let list = value.get_ref().as_array().map_or(&[][..], Vec::as_slice);
        list.iter().map(|one| triple(name, &Spanned::new(value.span(), one.clone()), range)).collect()
    };
    let is_list = value.get_ref().as_array().is_some_and(|list| list.first().is_some_and(Value::is_array));
    let load = |range: &Range| match is_list {
        true => each(range).map(Load::AtPressures),
        false => triple(name, value, range).map(Load::Always),
    };
    match name {
        "tip_force_n" => run.tip_force_n = load(&FORCE)?,
        "gravity_m_s2" => run.gravity_m_s2 = load(&ACCELERATION)?,
        _ if is_list => run.obstacle_moves_m = each(&POSITION)?,
        _ => {
            let help = "write how far it has moved at every pressure: [[0, 0, 0], [0, -20, 0]]";
            let message = format!("{name} is not a list of [x, y, z]");
            return refuse(message, help, value.span());
        }
    }
    Ok(())
}

/// Refuses lists whose length differs from the pressures', and a step in which nothing changes.
pub(super) fn check(run: &RobotRun, table: &FreeTable) -> Checked<()> {
    let span = |name: &str| find(table, name).map_or(0..0, Spanned::span);
    let of = |load: &Load| if let Load::AtPressures(list) = load { list.clone() } else { Vec::new() };
    let lists = [of(&run.tip_force_n), of(&run.gravity_m_s2), run.obstacle_moves_m.clone()];
    for (name, list) in LISTS.iter().zip(&lists).filter(|(_, list)| !list.is_empty()) {
        let (entries, pressures) = (list.len(), run.pressures_pa.len());
        if entries != pressures {
            let help = "write one entry for every pressure; a pressure may appear twice: pressures_kpa = [30, 30]";
            let message = format!("{name} has {entries} entries and pressures_kpa {pressures}");
            return refuse(message, help, span(name));
        }
        if run.separate {
            let help = "write separate = false, or one load for all";
            let message = format!("{name} changes within a run, and every pressure is a separate run");
            return refuse(message, help, span(name));
        }
    }
    let steps = 1..run.pressures_pa.len();
    let idle = |i: &usize| {
        run.pressures_pa[i - 1] == run.pressures_pa[*i]
            && lists.iter().all(|list| list.is_empty() || list[i - 1] == list[*i])
    };
    if !steps.into_iter().any(|i| idle(&i)) {
        return Ok(());
    }
    let message = "pressures_kpa needs pressures that differ one by one, or loads that do";
    refuse(message, PRESSURES, span("pressures_kpa"))
}

impl RobotRun {
    pub(super) fn load(&self, made: &mut Problem) -> Result<()> {
        let start = self.start.clone().unwrap_or_default();
        let force = self.steps(&self.tip_force_n, start.tip_force_n);
        let forces = match along(&force) {
            Some(one) => vec![one],
            // A force that turns has an amplitude along each axis.
            None => (0..3).filter_map(|k| along(&only(&force, k))).collect(),
        };
        let forces = forces.into_iter().filter(|(total_n, _)| *total_n != [0.0; 3]);
        made.forces.extend(forces.map(|(total_n, amplitude)| NodalForce { set: "tip".into(), total_n, amplitude }));
        let Some((g_m_s2, amplitude)) = along(&self.steps(&self.gravity_m_s2, start.gravity_m_s2)) else {
            let message = "robot: gravity_m_s2 turns, and can only grow and shrink; write vectors of one direction";
            return Err(FemError::Problem(message.into()));
        };
        made.gravity = (g_m_s2 != [0.0; 3]).then_some(Gravity { g_m_s2, amplitude });
        if let Some(obstacle) = &self.obstacle {
            let rests = self.obstacle_moves_m.is_empty();
            let moves =
                if rests { vec![start.obstacle_m; self.pressures_pa.len()] } else { self.obstacle_moves_m.clone() };
            let path = self.steps(&Load::AtPressures(moves), start.obstacle_m);
            let axis = |k: usize| Amplitude::Smooth(path.iter().map(|(t, m)| (*t, m[k])).collect());
            let moved = path.iter().any(|(_, m)| *m != [0.0; 3]);
            let motion = moved.then(|| [axis(0), axis(1), axis(2)]);
            made.obstacles.push(crate::problem::Obstacle { motion, ..obstacle.clone() });
        }
        Ok(())
    }

    /// A load through (time \[s\], vector) points.
    fn steps(&self, load: &Load, before: V3) -> Vec<(f64, V3)> {
        match load {
            Load::Always(value) if self.start.is_none() => vec![(0.0, before), (self.holds()[0].time_s, *value)],
            Load::Always(value) => self.stairs(before, std::iter::repeat(*value)),
            Load::AtPressures(list) => self.stairs(before, list.iter().copied()),
        }
    }
}

fn only(points: &[(f64, V3)], axis: usize) -> Vec<(f64, V3)> {
    points.iter().map(|(t, v)| (*t, std::array::from_fn(|k| if k == axis { v[k] } else { 0.0 }))).collect()
}

/// Vectors of one direction as the largest of them and its multiplier over time; `None` where they turn.
fn along(points: &[(f64, V3)]) -> Option<(V3, Amplitude)> {
    use crate::vec3::{dot, norm, scale, sub};
    let largest = points.iter().map(|p| p.1).max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
    let square = dot(largest, largest).max(f64::MIN_POSITIVE);
    let share = |v: [f64; 3]| dot(v, largest) / square;
    let turns = |(_, v): &(f64, [f64; 3])| norm(sub(*v, scale(largest, share(*v)))) > 1e-9 * norm(largest);
    let factors = points.iter().map(|(t, v)| (*t, share(*v))).collect();
    (!points.iter().any(turns)).then_some((largest, Amplitude::Smooth(factors)))
}
