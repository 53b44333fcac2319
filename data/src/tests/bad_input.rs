//! Each wrong table gives one clear error: where, what, and what to type.

use proptest::prelude::*;

use super::{read, read_bytes, table};
use crate::{DataError, ReadOptions, load, parse_about};

const HEAD: &str = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n";

/// The good table with the cell of one data row (from 1) replaced.
fn with_cell(row: usize, column: usize, cell: &str) -> String {
    let mut lines: Vec<String> = table(2, 5).lines().map(str::to_string).collect();
    let mut cells: Vec<&str> = lines[row].split(',').collect();
    cells[column] = cell;
    lines[row] = cells.join(",");
    lines.join("\n") + "\n"
}

#[test]
fn text_in_a_number_cell_names_line_column_and_cell() {
    let error = read(&with_cell(16, 7, "abc")).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv:17, column x_mm: expected a number, found \"abc\"");
    assert!(error.help().contains("12.5"), "{}", error.help());
    assert_eq!(error.location().cell.as_deref(), Some("abc"));
    let (start, end) = error.caret().unwrap();
    assert_eq!(&error.source_line().unwrap()[start..end], "abc");
    let text = with_cell(16, 7, "abc");
    let (start, end) = error.span().unwrap();
    assert_eq!(&text[start..end], "abc");
}

#[test]
fn cells_that_are_no_finite_number_are_refused() {
    for cell in ["NaN", "inf", "-Infinity", "1e400"] {
        let error = read(&with_cell(3, 8, cell)).unwrap_err();
        assert_eq!(error.message(), format!("expected a finite number, found \"{cell}\""));
    }
    assert_eq!(read(&with_cell(3, 8, " ")).unwrap_err().message(), "expected a number, the cell is empty");
    let error = read(&with_cell(3, 8, "\"1,5\"")).unwrap_err();
    assert_eq!(error.help(), "write decimals with a point: 1.5");
}

#[test]
fn labels_may_not_be_empty() {
    for (column, name) in [(0, "run"), (1, "actuator"), (5, "phase"), (6, "marker")] {
        let error = read(&with_cell(4, column, "")).unwrap_err();
        assert_eq!(error.to_string(), format!("markers.csv:5, column {name}: the cell is empty"));
    }
}

#[test]
fn an_unknown_phase_lists_the_three_words() {
    let error = read(&with_cell(2, 5, "loading")).unwrap_err();
    assert_eq!(error.message(), "unknown phase \"loading\"");
    assert!(error.help().contains("load (") && error.help().contains("unload"), "{}", error.help());
}

#[test]
fn a_header_without_rows_is_refused() {
    let error = read(HEAD).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv: the file has a header and no rows");
}

#[test]
fn a_row_cut_short_or_too_long_is_refused() {
    let text = table(2, 5);
    let cut = &text[..text.len() - 12];
    let error = read(cut).unwrap_err();
    assert!(error.message().starts_with("the file ends in the middle of a row"), "{error}");
    let error = read(&text.replacen(",load,1,60", ",1,60", 1)).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv:2: expected 9 cells, found 8");
    let error = read(&text.replacen(",load,1,60", ",load,1,60,7", 1)).unwrap_err();
    assert_eq!(error.message(), "expected 9 cells, found more than 9");
    let error = read(&text.replacen("1,ePAM", "\"1,ePAM", 1)).unwrap_err();
    assert_eq!(error.help(), "close the quotation mark on the same line");
    assert_eq!(error.location().line, 2);
}

#[test]
fn text_that_is_not_utf8_names_line_and_byte() {
    let mut bytes = table(1, 5).into_bytes();
    let at = HEAD.len() + 3;
    bytes[at] = 0xb5;
    let error = read_bytes(&bytes, ReadOptions::default()).unwrap_err();
    assert_eq!((error.location().line, error.span()), (2, Some((at, at + 1))));
    let utf16: Vec<u8> = [0xff, 0xfe].into_iter().chain(HEAD.bytes().flat_map(|byte| [byte, 0])).collect();
    assert!(read_bytes(&utf16, ReadOptions::default()).unwrap_err().help().contains("UTF-16"));
}

