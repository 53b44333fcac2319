//! Points made with a law of the library give it back; points of a robot that lacks nothing give none.

use super::*;
use crate::study::generate::NormalNumbers;
use crate::study::published::textbook_scenario;
use models::Scenario;
use nalgebra::{DMatrix, DVector};

const STATIONS: [f64; 5] = [0.045, 0.12, 0.18, 0.24, 0.315];

fn robot() -> Scenario {
    textbook_scenario("epam").unwrap().with_bending(1.35)
}

/// Bends that rise with pressure and differ a little along the robot, and the pull of a pouch to first order.
fn places(robot: &Scenario) -> Vec<[f64; 8]> {
    let of = |p_kpa: f64| {
        STATIONS.map(|s| {
            let kappa = 0.9 * p_kpa.powf(0.45) * (1.0 + 0.4 * (20.0 * s).sin());
            let pull = 1e3 * p_kpa * 2.9e-4 / (6.0 * 0.08 * kappa).sqrt();
            [kappa, 0.06 * kappa, 1e3 * p_kpa, 2e3, s, robot.radius_m, robot.bending_stiffness, pull]
        })
    };
    [5.0, 10.0, 15.0, 20.0, 25.0, 30.0].into_iter().flat_map(of).collect()
}

/// Numbers in units of the robot that make a law of some size there.
fn truth(form: &LawFormula, robot: &Scenario) -> Vec<f64> {
    let share = |n: &Number| match n.key {
        "n" | "q" if !n.is_linear() => n.tried[2],
        "k0" => 0.08,
        "k" => 0.9,
        "a" | "e" => 0.3,
        "b" => 0.8,
        _ => 1.2,
    };
    form.numbers.iter().map(|n| share(n) * n.scale(robot)).collect()
}

/// Points of a law with noise: of every point \[N·m\], and of all of a pressure together.
fn material(form: Option<&LawFormula>, sd: [f64; 2], seed: u64) -> MomentMaterial {
    let (robot, mut scatter) = (robot(), NormalNumbers::new(seed));
    let places = places(&robot);
    let formula = form.map(|f| f.formula("law", &robot).unwrap());
    let law = |at: &[f64; 8]| formula.as_ref().map_or(0.0, |f| f.moment_at(at, &truth(form.unwrap(), &robot)));
    let common: Vec<f64> = (0..6).map(|_| sd[1] * scatter.normal()).collect();
    let moments = places.iter().enumerate().map(|(i, at)| law(at) + sd[0] * scatter.normal() + common[i / 5]);
    let moments = DVector::from_vec(moments.collect());
    let covariance = |i: usize, j: usize| {
        let own = if i == j { sd[0].powi(2) } else { 0.0 };
        own + if i / 5 == j / 5 { sd[1].powi(2) } else { 0.0 }
    };
    MomentMaterial {
        covariance: DMatrix::from_fn(places.len(), places.len(), covariance),
        places,
        moments,
        stiffness: None,
    }
}

fn chosen(material: &MomentMaterial) -> (Option<&'static LawFormula>, Vec<f64>) {
    let mut ranked = rank(material, &robot());
    let laws: Vec<(usize, f64)> = ranked.iter().map(|t| (t.form.map_or(0, |f| f.numbers.len()), t.score())).collect();
    let law = ranked.swap_remove(taken(&laws).unwrap());
    (law.form, law.values)
}

#[test]
fn without_noise_every_law_gives_its_form_and_numbers_back() {
    for form in LIBRARY.iter().filter(|f| !f.is_of_body()) {
        let (found, values) = chosen(&material(Some(form), [1e-6, 0.0], 1));
        assert_eq!(found.map(|f| f.moment), Some(form.moment));
        for (value, true_value) in values.iter().zip(truth(form, &robot())) {
            assert!((value - true_value).abs() < 1e-4 * true_value.abs(), "{}: {value} {true_value}", form.moment);
        }
    }
}

#[test]
fn noise_alone_teaches_nothing_and_a_law_beyond_noise_is_learned() {
    let count = |form: Option<&LawFormula>, is_right: &dyn Fn(Option<&LawFormula>) -> bool| {
        (0..40).filter(|seed| is_right(chosen(&material(form, [0.03, 0.02], *seed)).0)).count()
    };
    let nothing = count(None, &|found| found.is_none());
    assert!(nothing >= 39, "{nothing} of 40");
    for moment in ["-m*tanh(kappa*R/0.002)", "-a*pull", "-(a + b*theta)*pull", "-k*pos(kappa - k0)"] {
        let form = LIBRARY.iter().find(|f| f.moment == moment);
        let same = count(form, &|found| found.map(|f| f.moment) == Some(moment));
        assert!(same >= 36, "{moment}: {same} of 40");
    }
}

/// Numbers of a law scatter over seeds as least squares says: the mean square of the whitened error is one.
#[test]
fn numbers_scatter_by_their_covariance() {
    let form = LIBRARY.iter().find(|f| f.moment == "-(a + b*theta)*pull").unwrap();
    let robot = robot();
    let formula = form.formula("law", &robot).unwrap();
    let (sd, seeds) = ([0.03, 0.02], 100);
    let of = material(Some(form), sd, 0);
    let columns =
        DMatrix::from_fn(of.places.len(), 2, |i, k| formula.moment_at(&of.places[i], &[1.0 - k as f64, k as f64]));
    let information = columns.tr_mul(&of.covariance.clone().cholesky().unwrap().solve(&columns));
    let away = |seed: u64| {
        let ranked = rank(&material(Some(form), sd, seed), &robot);
        let own = ranked.into_iter().find(|t| t.form.is_some_and(|f| f.moment == form.moment)).unwrap();
        let z = DVector::from_vec(own.values) - DVector::from_vec(truth(form, &robot));
        z.dot(&(&information * &z)) / 2.0
    };
    let mean = (0..seeds).map(away).sum::<f64>() / seeds as f64;
    assert!((0.75..1.25).contains(&mean), "{mean}");
}

#[test]
fn a_law_takes_three_pressures() {
    let of = |pressures: usize| {
        let (all, count) = (material(Some(&LIBRARY[0]), [0.03, 0.02], 1), 5 * pressures);
        let covariance = all.covariance.view((0, 0), (count, count)).into_owned();
        let (places, moments) = (all.places[..count].to_vec(), all.moments.rows(0, count).into_owned());
        rank(&MomentMaterial { places, moments, covariance, stiffness: None }, &robot()).len()
    };
    assert!(of(2) == 0 && of(3) > 0);
}

#[test]
fn the_fewest_numbers_are_taken_where_no_other_law_is_closer_by_a_fifth() {
    // 0.8 of √(1 + 2²) is √(1 + 1.48²).
    assert_eq!(taken(&[(2, 1.5), (1, 2.0), (0, 9.0)]), Some(1));
    assert_eq!(taken(&[(2, 1.45), (1, 2.0), (0, 9.0)]), Some(0));
    // Below the noise nothing is closer.
    assert_eq!(taken(&[(2, 0.0), (0, 0.7)]), Some(1));
    assert_eq!(taken(&[]), None);
}
