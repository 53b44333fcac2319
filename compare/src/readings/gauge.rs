//! A gauge at the actuator, read in addition to the set pressure.
//!
//! The mean over R runs of a reading r at the set pressure p_set, held for t, is
//!
//! ```text
//! r = p + γ p + b + e,   p = law(p_set, t) + c p_set
//! ```
//!
//! | symbol | meaning | from |
//! |---|---|---|
//! | law | the supply stage of a scenario | |
//! | c | error of the regulator, another one in every run | scatter between runs |
//! | γ | error of the gauge's gain | ±0.3 %, assumed |
//! | b | error of its zero \[Pa\] | ±0.1 kPa, assumed |
//! | e | scatter of its readings \[Pa\] | repeats, at least 20 Pa each |
//!
//! A supply law is judged by r − law(p_set, t), with the errors c, γ, b and e. Positions are predicted at r, whatever the law:
//! its slips do not get into them, the errors γ, b and e do, as ∂f/∂p. That these are the same errors in both parts is left
//! out: a supply law changes only the first, every other effect only the second, so that no test sees both.
//!
//! Validity: r is the pressure in the actuator while the markers are seen. Vented (p_set = 0) the pressure is known and the
//! reading, the zero of the gauge, is not used. Where the pressure runs down during a hold, every sample has its own reading.

