//! Exports of tensile machines.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

use data::{Coupon, CouponDefaults, DataError, Pulled, parse_coupons};
use std::path::PathBuf;

fn parse(text: &str, defaults: &CouponDefaults) -> Result<Vec<Coupon>, DataError> {
    parse_coupons("made.csv", &mut text.as_bytes(), 0, defaults, &mut |_, _| ())
}

fn read(file: &str, defaults: &CouponDefaults) -> Result<Vec<Coupon>, DataError> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases/c18-bluehill").join(file);
    parse(&std::fs::read_to_string(path).unwrap(), defaults)
}

fn warp() -> CouponDefaults {
    CouponDefaults { direction_deg: Some(0.0), ..CouponDefaults::default() }
}

fn force(coupon: &Coupon) -> &[[f64; 2]] {
    assert!(matches!(coupon.pulled, Pulled::Force(_)));
    coupon.pulled.rows()
}

#[test]
fn rows_about_the_test_units_in_a_row_and_kilonewtons() {
    let found = read("raw.csv", &warp()).unwrap();
    let coupon = &found[0];
    assert_eq!(
        (found.len(), coupon.width_m, coupon.thickness_m, coupon.length_m),
        (1, Some(0.025), Some(2e-4), Some(0.15))
    );
    let rows = force(coupon);
    assert!((rows[1][0] - 0.25e-3).abs() < 1e-12 && (rows[1][1] - 2.5013).abs() < 1e-9, "{:?}", rows[1]);
    assert!(
        coupon
            .told
            .join(" ")
            .contains("line 7 names the columns Time, Extension, Load; used are displacement_mm and force_n"),
        "{:?}",
        coupon.told
    );
    assert_eq!((coupon.line, coupon.specimen.as_str()), (9, "made"));
}

#[test]
fn two_specimens_side_by_side() {
    let found = read("two_specimens_side_by_side.csv", &warp()).unwrap();
    assert_eq!(found.iter().map(|c| c.specimen.as_str()).collect::<Vec<_>>(), ["1", "2"]);
    assert!((force(&found[0])[1][1] - 2.52626).abs() < 1e-9 && (force(&found[1])[1][1] - 2.55128).abs() < 1e-9);
    assert_eq!(found[0].pulled.rows().len(), found[1].pulled.rows().len());
    assert!(found[0].told.join(" ").contains("2 specimens stand side by side"));
}

#[test]
fn a_strain_over_a_force_needs_the_length_and_decimal_commas_are_read() {
    let error = read("decimal_comma.csv", &warp()).unwrap_err();
    assert!(error.message().contains("a strain and a force") && error.help().contains("--length 150mm"), "{error}");
    let found = read("decimal_comma.csv", &CouponDefaults { length_m: Some(0.15), ..warp() }).unwrap();
    let rows = force(&found[0]);
    assert!((rows[1][0] - 0.15 * 0.0016667).abs() < 1e-12 && (rows[1][1] - 2.50125).abs() < 1e-9, "{:?}", rows[1]);
    assert!(found[0].told.join(" ").contains("decimals are written with a comma"));
}

/// Another machine: units in the names, strain and stress beside extension and load, a shorter second specimen.
#[test]
fn another_machine_s_export() {
    let mut text = String::from(
        "Test;Zug\nBreite [mm];50\n\nA;;;B;;\nZeit [s];Dehnung [%];Spannung [MPa];Zeit [s];Dehnung [%];Spannung [MPa]\n",
    );
    for k in 0..8 {
        let end = if k < 6 { format!("{k};{k},5;{},25", 3 * k) } else { ";;".into() };
        text.push_str(&format!("{k};{k},5;{},5;{end}\n", 2 * k));
    }
    let found = parse(&text, &warp()).unwrap();
    assert_eq!(
        found.iter().map(|c| (c.specimen.as_str(), c.pulled.rows().len())).collect::<Vec<_>>(),
        [("A", 8), ("B", 6)]
    );
    assert_eq!(found[0].width_m, Some(0.05));
    let Pulled::Stress(rows) = &found[1].pulled else { panic!("strain and stress") };
    assert!((rows[1][0] - 0.01).abs() < 1e-12 && (rows[1][1] - 3e6).abs() < 1e-3, "{rows:?}");
    let error = parse(&text.replace("[MPa]", "[ksi]"), &warp()).unwrap_err();
    assert!(error.message().contains("ksi") && error.location().line == 5, "{error}");
}