#[test]
fn a_marker_missing_in_one_run_names_run_and_marker() {
    let text: String = table(2, 5)
        .lines()
        .filter(|row| !(row.starts_with("2,") && row.contains(",2,3")))
        .map(|row| format!("{row}\n"))
        .collect();
    let error = read(&text).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv:3, column marker: marker 2 appears in run 1 but not in run 2");
}

#[test]
fn a_hold_missing_in_one_run_names_run_and_hold() {
    let text = table(2, 5);
    let without: Vec<_> = text.lines().filter(|row| !(row.starts_with("2,") && row.contains(",20,load"))).collect();
    let error = read(&without.join("\n")).unwrap_err();
    let said = error.message();
    assert!(said.contains("run 2, marker 1 lacks a hold") && said.contains("load at 20.0 kPa"), "{said}");
    let lines: Vec<String> = text
        .lines()
        .map(|r| if r.starts_with("2,") { r.replace(",20,load", ",17,load") } else { r.to_string() })
        .collect();
    let error = read(&lines.join("\n")).unwrap_err();
    assert!(
        error.message().contains("run 2, marker 1 has a hold that run 1, marker 1 has not: load at 17.0"),
        "{error}"
    );
    assert_eq!(error.location().line, 72);
}

#[test]
fn time_going_backwards_and_rows_given_twice_are_refused() {
    let text = table(1, 5);
    let second = text.lines().nth(2).unwrap();
    let twice = text.replacen(second, &format!("{second}\n{second}"), 1);
    let error = read(&twice).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv:4, column t_s: run 1, marker 2 is there twice at this time");
    let error = read(&with_cell(5, 2, "0.2")).unwrap_err();
    assert_eq!(error.message(), "time goes backwards in run 1, marker 1: 0.2 s after 0.5 s");
}

#[test]
fn metres_in_a_millimetre_column_and_the_reverse_are_noticed() {
    let head_m = HEAD.replace("x_mm", "x_m");
    let small = format!("{HEAD}1,spam,0,2,10,load,1,0.06,0.001\n1,spam,0,2,10,load,2,0.36,0.02\n");
    let error = read(&small).unwrap_err();
    assert_eq!(error.help(), "name the column x_m");
    assert!(error.message().contains("looks like metres"), "{error}");
    assert_eq!(error.location().column_name.as_deref(), Some("x_mm"));
    let large = format!("{head_m}1,spam,0,2,10,load,1,60,1\n1,spam,0,2,10,load,2,360,20\n");
    assert_eq!(read(&large).unwrap_err().help(), "name the column x_mm");
    let stations = format!("{},s_mm\n1,spam,0,2,10,load,1,60,1,0.06\n", HEAD.trim());
    assert_eq!(read(&stations).unwrap_err().help(), "name the column s_m");
}

#[test]
fn pascal_psi_bar_and_megapascal_in_kilopascal_columns_are_noticed() {
    let row = |body: f64, act: f64| format!("{HEAD}1,spam,0,{body},{act},load,1,60,1\n");
    let error = read(&row(2.0, 10_000.0)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "markers.csv:2, column p_act_kpa: actuator pressure must be from 0 to 1000 kPa, not 10000; it looks like Pa"
    );
    assert_eq!(error.help(), "name the column p_act_pa");
    assert_eq!(read(&row(2000.0, 10.0)).unwrap_err().help(), "name the column p_body_pa");
    for (body, act, unit) in [(0.29, 4.35, "psi"), (0.02, 0.3, "bar"), (0.002, 0.03, "mpa")] {
        let error = read(&row(body, act)).unwrap_err();
        assert!(
            error.help().starts_with(&format!("name the columns p_act_{unit}, p_body_{unit};")),
            "{}",
            error.help()
        );
    }
    assert!(read(&row(0.7, 4.0)).is_ok());
    let mpa = row(2.0, 30.0).replace("p_act_kpa", "p_act_mpa");
    assert_eq!(read(&mpa).unwrap_err().help(), "name the column p_act_kpa");
}

#[test]
fn pressure_below_zero_is_refused() {
    let error = read(&with_cell(5, 4, "-10")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "markers.csv:6, column p_act_kpa: actuator pressure must be from 0 to 1000 kPa, not -10"
    );
    assert!(
        read(&with_cell(5, 3, "-2"))
            .unwrap_err()
            .message()
            .starts_with("body pressure must be from 0.5 to 215 kPa, not -2")
    );
}

