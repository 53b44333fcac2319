//! What the statistics promise, checked on many simulated datasets whose truth is known. Seeds are fixed.

use crate::accuracy::paper_accuracy;
use crate::beside_mean::BesideMean;
use crate::evaluate::{EvaluateOptions, evaluate};
use crate::metrics::metrics;
use crate::noise::NoiseModel;
use crate::residuals::residual_map;
use crate::stats::{f_tail, two_sided_p};
use crate::tests::synthetic::{CAMERA, SyntheticNoise, SyntheticRobot, TYPICAL};
use crate::where_it_fails::{Finding, where_it_fails};
use data::Dataset;

const NO_BOOTSTRAP: (usize, u64) = (0, 0);

/// Mean and standard error of the mean.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

/// Within four standard errors: a right answer misses this once in 16 000.
fn assert_mean(what: &str, values: &[f64], expected: f64) {
    let (mean, error) = mean_and_error(values);
    println!("{what}: {mean:.5} +- {error:.5}, expected {expected:.5}");
    assert!((mean - expected).abs() < 4.0 * error, "{what}: {mean} +- {error}, expected {expected}");
}

fn robot_with_tip_mm(tip_mm: f64) -> SyntheticRobot {
    let mut robot = SyntheticRobot { pressures_kpa: vec![(10.0, 2.0)], samples: 1, ..SyntheticRobot::paper() };
    let tip = |robot: &SyntheticRobot| 1e3 * robot.shape(1.0)[11];
    for _ in 0..50 {
        robot.curvature_per_m *= tip_mm / tip(&robot);
    }
    robot
}

#[test]
fn a_perfect_model_scores_the_closed_form_on_average() {
    let robot = robot_with_tip_mm(60.0);
    let truth = robot.shape(1.0);
    let y: Vec<f64> = truth.iter().skip(1).step_by(2).copied().collect();
    let loss = 1e-6 / 5.0 * y.iter().map(|y| 1.0 / (y * y)).sum::<f64>() / 6.0;
    let score = |seed| {
        let mean = robot.measured(5, CAMERA, seed).mean_over_runs();
        paper_accuracy(&y, &mean.iter().skip(1).step_by(2).copied().collect::<Vec<_>>()).unwrap()
    };
    assert_mean("accuracy of the truth", &(0..4000).map(score).collect::<Vec<_>>(), 1.0 - loss);
}

#[test]
fn the_noise_ceiling_is_that_of_the_handbook() {
    // Discovery handbook section 6: tips of 34.8, 51.5 and 63.3 mm, camera noise 1 mm, mean of 5 runs and 1 run.
    for (tip_mm, five_runs, one_run) in [(34.8, 0.595, -1.02), (51.5, 0.817, 0.08), (63.3, 0.880, 0.40)] {
        let robot = robot_with_tip_mm(tip_mm);
        for (runs, expected) in [(5, five_runs), (1, one_run)] {
            let data = robot.measured(runs, CAMERA, 1);
            let mut noise = NoiseModel::estimate(&data, &[0.0; 12], &[], Some(1e-3)).unwrap();
            noise.sigma_m = Some(1e-3);
            noise.mean_variance = Default::default();
            let c = BesideMean::new(&data, &noise, &robot.shape(1.0)).unwrap();
            let ceiling = metrics(&c, 0, NO_BOOTSTRAP).unwrap().holds[0].noise_ceiling.unwrap();
            println!("tip {tip_mm} mm, {runs} runs: ceiling {ceiling:.4}, handbook {expected}");
            assert!((ceiling - expected).abs() < 0.005 * (2.0 - expected), "{ceiling} {expected}");
        }
    }
}

