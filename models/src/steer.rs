//! Several supply channels: the pressures that bring the tip, or all markers, nearest to their targets.
//!
//! ```text
//! least Σ |x(P) − x_wanted|²   over P₀ … P₃, each within its limits
//! ```
//!
//! A grid over the limits finds the basins, Levenberg and Marquardt's steps in √P the bottom of the best ones; a pressure at
//! its limit is left there while the sum would fall beyond it. In √P the steep start of a pouch is a slope like others.

use crate::error::{Solved, Unsolved};
use crate::model::{MOST_ACTUATOR_PA, Model, Prediction};
use crate::reach::MET;
use crate::term::{CHANNELS, Loads};

/// Target place of the tip or of all markers, in the robot's plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim<'a> {
    /// End of the centre line \[m\].
    Tip([f64; 2]),
    /// Every marker of the scenario, base to tip \[m\].
    Markers(&'a [[f64; 2]]),
}

/// Pressures that may be asked for, per channel \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Least gauge pressure that may be set, per channel.
    pub least_pa: [f64; CHANNELS],
    /// Largest gauge pressure that may be set, per channel.
    pub most_pa: [f64; CHANNELS],
}

/// Which limit a pressure is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The channel is at its least pressure, and less would bring the robot nearer.
    Least,
    /// The channel is at its largest pressure, and more would bring the robot nearer.
    Most,
}

/// Pressures that bring the robot nearest to its aim, with the remaining distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steered {
    /// Pressures of body and channels; 0 in a channel that feeds nothing.
    pub loads: Loads,
    /// Distance from the aim, the root mean square over markers \[m\].
    pub miss_m: f64,
    /// The limit of each channel that keeps the robot from coming nearer.
    pub held: [Option<End>; CHANNELS],
}

/// Buffers of [`Model::steer`]; made once, so that steering allocates nothing.
#[derive(Debug, Clone)]
pub struct Steering {
    /// The state that was found, then one with each channel moved up and down.
    states: Vec<Prediction>,
}

/// Values of √P per channel on the grid, by the number of channels.
const GRID: [usize; CHANNELS + 1] = [1, 65, 21, 9, 6];
/// Grid points from which the bottom is sought.
const STARTS: usize = 6;
/// Steps to the bottom: some ten settle, more only along a flat valley.
const STEPS: usize = 60;
/// Relative fall of the cost at which the bottom is reached.
const SETTLED: f64 = 1e-12;
/// Step of the central differences over the largest √P.
const NUDGE: f64 = 1e-5;

/// √P per channel: the coordinates of the search.
type Roots = [f64; CHANNELS];

impl Limits {
    /// From nothing to the same pressure in every channel.
    pub fn up_to(most_pa: f64) -> Limits {
        Limits { least_pa: [0.0; CHANNELS], most_pa: [most_pa; CHANNELS] }
    }

    /// The limits narrowed to at most `change_pa` from present pressures: a rate times the time of a cycle.
    ///
    /// ```
    /// let near = models::Limits::up_to(50e3).near(&[10e3, 0.0, 0.0, 49e3], 2e3);
    /// assert_eq!((near.least_pa[0], near.most_pa[0], near.most_pa[3]), (8e3, 12e3, 50e3));
    /// ```
    pub fn near(&self, now_pa: &[f64; CHANNELS], change_pa: f64) -> Limits {
        let mut near = *self;
        for (channel, now) in now_pa.iter().enumerate() {
            // Pressures beyond the limits come back to them as fast as they may.
            let [least, most] = [self.least_pa[channel], self.most_pa[channel]];
            near.least_pa[channel] = (now - change_pa).clamp(least, most.max(least));
            near.most_pa[channel] = (now + change_pa).clamp(least, most.max(least));
        }
        near
    }

    fn ends(&self, channel: usize) -> [f64; 2] {
        [self.least_pa[channel].sqrt(), self.most_pa[channel].sqrt()]
    }
}