#[test]
fn exchanged_x_and_y_are_not_called_a_y_that_points_down() {
    let rows =
        "1,spam,0,2,0,load,1,60,0\n1,spam,0,2,0,load,2,360,0\n1,spam,1,2,30,load,1,60,5\n1,spam,1,2,30,load,2,340,60\n";
    let error = read(&format!("{}{rows}", HEAD.replace("x_mm,y_mm", "y_mm,x_mm"))).unwrap_err();
    assert_eq!(
        error.message(),
        "x and y look exchanged: in the first hold the markers take up 300.0 mm of y and 0.0 mm of x"
    );
    assert!(error.help().ends_with("exchange the names of the two columns"), "{}", error.help());
}

#[test]
fn y_pointing_down_is_noticed_either_way() {
    let rows = "1,spam,0,2,0,load,1,60,0\n1,spam,0,2,0,load,2,360,0\n1,spam,1,2,30,load,1,60,-1\n1,spam,1,2,30,load,2,340,-60\n";
    let error = read(&format!("{HEAD}{rows}")).unwrap_err();
    assert_eq!(error.message(), "y points down: at 30.0 kPa marker 2 has moved by -60.0 mm");
    assert!(error.help().ends_with("multiply it by -1, or name the column y_down_mm"), "{}", error.help());
    let down = HEAD.replace("y_mm", "y_down_mm");
    assert!(read(&format!("{down}{rows}")).is_ok());
    let error = read(&format!("{down}{}", rows.replace('-', ""))).unwrap_err();
    assert!(error.help().ends_with("name the column y_mm"), "{}", error.help());
}

#[test]
fn a_station_that_changes_or_contradicts_about_toml_is_refused() {
    let head = HEAD.replace("y_mm", "y_mm,s_mm");
    let error = read(&format!("{head}1,spam,0,2,0,load,1,60,0,60\n1,spam,1,2,0,load,1,60,0,61\n")).unwrap_err();
    assert_eq!(error.message(), "marker 1 has two stations: 60 mm and 61 mm");
    let about = "title='t'\nprovenance='measured'\nsource='s'\nlicence='l'\n[markers]\nnames=['1']\ns_mm=[65]";
    let about = parse_about("about.toml", about).unwrap();
    let options = ReadOptions { about: Some(&about), ..ReadOptions::default() };
    let error = read_bytes(format!("{head}1,spam,0,2,0,load,1,60,0,60\n").as_bytes(), options).unwrap_err();
    assert!(error.message().contains("is not the one in about.toml (65 mm)"), "{error}");
    let error = read_bytes(format!("{HEAD}1,spam,0,2,0,load,M1,60,0\n").as_bytes(), options).unwrap_err();
    assert_eq!(error.message(), "marker M1 is not in about.toml, which names 1");
}

#[test]
fn a_description_of_another_actuator_or_run_is_refused() {
    let base = "title='t'\nprovenance='measured'\nsource='s'\nlicence='l'\n";
    let with = |tail: &str| parse_about("about.toml", &format!("{base}{tail}")).unwrap();
    let (other, run) = (with("actuator='spam'"), with("[[run]]\nid='run1'"));
    let read_with =
        |about| read_bytes(table(2, 5).as_bytes(), ReadOptions { about: Some(about), ..ReadOptions::default() });
    assert_eq!(read_with(&other).unwrap_err().message(), "the table is of actuator epam, its about.toml names spam");
    assert_eq!(read_with(&run).unwrap_err().message(), "about.toml describes run run1, which has no rows");
}

#[test]
fn too_many_runs_markers_and_holds_are_refused_before_they_fill_the_memory() {
    let mut many_markers = HEAD.to_string();
    (0..1001).for_each(|i| many_markers += &format!("1,spam,0,2,0,load,{i},60,0\n"));
    assert_eq!(read(&many_markers).unwrap_err().message(), "more than 1000 markers");
    let mut many_runs = HEAD.to_string();
    (0..10_001).for_each(|i| many_runs += &format!("{i},spam,0,2,0,load,1,60,0\n"));
    assert_eq!(read(&many_runs).unwrap_err().message(), "more than 10000 runs");
    let mut flicker = HEAD.to_string();
    (0..1001).for_each(|i| flicker += &format!("1,spam,{i},2,{},load,1,60,0\n", 10 * (i % 2)));
    assert!(read(&flicker).unwrap_err().help().contains("pressures are steady"));
}

