//! Fabrics in a testing machine, and the inflated beam of one, against closed forms.

#![allow(clippy::unwrap_used)]

use models::fabrics::specimen::bias_grip_factor;
use models::fabrics::{BiasExtension, Orthotropic, Pull};
use models::{Loads, Model, Scenario};
use std::sync::Arc;
use verification::exact::beam::{BeamTheory, Cantilever, tip_deflection_m};
use verification::exact::coupon::{OrthotropicSheet, modulus_pa};

#[test]
fn a_linear_sheet_has_the_closed_modulus_at_every_angle() {
    let sheet = OrthotropicSheet { warp_pa: 96.5e6, fill_pa: 120e6, poisson: 0.3, shear_pa: 1.032e6 };
    let law = Arc::new(Orthotropic::new(96.5e6, 120e6, 0.3, 1.032e6, 5e-5));
    for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0_f64] {
        let angle = degrees.to_radians();
        let found = Pull::new(law.clone(), angle).unwrap().stress_pa(1e-7).unwrap() / 1e-7;
        assert!((found / modulus_pa(&sheet, angle) - 1.0).abs() < 1e-5, "{degrees}: {found}");
    }
}

#[test]
fn grips_stiffen_a_bias_specimen_by_what_the_zones_of_the_closed_form_give() {
    for (length_m, width_m) in [(0.25, 0.02), (0.08, 0.04)] {
        let angle = 1e-5;
        let (strip, shear_pa) = (BiasExtension { length_m, width_m, thickness_m: 1.0 }, 1e6);
        let [lengthening_m, force] = strip.pulled(angle, |x| shear_pa * x, None);
        let strain = lengthening_m / length_m;
        let found = force / width_m / strain / (4.0 * shear_pa);
        assert!((found / bias_grip_factor(&strip) - 1.0).abs() < 1e-4, "{found}");
    }
}

#[test]
fn a_small_load_bends_and_shears_it_as_fichters_beam() {
    for (wall, shear) in [(179e3, None), (179e3, Some(0.0)), (5e5, Some(2.5e3)), (2e6, Some(8.5e3))] {
        let more = shear.map_or(String::new(), |s| format!("\nwall_shear_n_per_m = {s}"));
        let text = format!(
            "[body]\nradius_mm = 80\nlength_mm = 1000\npressure_kpa = 30\nwall_stiffness_n_per_m = {wall}{more}\n"
        );
        let beam = Scenario { segments: 200, ..Scenario::parse(&text).unwrap() };
        let exact = Cantilever {
            radius_m: 0.08,
            thickness_m: 1.0,
            length_m: 1.0,
            young_pa: wall,
            shear_pa: shear.unwrap_or(0.0),
            pressure_pa: 3e4,
        };
        let theory = if shear.is_some() { BeamTheory::Fichter } else { BeamTheory::Euler };
        let force = 1e-3;
        let model = Model::new(&beam.with_effect("tip_load", &[0.0, -force]));
        let mut at = model.prediction();
        model.predict(&Loads::uniform(3e4, 0.0), &mut at).unwrap();
        let error = -at.tip.y_m / tip_deflection_m(&exact, force, theory) - 1.0;
        // 200 pieces of constant curvature lose 1/4n², creases 3/8 of the share of the collapse load.
        assert!(error.abs() < 2e-5, "{wall} {shear:?}: {error:e}");
    }
}
