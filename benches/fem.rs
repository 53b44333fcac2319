//! Time of steps of the finite element engine. Ids name physics and mesh: `pillow/bending/100x100x2`.

#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fem::Simulation;
use verification::speed::{plain_loop, workloads as speed};

/// Steps per sample: the engine looks at its guards every 64.
const STEPS: u64 = 64;

fn pillow(c: &mut Criterion) {
    let mut group = c.benchmark_group("pillow");
    group.sample_size(20);
    for n in [36, 72, 100] {
        for (physics, bending) in [("membrane", false), ("bending", true)] {
            for threads in [1, 2] {
                let mut problem = speed::pillow(n, bending).expect("the mesh is even");
                problem.settings.threads = threads;
                let mut run = Simulation::new(&problem).expect("the problem is right");
                let elements = run.elements() as u64;
                group.throughput(Throughput::Elements(elements * STEPS));
                let id = BenchmarkId::new(physics, format!("{n}x{n}x2/{threads} threads"));
                group.bench_function(id, |b| b.iter(|| speed::advance_by(&mut run, STEPS).expect("it stays stable")));
            }
        }
    }
}

/// The plain loop over membrane triangles on the same nodes: `plain/membrane/72x72x2`.
fn plain(c: &mut Criterion) {
    let mut group = c.benchmark_group("plain");
    group.sample_size(20);
    for n in [36, 72, 100] {
        let mut run = plain_loop::Membrane::new(&speed::pillow(n, false).expect("the mesh is even"));
        group.throughput(Throughput::Elements(run.triangles() as u64 * STEPS));
        let id = BenchmarkId::new("membrane", format!("{n}x{n}x2"));
        group.bench_function(id, |b| b.iter(|| run.advance_by(STEPS)));
    }
}

criterion_group!(benches, pillow, plain);
criterion_main!(benches);
