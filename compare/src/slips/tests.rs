//! Slips put into embedded sets are found with their size; the sets as they are have none.

use super::slips;
use data::Dataset;

type Point = [f64; 2];

fn embedded(name: &str) -> Dataset {
    data::load(name, &mut |_, _| {}).unwrap().0
}

/// What is told of a set after every hold of every run went through `edit`.
fn told(name: &str, edit: impl Fn(usize, usize, &mut [Point])) -> Vec<String> {
    let mut dataset = embedded(name);
    let (holds, samples, markers) = (dataset.holds.len(), dataset.samples_per_hold, dataset.markers.len());
    let mut coordinates_m = Vec::new();
    for run in 0..dataset.runs.len() {
        for hold in 0..holds {
            for sample in 0..samples {
                let mut points: Vec<Point> = (0..markers).map(|m| dataset.xy(run, hold, sample, m)).collect();
                edit(run, hold, &mut points);
                coordinates_m.extend(points.into_iter().flatten());
            }
        }
    }
    dataset.coordinates_m = coordinates_m;
    let stations_m: Vec<f64> = dataset.markers.iter().map(|marker| marker.station_m.unwrap()).collect();
    slips(&dataset, &stations_m, 0.04)
}

fn each(points: &mut [Point], edit: impl Fn(Point) -> Point) {
    points.iter_mut().for_each(|point| *point = edit(*point));
}

fn assert_only(told: &[String], words: &[&str]) {
    assert_eq!(told.len(), 1, "{told:#?}");
    words.iter().for_each(|words| assert!(told[0].contains(words), "`{words}` in {}", told[0]));
}

const SETS: [&str; 8] = [
    "synthetic-spam",
    "synthetic-cpam",
    "synthetic-epam",
    "synthetic-fpam",
    "fem-spam",
    "fem-cpam",
    "fem-epam",
    "fem-fpam",
];

