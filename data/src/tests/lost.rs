//! Markers that a camera lost in some holds or runs.

use super::{read, table};
use crate::{DataError, Dataset, Lost, check, write_markers_csv};

/// A robot that bends as y = (1 + c) P s/90 with another c, shift and roll in every run, seen without noise.
fn robot(runs: usize, is_kept: &dyn Fn(usize, usize, usize) -> bool) -> Dataset {
    seen(runs, is_kept).unwrap()
}

fn seen(runs: usize, is_kept: &dyn Fn(usize, usize, usize) -> bool) -> Result<Dataset, DataError> {
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for run in 0..runs {
        let c = [0.02, -0.03, 0.01, 0.015, -0.01][run];
        let (dx, dy, turn) = (30.0 * c, -20.0 * c, 0.1 * c);
        for (hold, (p, phase)) in
            [(0, "load"), (10, "load"), (20, "load"), (30, "load"), (0, "unload")].iter().enumerate()
        {
            for (marker, s) in [60.0, 160.0, 260.0, 360.0].iter().enumerate() {
                let (x, y) = (s - 0.01 * f64::from(*p), (1.0 + c) * f64::from(*p) * s / 90.0);
                let (x, y) = (x + dx - turn * y, y + dy + turn * x);
                if is_kept(run, hold, marker) {
                    text.push_str(&format!("{run},ePAM,{hold},2,{p},{phase},{marker},{x},{y}\n"));
                }
            }
        }
    }
    read(&text)
}

/// A run's bend, shift and roll are known from what it saw, so what it lost is known: to second order in them.
#[test]
fn what_one_run_lost_is_put_where_that_run_would_have_seen_it() {
    let whole = robot(5, &|_, _, _| true);
    let lossy = robot(5, &|run, hold, marker| (run, hold, marker) != (0, 3, 3) && (run, hold, marker) != (1, 2, 1));
    assert_eq!(lossy.lost.filled, [[0, 3, 3], [1, 2, 1]]);
    assert!(lossy.lost.unseen.is_empty() && whole.lost == Lost::default());
    let n = whole.values_per_run();
    for [run, hold, marker] in [[0, 3, 3], [1, 2, 1]] {
        let i = run * n + whole.offset(hold, 0, marker);
        let others = (0..5).filter(|r| *r != run).map(|r| whole.xy(r, hold, 0, marker)[1]).sum::<f64>() / 4.0;
        let missed = (others - whole.coordinates_m[i + 1]).abs();
        assert!(missed > 8e-4, "the others' mean alone is {missed} m off");
        for axis in 0..2 {
            assert!(
                (lossy.coordinates_m[i + axis] - whole.coordinates_m[i + axis]).abs() < 0.05 * missed,
                "{run} {axis}"
            );
        }
    }
    let [a, b] = [&whole, &lossy].map(Dataset::mean_over_runs);
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 2e-5));
}

#[test]
fn what_most_runs_lost_is_left_out_and_told() {
    let data = robot(5, &|run, hold, marker| !(marker == 3 && hold == 3 && run < 2));
    assert_eq!((data.lost.unseen.as_slice(), data.lost.filled.len()), ([[3, 3]].as_slice(), 0));
    assert!(!data.is_seen(3, 3) && data.is_seen(3, 2) && data.is_seen(2, 3));
    let places: Vec<usize> = data.unseen_values().collect();
    assert_eq!(places, [data.offset(3, 0, 3), data.offset(3, 0, 3) + 1]);
    assert!(places.iter().all(|i| (1..5).all(|run| data.run(run)[*i] == data.run(0)[*i])));
    let told = check(&data, None).warnings.join("\n");
    assert!(told.contains("left out: marker 3 at 30.0 kPa (load)"), "{told}");
}

#[test]
fn a_marker_that_hardly_any_run_saw_and_a_hold_without_markers_are_refused() {
    let blind = seen(3, &|run, hold, marker| marker != 3 || hold % 3 == run).unwrap_err();
    assert!(
        blind.message().contains("marker 3 was seen by fewer than two thirds of the runs in every hold"),
        "{blind}"
    );
    let dark = seen(5, &|run, hold, marker| hold != 2 || marker == run % 4).unwrap_err();
    assert!(dark.message().contains("at 20.0 kPa no marker was seen by two thirds of the runs"), "{dark}");
}