impl Steering {
    /// Borrows the prediction at the pressures of the last call of [`Model::steer`].
    pub fn state(&self) -> &Prediction {
        &self.states[0]
    }
}

impl Aim<'_> {
    fn count(&self) -> usize {
        match self {
            Aim::Tip(_) => 1,
            Aim::Markers(places) => places.len(),
        }
    }

    fn wanted(&self, index: usize) -> [f64; 2] {
        match self {
            Aim::Tip(place) => *place,
            Aim::Markers(places) => places[index],
        }
    }

    fn seen(&self, at: &Prediction, index: usize) -> [f64; 2] {
        match self {
            Aim::Tip(_) => [at.tip.x_m, at.tip.y_m],
            Aim::Markers(_) => at.markers[index],
        }
    }

    /// Half of the sum of squares \[m²\].
    fn cost(&self, at: &Prediction) -> f64 {
        let square = |i: usize| {
            let ([x, y], [a, b]) = (self.seen(at, i), self.wanted(i));
            (x - a).powi(2) + (y - b).powi(2)
        };
        0.5 * (0..self.count()).map(square).sum::<f64>()
    }

    fn miss_m(&self, cost: f64) -> f64 {
        (2.0 * cost / self.count() as f64).sqrt()
    }
}

struct Search<'a> {
    model: &'a Model,
    aim: Aim<'a>,
    body_pa: f64,
    limits: &'a Limits,
    used: [bool; CHANNELS],
    work: &'a mut Steering,
    failed: Option<Unsolved>,
}

