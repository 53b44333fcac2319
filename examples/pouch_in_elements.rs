//! Finite elements of one pouch that pulls, compared with its closed form.
//!
//! Two sheets of length L welded at both ends become arcs of half-angle θ under the pressure P. Per width W the tension is P L/2θ,
//! so the sheets stretch by e = P L₀ (1 − ν²)/(2θ E t), the pouch is L sinθ/θ long with L = L₀ (1 + e), and it pulls with
//! F = P W L cosθ/θ. The elements carry this force for θ = 1 at their right weld.
//!
//! ```text
//! force 1.636 N
//! closed form: 9.05 mm shorter
//! elements: 9.03 mm shorter
//! ```

use ibr::{FeSettings, FeSource, simulate};
use std::ops::ControlFlow::Continue;

const CASE: &str = r#"
kind = "fem"
mesh = { generator = "long_pouch", length_mm = 60, width_mm = 5, elements_along = 24, elements_across = 2 }
fabric.film = { law = "isotropic", e_MPa = 300, nu = 0.3, thickness_mm = 0.1 }
part.all = { fabric = "film", density_kg_m3 = 1000 }
chamber.air = { open_axis = "y", smooth_s_kPa = [[0, 0], [0.04, 10]] }
support = [{ set = "left" }, { set = "right", axes = "z" }, { set = "open_0", axes = "y" }, { set = "open_1", axes = "y" }]
force = [{ set = "right", total_n = [FORCE, 0, 0], smooth_s = [[0, 0], [0.04, 1]] }]
settings = { end_s = 0.12, mass_damping_1_s = 120 }
output = { probes = ["right"], frames = false, pictures = false }
"#;

pub(crate) fn example() -> Result<String, ibr::Error> {
    let (p_pa, l0_m, w_m, membrane_n_per_m, theta) = (10e3, 0.06, 0.005, 300e6 * 1e-4 / (1.0 - 0.3 * 0.3), 1.0_f64);
    let l_m = l0_m * (1.0 + p_pa * l0_m / (2.0 * theta * membrane_n_per_m));
    let force_n = p_pa * w_m * l_m * theta.cos() / theta;
    let source = FeSource::new("pouch", &CASE.replace("FORCE", &format!("{force_n:.6}")));
    let run = simulate(&source, &FeSettings::default(), &mut |_, _| Continue(()))?;
    let closed_mm = 1e3 * (l0_m - l_m * theta.sin() / theta);
    let elements_mm = -run.summary.probes[0].displacement_mm[0];
    Ok(format!("force {force_n:.3} N\nclosed form: {closed_mm:.2} mm shorter\nelements: {elements_mm:.2} mm shorter\n"))
}

fn main() -> Result<(), ibr::Error> {
    print!("{}", example()?);
    Ok(())
}