#[test]
fn right_data_have_none() {
    for name in SETS {
        assert_eq!(told(name, |_, _, _| {}), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn what_a_camera_a_mount_and_a_bent_wall_do_is_none() {
    for name in SETS {
        let scaled = told(name, |_, _, points| each(points, |p| p.map(|v| 1.05 * v)));
        let (sin, cos) = 0.05_f64.sin_cos();
        let rolled = told(name, |_, _, points| each(points, |[x, y]| [x * cos - y * sin, x * sin + y * cos]));
        let lens = told(name, |_, _, points| {
            each(points, |[x, y]| {
                let [u, v] = [x - 0.18, y - 0.06];
                let bulge = 0.8 * (u * u + v * v);
                [x + bulge * u, y + bulge * v]
            })
        });
        let drift = told(name, |_, hold, points| each(points, |[x, y]| [x, y + 0.004 * (hold % 4) as f64 / 3.0]));
        let marker = told(name, |_, _, points| points[3][0] += 0.012);
        let all = [scaled, rolled, lens, drift, marker].concat();
        assert_eq!(all, Vec::<String>::new(), "{name}");
    }
}

#[test]
fn a_shifted_origin_is_found_in_mm() {
    for name in SETS {
        let found = told(name, |_, _, points| each(points, |[x, y]| [x + 0.02, y]));
        assert_only(&found, &["origin of coordinates", "x +2", "mm from column x", "in all 5 runs", "become"]);
        let found = told(name, |_, _, points| each(points, |[x, y]| [x - 0.015, y + 0.01]));
        assert_only(&found, &["x -1", "mm from column x and ", "mm from column y"]);
    }
}

#[test]
fn exchanged_labels_are_found_with_runs_and_holds() {
    for name in SETS {
        for [a, b] in [[0, 1], [2, 3], [4, 5], [1, 4]] {
            let words = format!("markers {} and {} look exchanged in all 5 runs: ", a + 1, b + 1);
            assert_only(&told(name, |_, _, points| points.swap(a, b)), &[&words, "or their stations s_mm"]);
        }
        let one = |run, hold, points: &mut [Point]| {
            if run == 1 && hold > 1 {
                points.swap(2, 3)
            }
        };
        assert_only(&told(name, one), &["markers 3 and 4 look exchanged in run 2, holds 3 to ", "of these rows"]);
    }
    let both = told("synthetic-epam", |_, _, points| {
        points.swap(0, 1);
        points.swap(3, 4);
    });
    assert_eq!(both.len(), 2, "{both:#?}");
}

#[test]
fn numbers_from_the_tip_turned_axes_and_units_are_found_in_all_runs_or_one() {
    type Edit = fn(&mut [Point]);
    let slips: [(Edit, &str); 6] = [
        (|points| points.reverse(), "numbered from the tip"),
        (|points| each(points, |[x, y]| [-x, y]), "(-x, y) in place of (x, y)"),
        (|points| each(points, |[x, y]| [y, x]), "(y, x) in place of (x, y)"),
        (|points| each(points, |[x, y]| [-y, x]), "(y, -x) in place of (x, y)"),
        (|points| each(points, |p| p.map(|v| 0.1 * v)), "cm under a header of mm, or the stations"),
        (|points| each(points, |p| p.map(|v| 3.0 * v)), "pixels"),
    ];
    for name in SETS {
        for (slip, words) in slips {
            assert_only(&told(name, |_, _, points| slip(points)), &[words, "in all 5 runs: "]);
            let one = |run: usize, _: usize, points: &mut [Point]| {
                if run == 1 {
                    slip(points)
                }
            };
            assert_only(&told(name, one), &[words, "in run 2: "]);
        }
        let down = |run: usize, _: usize, points: &mut [Point]| {
            if run == 1 {
                each(points, |[x, y]| [x, -y])
            }
        };
        assert_only(&told(name, down), &["y looks turned over in run 2"]);
    }
}

/// A camera's scale is off by a fifth at most; a unit is told by its name to a tenth.
#[test]
fn a_scale_is_a_slip_where_no_camera_has_it_and_a_unit_where_it_is_near_one() {
    for name in SETS {
        let told = |by: f64| told(name, |_, _, points| each(points, |p| p.map(|v| by * v)));
        assert_eq!(told(1.0 / 1.15), Vec::<String>::new(), "{name}");
        assert_only(&told(1.0 / 1.4), &["pixels, or a scale that was not set"]);
        assert_only(&told(0.1 / 1.05), &["cm under a header of mm"]);
        assert_only(&told(0.1 / 1.2), &["pixels, or a scale that was not set"]);
    }
}

#[test]
fn a_picture_with_its_origin_in_a_corner_is_turned_first_and_shifted_then() {
    let found = told("synthetic-epam", |_, _, points| each(points, |[x, y]| [0.4 - x, y + 0.2]));
    assert_eq!(found.len(), 2, "{found:#?}");
    assert!(found[0].contains("(-x, y) in place of (x, y)") && found[1].contains("origin"), "{found:#?}");
}

/// What stands in the place of a lost marker is far from where it was.
#[test]
fn a_marker_that_was_lost_is_no_slip_and_hides_none() {
    for name in SETS {
        let whole = embedded(name);
        let stations_m: Vec<f64> = whole.markers.iter().map(|marker| marker.station_m.unwrap()).collect();
        let most = (0..whole.runs.len()).flat_map(|run| [[run, 3, 5], [run, 3, 4], [run, 0, 0]]).collect::<Vec<_>>();
        let mut lossy = whole.losing(&most);
        assert_eq!(lossy.lost.unseen.len(), 3);
        assert!(slips(&lossy, &stations_m, 0.04).is_empty(), "{name}: {:?}", slips(&lossy, &stations_m, 0.04));
        lossy.coordinates_m.iter_mut().step_by(2).for_each(|x| *x += 0.03);
        assert_only(&slips(&lossy, &stations_m, 0.04), &["origin", "x +30"]);
    }
}

/// Fifty markers seven millimetres apart can be told from each other, a thousand a third of a millimetre apart cannot.
#[test]
fn labels_are_told_as_far_as_noise_lets_them() {
    let told = |markers: usize| {
        let stations_m: Vec<f64> = (1..=markers).map(|i| 0.35 * i as f64 / markers as f64).collect();
        let robot =
            crate::study::published::textbook_scenario("epam").unwrap().with_bending(1.35).with_markers(&stations_m);
        let usual = crate::study::Generator { runs: 3, ..Default::default() };
        let mut data = crate::study::generate(&robot, "made", &usual).unwrap();
        let (width, last) = (2 * markers, data.coordinates_m.len());
        for at in (0..last).step_by(width) {
            (0..2).for_each(|axis| data.coordinates_m.swap(at + 40 + axis, at + 42 + axis));
        }
        slips(&data, &stations_m, robot.radius_m)
    };
    assert_only(&told(50), &["markers 21 and 22 look exchanged", "in all 3 runs"]);
    assert!(told(1000).is_empty());
}

/// A station column of zeros describes no body, and geometry does not separate two markers at one station.
#[test]
fn stations_at_the_base_or_at_one_place_are_looked_at_without_a_slip() {
    let dataset = embedded("synthetic-epam");
    let mut stations_m: Vec<f64> = dataset.markers.iter().map(|marker| marker.station_m.unwrap()).collect();
    assert!(slips(&dataset, &vec![0.0; stations_m.len()], 0.04).is_empty());
    stations_m[1] = stations_m[0];
    let told = slips(&dataset, &stations_m, 0.04);
    assert!(told.iter().all(|words| !words.contains("markers 1 and 2")), "{told:#?}");
    assert!(
        slips(&dataset, &vec![0.3; stations_m.len()], 0.04).iter().all(|words| words.starts_with("synthetic-epam"))
    );
}
