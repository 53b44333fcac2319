//! A million predictions as a study, beside the same as one batch: both end in a Parquet table of the same columns.

use criterion::{Criterion, criterion_group, criterion_main};
use ibr::data::{Column, Table};
use ibr::models::{Loads, Model};
use ibr::sweep::{Settings, Shard, Study, collect, names, run};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;

const CASES: usize = 1_000_000;

fn study() -> Study {
    let text = format!(
        "scenario = \"epam\"\noutputs = [\"tip\"]\n[[vary]]\nkey = \"pressure_kpa\"\nfrom = 0\nto = 30\nsteps = {CASES}\n"
    );
    Study::parse("bench", &text, Path::new(""), ibr::ScenarioFile::read).expect("a sound study")
}

/// What somebody would write who needs no table of cases: one batch, and its columns.
fn bare(study: &Study, file: &Path) {
    let model = Model::new(&study.base.scenario);
    let kpa = &study.pressures_kpa;
    let all: Vec<Loads> = kpa.iter().map(|kpa| Loads::uniform(study.base.p_body_pa, kpa * 1e3)).collect();
    let mut batch = model.batch(all.len(), 1);
    model.predict_batch(&all, &mut batch).expect("a prediction");
    let tips: Vec<[f64; 3]> =
        batch.tips.iter().map(|tip| [1e3 * tip.x_m, 1e3 * tip.y_m, tip.angle_rad.to_degrees()]).collect();
    let column = |k: usize| Column::F64(tips.iter().map(|tip| tip[k]).collect());
    let text = |word: &str| Column::Str(vec![word.into(); CASES]);
    let case = Column::I64((1..=CASES as i64).collect());
    let columns =
        [case, text("reduced"), Column::F64(kpa.clone()), column(0), column(1), column(2), text("ok"), text("")];
    Table { columns: names(study).into_iter().zip(columns).collect() }.to_parquet(file, &[]).expect("a table");
}

fn swept(study: &Study, folder: &Path) {
    let settings = Settings {
        folder: folder.to_path_buf(),
        shard: Shard::WHOLE,
        keep_runs: false,
        threads: 1,
        maker: ibr::program::maker(),
    };
    run(study, &settings, &mut |_, _| ControlFlow::Continue(())).expect("a sweep");
    let table = collect(study, folder, false).expect("all parts");
    table.to_parquet(&folder.join("table.parquet"), &[]).expect("a table");
}

fn sweep(c: &mut Criterion) {
    let study = study();
    let folder = tempfile::tempdir().expect("a folder");
    let mut group = c.benchmark_group("a million predictions to Parquet");
    group.sample_size(10);
    group.bench_function("one batch", |b| b.iter(|| bare(black_box(&study), &folder.path().join("bare.parquet"))));
    group.bench_function("a study", |b| {
        b.iter_with_setup(|| tempfile::tempdir().expect("a folder"), |folder| swept(black_box(&study), folder.path()))
    });
    group.finish();
}

criterion_group!(benches, sweep);
criterion_main!(benches);