#[test]
fn rows_without_a_position_are_lost_frames() {
    let text = table(2, 6);
    let lost: Vec<String> = text
        .lines()
        .enumerate()
        .map(|(i, row)| {
            let cells: Vec<&str> = row.split(',').collect();
            match i {
                9 => format!("{},,", cells[..7].join(",")),
                23 => format!("{},NaN,nan", cells[..7].join(",")),
                _ => row.to_string(),
            }
        })
        .collect();
    let without: Vec<&str> =
        text.lines().enumerate().filter(|(i, _)| ![9, 23].contains(i)).map(|(_, row)| row).collect();
    let (mut found, expected) = (read(&lost.join("\n")).unwrap(), read(&without.join("\n")).unwrap());
    assert_eq!(found.lost.frames, 2);
    assert!(check(&found, None).warnings.iter().any(|w| w.contains("2 rows have no position")));
    found.lost.frames = 0;
    assert_eq!(found, expected);
}

/// Rows without a position say that the marker was there to be seen: the other runs show where.
#[test]
fn a_marker_that_one_run_never_saw_is_filled_in_and_one_that_most_runs_never_saw_is_refused() {
    let blind = |runs: &[&str]| {
        let line = |row: &str| {
            let cells: Vec<&str> = row.split(',').collect();
            let is_lost = runs.contains(&cells[0]) && cells[6] == "2";
            if is_lost { format!("{},,\n", cells[..7].join(",")) } else { format!("{row}\n") }
        };
        read(&table(3, 3).lines().map(line).collect::<String>())
    };
    let data = blind(&["2"]).unwrap();
    let whole = blind(&[]).unwrap();
    assert!(data.lost.unseen.is_empty() && data.lost.filled.len() == data.holds.len(), "{:?}", data.lost);
    assert!(data.lost.filled.iter().all(|[run, _, marker]| [*run, *marker] == [1, 1]));
    let off = data.coordinates_m.iter().zip(&whole.coordinates_m).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 2e-3, "{off}");
    let most = blind(&["2", "3"]).unwrap_err();
    assert!(most.message().contains("marker 2 was seen by fewer than two thirds of the runs in every hold"), "{most}");
}

/// A marker in a hold with few frames would leave every hold with as few samples.
#[test]
fn a_glimpse_of_a_marker_is_a_loss() {
    let text = table(3, 6);
    let rows =
        text.lines().filter(|row| !(row.starts_with("2,") && row.contains(",30,load,2,") && !row.contains(",15,2,")));
    let data = read(&rows.map(|row| format!("{row}\n")).collect::<String>()).unwrap();
    assert_eq!((data.lost.filled.as_slice(), data.samples_per_hold), ([[1, 3, 1]].as_slice(), 5));
}

#[test]
fn a_marker_lost_between_two_equal_holds_is_refused_with_its_place() {
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for (hold, (p, phase)) in [(0, "unload"), (30, "load"), (0, "unload")].iter().enumerate() {
        for frame in 0..4 {
            for marker in [1, 2] {
                if (marker, hold) != (2, 1) {
                    let t = 5 * hold + frame;
                    text += &format!("1,spam,{t},2,{p},{phase},{marker},{},{p}\n", 60 * marker);
                }
            }
        }
    }
    let error = read(&text).unwrap_err();
    assert!(error.message().contains("marker 2 was lost between two equal holds"), "{error}");
    assert_eq!(error.location().line, 3);
}

#[test]
fn written_and_read_again_the_losses_are_the_same() {
    let data =
        robot(5, &|run, hold, marker| !(marker == 3 && hold == 3 && run < 2) && (run, hold, marker) != (4, 2, 2));
    let mut bytes = Vec::new();
    write_markers_csv(&data, &mut bytes).unwrap();
    let again = read(std::str::from_utf8(&bytes).unwrap()).unwrap();
    assert_eq!(again.lost, data.lost);
    let unseen: Vec<usize> = data.unseen_values().collect();
    let n = data.values_per_run();
    let pairs =
        again.coordinates_m.iter().zip(&data.coordinates_m).enumerate().filter(|(i, _)| !unseen.contains(&(i % n)));
    assert!(pairs.map(|(_, (a, b))| (a - b).abs()).all(|d| d < 1e-6));
    assert_eq!(data.to_table().rows(), bytes.iter().filter(|b| **b == b'\n').count() - 1);
}

#[test]
fn a_table_without_any_position_is_refused_as_that() {
    let line = |row: &str| format!("{},,\n", row.split(',').take(7).collect::<Vec<_>>().join(","));
    let text = table(2, 3);
    let (header, rows) = text.split_once('\n').unwrap();
    let error = read(&format!("{header}\n{}", rows.lines().map(line).collect::<String>())).unwrap_err();
    assert_eq!(error.message(), "none of the 60 rows has a position");
}
