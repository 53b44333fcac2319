//! Known answers: what a robot has more than its model comes back as the missing moment, and noise alone gives none.

use super::*;
use crate::layout::Weights;
use crate::noise::NoiseModel;
use crate::study::published::textbook_scenario;
use crate::study::{Generator, generate, predict_dataset};
use data::{Dataset, Direct};
use models::Scenario;

const KINDS: [(&str, f64); 4] = [("spam", 6.0), ("epam", 1.35), ("cpam", 0.9), ("fpam", 0.3)];

/// A robot with a bending stiffness.
fn robot(kind: &str, bending: f64) -> Scenario {
    textbook_scenario(kind).unwrap().with_bending(bending)
}

/// Shape and missing moments of data, seen by a model, with noise that is known.
fn seen(model: &Scenario, data: &Dataset, noise: &Generator) -> (Shape, Moments) {
    let slope = predict_dataset(model, data).unwrap().d_ln_pressure_m;
    let sd = [noise.pressure_sd, noise.alignment_sd_m, noise.alignment_sd_m, noise.rotation_sd];
    let known = NoiseModel::known(data, &slope, data.runs.len(), noise.camera_sd_m, sd).unwrap();
    let each: Vec<Weights> = (0..data.values_per_run()).map(|i| vec![(i, 1.0)]).collect();
    let (whitener, target_m) = (known.whitener_of(&each).unwrap(), data.mean_over_runs());
    let view =
        View { scenario: model, dataset: data, direct: Direct::default(), target_m: &target_m, whitener: &whitener };
    let shape = shape(&view).unwrap();
    let of_hold = vec![0; data.holds.len()];
    let told =
        moments(&view, &shape, &RobotScenarios { scenarios: std::slice::from_ref(model), of_hold: &of_hold }).unwrap();
    (shape, told)
}

/// Hardly any noise, and a body pressure and a hold more.
fn exact() -> Generator {
    Generator {
        camera_sd_m: 1e-7,
        pressure_sd: 0.0,
        alignment_sd_m: 0.0,
        rotation_sd: 0.0,
        runs: 3,
        protocol: [0.0, 10e3, 20e3, 30e3, 15e3, 0.0].map(|p| [2e3, p]).to_vec(),
        ..Generator::default()
    }
}

/// Name, robot, and what its model misses at a bend.
type Known<'a> = (&'a str, Scenario, &'a dyn Fn(f64) -> f64);

#[test]
fn a_constant_and_a_spring_come_back_exactly() {
    for (kind, bending) in KINDS {
        let plain = robot(kind, bending);
        let laws: [Known; 2] = [
            ("constant", plain.with_effect("tail_tension", &[0.1]), &|_| -0.1),
            ("spring", plain.with_bending(bending + 0.2), &|kappa| -0.2 * kappa),
        ];
        for (name, real, law) in laws {
            let data = generate(&real, "made", &exact()).unwrap();
            let (shape, told) = seen(&plain, &data, &exact());
            assert!(shape.floor_mm < 1e-3, "{kind} {name}: {} mm left", shape.floor_mm);
            assert_eq!(told.of_holds.len(), 4, "{kind} {name}");
            for point in &told.of_holds {
                let truth = law(point.kappa);
                assert!((point.moment_nm - truth).abs() < 2e-4, "{kind} {name}: {} and not {truth}", point.moment_nm);
            }
            for point in told.points.iter().filter(|p| p.is_change) {
                assert!(point.moment_nm.abs() < 2e-4, "{kind} {name}: {} in a hold", point.moment_nm);
            }
        }
    }
}

#[test]
fn a_line_that_lies_elsewhere_a_scale_and_a_roll_are_found_and_no_moment_is() {
    let plain = robot("epam", 1.35);
    let mut other = plain.with_effect("camera_scale", &[0.02]).with_effect("camera_rotation", &[0.01]);
    other.centre_line_m = Some(0.7 * plain.radius_m);
    let data = generate(&other, "made", &exact()).unwrap();
    let (shape, told) = seen(&plain, &data, &exact());
    let found: Vec<f64> = shape.shared.iter().map(|s| s.value).collect();
    // Printed: mm, per cent, degrees.
    assert!((found[0] + 300.0 * plain.radius_m).abs() < 1e-2, "{found:?}");
    assert!((found[1] - 2.0).abs() < 1e-3 && (found[2].abs() - 0.01_f64.to_degrees()).abs() < 1e-3, "{found:?}");
    assert!(told.of_holds.iter().all(|p| p.moment_nm.abs() < 2e-4), "{:?}", told.of_holds);
}

/// Mean of the quadratic form over its degrees of freedom, over many seeds: one where the covariance is that of the scatter.
#[test]
fn noise_alone_gives_no_moment_beyond_its_covariance() {
    for (kind, bending) in KINDS {
        let plain = robot(kind, bending);
        let (mut squares, mut count) = (0.0, 0.0);
        for seed in 0..20 {
            let noise = Generator { seed, ..Generator::default() };
            let data = generate(&plain, "made", &noise).unwrap();
            let (_, told) = seen(&plain, &data, &noise);
            let moments = nalgebra::DVector::from_iterator(told.points.len(), told.points.iter().map(|p| p.moment_nm));
            let solved = told.covariance.clone().cholesky().unwrap().solve(&moments);
            squares += moments.dot(&solved);
            count += moments.len() as f64;
        }
        let ratio = squares / count;
        // Of n values the mean scatters by √(2/n): some 450 values, 0.07.
        assert!((0.84..1.16).contains(&ratio), "{kind}: {ratio:.3} over {count} values");
    }
}

/// At the bend where a robot rests nothing is missing; a stiffer model misses its own surplus there.
#[test]
fn at_a_turn_the_model_that_made_it_misses_nothing_and_a_stiffer_one_its_surplus() {
    for (kind, bending) in KINDS {
        let plain = robot(kind, bending);
        let model = models::Model::new(&plain);
        let (loads, mut at) = (models::Loads::uniform(2e3, 20e3), model.prediction());
        model.predict(&loads, &mut at).unwrap();
        let turn = at.tip.angle_rad;
        let [kappa, nothing] = at_turn(&plain, &loads, turn).unwrap();
        let [_, surplus] = at_turn(&plain.with_bending(bending + 0.2), &loads, turn).unwrap();
        assert!(nothing.abs() < 1e-6, "{kind}: {nothing}");
        assert!((surplus - 0.2 * kappa).abs() < 1e-6 && kappa > 0.1, "{kind}: {surplus} at {kappa}");
    }
}
