//! The search, and its result.

use super::misses::{Miss, parts, worst_m};
use super::wish::Wish;
use crate::SweepError;
use crate::axis::{Axis, CaseChanges, as_number, channel};
use crate::pieces::beside;
use crate::sample::{Method, Points};
use argmin::core::{CostFunction, Executor};
use argmin::solver::neldermead::NelderMead;
use compare::{CompareError, ScenarioFile};
use fem::session::Progress;
use models::{CHANNELS, Loads, Model, Prediction, Scenario};
use spelling::si;
use toml::Value;

/// Starts for every combination of the entries of lists, and in all.
const STARTS_PER_COMBINATION: usize = 12;
const MOST_STARTS: usize = 192;
/// First and second simplex as a share of the ranges, and steps of each.
const SIMPLEX: [(f64, u64); 2] = [(0.2, 250), (0.02, 150)];
/// Points over the assumed numbers, in the search and for the interval.
const ASSUMED: [usize; 2] = [8, 64];
/// Points of the centre line that places are read from.
const LINE: usize = 401;
/// Digits of the values of a design: a hundredth of a per cent.
const DIGITS: usize = 4;
/// Objective of what has no equilibrium or no meaning; above any miss.
const NONE: f64 = 1e12;
/// What it costs to leave the design that a correction is from: a key that goes through its whole range, or to another entry of its
/// list, counts as much as a miss of one tolerance.
const NEAR: f64 = 1.0;

/// How far the tip and the miss go over the assumed numbers.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Spread {
    /// Smallest and largest x of the tip \[m\].
    #[serde(rename = "tip_x_mm", serialize_with = "si::mm")]
    pub x_m: [f64; 2],
    /// Smallest and largest y of the tip \[m\].
    #[serde(rename = "tip_y_mm", serialize_with = "si::mm")]
    pub y_m: [f64; 2],
    /// Largest miss of any part of the wish \[m\].
    #[serde(rename = "worst_mm", serialize_with = "si::mm")]
    pub worst_m: f64,
}

/// A free key at an end of its range or list that holds the design back.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Held {
    /// Free key that is at an end of its range.
    pub key: String,
    /// The end, in the unit of the key.
    #[serde(rename = "end")]
    pub value: f64,
    /// What a unit beyond it would take off the largest miss, the other keys as they are \[m\].
    #[serde(rename = "gain_mm", serialize_with = "si::mm")]
    pub gain_m: f64,
}

/// Robot that comes nearest to a wish, with what limits it.
#[derive(Debug, Clone)]
pub struct Design {
    /// The robot with the chosen values; its pressure to predict at is the chosen one where the channels share it.
    pub file: ScenarioFile,
    /// Keys and values as they are written.
    pub chosen: Vec<(String, String)>,
    /// Pressures of body and channels at which the wish is met \[Pa\].
    pub loads: Loads,
    /// Pose of the model at these pressures.
    pub pose: Prediction,
    /// Miss of every part of the wish by the model.
    pub misses: Vec<Miss>,
    /// Over the assumed numbers; `None` where none are named.
    pub spread: Option<Spread>,
    /// What holds it back, where the wish is not reached; the most first.
    pub held: Vec<Held>,
    /// Starts of the search, and how many of them ended at this objective.
    pub starts: [usize; 2],
    /// Shares of the ranges of the free keys.
    pub(super) shares: Vec<f64>,
}

impl Design {
    /// Whether every part of the wish is within the tolerance.
    pub fn reached(&self, wish: &Wish) -> bool {
        self.worst_m() <= wish.tolerance * self.file.length_m
    }

    /// Largest miss of a part \[m\].
    pub fn worst_m(&self) -> f64 {
        worst_m(&self.misses)
    }
}

struct PosedDesign {
    scenario: Scenario,
    model: Model,
    loads: Loads,
    pose: Prediction,
}

impl Wish {
    fn tried(&self, CaseChanges { values, pressures_kpa }: &CaseChanges) -> Option<PosedDesign> {
        let scenario = self.base.scenario_with(values).ok()?;
        let own = || scenario.pressures_pa.iter().copied().reduce(f64::max).map(|pa| [pa; CHANNELS]);
        let actuator_pa = pressures_kpa.map(|all| all.map(|kpa| 1e3 * kpa)).or_else(own).unwrap_or_default();
        let loads = Loads { body_pa: scenario.p_body_pa, actuator_pa };
        let model = Model::new(&scenario);
        let mut pose = model.prediction();
        model.predict_held(&loads, &mut pose).ok()?;
        Some(PosedDesign { scenario, model, loads, pose })
    }

