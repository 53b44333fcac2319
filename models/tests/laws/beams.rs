//! A body without actuator is an inflated beam: equilibrium, and published measurements up to collapse.

use crate::support::*;
use models::{Loads, Model, Scenario};
use std::f64::consts::PI;

/// A beam of 1 m with further keys of `[body]`.
fn beam(radius_mm: f64, p_body_kpa: f64, more: &str) -> Scenario {
    let text = format!("[body]\nradius_mm = {radius_mm}\nlength_mm = 1000\npressure_kpa = {p_body_kpa}\n{more}\n");
    Scenario { segments: 200, ..Scenario::parse(&text).unwrap_or_else(|e| panic!("{e:?}")) }
}

/// Tip deflection under a force across the tip \[m\].
fn deflection(beam: &Scenario, force_n: f64) -> f64 {
    let model = Model::new(&beam.with_effect("tip_load", &[0.0, -force_n]));
    let at = predicted(&model, &Loads::uniform(beam.p_body_pa, 0.0)).unwrap_or_else(|e| panic!("{force_n} N: {e}"));
    -at.tip.y_m
}

#[test]
fn a_beam_needs_no_actuator_and_stays_straight_without_load() {
    let beam = beam(80.0, 30.0, "");
    let at = predict(&beam, 3e4, 0.0);
    assert_eq!((at.tip.x_m, at.tip.y_m), (1.0, 0.0));
    let text = "[body]\nradius_mm = 80\nlength_mm = 1000\npressure_kpa = 30\n[effects.seam_stiffness]\n";
    let error = Scenario::parse(text).unwrap_err();
    assert!(error.message.contains("does not exist for actuator beam"), "{error:?}");
}

#[test]
fn a_sheared_beam_is_in_equilibrium() {
    // At equilibrium the total potential changes with the load alone: dΠ/dF = −(tip along F).
    let base = beam(60.0, 5.0, "wall_stiffness_n_per_m = 60000\nwall_shear_n_per_m = 1500");
    let at = |f: f64| {
        let model = Model::new(&base.with_effect("tip_load", &[-0.3, -f]).with_effect("gravity", &[0.8]));
        let loads = Loads::uniform(5e3, 0.0);
        let state = predicted(&model, &loads).unwrap();
        let lines = model.ledger(&loads, &state);
        assert!(lines.iter().any(|line| line.name == "wall_shear" && line.energy_j > 0.0));
        (lines.iter().map(|line| line.energy_j).sum::<f64>(), state)
    };
    let by_force = slope(|f| at(f).0, 1.2, 0.05);
    let tip = at(1.2).1.tip;
    assert!((by_force / tip.y_m - 1.0).abs() < 1e-7, "{by_force:e} {:e}", tip.y_m);
}

#[test]
fn markers_lie_on_the_sheared_centre_line() {
    let mut base = beam(80.0, 30.0, "wall_stiffness_n_per_m = 500000\nwall_shear_n_per_m = 2500");
    base.markers_m = vec![0.31, 0.7, 1.0];
    let at = predict(&base.with_effect("tip_load", &[0.0, -20.0]), 3e4, 0.0);
    let gap = [at.markers[2][0] - at.tip.x_m, at.markers[2][1] - at.tip.y_m];
    assert!(gap[0].hypot(gap[1]) < 1e-14 && at.markers[0][1] < -1e-3, "{at:?}");
}

/// Breukels' regression of tip load on tip deflection of kite beams of 1 m, `F = D (1 − exp(−N v/D))`, and the deflection at
/// collapse; pressures in bar. Delft thesis 2011, as quoted in github.com/awegroup/kite_fem (MIT): measured, published.
struct Breukels {
    radius_m: f64,
    pressure_bar: f64,
}

impl Breukels {
    fn most_n(&self) -> f64 {
        let (r, p) = (self.radius_m, self.pressure_bar);
        (6582.82 * r - 272.43) * p * p + 40852.38 * r.powi(3) + 14.31
    }