#[test]
fn places_that_do_not_exist_are_named_with_what_can_be_given() {
    let load = |spec: &str| load(spec, &mut |_, _| ()).unwrap_err();
    let error = load("du-pasquier-2032");
    assert!(error.help().starts_with("did you mean du-pasquier-2023?"), "{}", error.help());
    let error = load("du-pasquier-2023");
    assert_eq!(error.message(), "the set du-pasquier-2023 has no marker positions");
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(load(&folder.path().display().to_string()).message(), "the folder has no markers.csv");
    assert!(matches!(load("/nowhere/markers.csv"), DataError::File(_)));
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(read_bytes(&bytes, ReadOptions::default()).is_err());
    }

    #[test]
    fn a_table_with_a_few_bytes_changed_never_panics(
        changes in proptest::collection::vec((0..2000_usize, prop_oneof![any::<u8>(), Just(b'"'), Just(b','), Just(b'\n')]), 1..8),
    ) {
        let mut bytes = table(2, 3).into_bytes();
        for (at, byte) in changes {
            let length = bytes.len();
            bytes[at % length] = byte;
        }
        if let Err(error) = read_bytes(&bytes, ReadOptions::default()) {
            prop_assert!(!error.message().is_empty() && !error.help().is_empty());
            if let (Some(line), Some((start, end))) = (error.source_line(), error.caret()) {
                prop_assert!(start <= end && end <= line.len());
            }
        }
    }
}

/// The good table with a column of gauge readings; the second row's is `cell`.
fn with_gauge(name: &str, cell: &str) -> String {
    let row = |(i, line): (usize, &str)| match i {
        0 => format!("{line},{name}\n"),
        2 => format!("{line},{cell}\n"),
        _ => format!("{line},0.5\n"),
    };
    table(2, 5).lines().enumerate().map(row).collect()
}

#[test]
fn a_gauge_needs_a_unit_and_a_plausible_number_in_every_row() {
    assert!(read(&with_gauge("p_gauge_kpa", "1.5")).unwrap().gauge_pa.is_some());
    let error = read(&with_gauge("p_gauge", "1.5")).unwrap_err();
    assert_eq!(error.message(), "column p_gauge has no unit in its name");
    assert!(error.help().starts_with("name it p_gauge_kpa"), "{}", error.help());
    assert!(read(&with_gauge("p_gauge_torr", "1.5")).unwrap_err().message().contains("unknown unit"));
    let error = read(&with_gauge("p_gauge_kpa", "")).unwrap_err();
    assert_eq!(error.to_string(), "markers.csv:3, column p_gauge_kpa: expected a number, the cell is empty");
    let error = read(&with_gauge("p_gauge_kpa", "-2")).unwrap_err();
    assert!(error.message().starts_with("actuator pressure must be from 0 to 1000 kPa"), "{error}");
    assert!(read(&with_gauge("p_gauge_kpa", "30000")).unwrap_err().help().contains("p_gauge_pa"));
}

#[test]
fn line_ends_of_cr_only_are_said_to_be_so_whatever_the_size() {
    for copies in [1, 3000] {
        let text = table(1, 5).repeat(copies).replace('\n', "\r");
        let error = read(&text).unwrap_err();
        assert!(error.message().contains("the line ends are CR only"), "{error}");
        assert!(error.help().contains("tr '\\r' '\\n'") && error.source_line().is_none(), "{}", error.help());
    }
}

#[test]
fn a_time_below_zero_is_refused() {
    let error = read(&table(1, 5).replacen(",0,2,0,load,1", ",-0.5,2,0,load,1", 1)).unwrap_err();
    assert_eq!(error.location().column_name.as_deref(), Some("t_s"));
    assert!(error.message().contains("time must be from 0 to 10000000000 s, not -0.5"), "{error}");
}

#[test]
fn a_message_lists_few_of_very_many_columns() {
    let header = (0..500).map(|i| format!("c{i}")).collect::<Vec<_>>().join(",");
    let error = read(&format!("{header}\n")).unwrap_err();
    assert!(error.message().ends_with("c29 and 470 more"), "{error}");
}