#[test]
fn a_perfect_model_meets_its_noise_ceiling_on_average() {
    let robot = SyntheticRobot::paper();
    let (truth, slope) = (robot.shape(1.0), robot.slope());
    let mut gaps = vec![Vec::new(); 3];
    for seed in 0..250 {
        let data = robot.measured(5, SyntheticNoise { alignment_m: 2e-4, ..TYPICAL }, 2000 + seed);
        let noise = NoiseModel::estimate(&data, &slope, &[], None).unwrap();
        let holds = metrics(&BesideMean::new(&data, &noise, &truth).unwrap(), 0, NO_BOOTSTRAP).unwrap().holds;
        for (gap, hold) in gaps.iter_mut().zip(&holds[1..4]) {
            gap.push(hold.paper_accuracy.unwrap() - hold.noise_ceiling.unwrap());
        }
    }
    gaps.iter().for_each(|g| assert_mean("accuracy of the truth minus its ceiling", g, 0.0));
}

#[test]
fn known_noise_is_recovered_without_bias() {
    let robot = SyntheticRobot::paper();
    let slope = robot.slope();
    let models: Vec<NoiseModel> = (0..150)
        .map(|seed| NoiseModel::estimate(&robot.measured(5, TYPICAL, seed), &slope, &[], None).unwrap())
        .collect();
    let of = |f: &dyn Fn(&NoiseModel) -> f64| models.iter().map(f).collect::<Vec<f64>>();
    assert_mean("sigma^2 [mm^2]", &of(&|m| 1e6 * m.sigma_m.unwrap().powi(2)), 1.0);
    assert_mean("pressure variance [%^2]", &of(&|m| 1e4 * m.run_sd[0].unwrap().powi(2)), 4.0);
    assert_mean("alignment variance [mm^2]", &of(&|m| 1e6 * m.run_sd[1].unwrap().powi(2)), 0.25);
}

#[test]
fn the_error_beyond_noise_and_the_noise_floor_are_unbiased() {
    let robot = SyntheticRobot::paper();
    let (truth, slope) = (robot.shape(1.0), robot.slope());
    let mut excess = Vec::new();
    for seed in 0..150 {
        let data = robot.measured(5, TYPICAL, 1000 + seed);
        let noise = NoiseModel::estimate(&data, &slope, &[], None).unwrap();
        let overall = metrics(&BesideMean::new(&data, &noise, &truth).unwrap(), 0, NO_BOOTSTRAP).unwrap().overall;
        excess.push(overall.rmse_mm.powi(2) - overall.noise_floor_mm.unwrap().powi(2));
    }
    assert_mean("mean square error of the truth minus noise floor^2 [mm^2]", &excess, 0.0);
}

/// What one noise model says about the truth: χ²/dof, its p, and the smallest p of four directed tests times 24, the
/// number of effects in the handbook's catalogue.
struct NullTest {
    reduced_chi2: f64,
    p: f64,
    directed_p: f64,
}

/// The verdicts on the truth for one dataset.
struct NullDataset {
    run_as_unit: NullTest,
    independent: NullTest,
    /// Whether a failure is named somewhere, tolerance zero.
    failure_named: bool,
}

impl NullTest {
    fn of(white: &[f64], directions: &[Vec<f64>], dof: usize) -> NullTest {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let reduced_chi2 = dot(white, white) / white.len() as f64;
        let directed = directions.iter().map(|g| two_sided_p(dot(g, white) / dot(g, g).sqrt(), dof));
        let directed_p = 24.0 * directed.fold(1.0, f64::min);
        NullTest { reduced_chi2, p: f_tail(reduced_chi2, white.len(), dof), directed_p }
    }

    fn alarms(&self) -> bool {
        self.p < 0.01 || self.directed_p < 0.01
    }
}