    fn slope_n_per_m(&self) -> f64 {
        let (r, p) = (self.radius_m, self.pressure_bar);
        (271865251.42 * r.powi(5) + 215.93) * p + 14021.79 * r - 589.05
    }

    fn collapse_n(&self) -> f64 {
        let (r, p) = (self.radius_m, self.pressure_bar);
        let v = (322.55 * r.powi(4) + 0.0239) * p + 5.3833 * r * r + 0.0461;
        self.most_n() * (1.0 - (-self.slope_n_per_m() / self.most_n() * v).exp())
    }

    fn deflection_m(&self, force_n: f64) -> f64 {
        -self.most_n() / self.slope_n_per_m() * (1.0 - force_n / self.most_n()).ln()
    }

    /// The beam with the E t that its first quarter of the load shows, and a share of πp_bR³ as its collapse.
    fn model(&self, share: f64) -> Scenario {
        let first = 0.25 * self.collapse_n();
        let wanted = self.deflection_m(first);
        let (mut low, mut high) = (1e3_f64, 1e8_f64);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            let beam = self.with_wall(middle, share);
            if deflection(&beam, first) > wanted { low = middle } else { high = middle }
        }
        self.with_wall(low, share)
    }

    fn with_wall(&self, stiffness: f64, share: f64) -> Scenario {
        let more =
            format!("wall_stiffness_n_per_m = {stiffness}\nwall_basis = \"calibrated\"\nhinge_moment_share = {share}");
        Scenario { segments: 60, ..beam(1e3 * self.radius_m, 100.0 * self.pressure_bar, &more) }
    }
}

/// Largest error of the deflection up to a part of the measured collapse load.
fn worst(radius_m: f64, pressure_bar: f64, share_of_collapse: bool, up_to: f64) -> f64 {
    let measured = Breukels { radius_m, pressure_bar };
    let theory = PI * pressure_bar * 1e5 * radius_m.powi(3);
    let share = if share_of_collapse { measured.collapse_n() / theory } else { 1.0 };
    let beam = measured.model(share);
    let (stiffness, mut worst) = (beam.wall.stiffness_n_per_m.unwrap(), 0.0_f64);
    for part in [0.1, 0.25, 0.5, 0.65, 0.75, 0.8] {
        let force = part * measured.collapse_n();
        let (model, seen) = (deflection(&beam, force), measured.deflection_m(force));
        let error = model / seen - 1.0;
        println!(
            "r {:.0} mm, {:.0} kPa, E t {stiffness:.0} N/m, collapse at {:.2} of πp_bR³/L: {force:5.1} N ({part:.2}): \
             {:.1} mm, measured {:.1} mm, {:+.1} %",
            1e3 * radius_m,
            100.0 * pressure_bar,
            measured.collapse_n() / theory,
            1e3 * model,
            1e3 * seen,
            100.0 * error
        );
        worst = if part <= up_to && error.abs() > worst.abs() { error } else { worst };
    }
    worst
}

/// The beams whose E t is known from their first quarter of the load, and those whose collapse load is known as well.
fn hold(radii_m: &[f64], share_of_collapse: bool, up_to: f64, limit: f64) {
    for &radius_m in radii_m {
        for pressure_bar in [0.2, 0.3, 0.4, 0.5] {
            let error = worst(radius_m, pressure_bar, share_of_collapse, up_to);
            assert!(error.abs() < limit, "{radius_m} {pressure_bar}: {error}");
        }
    }
}

/// Within 15 % up to 0.8 of collapse for 80 mm. The beams of 100 mm at 30 and 40 kPa fold at 0.81 and 0.85 of πp_bR³/L: with
/// E t alone they are 16 % short there, and within 15 % up to 0.75.
#[test]
fn measured_beams_bend_as_the_wall_that_softens() {
    hold(&[0.08], false, 0.8, 0.15);
    hold(&[0.1], false, 0.75, 0.15);
}

#[test]
fn a_measured_collapse_load_brings_the_measured_beams_closer() {
    hold(&[0.08, 0.1], true, 0.8, 0.12);
}