    /// The objective; shares beyond the ranges are put back and cost.
    fn objective(&self, shares: &[f64]) -> f64 {
        let inside: Vec<f64> = shares.iter().map(|share| share.clamp(0.0, 1.0)).collect();
        let beyond: f64 = shares.iter().zip(&inside).map(|(share, put)| (share - put).powi(2)).sum();
        let usual = vec![0.5; self.assumed.len()];
        let Some(tried) = self.tried(&self.changes(&inside, &usual)) else { return NONE * (1.0 + beyond) };
        let tolerance_m = self.tolerance * tried.scenario.length_m;
        let off: f64 = self.misses(&tried).iter().map(|miss| (miss.miss_m / tolerance_m).powi(2)).sum();
        let highest = tried.loads.actuator_pa.iter().copied().fold(0.0, f64::max);
        let area = |Scenario { actuator, .. }: &Scenario| {
            actuator.count as f64 * actuator.shape.length_m * actuator.shape.width_m
        };
        let pressure = self.cost.pressure * (highest / tried.scenario.p_max_pa.max(1.0)).powi(2);
        let footprint = match self.cost.footprint {
            0.0 => 0.0,
            weight => weight * area(&tried.scenario) / area(&self.base).max(1e-9),
        };
        let robustness = match self.cost.robustness {
            0.0 => 0.0,
            weight => self.spread(&inside, ASSUMED[0]).map_or(NONE, |spread| {
                let half = |[low, high]: [f64; 2]| 0.5 * (high - low);
                weight * (half(spread.x_m).powi(2) + half(spread.y_m).powi(2)) / tolerance_m.powi(2)
            }),
        };
        off + pressure + footprint + robustness + 1e6 * beyond
    }

    /// How far shares of the ranges are from others, squared; another entry of a list is as far as the whole of a range.
    fn way(&self, from: &[f64], to: &[f64]) -> f64 {
        let of = |(axis, (from, to)): (&Axis, (&f64, &f64))| match axis.entries() {
            Some(_) => f64::from(u8::from(axis.at(*from) != axis.at(*to))),
            None => (from - to).powi(2),
        };
        self.free.iter().zip(from.iter().zip(to)).map(of).sum()
    }

    fn misses(&self, tried: &PosedDesign) -> Vec<Miss> {
        let PosedDesign { scenario: Scenario { length_m, .. }, model, pose, .. } = tried;
        let line = match self.wanted.places.is_empty() {
            true => Vec::new(),
            false => model.centre_line(pose, LINE),
        };
        let place = |s_m: f64| {
            let at = (s_m / length_m).clamp(0.0, 1.0) * (LINE - 1) as f64;
            let i = (at as usize).min(LINE - 2);
            let rest = at - i as f64;
            [0, 1].map(|k| line[i][k] + rest * (line[i + 1][k] - line[i][k]))
        };
        let heading = |s_m: f64| -> f64 {
            model.curvatures(pose).map(|(s, kappa)| kappa * (s_m - s.start_m).clamp(0.0, s.length_m)).sum()
        };
        parts(self, *length_m, [pose.tip.x_m, pose.tip.y_m], pose.tip.angle_rad, &place, &heading)
    }

    /// Over points of the assumed numbers; `None` without any, or where one of them has no equilibrium.
    fn spread(&self, free: &[f64], points: usize) -> Option<Spread> {
        if self.assumed.is_empty() {
            return None;
        }
        let all = Points::new(Method::Sobol, points, self.assumed.len(), 1);
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let mut spread = Spread { x_m: none, y_m: none, worst_m: 0.0 };
        for k in 0..points {
            let tried = self.tried(&self.changes(free, all.of(k)))?;
            let tip = tried.pose.tip;
            let wider = |[low, high]: [f64; 2], v: f64| [low.min(v), high.max(v)];
            spread.x_m = wider(spread.x_m, tip.x_m);
            spread.y_m = wider(spread.y_m, tip.y_m);
            spread.worst_m = worst_m(&self.misses(&tried)).max(spread.worst_m);
        }
        Some(spread)
    }
}