impl Search<'_> {
    fn loads(&self, roots: &Roots) -> Loads {
        let mut actuator_pa = roots.map(|root| root * root);
        // At a limit exactly that, whatever the root was rounded to.
        for channel in self.channels() {
            let [low, high] = self.limits.ends(channel);
            let limits = [(low, self.limits.least_pa[channel]), (high, self.limits.most_pa[channel])];
            let at = limits.into_iter().find(|(root, _)| *root == roots[channel]);
            actuator_pa[channel] = at.map_or(actuator_pa[channel], |(_, limit)| limit);
        }
        Loads { body_pa: self.body_pa, actuator_pa }
    }

    fn channels(&self) -> impl Iterator<Item = usize> + use<> {
        let used = self.used;
        (0..CHANNELS).filter(move |channel| used[*channel])
    }

    /// Cost at pressures, their state in a buffer; infinite where nothing balances.
    fn cost(&mut self, roots: &Roots, buffer: usize) -> f64 {
        match self.model.predict(&self.loads(roots), &mut self.work.states[buffer]) {
            Ok(()) => self.aim.cost(&self.work.states[buffer]),
            Err(error) => {
                self.failed.get_or_insert(error);
                f64::INFINITY
            }
        }
    }

    fn starts(&mut self) -> [(f64, Roots); STARTS] {
        let mut best = [(f64::INFINITY, [0.0; CHANNELS]); STARTS];
        let count = GRID[self.channels().count()];
        let points = count.pow(self.channels().count() as u32);
        for point in 0..points {
            let (mut rest, mut roots) = (point, [0.0; CHANNELS]);
            for channel in self.channels() {
                let ([low, high], share) = (self.limits.ends(channel), (rest % count) as f64 / (count - 1) as f64);
                roots[channel] = low + share * (high - low);
                rest /= count;
            }
            let cost = self.cost(&roots, 0);
            if cost < best[STARTS - 1].0 {
                best[STARTS - 1] = (cost, roots);
                best.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            }
        }
        best
    }

    /// Gradient of the cost by √P, and the matrix of its normal equations.
    fn normal(&mut self, roots: &Roots) -> (Roots, [Roots; CHANNELS]) {
        let mut spans = [0.0; CHANNELS];
        for channel in self.channels() {
            let step = NUDGE * self.limits.ends(channel)[1].max(1.0);
            let [mut up, mut down] = [*roots; 2];
            up[channel] = (roots[channel] + step).min(MOST_ACTUATOR_PA.sqrt());
            down[channel] = (roots[channel] - step).max(0.0);
            let lost = self.cost(&up, 1 + 2 * channel) + self.cost(&down, 2 + 2 * channel);
            spans[channel] = if lost.is_finite() { up[channel] - down[channel] } else { f64::INFINITY };
        }
        let (mut gradient, mut matrix) = ([0.0; CHANNELS], [[0.0; CHANNELS]; CHANNELS]);
        for (index, side) in (0..self.aim.count()).flat_map(|index| [(index, 0), (index, 1)]) {
            let of = |state: usize| self.aim.seen(&self.work.states[state], index)[side];
            let mut row = [0.0; CHANNELS];
            for channel in self.channels() {
                row[channel] = (of(1 + 2 * channel) - of(2 + 2 * channel)) / spans[channel];
            }
            let miss = of(0) - self.aim.wanted(index)[side];
            for a in self.channels() {
                gradient[a] += row[a] * miss;
                for b in self.channels() {
                    matrix[a][b] += row[a] * row[b];
                }
            }
        }
        (gradient, matrix)
    }

    /// The limit at which a channel is, if the cost falls beyond it.
    fn held(&self, channel: usize, roots: &Roots, gradient: &Roots) -> Option<End> {
        let [low, high] = self.limits.ends(channel);
        match gradient[channel] {
            slope if slope > 0.0 && roots[channel] <= low => Some(End::Least),
            slope if slope < 0.0 && roots[channel] >= high => Some(End::Most),
            _ => None,
        }
    }

    fn descend(&mut self, start: (f64, Roots)) -> (f64, Roots) {
        let (mut cost, mut roots) = start;
        let mut damping = 1e-3;
        self.cost(&roots, 0);
        for _ in 0..STEPS {
            if self.aim.miss_m(cost) <= 1e-2 * MET || damping > 1e12 {
                break;
            }
            let (gradient, matrix) = self.normal(&roots);
            let mut free = self.used;
            for channel in self.channels() {
                free[channel] = self.held(channel, &roots, &gradient).is_none();
            }
            let (mut moved, before) = (false, cost);
            while !moved && damping < 1e12 {
                let step = solve(&gradient, &matrix, &free, damping);
                let mut next = roots;
                for channel in self.channels() {
                    let [low, high] = self.limits.ends(channel);
                    next[channel] = (roots[channel] - step[channel]).clamp(low, high);
                }
                let there = self.cost(&next, 0);
                moved = there < cost;
                if moved {
                    (cost, roots, damping) = (there, next, (0.1 * damping).max(1e-12));
                } else {
                    damping *= 10.0;
                }
            }
            // At the minimum for an aim out of reach the cost only falls by its rounding.
            if before - cost <= SETTLED * before {
                break;
            }
        }
        (cost, roots)
    }
}

/// Step of the damped normal equations over the free channels: Gauss's elimination; the matrix is positive definite.
fn solve(gradient: &Roots, matrix: &[Roots; CHANNELS], free: &[bool; CHANNELS], damping: f64) -> Roots {
    let (mut a, mut x) = (*matrix, *gradient);
    let scale = (0..CHANNELS).fold(f64::MIN_POSITIVE, |most, i| most.max(matrix[i][i]));
    for i in 0..CHANNELS {
        a[i][i] += damping * (matrix[i][i] + 1e-9 * scale);
        if !free[i] {
            (a[i], x[i]) = ([0.0; CHANNELS], 0.0);
            a[i][i] = 1.0;
        }
    }
    for i in 0..CHANNELS {
        for j in i + 1..CHANNELS {
            let share = a[j][i] / a[i][i];
            let row = a[i];
            a[j].iter_mut().zip(row).for_each(|(below, above)| *below -= share * above);
            x[j] -= share * x[i];
        }
    }
    for i in (0..CHANNELS).rev() {
        let known: f64 = (i + 1..CHANNELS).map(|j| a[i][j] * x[j]).sum();
        x[i] = (x[i] - known) / a[i][i];
    }
    x
}