use crate::directions::DirectionRow;
use crate::error::CompareError;
use crate::fit::numbers::mean;
use crate::fit::whiten::Whitener;
use crate::layout::values_of;
use crate::policy;
use crate::stats::t_inflation;
use crate::study::generate::held;
use data::{Dataset, Hold, Lost};
use models::{Moment, Scenario, Supply};
use std::collections::BTreeSet;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GaugeReading {
    /// Hold of the positions that belong to it ([`Gauge::positions`]).
    pub hold: usize,
    pub set_pa: f64,
    /// For how long it had been set \[s\].
    pub at: Moment,
    pub read_pa: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Gauge {
    /// Readings at set pressures above zero.
    pub readings: Vec<GaugeReading>,
    /// The scenario as given, with its own supply effects.
    pub scenario: Scenario,
    /// The holds as they were set.
    pub set: Vec<Hold>,
    /// Standard deviation of e of every mean reading \[Pa\].
    scatter_pa: f64,
    /// Standard deviation of c of the mean over runs \[-\], widened for few runs.
    run_sd: f64,
    /// Every sample is a separate hold.
    split: bool,
    /// Degrees of freedom of the scatter; 0 if it was assumed.
    pub dof: usize,
}

impl Gauge {
    /// Of the readings in a dataset; `None` if it has none above zero pressure.
    pub(crate) fn of(dataset: &Dataset, scenario: &Scenario) -> Option<Gauge> {
        let runs: Vec<&[f64]> = (0..dataset.runs.len()).map(|r| dataset.gauge(r)).collect::<Option<_>>()?;
        let set: Vec<f64> = dataset.holds.iter().flat_map(|h| vec![h.p_act_pa; dataset.samples_per_hold]).collect();
        let used: Vec<usize> = (0..set.len()).filter(|i| set[*i] > policy::ZERO_PRESSURE_PA).collect();
        let mean: Vec<f64> = (0..set.len()).map(|i| mean(runs.iter().map(|r| r[i]))).collect();
        let squares: f64 = used.iter().map(|i| set[*i] * set[*i]).sum();
        if used.is_empty() {
            return None;
        }
        let (mut scatter, mut gains) = (0.0, 0.0);
        for run in &runs {
            let off = |i: &usize| run[*i] - mean[*i];
            let gain = used.iter().map(|i| off(i) * set[*i]).sum::<f64>() / squares;
            scatter += used.iter().map(|i| (off(i) - gain * set[*i]).powi(2)).sum::<f64>();
            gains += gain * gain;
        }
        let (repeats, count) = (runs.len() - 1, runs.len() as f64);
        let dof = repeats * (used.len() - 1);
        let variance = match dof {
            0 => policy::READING_SD_PA * policy::READING_SD_PA,
            _ => (scatter / dof as f64).max(policy::LEAST_READING_SD_PA * policy::LEAST_READING_SD_PA),
        };
        let run_variance = match repeats {
            0 => policy::SENSOR_SD[0] * policy::SENSOR_SD[0],
            n => (gains / n as f64 - variance / squares).max(0.0) * t_inflation(n) / count,
        };
        let gauge = Gauge::new(dataset, scenario, &mean, (variance / count).sqrt(), run_variance.sqrt());
        Some(Gauge { dof, ..gauge })
    }

    /// What a gauge would read behind a supply, in the mean of `runs` runs whose pressures scatter by `run_sd`.
    pub(crate) fn planned(dataset: &Dataset, scenario: &Scenario, supply: &Supply, runs: usize, run_sd: f64) -> Gauge {
        let expected: Vec<f64> = held(&dataset.holds).iter().map(|(set, at)| supply.pressure(*set, at)).collect();
        let share = 1.0 / (runs.max(1) as f64).sqrt();
        Gauge::new(dataset, scenario, &expected, policy::READING_SD_PA * share, run_sd * share)
    }

    /// `mean` is laid out `[hold][sample]`, `sd_pa` belongs to one of its values.
    fn new(dataset: &Dataset, scenario: &Scenario, mean: &[f64], sd_pa: f64, run_sd: f64) -> Gauge {
        let samples = dataset.samples_per_hold;
        let is_used = |(_, hold): &(usize, &Hold)| hold.p_act_pa > policy::ZERO_PRESSURE_PA;
        let holds = || dataset.holds.iter().enumerate().filter(is_used);
        let runs_down =
            |h: usize| policy::runs_down((mean[h * samples] - mean[(h + 1) * samples - 1]) / (2_f64.sqrt() * sd_pa));
        let split = samples > 1 && holds().any(|(h, _)| runs_down(h));
        let held = held(&dataset.holds);
        let reading = |i: usize| GaugeReading {
            hold: if split { i } else { i / samples },
            set_pa: held[i].0,
            at: held[i].1,
            read_pa: mean[i],
        };
        Gauge {
            readings: holds().flat_map(|(h, _)| h * samples..(h + 1) * samples).map(reading).collect(),
            scenario: scenario.clone(),
            set: dataset.holds.clone(),
            scatter_pa: sd_pa,
            run_sd,
            split,
            dof: 0,
        }
    }

    /// The dataset with its positions at what was read in place of what was set.
    pub(crate) fn positions(&self, dataset: &Dataset) -> Dataset {
        let mut read = Dataset { gauge_pa: None, ..dataset.clone() };
        if self.split {
            let each =
                |hold: &Hold| hold.t_s.iter().map(|t| Hold { t_s: vec![*t], ..hold.clone() }).collect::<Vec<_>>();
            read.holds = dataset.holds.iter().flat_map(each).collect();
            read.samples_per_hold = 1;
            read.lost = of_samples(&dataset.lost, dataset.samples_per_hold);
        }
        for (h, hold) in read.holds.iter_mut().enumerate() {
            let own = || self.of_hold(h).map(|r| r.read_pa);
            let mean_pa = (own().sum::<f64>() / own().count().max(1) as f64).max(0.0);
            hold.p_act_pa = if hold.p_act_pa > policy::ZERO_PRESSURE_PA { mean_pa } else { 0.0 };
        }
        read
    }

    fn of_hold(&self, hold: usize) -> impl Iterator<Item = &GaugeReading> {
        self.readings.iter().filter(move |r| r.hold == hold)
    }

    /// The dataset of [`Gauge::positions`] with its holds as they were set.
    pub(crate) fn as_set(&self, positions: &Dataset) -> Dataset {
        let samples_per_hold = self.set.first().map_or(1, |hold| hold.t_s.len());
        let mut lost = positions.lost.clone();
        if self.split {
            let unseen = lost.unseen.iter().map(|[sample, marker]| [sample / samples_per_hold, *marker]);
            lost.unseen = unseen.collect::<BTreeSet<_>>().into_iter().collect();
            let filled = lost.filled.iter().map(|[run, sample, marker]| [*run, sample / samples_per_hold, *marker]);
            lost.filled = filled.collect::<BTreeSet<_>>().into_iter().collect();
        }
        Dataset { holds: self.set.clone(), samples_per_hold, lost, ..positions.clone() }
    }

    /// What one standard deviation of each error of the gauge does to positions predicted at its readings \[m\], from
    /// ∂f/∂ln p there.
    pub(crate) fn errors_m(&self, positions: &Dataset, d_ln_pressure_m: &[f64]) -> Vec<Vec<f64>> {
        let read: Vec<usize> = (0..positions.holds.len()).filter(|h| self.of_hold(*h).next().is_some()).collect();
        // What an error of `sd` pascal at some holds does.
        let along = |holds: &[usize], sd: &dyn Fn(f64) -> f64| {
            let mut column = vec![0.0; d_ln_pressure_m.len()];
            for &h in holds.iter().filter(|h| positions.holds[**h].p_act_pa > 0.0) {
                let p = positions.holds[h].p_act_pa;
                values_of(positions, &[h]).for_each(|i| column[i] = sd(p) / p * d_ln_pressure_m[i]);
            }
            column
        };
        let own = |h: &usize| along(&[*h], &|_| self.scatter_pa / (self.of_hold(*h).count() as f64).sqrt());
        let shared = [along(&read, &|_| policy::ZERO_SD_PA), along(&read, &|p| policy::SENSOR_SD[0] * p)];
        shared.into_iter().chain(read.iter().map(own)).collect()
    }

    pub(crate) fn whitener(&self) -> Result<Whitener, CompareError> {
        let column = |of: &dyn Fn(&GaugeReading) -> f64| self.readings.iter().map(of).collect::<Vec<f64>>();
        let columns = [
            column(&|r| self.run_sd * r.set_pa),
            column(&|r| policy::SENSOR_SD[0] * r.read_pa),
            column(&|_| policy::ZERO_SD_PA),
        ];
        Whitener::with_columns(
            &vec![DirectionRow::default(); self.readings.len()],
            self.scatter_pa,
            &DirectionRow::default(),
            &columns,
        )
    }

    /// Pressure by the laws of a scenario minus what was read \[Pa\], one for each reading.
    pub(crate) fn differences_pa(&self, scenario: &Scenario) -> Vec<f64> {
        let supply = Supply::of(scenario);
        self.readings.iter().map(|r| supply.pressure(r.set_pa, &r.at) - r.read_pa).collect()
    }
}

fn of_samples(lost: &Lost, samples: usize) -> Lost {
    let holds = |hold: usize| hold * samples..(hold + 1) * samples;
    let unseen = lost.unseen.iter().flat_map(|[hold, marker]| holds(*hold).map(move |h| [h, *marker]));
    let filled = lost.filled.iter().flat_map(|[run, hold, marker]| holds(*hold).map(move |h| [*run, h, *marker]));
    let (mut unseen, mut filled): (Vec<_>, Vec<_>) = (unseen.collect(), filled.collect());
    unseen.sort_unstable();
    filled.sort_unstable();
    Lost { unseen, filled, frames: lost.frames }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::published::textbook_scenario;
    use crate::study::{Generator, generate, predict_dataset};

    fn read(scenario: &Scenario, runs: usize, seed: u64) -> Dataset {
        generate(scenario, "read", &Generator { runs, seed, gauge: true, ..Generator::default() }).unwrap()
    }

    #[test]
    fn readings_whitened_have_the_variance_of_noise() {
        let robot = textbook_scenario("epam").unwrap().with_bending(1.35);
        let (mut squares, mut count) = (0.0, 0);
        for seed in 0..300 {
            let gauge = Gauge::of(&read(&robot, 10, seed), &robot).unwrap();
            let white = gauge.whitener().unwrap().whiten(&gauge.differences_pa(&robot));
            squares += white.iter().map(|w| w * w).sum::<f64>();
            count += white.len();
        }
        // Widening of the regulator's scatter takes one of fifteen readings down a little.
        let mean = squares / f64::from(count as u32);
        assert!((0.93..1.03).contains(&mean), "{mean}");
    }

    /// 0.1 kPa of the zero, 0.3 % of the gain, 50 Pa of a reading, and no less than its last digit of 20 where runs repeat.
    #[test]
    fn a_gauge_errs_as_is_said_of_it() {
        let robot = textbook_scenario("epam").unwrap().with_bending(1.35);
        let one = read(&robot, 1, 1);
        let gauge = Gauge::of(&one, &robot).unwrap();
        assert_eq!(gauge.scatter_pa, 50.0);
        // Where ∂f/∂ln p is one metre, an error of a share of the pressure is that share of a metre.
        let at = gauge.positions(&one);
        let hold = at.holds.iter().rposition(|hold| hold.p_act_pa > 0.0).unwrap();
        let value = hold * at.values_per_run() / at.holds.len();
        let errors = gauge.errors_m(&at, &vec![1.0; at.values_per_run()]);
        assert!((errors[0][value] - 100.0 / at.holds[hold].p_act_pa).abs() < 1e-12);
        assert!((errors[1][value] - 0.003).abs() < 1e-12);
        let quiet = Dataset {
            runs: vec!["1".into(), "2".into()],
            gauge_pa: one.gauge_pa.as_ref().map(|g| [g.clone(), g.clone()].concat()),
            coordinates_m: [one.coordinates_m.clone(), one.coordinates_m.clone()].concat(),
            ..one
        };
        assert!((Gauge::of(&quiet, &robot).unwrap().scatter_pa - 20.0 / 2_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn what_was_lost_is_lost_in_every_sample_and_back() {
        let robot = textbook_scenario("spam").unwrap().with_bending(6.0).with_effect("leak", &[0.1]);
        let data = read(&robot, 3, 1).losing(&[[0, 1, 2], [0, 3, 5], [1, 3, 5], [0, 3, 4], [1, 3, 4]]);
        let gauge = Gauge::of(&data, &robot).unwrap();
        let at = gauge.positions(&data);
        assert!(gauge.split && at.lost.unseen.is_sorted() && at.lost.unseen.len() == 2 * data.samples_per_hold);
        assert!(at.unseen_values().eq(data.unseen_values().collect::<std::collections::BTreeSet<_>>()));
        assert_eq!(gauge.as_set(&at).lost, data.lost);
    }

    #[test]
    fn errors_of_the_gauge_move_the_markers_as_much_as_the_model_says() {
        let robot = textbook_scenario("spam").unwrap().with_bending(6.0);
        let data = read(&robot, 5, 1);
        let gauge = Gauge::of(&data, &robot).unwrap();
        let at = gauge.positions(&data);
        let predicted = predict_dataset(&robot, &at).unwrap();
        let errors = gauge.errors_m(&at, &predicted.d_ln_pressure_m);
        assert_eq!(errors.len(), 2 + 3);
        let mut off = at.clone();
        off.holds.iter_mut().filter(|hold| hold.p_act_pa > 0.0).for_each(|hold| hold.p_act_pa += policy::ZERO_SD_PA);
        let moved = predict_dataset(&robot, &off).unwrap();
        for ((a, b), column) in moved.coordinates_m.iter().zip(&predicted.coordinates_m).zip(&errors[0]) {
            assert!((a - b - column).abs() < 0.02 * column.abs() + 1e-6, "{} {column}", a - b);
        }
        let vented = at.values_per_run() / at.holds.len();
        assert!(errors.iter().all(|column| column[..vented].iter().all(|e| *e == 0.0)));
    }

    #[test]
    fn a_pressure_that_runs_down_is_followed_sample_by_sample() {
        let robot = textbook_scenario("epam").unwrap().with_bending(1.35);
        let steady = read(&robot, 5, 2);
        let gauge = Gauge::of(&steady, &robot).unwrap();
        assert_eq!(gauge.positions(&steady).holds.len(), steady.holds.len());
        let leaking = read(&robot.with_effect("leak", &[0.05]), 5, 2);
        let gauge = Gauge::of(&leaking, &robot).unwrap();
        let at = gauge.positions(&leaking);
        assert_eq!((at.holds.len(), at.samples_per_hold), (25, 1));
        let (first, last) = (at.holds[15].p_act_pa, at.holds[19].p_act_pa);
        assert!((last / first - (-0.05_f64 * 4.0).exp()).abs() < 0.01, "{first} {last}");
        assert_eq!(gauge.as_set(&at).holds, leaking.holds);
        assert!(Gauge::of(&Dataset { gauge_pa: None, ..leaking }, &robot).is_none());
    }
}