struct SearchProblem<'a> {
    wish: &'a Wish,
    /// All shares; the search replaces the shares of ranges.
    fixed: Vec<f64>,
    ranges: &'a [usize],
    /// Shares of a design to stay near to.
    near: Option<&'a [f64]>,
}

impl SearchProblem<'_> {
    fn shares(&self, of_ranges: &[f64]) -> Vec<f64> {
        let mut all = self.fixed.clone();
        self.ranges.iter().zip(of_ranges).for_each(|(k, share)| all[*k] = *share);
        all
    }

    fn objective(&self, shares: &[f64]) -> f64 {
        self.wish.objective(shares) + self.near.map_or(0.0, |near| NEAR * self.wish.way(near, shares))
    }

    fn solved(self) -> (f64, Vec<f64>) {
        let mut at: Vec<f64> = self.ranges.iter().map(|k| self.fixed[*k]).collect();
        let mut best = self.objective(&self.fixed);
        if at.is_empty() {
            return (best, self.fixed);
        }
        for (size, steps) in SIMPLEX {
            let corner = |k: usize| {
                let mut corner = at.clone();
                corner[k] += if corner[k] > 0.5 { -size } else { size };
                corner
            };
            let simplex = std::iter::once(at.clone()).chain((0..at.len()).map(corner)).collect();
            let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(1e-9) else { break };
            let of = SearchProblem { fixed: self.fixed.clone(), ..self };
            let made = Executor::new(of, solver).configure(|state| state.max_iters(steps)).run();
            if let Some((found, cost)) = made.ok().and_then(|made| Some((made.state.best_param?, made.state.best_cost)))
                && cost < best
            {
                (at, best) = (found, cost);
            }
        }
        let all = self.shares(&at).into_iter().map(|share| share.clamp(0.0, 1.0)).collect();
        (best, all)
    }
}

impl CostFunction for SearchProblem<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, of_ranges: &Vec<f64>) -> Result<f64, argmin::core::Error> {
        Ok(self.objective(&self.shares(of_ranges)))
    }
}

/// Searches the design. The same wish gives the same bits, whatever the threads.
///
/// # Errors
/// No values of the free keys give a robot with an equilibrium; [`fem::FemError::Interrupted`] if `progress` asked to end.
pub fn design(wish: &Wish, progress: Progress) -> Result<Design, SweepError> {
    design_near(wish, None, progress)
}

/// The same with one more start at the shares of a design, which it leaves no further than the wish asks for.
pub(super) fn design_near(wish: &Wish, near: Option<&[f64]>, progress: Progress) -> Result<Design, SweepError> {
    let ranges: Vec<usize> = (0..wish.free.len()).filter(|k| wish.free[*k].entries().is_none()).collect();
    let combinations = wish.free.iter().filter_map(Axis::entries).try_fold(1_usize, |n, m| n.checked_mul(m));
    let starts = combinations.unwrap_or(MOST_STARTS).saturating_mul(STARTS_PER_COMBINATION).min(MOST_STARTS);
    let points = Points::new(Method::Sobol, starts, wish.free.len(), 1);
    let from: Vec<&[f64]> = (0..starts).map(|k| points.of(k)).chain(near).collect();
    let starts = from.len();
    let one = |k: usize| Ok(SearchProblem { wish, fixed: from[k].to_vec(), ranges: &ranges, near }.solved());
    let all: Vec<(f64, Vec<f64>)> = beside(starts, 0, "searching designs", progress, &one)?;
    let (best, shares) = all.iter().min_by(|a, b| a.0.total_cmp(&b.0)).cloned().unwrap_or((NONE, Vec::new()));
    if best >= NONE {
        let help = "widen the ranges, or try one design with ibr predict to see why";
        return Err(CompareError::refused("no design within these ranges has an equilibrium", help).into());
    }
    let same = all.iter().filter(|(cost, _)| cost - best <= 1e-3 * best.max(1e-3)).count();
    Ok(told_of(wish, &shares, [starts, same])?)
}

