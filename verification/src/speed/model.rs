//! Speed of the model on this machine, compared with a controller's needs.

use crate::{Error, Findings, Printed};
use compare::Progress;
use compare::study::published::shipped_scenario;
use fem::record::RecordShape;
use models::{Loads, Model, Scenario, Target, Unsolved};
use serde::Serialize;
use std::time::Instant;

const BATCHES: usize = 31;

/// Predictions in one batch, in an order without pattern.
const BATCH: usize = 10_000;

/// Largest cost of the mechanics, relative to the textbook model in the same run.
const TARGET_RATIO: f64 = 1.5;

struct CallTime {
    id: String,
    /// Textbook model, and the robot as it ships \[µs\].
    median_us: [f64; 2],
    wanted_us: f64,
    /// Whether the ratio has a target too.
    compared: bool,
}

impl CallTime {
    fn ratio(&self) -> f64 {
        self.median_us[1] / self.median_us[0]
    }

    fn met(&self) -> bool {
        self.median_us[0] <= self.wanted_us && (!self.compared || self.ratio() <= TARGET_RATIO)
    }

    fn row(&self) -> Vec<String> {
        let wanted = if self.compared { format!("{TARGET_RATIO:.1}") } else { String::new() };
        let met = if self.met() { "yes" } else { "no" };
        let [textbook, shipped] = self.median_us.map(|us| format!("{us:.3}"));
        let limit = format!("{:.1}", self.wanted_us);
        vec![self.id.clone(), textbook, limit, shipped, format!("{:.2}", self.ratio()), wanted, met.into()]
    }

    fn told(&self) -> BenchFigure<'_> {
        let [textbook_us, shipped_us] = self.median_us;
        let target_ratio = self.compared.then_some(TARGET_RATIO);
        let (id, target_us) = (&self.id, self.wanted_us);
        BenchFigure { id, textbook_us, target_us, shipped_us, ratio: self.ratio(), target_ratio, met: self.met() }
    }
}

/// `ibr.bench`: `ibr bench`
#[derive(Serialize)]
struct SpeedAnswer<'a> {
    /// Processor, number of cores and operating system.
    machine: &'a str,
    /// Times of the calls of every robot.
    figures: Vec<BenchFigure<'a>>,
}

#[derive(Serialize)]
struct BenchFigure<'a> {
    /// Robot and call that are timed.
    id: &'a str,
    /// Median time of a call, textbook robot.
    textbook_us: f64,
    /// Longest time that the textbook robot may take.
    target_us: f64,
    /// Median time of a call, shipped robot.
    shipped_us: f64,
    /// Time of the shipped robot relative to the textbook one.
    ratio: f64,
    /// Largest ratio that is allowed; `None` where only the time counts.
    target_ratio: Option<f64>,
    /// Whether time and ratio are within their limits.
    met: bool,
}

/// Times every actuator's robot; `machine` names the computer.
///
/// # Errors
/// A shipped robot without an equilibrium.
pub fn measure(machine: &str, progress: &mut Progress) -> Result<Findings, Error> {
    let mut figures = Vec::new();
    for kind in models::actuators::ACTUATORS.iter().map(|a| a.name) {
        progress(kind, None);
        figures.extend(of_kind(kind)?);
    }
    let head = &["what", "textbook [µs]", "target [µs]", "shipped [µs]", "ratio", "target", "met"];
    let answer = SpeedAnswer { machine, figures: figures.iter().map(CallTime::told).collect() };
    Ok(Findings {
        parts: vec![
            Printed::Text(format!("Median time on one core of {machine}\n")),
            Printed::table(head, 1, figures.iter().map(CallTime::row)),
        ],
        json: RecordShape { schema: "ibr.bench", version: 2 }.stamped(&answer),
        missed: !figures.iter().all(CallTime::met),
    })
}

/// A timed call: which one, of how many.
type Call = Box<dyn FnMut(usize, usize) -> Result<(), Unsolved>>;

/// Timed calls: name, target time of the textbook model \[µs\], whether the ratio has a target, calls per batch, predictions per call.
const TIMED: [(&str, f64, bool, usize, usize); 4] = [
    ("predict", 1.0, true, 500, 1),
    ("batch of 10 000, each", 0.4, true, 1, BATCH),
    ("predict with gravity and tip load, 12 segments", 20.0, false, 30, 1),
    ("inverse", 10.0, true, 50, 1),
];

fn of_kind(kind: &str) -> Result<Vec<CallTime>, Error> {
    let mut textbook = calls(&shipped_scenario(&format!("{kind}-textbook"))?)?;
    let mut shipped = calls(&shipped_scenario(kind)?)?;
    let pairs = TIMED.iter().zip(textbook.iter_mut().zip(&mut shipped));
    pairs
        .map(|(&(what, wanted_us, compared, calls, each), (a, b))| {
            let median_us = medians(calls, [a, b])?.map(|us| us / each as f64);
            Ok(CallTime { id: format!("{what}/{kind}"), median_us, wanted_us, compared })
        })
        .collect()
}

/// The calls to time, in the order of [`TIMED`].
fn calls(scenario: &Scenario) -> Result<[Call; 4], Error> {
    let [plain, each, inverse] = [Model::new(scenario), Model::new(scenario), Model::new(scenario)];
    let loaded = Model::new(&scenario.with_effect("gravity", &[1.5]).with_effect("tip_load", &[0.0, -0.1]));
    let (mut a, mut b, mut c) = (plain.prediction(), loaded.prediction(), inverse.prediction());
    let body = scenario.p_body_pa;
    let loads = move |i: usize, n: usize| Loads::uniform(body, 10e3 + 20e3 * i as f64 / n as f64);
    let mut tip = |p_pa: f64| inverse.predict(&Loads::uniform(body, p_pa), &mut c).map(|()| c.tip.y_m);
    let (low, high) = (tip(10e3)?, tip(30e3)?);
    let target = move |i: usize, n: usize| Target::TipHeight(low + (high - low) * i as f64 / n as f64);
    let all: Vec<Loads> = (0..BATCH).map(|i| loads(i * 7919 % BATCH, BATCH)).collect();
    let mut batch = each.batch(all.len(), 1);
    Ok([
        Box::new(move |i, n| plain.predict(&loads(i, n), &mut a)),
        Box::new(move |_, _| each.predict_batch(&all, &mut batch)),
        Box::new(move |i, n| loaded.predict(&loads(i, n), &mut b)),
        Box::new(move |i, n| inverse.pressure_for(target(i, n), body, &mut c).map(|_| ())),
    ])
}

/// Medians over batches of the times per call \[µs\]; the two take turns.
fn medians(calls: usize, mut both: [&mut Call; 2]) -> Result<[f64; 2], Error> {
    let mut times = [Vec::with_capacity(BATCHES), Vec::with_capacity(BATCHES)];
    for _ in 0..BATCHES {
        for (call, times) in both.iter_mut().zip(&mut times) {
            let start = Instant::now();
            for i in 0..calls {
                std::hint::black_box(call(i, calls))?;
            }
            times.push(start.elapsed().as_secs_f64() * 1e6 / calls as f64);
        }
    }
    Ok(times.map(|mut t| {
        t.sort_by(f64::total_cmp);
        t[BATCHES / 2]
    }))
}
