//! A bias-extension test made by the finite element engine gives back the shear curve that the engine was given.

use crate::alone;
use crate::support::Folder;
use models::fabrics::Curve;
use verification::checks::bias::{SHEAR, STRIP, THICKNESS_M, pull};

#[test]
fn the_shear_curve_of_the_engine_comes_back_from_its_bias_extension() {
    let _alone = alone();
    let pulled = pull().unwrap();
    let folder = Folder::new();
    let mut text = format!(
        "# provenance: synthetic\n# direction_deg: 45\n# length_mm: {}\n# width_mm: {}\n# thickness_mm: {}\ndisplacement_mm,force_n\n",
        1e3 * STRIP.length_m,
        1e3 * STRIP.width_m,
        1e3 * THICKNESS_M
    );
    pulled.rows.iter().for_each(|[d, f]| text.push_str(&format!("{},{f}\n", 1e3 * d)));
    folder.write("engine.csv", text);
    let answer = folder.run(&["characterize", "engine.csv", "--json"]).json("ibr.characterize");
    let truth = Curve::table(&SHEAR).unwrap();
    let rows: Vec<[f64; 2]> = serde_json::from_value(answer["shear_rad_pa"].clone()).unwrap();
    assert!(rows.len() > 20 && rows[rows.len() - 1][0] > 0.69, "{rows:?}");
    for [angle, moment_pa] in &rows[1..] {
        // The engine meets the curve within 1 %; between its rows the curve is read straight.
        let off = moment_pa / truth.value(*angle) - 1.0;
        println!("{angle:.3} rad: {:.4} MPa, {:+.2} %", 1e-6 * moment_pa, 100.0 * off);
        assert!(off.abs() < 0.015, "{angle}: {off}");
    }
}