/// The design at shares of the ranges, with its values as somebody would write them.
fn told_of(wish: &Wish, shares: &[f64], starts: [usize; 2]) -> Result<Design, CompareError> {
    let usual = vec![0.5; wish.assumed.len()];
    // Rounding a value may change which side of an end it is on by a hundredth of a per cent.
    let chosen: Vec<(String, Value)> =
        wish.free.iter().zip(shares).map(|(axis, share)| (axis.key.clone(), axis.rounded(*share, DIGITS))).collect();
    let rounded: Vec<f64> = wish
        .free
        .iter()
        .zip(&chosen)
        .zip(shares)
        .map(|((axis, (_, value)), share)| axis.share_of(value).unwrap_or(*share))
        .collect();
    let gone = || CompareError::refused("the design has no equilibrium when its values are rounded", "report this");
    let changes = wish.changes(&rounded, &usual);
    let tried = wish.tried(&changes).ok_or_else(gone)?;
    let misses = wish.misses(&tried);
    let mut file = wish.base.with(&changes.values)?;
    let all = tried.loads.actuator_pa;
    if chosen.iter().any(|(key, _)| channel(key).is_some()) && all.iter().all(|pa| *pa == all[0]) {
        let kpa = fem::session::rounded(1e-3 * all[0]);
        file = file.with(&[("predict.pressures_kpa".into(), format!("[{kpa}]"))])?;
    }
    let chosen: Vec<(String, String)> = chosen.into_iter().map(|(key, value)| (key, value.to_string())).collect();
    let stem = std::path::Path::new(&wish.base.name).file_stem().unwrap_or_default().to_string_lossy();
    let of = if file.scenario.name.is_empty() { &*stem } else { &file.scenario.name };
    let name = Value::String(format!("{of}, designed")).to_string();
    file = file.with(&[("name".into(), name)])?;
    file = ScenarioFile::parse("design.toml", &commented(&file.text, &chosen))?;
    let mut design = Design {
        file,
        chosen,
        loads: tried.loads,
        pose: tried.pose,
        misses,
        spread: None,
        held: Vec::new(),
        starts,
        shares: rounded.clone(),
    };
    design.spread = wish.spread(&rounded, ASSUMED[1]);
    if !design.reached(wish) {
        design.held = held(wish, shares);
    }
    Ok(design)
}

/// Free keys at an end of their ranges or lists beyond which the miss goes on falling.
fn held(wish: &Wish, shares: &[f64]) -> Vec<Held> {
    let worst_with = |other: Option<(usize, &Value)>| {
        let value = |(i, (axis, share)): (usize, (&'_ Axis, &f64))| match other {
            Some((k, beyond)) if k == i => beyond.clone(),
            _ => axis.at(*share),
        };
        let free = wish.free.iter().zip(shares).enumerate().map(|all| (all.1.0, value(all)));
        let tried = wish.tried(&CaseChanges::of(free.chain(wish.assumed.iter().map(|axis| (axis, axis.at(0.5))))))?;
        Some(worst_m(&wish.misses(&tried)))
    };
    let Some(here) = worst_with(None) else { return Vec::new() };
    let one = |(k, axis): (usize, &Axis)| {
        let (value, beyond) = axis.beyond(shares[k])?;
        let gain_m = (here - worst_with(Some((k, &beyond)))?) / (as_number(&beyond)? - value).abs();
        Some(Held { key: axis.key.clone(), value, gain_m }).filter(|held| held.gain_m > 0.0)
    };
    let mut found: Vec<Held> = wish.free.iter().enumerate().filter_map(one).collect();
    found.sort_by(|a, b| b.gain_m.total_cmp(&a.gain_m));
    found
}

/// The text with a comment at every chosen value. Other comments of the original robot stay: they name the sources of its values.
fn commented(text: &str, chosen: &[(String, String)]) -> String {
    let key = |place: &str| place.rsplit('.').next().unwrap_or(place).to_string();
    let is_chosen = |line: &str| {
        let (name, value) = line.split_once('=').map_or(("", ""), |(name, value)| (name.trim(), value.trim()));
        let own =
            chosen.iter().any(|(place, chosen)| channel(place).is_none() && key(place) == name && value == chosen);
        own || name == "pressures_kpa" && chosen.iter().any(|(place, _)| channel(place).is_some())
    };
    let line = |line: &str| {
        let bare = line.split('#').next().unwrap_or_default().trim_end();
        if is_chosen(bare) { format!("{bare} # chosen\n") } else { format!("{line}\n") }
    };
    let head = "# Values marked `chosen` were chosen for a wish. Comments and notes about other values come from the original robot.\n";
    text.lines().map(line).fold(head.to_string(), |all, line| all + &line)
}
