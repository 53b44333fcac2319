//! Where a table is just refused, cut or doubted, and just not.

use super::{read, read_bytes, table};
use crate::coupons::{CouponDefaults, parse_coupons};
use crate::{DataError, Dataset, check};

/// Two runs that go from nothing to a pressure: `cells` gives what follows run and time in hold 0 or 1.
fn two_holds(columns: &str, cells: impl Fn(usize) -> String) -> Result<Dataset, DataError> {
    let mut text = format!("run,t_s,actuator,phase,marker,{columns}\n");
    for run in 1..=2 {
        for hold in 0..2 {
            text.push_str(&format!("{run},{hold},epam,load,1,{}\n", cells(hold)));
        }
    }
    read(&text)
}

/// What a refusal says; empty if there is none.
fn said(result: Result<Dataset, DataError>) -> String {
    result.err().map_or(String::new(), |error| format!("{error} | {}", error.help()))
}

#[test]
fn lengths_between_two_millimetres_and_twenty_metres_are_robots() {
    let farthest = |column: &str, value: f64| {
        said(two_holds(&format!("p_body_kpa,p_act_kpa,x_{column},y_{column}"), |hold| {
            format!("2,{},{value},0", 20 * hold)
        }))
    };
    assert!(farthest("mm", 1.98).contains("looks like metres") && farthest("mm", 2.02).is_empty());
    assert!(farthest("m", 19.8).is_empty() && farthest("m", 20.2).contains("looks like millimetres"));
    assert!(farthest("mm", 0.99e6).is_empty() && farthest("mm", 1.01e6).contains("farther than any robot"));
    let station =
        |s: f64| said(two_holds("p_body_kpa,p_act_kpa,x_mm,y_mm,s_mm", |hold| format!("2,{},60,0,{s}", 20 * hold)));
    assert!(station(1.98).contains("looks like metres") && station(2.02).is_empty());
}

#[test]
fn a_marker_that_falls_by_five_millimetres_says_that_y_points_down() {
    let falling = |mm: f64| {
        said(two_holds("p_body_kpa,p_act_kpa,x_mm,y_mm", |hold| format!("2,{},60,{}", 20 * hold, -mm * hold as f64)))
    };
    assert!(falling(4.95).is_empty() && falling(5.05).contains("y points down"));
}

#[test]
fn pressures_are_told_by_what_robots_have() {
    let of = |body: f64, act: f64| {
        said(two_holds("p_body_kpa,p_act_kpa,x_mm,y_mm", |hold| format!("{body},{},60,{hold}", act * hold as f64)))
    };
    for (body, act, unit) in [(0.6, 7.0, "psi"), (0.06, 1.0, "bar"), (0.006, 0.1, "MPa")] {
        let like = format!("look like {unit}");
        let [low, high] = [0.99, 1.01].map(|by| move |limit: f64| by * limit);
        assert!(of(low(body), low(act)).contains(&like), "{}", of(low(body), low(act)));
        assert!(!of(high(body), low(act)).contains(&like) && !of(low(body), high(act)).contains(&like), "{unit}");
    }
    assert!(of(2.0, 990.0).is_empty() && of(2.0, 1010.0).contains("must be from 0 to 1000 kPa, not 1010"));
    assert!(
        of(214.0, 20.0).is_empty() && of(216.0, 20.0).contains("body pressure must be from 0.5 to 215 kPa, not 216")
    );
    let vented = |act: f64| {
        said(two_holds("p_body_kpa,p_act_kpa,x_mm,y_mm", |hold| {
            format!("2,{},60,{hold}", if hold == 0 { act } else { 20.0 })
        }))
    };
    assert!(vented(-0.495).is_empty() && vented(-0.505).contains("pressure must be from 0 to 1000 kPa"));
}

#[test]
fn stations_of_one_marker_are_one_to_a_micrometre_and_those_of_about_toml_to_half_a_millimetre() {
    let columns = "p_body_kpa,p_act_kpa,x_mm,y_mm,s_mm";
    let moved = |mm: f64| said(two_holds(columns, |hold| format!("2,{},60,0,{}", 20 * hold, 60.0 + mm * hold as f64)));
    assert!(moved(0.9e-3).is_empty() && moved(1.1e-3).contains("two stations"));
    let about = crate::parse_about("about.toml", "title = \"two\"\nprovenance = \"synthetic\"\nsource = \"here\"\nlicence = \"MIT\"\nactuator = \"ePAM\"\n[markers]\nnames = [\"1\", \"2\"]\ns_mm = [60, 360]\n").unwrap();
    let beside = |mm: f64| {
        let text = table(2, 1).replace("x_mm,y_mm\n", "x_mm,y_mm,s_mm\n");
        let rows = text.lines().enumerate().map(|(i, line)| match line.contains(",1,") && i > 0 {
            _ if i == 0 => format!("{line}\n"),
            _ => {
                let marker = line.split(',').nth(6).unwrap();
                format!("{line},{}\n", if marker == "1" { 60.0 + mm } else { 360.0 })
            }
        });
        let text: String = rows.collect();
        said(read_bytes(text.as_bytes(), crate::ReadOptions { about: Some(&about), ..crate::ReadOptions::default() }))
    };
    assert!(beside(0.49).is_empty(), "{}", beside(0.49));
    assert!(beside(0.51).contains("not the one in about.toml"), "{}", beside(0.51));
}

