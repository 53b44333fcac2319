//! Time of a diagnosis by the number of markers. Ids name what is missing, actuator and markers: `diagnose/end_constraint/spam/100`.

#![allow(missing_docs)]

use compare::Evidence;
use compare::diagnosis::{Options, diagnose};
use compare::study::{Generator, generate};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use models::{Scenario, shipped};
use std::hint::black_box;

/// How much of it is missing, and markers: a few that are stuck on, and backbones that a camera follows. A small loss is one about
/// which the simulated noise is asked; 400 markers take seconds then.
const MISSING: [(&str, f64, &[u32]); 2] =
    [("end_constraint", 0.3, &[5, 25, 100, 400]), ("small_end_constraint", 0.05, &[5, 25, 100])];
const STIFFNESS: f64 = 4.0;

fn diagnosis(c: &mut Criterion) {
    let mut group = c.benchmark_group("diagnose");
    group.sample_size(10);
    for (missing, value, all) in MISSING {
        for markers in all {
            let plain = Scenario::parse(shipped("spam-textbook").expect("shipped")).expect("shipped scenarios parse");
            let station = |i: u32| plain.length_m * (f64::from(i) + 0.5) / f64::from(*markers);
            let told = plain.with_bending(STIFFNESS).with_markers(&(0..*markers).map(station).collect::<Vec<_>>());
            let data = generate(&told.with_effect("end_constraint", &[value, 1.0]), "made", &Generator::default());
            let data = data.expect("the robot has an equilibrium");
            let data = [Evidence::of(data, None)];
            group.bench_function(BenchmarkId::new(missing, format!("spam/{markers}")), |b| {
                b.iter(|| diagnose(black_box(&told), &data, &Options::default(), &mut |_, _| ()));
            });
        }
    }
}

criterion_group!(benches, diagnosis);
criterion_main!(benches);
