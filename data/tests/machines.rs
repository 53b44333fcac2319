//! Files as tensile machines export them, and the coupons read from them.

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

/// The curve 1 N per 0.1 mm, with a little curvature, to 3 mm or 5 mm.
fn exact(file: &str) -> Vec<[f64; 2]> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases/c27-tensile-machines").join(file);
    let rows = std::fs::read_to_string(path).unwrap();
    let numbers =
        |line: &str| line.rsplit(',').take(2).map(|cell| cell.parse::<f64>().ok()).collect::<Option<Vec<_>>>();
    let rows: Vec<[f64; 2]> = rows.lines().filter_map(numbers).map(|row| [row[1].abs() * 1e-3, row[0].abs()]).collect();
    let mut first: Vec<[f64; 2]> = Vec::new();
    rows.into_iter()
        .for_each(|row| first.extend(Some(row).filter(|row| first.last().is_none_or(|last| row[0] > last[0]))));
    first
}

#[test]
fn of_cycles_the_first_loading_is_taken_and_either_sign_is_a_pull() {
    let of = |file: &str, turn: [f64; 2], swap: bool| {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases/c27-tensile-machines").join(file);
        let text = std::fs::read_to_string(path).unwrap();
        let line =
            |line: &str| match line.rsplit_once(',').and_then(|(head, force)| Some((head, force.parse::<f64>().ok()?)))
            {
                Some((head, force)) => {
                    let (cycle, x) = head.rsplit_once(',').unwrap_or(("", head));
                    let x = turn[0] * x.parse::<f64>().unwrap();
                    format!("{cycle}{}{x},{}\n", if cycle.is_empty() { "" } else { "," }, turn[1] * force)
                }
                None => format!("{line}\n"),
            };
        let mut lines: Vec<String> = text.lines().map(line).collect();
        let head = lines.iter().position(|line| line.contains("force_n")).unwrap() + 1;
        if swap {
            lines[head..].reverse();
        }
        parse(&lines.concat(), &CouponDefaults::default())
    };
    for turn in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
        for (file, words) in [("cyclic.csv", "the first loading is used"), ("tension_negative.csv", "")] {
            let found = of(file, turn, false).unwrap();
            let right = exact(file);
            assert_eq!(force(&found[0]).len(), right.len(), "{file} {turn:?}: {:?}", found[0].told);
            let off = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-9;
            assert!(force(&found[0]).iter().zip(&right).all(off), "{file} {turn:?}");
            let told = found[0].told.join(" ");
            assert!(told.contains(words), "{told}");
            let negative = if file == "cyclic.csv" { turn } else { turn.map(|sign| -sign) };
            assert_eq!(told.matches("its sign is turned").count(), negative.iter().filter(|sign| **sign < 0.0).count());
        }
    }
    let error = of("tension_negative.csv", [-1.0, -1.0], true).unwrap_err();
    assert!(
        error.to_string().contains("goes back") || error.to_string().contains("rise"),
        "unloading is not a pull: {error}"
    );
}