#[test]
fn a_time_after_an_hour_is_a_clock_and_holds_of_a_quarter_of_an_hour_are_milliseconds() {
    let at = |start: f64, step: f64| {
        let plain = table(2, 1);
        let text = plain.lines().enumerate().map(|(i, line)| {
            let mut cells: Vec<String> = line.split(',').map(String::from).collect();
            if i > 0 {
                cells[2] = format!("{}", start + step * cells[2].parse::<f64>().unwrap() / 5.0);
            }
            cells.join(",") + "\n"
        });
        read(&text.collect::<String>()).unwrap()
    };
    assert_eq!([3590.0, 3610.0].map(|start| at(start, 5.0).holds[0].t_s[0]), [3590.0, 0.0]);
    let doubted = |step: f64| check(&at(0.0, step), None).warnings.iter().any(|w| w.contains("name the column t_ms"));
    assert!(!doubted(990.0) && doubted(1010.0));
}

#[test]
fn a_marker_is_lost_where_fewer_than_half_of_its_frames_are_there() {
    let lost = |frames: usize| {
        let mut text = "run,t_s,actuator,phase,marker,p_body_kpa,p_act_kpa,x_mm,y_mm\n".to_string();
        for (run, hold, frame) in (0..600).map(|i| (i / 200, i / 100 % 2, i % 100)) {
            let (t, kpa) = (100 * hold + frame, 20 * hold);
            text.push_str(&format!("{run},{t},epam,load,1,2,{kpa},60,0\n"));
            if (run, hold) != (0, 1) || frame < frames {
                text.push_str(&format!("{run},{t},epam,load,2,2,{kpa},360,{hold}\n"));
            }
        }
        read(&text).unwrap().lost.filled
    };
    assert_eq!((lost(51), lost(49)), (vec![], vec![[0, 1, 1]]));
}

#[test]
fn six_robust_deviations_make_a_stray_and_ten_micrometres_none() {
    let found = |scatter_mm: f64, off_mm: f64| {
        let mut data = read(&table(5, 5)).unwrap();
        let (values, first) = (data.values_per_run(), data.run(0).to_vec());
        // Two runs above the median one, two below it: a robust deviation of 1.4826 √(5/4) times their distance.
        for (run, side) in [-1.0, 1.0, 0.0, -1.0, 1.0].into_iter().enumerate() {
            (0..values).for_each(|i| data.coordinates_m[run * values + i] = first[i] + 1e-3 * scatter_mm * side);
        }
        let at = data.offset(2, 3, 1) + 1;
        data.coordinates_m[values + at] = first[at] + 1e-3 * off_mm;
        check(&data, None).outliers.len()
    };
    let limit_mm = 6.0 * 1.482_602_2 * 1.25_f64.sqrt();
    assert_eq!([0.99, 1.01].map(|by| found(1.0, by * limit_mm)), [0, 1]);
    assert_eq!([0.99e-2, 1.01e-2].map(|off_mm| found(1e-6, off_mm)), [0, 1]);
}

#[test]
fn ten_thousand_runs_and_a_thousand_markers_are_read() {
    let many = |runs: usize, markers: usize| {
        let mut text = "run,t_s,actuator,phase,marker,p_body_kpa,p_act_kpa,x_mm,y_mm\n".to_string();
        for run in 0..runs {
            (0..markers).for_each(|marker| text.push_str(&format!("{run},0,epam,load,{marker},2,0,60,0\n")));
        }
        said(read(&text))
    };
    assert!(many(10_000, 1).is_empty() && many(10_001, 1).contains("more than 10000 runs"));
    assert!(many(1, 1000).is_empty() && many(1, 1001).contains("more than 1000 markers"));
}

#[test]
fn a_pull_has_six_rows_that_rise_and_no_strain_of_three() {
    let pull = |rows: &[f64]| {
        let rows: String = rows.iter().map(|strain| format!("{strain},{strain}\n")).collect();
        let text = format!("# direction_deg: 0\nstrain_ratio,stress_mpa\n{rows}");
        let read = parse_coupons("a.csv", &mut text.as_bytes(), 0, &CouponDefaults::default(), &mut |_, _| ());
        read.map_or_else(|error| error.to_string(), |found| found[0].told.join(" "))
    };
    let rising = |count: usize, last: f64| (0..count).map(|i| last * i as f64 / (count - 1) as f64).collect::<Vec<_>>();
    assert!(pull(&rising(6, 0.1)).is_empty() && pull(&rising(5, 0.1)).contains("5 rows that rise"));
    assert!(pull(&rising(8, 2.97)).is_empty() && pull(&rising(8, 3.03)).contains("reaches a strain"));
    let back = |by: f64| pull(&[rising(8, 0.1), vec![0.1 - by * 0.1]].concat());
    assert!(back(1.98e-3).is_empty() && back(2.02e-3).contains("the first loading is used"));
    assert!(back(0.198).contains("the first loading is used") && back(0.202).contains("goes back in one step"));
}
