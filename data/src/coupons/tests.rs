//! Tests of reading tensile tests: what is understood, and what is refused with what to type.

use super::*;
use crate::Provenance;

const ROWS: &str = "0,0\n0.5,1\n1,2\n1.5,3\n2,4\n2.5,5\n";

fn read_with(text: &str, defaults: &CouponDefaults) -> Result<Vec<Coupon>, DataError> {
    parse_coupons("a.csv", &mut text.as_bytes(), 0, defaults, &mut |_, _| ())
}

fn read(text: &str) -> Result<Vec<Coupon>, DataError> {
    read_with(text, &CouponDefaults::default())
}

fn refused(text: &str, words: &[&str]) {
    let error = read(text).unwrap_err();
    let said = format!("{error} | {}", error.help());
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn units_comments_and_the_first_row_are_understood() {
    let text = "# direction_deg: 90\n# width_mm = 20\n# Thickness_mm: 0.05\n# a note: with colon\n# provenance: synthetic\n\
                strain_pct;stress_MPa\n0.1;0.5\n0.6;1.5\n1.1;2.5\n1.6;3.5\n2.1;4.5\n2.6;5.5\n";
    let found = read(text).unwrap();
    let coupon = &found[0];
    assert_eq!((found.len(), coupon.specimen.as_str(), coupon.direction), (1, "a", Direction::Fill));
    assert_eq!((coupon.width_m, coupon.thickness_m, coupon.length_m), (Some(0.02), Some(5e-5), None));
    assert_eq!((coupon.provenance, coupon.line), (Provenance::Synthetic, 7));
    let rows = coupon.pulled.rows();
    assert!(matches!(coupon.pulled, Pulled::Stress(_)) && rows[0] == [0.0, 0.0]);
    assert!((rows[5][0] - 0.025).abs() < 1e-15 && (rows[5][1] - 5e6).abs() < 1e-6);
}

#[test]
fn several_specimens_and_sizes_may_share_a_table() {
    let mut text = "specimen,direction_deg,width_mm,displacement_mm,force_kn\n".to_string();
    for (name, direction) in [("A", 0), ("B", 45)] {
        (0..7).for_each(|i| text.push_str(&format!("{name},{direction},{}5,{i},{}\n", direction / 45 + 1, 2 * i)));
    }
    let found = read(&text).unwrap();
    assert_eq!(found.len(), 2);
    assert_eq!((found[1].specimen.as_str(), found[1].direction, found[1].width_m), ("B", Direction::Bias, Some(0.025)));
    assert!(matches!(&found[0].pulled, Pulled::Force(rows) if rows[6] == [0.006, 12e3]));
}

#[test]
fn column_names_and_sizes_may_come_from_outside_but_not_contradict() {
    let defaults = CouponDefaults {
        direction_deg: Some(45.0),
        length_m: Some(0.45),
        columns: vec!["displacement_mm".into(), "force_n".into()],
        ..CouponDefaults::default()
    };
    let found = read_with(&format!("displacement,   force\n{ROWS}"), &defaults).unwrap();
    assert_eq!((found[0].direction, found[0].length_m), (Direction::Bias, Some(0.45)));
    let error = read_with(&format!("# length_mm: 230\nx,y\n{ROWS}"), &defaults).unwrap_err();
    assert!(error.message().contains("230") && error.message().contains("450"), "{error}");
    let error = read_with(&format!("x,y,z\n{ROWS}"), &defaults).unwrap_err();
    assert!(error.message().contains("3 columns"), "{error}");
}

#[test]
fn noise_of_the_sensor_is_left_out_and_counted() {
    let text = "# direction_deg: 0\ndisplacement_mm,force_n\n0,0\n1,1\n2,2\n1.99,2\n3,3\n4,4\n5,5\n6,6\n7,7\n";
    let found = read(text).unwrap();
    assert_eq!((found[0].jitter, found[0].pulled.rows().len()), (1, 8));
}

#[test]
fn headers_without_unit_or_curve_are_refused_with_the_name_to_type() {
    refused(&format!("displacement,force\n{ROWS}"), &["column displacement has no unit", "name it displacement_mm"]);
    refused(&format!("strain_pct,stress_ksi\n{ROWS}"), &["stress_ksi has an unknown unit", "MPa", "stress_mpa"]);
    refused(&format!("strain_pct,strss_mpa\n{ROWS}"), &["stress_mpa is missing", "did you mean"]);
    refused("strain_pct,stress_mpa,displacement_mm,force_n\n", &["more than one curve"]);
    refused("strain_pct,stress_mpa,stress_kpa\n", &["stress_mpa and stress_kpa hold the same quantity"]);
    refused("", &["empty", "strain_pct,stress_mpa"]);
    refused("strain_pct,stress_mpa\n", &["no rows"]);
    refused(&format!("# widht_mm: 20\nstrain_pct,stress_mpa\n{ROWS}"), &["widht_mm", "did you mean # width_mm: 20"]);
    refused(&format!("# width: 20\nstrain_pct,stress_mpa\n{ROWS}"), &["no unit", "# width_mm: 20"]);
    refused(&format!("# width_mm: wide\nstrain_pct,stress_mpa\n{ROWS}"), &["a.csv:1", "wide"]);
    refused("# provenance: guessed\n", &["guessed", "digitised"]);
}

#[test]
fn bad_rows_are_refused_with_line_and_remedy() {
    let head = "# direction_deg: 0\nstrain_pct,stress_mpa\n";
    refused(&format!("{head}0,0\n0.5,one\n"), &["a.csv:4, column stress_mpa", "found \"one\""]);
    refused(&format!("{head}0,0\n0.5,nan\n"), &["finite"]);
    refused(&format!("{head}0;0\n"), &["1 cells"]);
    refused(&format!("{head}0,0,5\n"), &["3 cells", "decimals with a point"]);
    refused(&format!("{head}0,0\n1,1\n2,2\n"), &["has 3 rows", "at least 6"]);
    refused(&format!("{head}{ROWS}1,2\n0.5,1\n"), &["a.csv:9, column strain_pct", "goes back", "loading only"]);
    refused(&format!("strain_pct,stress_mpa\n{ROWS}"), &["direction", "not known", "--direction 0"]);
    refused(&format!("# direction_deg: 120\nstrain_pct,stress_mpa\n{ROWS}"), &["120 degrees", "60 for 120"]);
    refused(
        &format!("# direction_deg: 0\nstrain_ratio,stress_mpa\n{}", ROWS.replace("2.5", "12")),
        &["1200", "strain_pct"],
    );
    refused(&format!("# direction_deg: 0\n# width_mm: -2\nstrain_pct,stress_mpa\n{ROWS}"), &["width is -2"]);
}

#[test]
fn any_angle_and_the_width_under_load_are_read() {
    let rows: String = (0..7).map(|i| format!("{i},{i},{}\n", 20.0 - 0.01 * f64::from(i))).collect();
    let found = read(&format!("# direction_deg: 22.5\nstrain_pct,stress_mpa,loaded_width_mm\n{rows}")).unwrap();
    assert_eq!((found[0].direction.degrees(), found[0].direction.word()), (22.5, "off-axis"));
    assert_eq!(found[0].loaded_width_m.len(), found[0].pulled.rows().len());
    assert!((found[0].loaded_width_m[6] - 0.01994).abs() < 1e-15);
}

#[test]
fn mixed_directions_of_one_specimen_are_refused_where_they_change() {
    let text = "direction_deg,strain_pct,stress_mpa\n0,0,0\n0,1,1\n45,2,2\n";
    refused(text, &["a.csv:4, column direction_deg", "changes within its rows, here to 45", "another label"]);
}