impl Model {
    /// Allocates the buffers of [`Model::steer`]: one state, and two for the slope of each channel.
    pub fn steering(&self) -> Steering {
        Steering { states: vec![self.prediction(); 1 + 2 * CHANNELS] }
    }

    /// Pressures within limits that bring the robot nearest to an aim, on the first loading from rest; [`Steering::state`] is
    /// then that state. Of several pressures that reach it, one. Allocates nothing.
    ///
    /// ```
    /// use models::{Aim, Limits, Model, Scenario, shipped};
    /// let two = "\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n";
    /// let robot = Scenario::parse(&(shipped("epam-textbook").unwrap().to_string() + two)).unwrap();
    /// let model = Model::new(&robot);
    /// let found = model.steer(Aim::Tip([0.29, 0.13]), 2e3, &Limits::up_to(50e3), &mut model.steering()).unwrap();
    /// assert!(found.miss_m < 1e-9 && found.loads.actuator_pa[0] != found.loads.actuator_pa[1]);
    /// ```
    ///
    /// # Errors
    /// [`Unsolved::BadAim`], a limit that is not a pressure, or what [`Model::predict`] returns if nothing balances anywhere.
    pub fn steer(&self, aim: Aim, body_pa: f64, limits: &Limits, work: &mut Steering) -> Solved<Steered> {
        self.planar("steering to a place")?;
        self.check_aim(&aim, body_pa, limits)?;
        let mut used = [false; CHANNELS];
        self.channels().for_each(|channel| used[channel] = true);
        let mut search = Search { model: self, aim, body_pa, limits, used, work, failed: None };
        let mut best = (f64::INFINITY, [0.0; CHANNELS]);
        for start in search.starts().into_iter().filter(|start| start.0.is_finite()) {
            let bottom = search.descend(start);
            best = if bottom.0 < best.0 { bottom } else { best };
            if aim.miss_m(best.0) <= MET {
                break;
            }
        }
        if let (f64::INFINITY, Some(error)) = (best.0, search.failed.take()) {
            return Err(error);
        }
        let (cost, roots) = search.released(best);
        search.cost(&roots, 0);
        let (miss_m, gradient) = (aim.miss_m(cost), search.normal(&roots).0);
        let mut held = [None; CHANNELS];
        for channel in search.channels().filter(|_| miss_m > MET) {
            held[channel] = search.held(channel, &roots, &gradient);
        }
        Ok(Steered { loads: search.loads(&roots), miss_m, held })
    }

    fn check_aim(&self, aim: &Aim, body_pa: f64, limits: &Limits) -> Solved {
        for actuator_pa in [limits.least_pa, limits.most_pa] {
            crate::model::check(&Loads { body_pa, actuator_pa })?;
        }
        let finite = (0..aim.count()).all(|i| aim.wanted(i).iter().all(|x| x.is_finite()));
        let what = match aim {
            _ if limits.least_pa.iter().zip(&limits.most_pa).any(|(least, most)| least > most) => {
                "the least pressure of a channel is above its largest"
            }
            Aim::Markers(places) if places.len() != self.marker_count() || places.is_empty() => {
                "there must be one target place for each marker of the scenario"
            }
            _ if !finite => "a target place is not a finite number of metres",
            _ => return Ok(()),
        };
        Err(Unsolved::BadAim { what })
    }
}

impl Search<'_> {
    /// The same with the least pressure in every channel where it makes no difference: in one whose actuators stay flat.
    fn released(&mut self, (cost, roots): (f64, Roots)) -> (f64, Roots) {
        let mut kept = (cost, roots);
        for channel in self.channels() {
            let mut less = kept.1;
            less[channel] = self.limits.ends(channel)[0];
            let there = self.cost(&less, 0);
            if there <= kept.0 {
                kept = (there, less);
            }
        }
        kept
    }
}
