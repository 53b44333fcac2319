//! Tests of the characterisation: known truth comes back, published numbers too, and bad specimens are named.

use super::example::{FILL, SHEAR, STRIP, THICKNESS_M, WARP, example};
use super::write::{fabric_toml, measured_toml};
use super::*;
use crate::CompareError;
use data::{Coupon, CouponDefaults, Direction, parse_coupons};
use models::fabrics::{BiasExtension, Curve};

fn read(text: &str, defaults: &CouponDefaults) -> Vec<Coupon> {
    parse_coupons("a.csv", &mut text.as_bytes(), 0, defaults, &mut |_, _| ()).unwrap()
}

fn made(seed: u64) -> Characterized {
    let coupons: Vec<Coupon> = example(seed).iter().flat_map(|(_, t)| read(t, &CouponDefaults::default())).collect();
    characterize(&coupons, &Reduction::default()).unwrap()
}

/// Specimens of a straight law in MPa over strain, one per factor.
fn straight(direction: u32, moduli_mpa: &[f64]) -> String {
    let mut text = format!("# direction_deg: {direction}\n# thickness_mm: 0.05\nspecimen,strain_pct,stress_mpa\n");
    for (k, e) in moduli_mpa.iter().enumerate() {
        (0..=40).for_each(|i| {
            text.push_str(&format!("S{},{},{}\n", k + 1, 0.25 * f64::from(i), 0.0025 * f64::from(i) * e))
        });
    }
    text
}