fn null_dataset(data: &Dataset, truth: &[f64], slope: &[f64]) -> NullDataset {
    let noise = NoiseModel::estimate(data, slope, &[], None).unwrap();
    let c = BesideMean::new(data, &noise, truth).unwrap();
    let directions: Vec<Vec<f64>> = (0..4).map(|j| noise.directions.iter().map(|u| u[j]).collect()).collect();
    let whitened: Vec<Vec<f64>> = directions.iter().map(|g| noise.whiten(g)).collect();
    let run_as_unit = NullTest::of(&noise.whiten(&c.residual_m), &whitened, noise.pure_error_dof);
    let failure_named = where_it_fails(&c, &residual_map(&c), None, 0.01, 0.0)[0].finding != Finding::Agrees;
    let (n, runs) = (truth.len(), data.runs.len());
    let mean = data.mean_over_runs();
    let scatter: f64 = data.coordinates_m.iter().enumerate().map(|(i, y)| (y - mean[i % n]).powi(2)).sum();
    let unit = (scatter / ((runs - 1) * n * runs) as f64).sqrt();
    let scaled: Vec<f64> = c.residual_m.iter().map(|r| r / unit).collect();
    NullDataset { run_as_unit, independent: NullTest::of(&scaled, &directions, (runs - 1) * n), failure_named }
}

#[test]
fn a_right_model_rarely_alarms_because_the_run_is_the_unit() {
    let robot = SyntheticRobot::paper();
    let (truth, slope) = (robot.shape(1.0), robot.slope());
    for (runs, bound) in [(3, 0.07), (5, 0.03), (10, 0.03)] {
        let data = |seed: u64| robot.measured(runs, TYPICAL, 5000 + seed);
        let tests: Vec<_> = (0..300).map(|seed| null_dataset(&data(seed), &truth, &slope)).collect();
        let rate = |alarms: &dyn Fn(&NullDataset) -> bool| {
            tests.iter().filter(|t| alarms(t)).count() as f64 / tests.len() as f64
        };
        let (chi2_only, all) = (rate(&|t| t.run_as_unit.p < 0.01), rate(&|t| t.run_as_unit.alarms()));
        let (iid_chi2, iid_all) = (rate(&|t| t.independent.p < 0.01), rate(&|t| t.independent.alarms()));
        let named = rate(&|t| t.failure_named);
        let (chi2, error) = mean_and_error(&tests.iter().map(|t| t.run_as_unit.reduced_chi2).collect::<Vec<_>>());
        println!(
            "R = {runs}, p < .01: run as unit: chi2 {chi2_only:.3}, with directed tests {all:.3}, failure named \
             {named:.3}; independent errors: {iid_chi2:.3}, {iid_all:.3}; chi2/dof {chi2:.4} +- {error:.4}"
        );
        assert!(chi2_only.max(all).max(named) <= bound, "R = {runs}: {chi2_only} {all} {named}");
        assert!(iid_all > 0.5, "R = {runs}: independent errors must fail on these data, {iid_all}");
        // Unit variance: the four widened directions are worth 0 to 4 of 300; F(n, m) has the mean m/(m - 2).
        let m = ((runs - 1) * 296) as f64;
        let scale = m / (m - 2.0);
        assert!(chi2 > scale * 296.0 / 300.0 - 4.0 * error && chi2 < scale + 4.0 * error, "{chi2} +- {error}");
    }
}

#[test]
fn a_systematic_error_of_known_size_is_found() {
    let robot = SyntheticRobot::paper();
    let (truth, slope) = (robot.shape(1.0), robot.slope());
    // 0.8 mm on every coordinate, checkerboard signs: no nuisance direction can take it.
    let model: Vec<f64> =
        truth.iter().enumerate().map(|(i, v)| v + 8e-4 * if i % 4 < 2 { 1.0 } else { -1.0 }).collect();
    let squares: Vec<f64> = (0..100)
        .map(|seed| {
            let data = robot.measured(5, SyntheticNoise { pressure: 0.005, ..TYPICAL }, seed);
            let options = EvaluateOptions { bootstrap_samples: 0, ..Default::default() };
            let overall = evaluate(&data, &model, &slope, &options).unwrap().metrics.overall;
            assert!(overall.p_value.unwrap() < 0.01, "0.8 mm against a noise of the mean of 0.5 mm is visible");
            overall.systematic_mm.unwrap().powi(2)
        })
        .collect();
    assert_mean("systematic error^2 [mm^2]", &squares, 0.64);
}
