//! Scatter as laboratories have it: the model is exact, and nothing may be found missing.

use crate::diagnosis::verdict::lack_of_fit::lack_of_fit;
use crate::noise::NoiseModel;
use crate::study::generate::HoldScatter;
use crate::study::predict::predict_dataset;
use crate::study::published::textbook_scenario;
use crate::study::{Generator, generate};

/// Of so many sets with this scatter, in how many p is below 0.01.
fn alarms(sets: u64, runs: usize, per_hold: HoldScatter, camera_sd_m: f64) -> usize {
    let scenario = textbook_scenario("epam").unwrap();
    let exact = |seed: &u64| {
        let generator = Generator { seed: *seed, runs, per_hold, camera_sd_m, ..Generator::default() };
        let data = generate(&scenario, "null", &generator).unwrap();
        let model = predict_dataset(&scenario, &data).unwrap();
        let noise = NoiseModel::estimate(&data, &model.d_ln_pressure_m, &[], None).unwrap();
        let found = lack_of_fit(&data, &noise, &model.coordinates_m, 0).unwrap().unwrap();
        found.p_value < 0.01
    };
    (1..=sets).filter(exact).count()
}

const NONE: HoldScatter = HoldScatter { pressure_sd: 0.0, alignment_sd_m: 0.0, rotation_sd: 0.0, lasting_sd_m: 0.0 };

/// Laboratories see these rows; with errors of whole runs and single samples alone 18 to 40 of 40 sets gave alarm.
#[test]
fn ordinary_scatter_of_single_holds_raises_no_alarm() {
    let rows = [
        ("white", NONE, 1e-3),
        ("pressure 2 %", HoldScatter { pressure_sd: 0.02, ..NONE }, 1e-3),
        ("camera moved by 1.5 mm", HoldScatter { alignment_sd_m: 1.5e-3, ..NONE }, 1e-3),
        ("roll 2 mrad", HoldScatter { rotation_sd: 2e-3, ..NONE }, 1e-3),
        ("lasting 0.5 mm", HoldScatter { lasting_sd_m: 0.5e-3, ..NONE }, 1e-3),
        ("means of frames", HoldScatter { lasting_sd_m: 0.3e-3, ..NONE }, 5e-5),
        ("all", HoldScatter { pressure_sd: 0.01, alignment_sd_m: 3e-4, rotation_sd: 5e-4, lasting_sd_m: 3e-4 }, 1e-3),
    ];
    for (name, per_hold, camera_sd_m) in rows {
        for runs in [3, 5, 10] {
            let alarms = alarms(100, runs, per_hold, camera_sd_m);
            println!("{name}, {runs} runs: {alarms} of 100");
            // 3 of 100 are allowed; 8 of 100 have a chance of 1 % then.
            assert!(alarms <= 8, "{name}, {runs} runs: {alarms} of 100");
        }
    }
}