fn refused(text: &str, defaults: &CouponDefaults, words: &[&str]) {
    let error = characterize(&read(text, defaults), &Reduction::default()).unwrap_err();
    let CompareError::Data(error) = error else { panic!("{error}") };
    let said = format!("{error} | {}", error.help());
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

fn warned(text: &str, words: &[&str]) {
    let found = characterize(&read(text, &CouponDefaults::default()), &Reduction::default()).unwrap();
    let said = found.warnings.join(" | ");
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn the_limit_of_the_paper_is_24_per_cent_of_its_strip() {
    let strip = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 1.0 };
    assert!((strip.angle(0.06).unwrap() - PAPER_LIMIT_RAD).abs() < 1e-6);
    assert!((PAPER_LIMIT_RAD.to_degrees() - 36.14225).abs() < 1e-4);
}

#[test]
fn intervals_of_made_up_specimens_hold_the_truth_as_often_as_they_say() {
    // 95 % each; of 40 sets 34 or fewer would come up once in about two hundred times.
    let truth = [("e0", 96.5), ("e90", 120.0), ("g12", 1.03)];
    let mut held = [0; 3];
    for seed in 0..40 {
        let found = made(100 + seed);
        for (k, (key, value)) in truth.iter().enumerate() {
            let [low, high] = found.quantity(key).unwrap().scatter.interval().unwrap();
            held[k] += usize::from((low..high).contains(value));
        }
    }
    assert!(held.iter().all(|n| *n >= 34), "{held:?}");
}

#[test]
fn the_curves_of_a_made_up_fabric_come_back_within_its_scatter() {
    let found = made(1);
    for (direction, truth) in [(Direction::Warp, WARP), (Direction::Fill, FILL)] {
        let (yarn, truth) =
            (found.yarns.iter().find(|y| y.direction == direction).unwrap(), Curve::table(&truth).unwrap());
        // Three standard errors of five specimens (stiffness 4 %, load cell 0.1 % of the largest stress), half a per cent for
        // corners between rows.
        for row in &yarn.rows[1..] {
            let (wanted, noise) = (truth.value(row[0]), 1e-3 * truth.value(0.25));
            let error = (0.04_f64.powi(2) + (noise / wanted).powi(2)).sqrt() / 5.0_f64.sqrt();
            assert!((row[1] / wanted - 1.0).abs() < 3.0 * error + 0.005, "{direction:?} {row:?} {wanted}");
        }
    }
    let moment = found.shear.as_ref().unwrap().moment_pa.as_ref().unwrap();
    let truth = Curve::table(&SHEAR).unwrap();
    let worst = moment[2..].iter().map(|r| (r[1] / truth.value(r[0]) - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst < 0.08, "{worst}");
    let locking = found.quantity("locking").unwrap().scatter.mean;
    assert!((locking - 45.0).abs() < 4.0, "{locking}");
    // A specimen may deviate by chance; none slipped.
    assert!(!found.warnings.iter().any(|w| w.contains("slipped")), "{:?}", found.warnings);
}

#[test]
fn without_noise_the_shear_curve_and_its_force_come_back() {
    let truth = Curve::table(&SHEAR).unwrap();
    let law = |angle: f64| truth.value(angle) * THICKNESS_M / angle.cos();
    let mut text =
        "# direction_deg: 45\n# width_mm: 20\n# length_mm: 250\n# thickness_mm: 0.05\ndisplacement_mm,force_n\n"
            .to_string();
    for i in 0..=180 {
        let [lengthening_m, force_n] = STRIP.pulled(0.005 * f64::from(i), law, None);
        text.push_str(&format!("{:.9},{force_n:.9}\n", 1e3 * lengthening_m));
    }
    let found = characterize(&read(&text, &CouponDefaults::default()), &Reduction::default()).unwrap();
    let moment = found.shear.unwrap().moment_pa.unwrap();
    for row in &moment[1..] {
        assert!((row[1] / truth.value(row[0]) - 1.0).abs() < 5e-3, "{row:?} {}", truth.value(row[0]));
    }
}

#[test]
fn published_moduli_give_the_published_shear_modulus() {
    let text = [straight(0, &[96.5]), straight(45, &[4.05]), straight(90, &[120.0])];
    let coupons: Vec<Coupon> = text.iter().flat_map(|t| read(t, &CouponDefaults::default())).collect();
    let found = characterize(&coupons, &Reduction::default()).unwrap();
    let value = |key: &str| found.quantity(key).unwrap().scatter.mean;
    assert!((value("e0") - 96.5).abs() < 1e-9 && (value("e45") - 4.05).abs() < 1e-9);
    assert!((value("g12_link") - 1.032).abs() < 5e-4, "{}", value("g12_link"));
    let fragment = fabric_toml(&found, &Reduction::default(), "ibr").unwrap();
    assert!(fragment.contains("e45_MPa = 4.05") && fragment.contains("[fabric.fabric-film]"), "{fragment}");
}

/// 1/(E t) of the mean, and the deviation of one more piece: s √(1 + 1/n) of two specimens at 90 and 110 MPa is 17.32 MPa.
#[test]
fn what_a_robot_of_the_fabric_is_told_is_the_value_of_one_more_piece() {
    let sized = CouponDefaults { thickness_m: Some(5e-5), ..CouponDefaults::default() };
    let found = characterize(&read(&straight(0, &[90.0, 110.0]), &sized), &Reduction::default()).unwrap();
    let text = measured_toml(&found, "ibr").unwrap();
    assert!(text.contains("[measured.fabric_stretch]\ncompliance_m_per_n = [0.0002, 0.00003464102]"), "{text}");
    assert!(!text.contains("shear"), "{text}");
    let single = characterize(&read(&straight(0, &[100.0]), &sized), &Reduction::default()).unwrap();
    assert_eq!(measured_toml(&single, "ibr"), None);
}

/// The digitised curves of Cao et al. 2008 may not be passed on with this program; where a copy lies in a folder
/// `shared/data` above the sources, the fixed point of eq. 18 on its rows must come out, iterated apart from this program.
#[test]
fn digitised_glass_gives_the_known_numbers_where_it_is_present() {
    let known = [
        (
            "glass_plain_150_450.csv",
            [0.15, 0.45],
            vec![
                [9.8437, 3.82452994, 3.23386],
                [34.4126, 14.0385939, 5.68045],
                [73.7241, 33.4964798, 17.3129],
                [105.5746, 55.8606665, 66.44574],
            ],
        ),
        (
            "glass_plain_115_230.csv",
            [0.115, 0.23],
            vec![[24.1332, 27.6290942, 12.19498], [36.1998, 46.7731624, 24.54503]],
        ),
    ];
    let above = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let Some(folder) = above.map(|a| a.join("shared/data")).find(|folder| folder.is_dir()) else { return };
    for (name, [width_m, length_m], rows) in known {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        let columns = vec!["displacement_mm".into(), "force_n".into()];
        let defaults = CouponDefaults {
            direction_deg: Some(45.0),
            width_m: Some(width_m),
            length_m: Some(length_m),
            columns,
            ..CouponDefaults::default()
        };
        let found = characterize(&read(&text, &defaults), &Reduction::default()).unwrap();
        let strip = found.specimens[0].strip.as_ref().unwrap();
        for [d_mm, degrees, n_per_m] in &rows {
            let row = strip.pulled.iter().position(|row| (1e3 * row[0] - d_mm).abs() < 1e-3).unwrap();
            let [angle, force] = strip.shear[row];
            assert!((angle.to_degrees() - degrees).abs() < 1e-3, "{name}: {}", angle.to_degrees());
            assert!((force / n_per_m - 1.0).abs() < 2e-6, "{name} {degrees}: {force}");
        }
        let locking = found.quantity("locking").map(|q| q.scatter.mean);
        println!("{name}: locking {locking:?}, {:?}", found.warnings);
        assert!(locking.is_some_and(|angle| (35.0..55.0).contains(&angle)), "{name}: {locking:?}");
    }
}

#[test]
fn stresses_in_another_unit_are_refused_with_the_name_to_type() {
    let none = CouponDefaults::default();
    let good = straight(0, &[96.5]);
    refused(
        &good.replace("stress_mpa", "stress_kpa"),
        &none,
        &["S1", "0.0965 MPa", "name it stress_mpa (modulus 96.5 MPa)"],
    );
    let pascals = straight(0, &[96.5e6]);
    refused(&pascals, &none, &["if stress_mpa holds Pa, name it stress_pa (modulus 96.5 MPa)", "--any-modulus"]);
    refused(&straight(0, &[96.5e3]), &none, &["if stress_mpa holds kPa, name it stress_kpa"]);
    refused(&straight(45, &[4.05e3]), &none, &["(45°)", "4050 MPa", "stress_kpa"]);
    let anyway = Reduction { any_modulus: true, ..Reduction::default() };
    assert!(characterize(&read(&pascals, &none), &anyway).is_ok());
}

#[test]
fn a_bias_strip_shorter_than_twice_its_width_is_refused_with_both_numbers() {
    let rows: String = (0..10).map(|i| format!("{i},{i}\n")).collect();
    let text = format!("# direction_deg: 45\n# width_mm: 60\n# length_mm: 100\ndisplacement_mm,force_n\n{rows}");
    refused(&text, &CouponDefaults::default(), &["H = 100.000 mm", "W = 60.000 mm", "120 mm"]);
}

#[test]
fn what_is_missing_for_a_stress_is_named() {
    let rows: String = (0..10).map(|i| format!("{i},{i}\n")).collect();
    let text = |notes: &str| format!("# direction_deg: 0\n{notes}displacement_mm,force_n\n{rows}");
    let none = CouponDefaults::default();
    refused(
        &text("# width_mm: 20\n# length_mm: 250\n"),
        &none,
        &["the thickness, which is missing", "# thickness_mm: 0.05", "--thickness"],
    );
    refused(&text("# width_mm: 20\n# thickness_mm: 0.05\n"), &none, &["free, between the grips", "--length 250mm"]);
    let far = text("# width_mm: 20\n# thickness_mm: 0.05\n");
    let short = CouponDefaults { length_m: Some(0.25e-3), ..CouponDefaults::default() };
    refused(&far, &short, &["displacement of 9.000 mm on a free length of 0.250 mm"]);
    // A machine that counts tension as negative gives the same fabric.
    let turned = characterize(&read(&straight(0, &[-96.5]), &none), &Reduction::default()).unwrap();
    assert_eq!(
        turned.quantities,
        characterize(&read(&straight(0, &[96.5]), &none), &Reduction::default()).unwrap().quantities
    );
    let twice = straight(0, &[96.5]).replace("S1,10,", "S1,10.0,");
    let both = [read(&twice, &none), read(&twice, &none)].concat();
    assert!(characterize(&both, &Reduction::default()).unwrap_err().to_string().contains("there twice"));
}

/// A fabric along a yarn has 5 MPa to 20 GPa, at 45° 0.02 MPa to 2 GPa.
#[test]
fn moduli_of_no_fabric_are_refused() {
    for (direction, [low, high]) in [(0, [5.0, 20e3]), (45, [0.02, 2e3])] {
        for (modulus_mpa, fits) in [(0.98 * low, false), (1.02 * low, true), (0.98 * high, true), (1.02 * high, false)]
        {
            let coupons = read(&straight(direction, &[modulus_mpa]), &CouponDefaults::default());
            let found = characterize(&coupons, &Reduction::default());
            assert_eq!(found.is_ok(), fits, "{modulus_mpa} MPa at {direction}°: {:?}", found.err());
        }
    }
}

#[test]
fn five_rows_of_loading_are_a_curve_and_four_are_none() {
    let text = |peak: i32| -> String {
        let rows = (1..=10).map(|i| format!("{},{}\n", 0.1 * f64::from(i), f64::from(peak - (i - peak).abs()) * 0.1));
        "# direction_deg: 0\nstrain_pct,stress_mpa\n".to_string() + &rows.collect::<String>()
    };
    refused(&text(4), &CouponDefaults::default(), &["largest in row 4", "at least 5 rows"]);
    assert!(characterize(&read(&text(5), &CouponDefaults::default()), &Reduction::default()).is_ok());
}

#[test]
fn rows_beyond_seventy_degrees_of_shear_are_left_out() {
    let strip = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 5e-5 };
    let said = |degrees: f64| {
        let last_mm = 1e3 * strip.displacement_m(degrees.to_radians());
        let rows = (0..=40).map(|i| 0.025 * f64::from(i)).map(|u| format!("{},{}\n", u * last_mm, u));
        let text =
            "# direction_deg: 45\n# width_mm: 20\n# length_mm: 250\n# thickness_mm: 0.05\ndisplacement_mm,force_n\n";
        let coupons = read(&(text.to_string() + &rows.collect::<String>()), &CouponDefaults::default());
        characterize(&coupons, &Reduction::default()).unwrap().warnings.join(" | ")
    };
    assert!(!said(69.0).contains("yarns slip") && said(71.0).contains("1 rows beyond"), "{}", said(71.0));
}

#[test]
fn a_slipping_specimen_is_named_with_its_strain() {
    let dropped = |i: i32| if i < 20 { f64::from(i) } else { f64::from(i) - 4.0 };
    let halted = |i: i32| f64::from(i.min(20)) + f64::from((i - 26).max(0));
    for (law, words) in [
        (&dropped as &dyn Fn(i32) -> f64, ["specimen G2 (0°)", "drops by 16 % from 4.75 % strain"]),
        (&halted, ["specimen G2 (0°)", "stays constant from 5.00 % strain"]),
    ] {
        let mut text = "# direction_deg: 0\n# specimen: G2\nstrain_pct,stress_mpa\n".to_string();
        (0..=40).for_each(|i| text.push_str(&format!("{},{}\n", 0.25 * f64::from(i), 0.25 * law(i))));
        warned(&text, &words);
    }
}

#[test]
fn a_specimen_that_deviates_or_has_the_wrong_direction_is_named() {
    warned(&straight(0, &[96.0, 97.0, 61.0, 95.0, 96.5]), &["specimen S3 (0°)", "61", "off the mean of the others"]);
    let none = CouponDefaults::default();
    let warp = straight(0, &[96.0, 97.0, 4.1, 95.0, 96.5]).replace("S3", "X");
    let text = [read(&warp, &none), read(&straight(45, &[4.0, 4.1, 4.05]), &none)].concat();
    let found = characterize(&text, &Reduction { any_modulus: true, ..Reduction::default() }).unwrap();
    let said = found.warnings.join(" | ");
    assert!(said.contains("specimen X (0°)") && said.contains("like those at 45°"), "{said}");
    let soft = [
        read(&straight(0, &[2.0e1, 2.0e1]), &none),
        read(&straight(90, &[2.0e1]), &none),
        read(&straight(45, &[9e1]), &none),
    ];
    let found = characterize(&soft.concat(), &Reduction::default()).unwrap();
    assert!(
        found.warnings.iter().any(|w| w.contains("E45 = 90") && w.contains("directions right")),
        "{:?}",
        found.warnings
    );
}

fn nylon(degrees: &[u32]) -> Characterized {
    let text = |d: &u32| data::set_file("nylon-offaxis", &format!("coupon_{d:02}.csv")).unwrap();
    let coupons: Vec<Coupon> = degrees.iter().flat_map(|d| read(text(d), &CouponDefaults::default())).collect();
    characterize(&coupons, &Reduction::default()).unwrap()
}

#[test]
fn the_name_of_an_embedded_set_stands_for_its_coupons() {
    let read = |name: &str| FabricTests::read(&[name.into()], &CouponDefaults::default(), &mut |_, _| ());
    let tests = read("nylon-offaxis").unwrap();
    assert_eq!((tests.coupons.len(), tests.files.len()), (7, 7));
    let [all, some] = [tests.reduce(&Reduction::default()).unwrap(), nylon(&[0, 15, 30, 45, 60, 75, 90])];
    assert_eq!(all.quantity("g12"), some.quantity("g12"));
    let refused = read("fem-epam").unwrap_err().to_string();
    assert!(refused.contains("fem-epam has no tests of a fabric"), "{refused}");
}

/// A law with the yarns' stretch twice in it gives a real nylon with E0/E45 = 2.1 a fifth too little in its own test at 45°.
/// Judged by the law pulled with free edges, not by the zones that the shear came from: 43 widths long, grips do 2 %.
#[test]
fn the_law_of_a_real_nylon_returns_the_tests_it_was_made_of() {
    let found = nylon(&[0, 45, 90]);
    let text = fabric_toml(&found, &Reduction::default(), "ibr").unwrap();
    for replay in found.replays.iter().filter(|r| r.law == "fabric") {
        let is_its = |s: &&Specimen| s.name == replay.specimen && s.direction.degrees() == replay.direction_deg;
        let test = found.specimens.iter().find(is_its).unwrap();
        assert!(replay.at_end.abs() < 0.01 && replay.rms < 0.01, "{}° {replay:?}", test.direction.degrees());
        let law = super::replay::laws(&found, &Reduction::default()).remove(0).1;
        let mut pull = models::fabrics::Pull::new(law, test.direction.degrees().to_radians()).unwrap();
        for [strain, stress] in test.stress.iter().filter(|row| row[0] > 0.005) {
            let off = pull.stress_pa(*strain).unwrap() / stress - 1.0;
            assert!(off.abs() < 0.04, "{}° {strain}: {off} {text}", test.direction.degrees());
        }
    }
    // The two shear moduli told 14.7 and 18.4 MPa before.
    let value = |key: &str| found.quantity(key).unwrap().scatter.mean;
    let apart = (value("g12") / value("g12_link") - 1.0).abs();
    assert!(apart < 0.1 || found.warnings.iter().any(|w| w.contains("two shear moduli")), "{apart}");
    assert!(found.notes.iter().any(|n| n.contains("slack")) && found.specimens.iter().all(|s| s.slack < 2e-3));
}

#[test]
fn other_angles_check_the_law_and_change_nothing_of_it() {
    let (three, seven) = (nylon(&[0, 45, 90]), nylon(&[0, 15, 30, 45, 60, 75, 90]));
    let settings = Reduction::default();
    let law =
        |found: &Characterized| fabric_toml(found, &settings, "ibr").unwrap().replace("7 specimens", "3 specimens");
    assert_eq!(law(&three), law(&seven));
    let checks: Vec<_> = seven.replays.iter().filter(|r| r.law == "fabric" && !r.used).collect();
    assert_eq!(checks.len(), 4);
    // What the law misses at angles it was not made from is told, not fitted.
    assert!(checks.iter().all(|r| r.at_end.abs() < 0.3) && checks.iter().any(|r| r.at_end.abs() > 0.1));
    assert!(seven.warnings.iter().any(|w| w.contains("tests at other angles")), "{:?}", seven.warnings);
}

#[test]
fn poissons_ratio_is_that_of_the_width_under_load() {
    let file = |direction: u32, e: f64, nu: f64| {
        let rows =
            (0..=20).map(f64::from).map(|i| format!("{},{},{}\n", 0.1 * i, 1e-3 * i * e, 20.0 * (1.0 - nu * 1e-3 * i)));
        let head =
            format!("# direction_deg: {direction}\n# thickness_mm: 0.05\nstrain_pct,stress_mpa,loaded_width_mm\n");
        read(&(head + &rows.collect::<String>()), &CouponDefaults::default())
    };
    let both = [file(0, 100.0, 0.2), file(90, 50.0, 0.1)].concat();
    let found = characterize(&both, &Reduction::default()).unwrap();
    assert!((found.nu12() - 0.2).abs() < 1e-9 && found.warnings.is_empty(), "{} {:?}", found.nu12(), found.warnings);
    // Of the fill alone: nu12 = nu21 E0/E90 = 0.2.
    let plain = read(&straight(0, &[100.0]), &CouponDefaults::default());
    let found = characterize(&[plain, file(90, 50.0, 0.1)].concat(), &Reduction::default()).unwrap();
    assert!((found.nu12() - 0.2).abs() < 1e-9);
    let wrong = [file(0, 100.0, 0.5), file(90, 50.0, 0.1)].concat();
    assert!(characterize(&wrong, &Reduction::default()).unwrap().warnings[0].contains("nu12 is 0.500"));
}

#[test]
fn the_same_tests_give_the_same_bytes() {
    let both = [made(1), made(1)].map(|found| fabric_toml(&found, &Reduction::default(), "ibr").unwrap());
    assert_eq!(both[0], both[1]);
}

/// A solid plate of a fabric bends by E t³/12: with that D the factor is 1.
#[test]
fn a_bending_length_is_written_as_what_finite_elements_and_the_fold_take() {
    let mut found = nylon(&[0, 45, 90]);
    assert!(!fabric_toml(&found, &Reduction::default(), "ibr").unwrap().contains("bending_factor"));
    let mean = |key: &str| 1e6 * found.quantity(key).unwrap().scatter.mean;
    let plate = 0.5 * (mean("e0") + mean("e90")) * found.thickness_m.unwrap().powi(3) / 12.0;
    // D = w c³.
    found.bend(&[[0.03, plate / 0.03_f64.powi(3)]], "measured");
    let text = fabric_toml(&found, &Reduction::default(), "ibr").unwrap();
    assert!(text.contains("bending_factor = 1.000,"), "{text}");
    let told: f64 =
        text.split("bending_nm = ").nth(1).unwrap().lines().next().unwrap().trim_end_matches('.').parse().unwrap();
    assert!((told / plate - 1.0).abs() < 1e-6);
}
