//! Time of predictions, inverse, Jacobian and batches. Ids name actuator and size: `predict/epam/6x60mm`.

#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use models::actuators::ACTUATORS;
use models::{Loads, Model, Scenario, Step, Target, shipped};
use std::hint::black_box;

/// The shipped robots and the size of their actuators.
fn robots() -> impl Iterator<Item = (&'static str, String)> {
    ACTUATORS.iter().map(|kind| {
        let actuator = robot(kind.name).actuator;
        (kind.name, format!("{}x{:.0}mm", actuator.count, actuator.shape.length_m * 1e3))
    })
}
/// Bending stiffness of the robots that are not bare \[N·m²\], near the calibrated ones.
const STIFFNESS: f64 = 1.35;
const BODY_PA: f64 = 2e3;
const BATCH: usize = 10_000;

fn robot(name: &str) -> Scenario {
    Scenario::parse(shipped(name).expect("shipped")).expect("shipped scenarios parse")
}

/// Pressures from 10 to 30 kPa in an order without pattern, so that no prediction profits from the one before.
fn pressures() -> impl Iterator<Item = f64> {
    (0_u32..).map(|i| 10e3 + f64::from(i * 7919 % 20_001))
}

/// Equilibrium and six markers, no transverse load; without and with bending stiffness.
fn predict(c: &mut Criterion) {
    for (name, size) in robots() {
        for (kind, scenario) in [
            ("predict", robot(name)),
            ("predict_textbook", robot(&format!("{name}-textbook"))),
            ("predict_stiff", robot(name).with_bending(STIFFNESS)),
        ] {
            let model = Model::new(&scenario);
            let (mut out, mut p) = (model.prediction(), pressures());
            c.bench_function(&format!("{kind}/{name}/{size}"), |b| {
                b.iter(|| model.predict(black_box(&Loads::uniform(BODY_PA, p.next().unwrap_or(0.0))), &mut out));
            });
        }
    }
}

/// Gravity and a tip load: all segments coupled.
fn loaded(c: &mut Criterion) {
    for (name, size) in robots() {
        for segments in [12, 48] {
            let loads = [("gravity", vec![1.5]), ("tip_load", vec![0.0, -0.2])];
            let stiff = robot(name).with_bending(STIFFNESS);
            let mut scenario = loads.iter().fold(stiff, |s, (effect, values)| s.with_effect(effect, values));
            scenario.segments = segments;
            let model = Model::new(&scenario);
            let (mut out, mut p) = (model.prediction(), pressures());
            c.bench_function(&format!("loaded/{name}/{size}/{segments}seg"), |b| {
                b.iter(|| model.predict(black_box(&Loads::uniform(BODY_PA, p.next().unwrap_or(0.0))), &mut out));
            });
        }
    }
}

fn inverse(c: &mut Criterion) {
    for (name, size) in robots() {
        let model = Model::new(&robot(name).with_bending(STIFFNESS));
        let (mut out, mut p) = (model.prediction(), pressures());
        c.bench_function(&format!("inverse/{name}/{size}"), |b| {
            // Tip heights from 20 to 40 mm, which all four reach.
            b.iter(|| {
                let target = Target::TipHeight(1e-6 * (10e3 + p.next().unwrap_or(0.0)));
                model.pressure_for(black_box(target), BODY_PA, &mut out)
            });
        });
    }
}

fn jacobian(c: &mut Criterion) {
    for (name, size) in robots() {
        let model = Model::new(&robot(name).with_bending(STIFFNESS));
        let (mut out, mut p) = (model.prediction(), pressures());
        c.bench_function(&format!("jacobian/{name}/{size}"), |b| {
            b.iter(|| model.jacobian(black_box(&Loads::uniform(BODY_PA, p.next().unwrap_or(0.0))), &mut out));
        });
    }
}

/// Time of the whole batch on one thread and on two; criterion's elements per second are predictions per second.
fn batch(c: &mut Criterion) {
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(BATCH as u64)).sample_size(20);
    for (name, size) in robots() {
        let model = Model::new(&robot(name));
        let loads: Vec<Loads> = pressures().take(BATCH).map(|p| Loads::uniform(BODY_PA, p)).collect();
        for threads in [1, 2] {
            let mut out = model.batch(BATCH, threads);
            group.bench_function(BenchmarkId::new(BATCH.to_string(), format!("{name}/{size}/{threads}thr")), |b| {
                b.iter(|| model.predict_batch(black_box(&loads), &mut out));
            });
        }
    }
    group.finish();
}

/// What is done once per robot.
fn set_up(c: &mut Criterion) {
    let scenario = robot("epam");
    c.bench_function("set_up/epam/6x60mm", |b| b.iter(|| Model::new(black_box(&scenario)).prediction()));
}

/// Six holds of five samples with an effect that has history.
fn protocol(c: &mut Criterion) {
    for (name, size) in robots() {
        for (effect, values) in [("friction", vec![0.3]), ("creep", vec![0.25, 2.0])] {
            let model = Model::new(&robot(name).with_bending(STIFFNESS).with_effect(effect, &values));
            let step = |i: usize, p: f64, k: usize| Step {
                t_s: 5.0 * i as f64 + k as f64 + 1.0,
                loads: Loads::uniform(BODY_PA, p),
            };
            let holds = [0.0, 10e3, 20e3, 30e3, 20e3, 0.0];
            let steps: Vec<Step> =
                holds.iter().enumerate().flat_map(|(i, p)| (0..5).map(move |k| step(i, *p, k))).collect();
            let mut out = model.prediction();
            c.bench_function(&format!("protocol/{name}/{size}/{effect}"), |b| {
                b.iter(|| model.follow(black_box(&steps), &mut out, &mut |_, _| ()));
            });
        }
    }
}

criterion_group!(benches, predict, loaded, inverse, jacobian, batch, set_up, protocol);
criterion_main!(benches);
