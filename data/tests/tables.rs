//! Marker tables as spreadsheets, R, pandas, MATLAB and careless people write them, against the same table written well.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

use data::{DataError, Dataset, check, load};
use std::path::PathBuf;

fn case(file: &str) -> String {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(file).display().to_string()
}

fn read(file: &str) -> Dataset {
    load(&case(file), &mut |_, _| ()).unwrap_or_else(|error| panic!("{error}\n{}", error.help())).0
}

fn text(text: &str) -> Result<Dataset, DataError> {
    data::parse_markers("made.csv", &mut text.as_bytes(), data::ReadOptions::default(), &mut |_, _| ())
}

/// The same numbers as the reference; returns what was told.
fn is_reference(found: &Dataset) -> String {
    let right = read("reference_markers.csv");
    assert_eq!(found.coordinates_m, right.coordinates_m);
    assert_eq!(found.holds, right.holds);
    assert_eq!(found.runs, right.runs);
    found.told.join("\n")
}

#[test]
fn spreadsheets_of_other_countries_are_read_and_said_so() {
    let told = is_reference(&read("c06-spreadsheet-locale/semicolon_decimal_comma_bom.csv"));
    assert!(told.contains("decimals are written with a comma"), "{told}");
    let told = is_reference(&read("c06-spreadsheet-locale/sep_line.csv"));
    assert!(told.contains("names the separator: ;"), "{told}");
    assert_eq!(is_reference(&read("c06-spreadsheet-locale/empty_rows_at_end.csv")), "");
    assert_eq!(is_reference(&read("reference_markers.csv")), "");
}

#[test]
fn dialects_of_programs_are_read_and_said_so() {
    let told = is_reference(&read("c07-table-dialects/matlab_duration.csv"));
    assert!(told.contains("times such as \"1 sec\" are read as seconds"), "{told}");
    let told = is_reference(&read("c07-table-dialects/r_row_names.csv"));
    assert!(told.contains("as R writes it"), "{told}");
    let numbered = read("c07-table-dialects/float_labels/markers.csv");
    assert!(is_reference(&numbered).contains("labels such as 1.0 are read as 1"));
    assert_eq!(numbered.markers.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["1", "2", "3"]);
    assert!(numbered.markers.iter().all(|m| m.station_m.is_some()), "about.toml names them 1.0 or 1");
    for file in ["c07-table-dialects/lost_as_NA.csv", "c07-table-dialects/lost_as_nan_ind.csv"] {
        let lossy = read(file);
        assert_eq!((lossy.lost.frames, lossy.lost.filled.len()), (3, 1), "{file}");
    }
    let error = load(&case("c07-table-dialects/wide.csv"), &mut |_, _| ()).unwrap_err();
    assert!(error.help().contains("ibr data import") && error.help().contains("wide.csv"), "{error} {}", error.help());
}

#[test]
fn zeros_are_lost_markers_unless_the_marker_sits_at_the_base() {
    let lossy = read("c08-lost-as-zero/markers.csv");
    assert_eq!((lossy.lost.filled.len(), lossy.lost.frames), (1, 0));
    let warnings = check(&lossy, None).warnings.join("\n");
    assert!(warnings.contains("3 rows have a marker at exactly 0, 0"), "{warnings}");
    let rows = |s: f64| {
        let row = |t: i32, m: &str, x: f64, s: f64| format!("1,epam,{t},2,{},load,{m},{x},0,{s}\n", 10 * t);
        let body: String = (0..2).flat_map(|t| [row(t, "base", 0.0, s), row(t, "tip", 300.0, 300.0)]).collect();
        text(&format!("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,s_mm\n{body}")).unwrap()
    };
    assert_eq!(rows(1.0).markers.len(), 2);
    assert_eq!((rows(100.0).markers.len(), rows(100.0).told.len()), (1, 1));
}

#[test]
fn a_ramp_is_no_row_of_holds() {
    let error = load(&case("c10-ramp"), &mut |_, _| ()).unwrap_err();
    assert!(error.message().contains("looks like a ramp") && error.help().contains("--bin 2kPa"), "{error}");
    assert!(error.help().contains("ibr data import"), "{}", error.help());
}

/// 60 frames per second, 2 s at 0 and 2 s at 10 kPa with 0.3 s between them.
#[test]
fn a_recording_with_ramps_between_its_holds_is_sent_to_the_import() {
    let mut rows = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for frame in 0..258 {
        let p = f64::from((frame - 120).clamp(0, 18)) / 1.8;
        rows.push_str(&format!("1,epam,{:.4},2,{p:.3},load,a,300,{p}\n", f64::from(frame) / 60.0));
    }
    let error = text(&rows).unwrap_err();
    assert!(
        error.message().contains("a hold lasts at least 0.5 s") && error.help().contains("ibr data import"),
        "{error}"
    );
}

#[test]
fn noise_about_zero_is_judged_by_the_mean_of_its_hold() {
    let noisy = read("c11-zero-noise");
    let right = read("reference_markers.csv");
    assert_eq!(noisy.coordinates_m, right.coordinates_m);
    assert!(noisy.holds[0].p_act_pa.abs() < 100.0, "{}", noisy.holds[0].p_act_pa);
    let below =
        std::fs::read_to_string(case("reference_markers.csv")).unwrap().replace(",0.0000,load", ",-0.8000,load");
    let error = text(&below).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("made.csv:2, column p_act_kpa: actuator pressure must be from 0 to 1000 kPa, not -0.8"),
        "{error}"
    );
}

#[test]
fn a_comma_that_may_be_of_thousands_is_refused_with_both_readings() {
    let head = "run;actuator;t_s;p_body_kpa;p_act_kpa;phase;marker;x_mm;y_mm\n";
    let error = text(&format!("{head}1;epam;0;2;0;load;a;300;1,234\n1;epam;1;2;10;load;a;290;5,678\n")).unwrap_err();
    assert!(error.message().contains("1.234 (decimal comma)") && error.message().contains("1234"), "{error}");
    let sure = text(&format!("{head}1;epam;0;2;0;load;a;300;1,234\n1;epam;1;2;10;load;a;290;5,6\n")).unwrap();
    assert_eq!(sure.coordinates_m[1], 1.234e-3);
    let mixed = text(&format!("{head}1;epam;0;2;0;load;a;300.5;1,2\n1;epam;1;2;10;load;a;290;5,6\n")).unwrap_err();
    assert!(mixed.message().contains("points and commas"), "{mixed}");
}

#[test]
fn one_cell_more_than_the_header_is_a_name_only_if_the_rest_fits() {
    let head = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n";
    let error = text(&format!("{head}1,epam,1,5,2,0,load,a,88,0\n1,epam,2,5,2,0,load,a,88,0\n")).unwrap_err();
    assert!(error.message().contains("one cell more"), "{error}");
}

/// Files of pyarrow (as pandas writes categories), DuckDB's decimals, and polars, all of the reference.
#[cfg(feature = "parquet")]
#[test]
fn parquet_files_of_other_programs_equal_the_reference() {
    for file in ["categories", "decimals", "decimals_bytes", "booleans", "polars_enum"] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/parquet/{file}.parquet"));
        let made = load(&path.display().to_string(), &mut |_, _| ());
        let (found, _) = made.unwrap_or_else(|error| panic!("{file}: {error}"));
        let right = read("reference_markers.csv");
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
        assert!(found.coordinates_m.iter().zip(&right.coordinates_m).all(near), "{file}");
        assert_eq!((found.holds, found.runs), (right.holds, right.runs), "{file}");
    }
    let stamped = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/parquet/stamped.parquet");
    let error = data::read_parquet(&stamped).unwrap_err();
    assert!(error.to_string().contains("column t_s has the type Timestamp"), "{error}");
}

#[cfg(feature = "parquet")]
#[test]
fn empty_cells_are_null_and_true_and_false_come_back_with_units_in_the_file() {
    use data::{Column, Table};
    let columns = vec![
        ("case".to_string(), Column::I64(vec![1, 2, 3])),
        ("tip_x_mm".to_string(), Column::F64(vec![1.5, f64::NAN, -2.0])),
        ("trusted".to_string(), Column::Bool(vec![Some(true), None, Some(false)])),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    Table { columns }.to_parquet(&path, &[("ibr.note".into(), "made".into())]).unwrap();
    let again = data::read_parquet(&path).unwrap();
    let Column::F64(tips) = &again.columns[1].1 else { panic!("{again:?}") };
    assert!(tips[1].is_nan() && tips[0] == 1.5);
    assert_eq!(again.columns[2].1, Column::Bool(vec![Some(true), None, Some(false)]));
    let mut csv = Vec::new();
    again.to_csv(&mut csv).unwrap();
    assert_eq!(String::from_utf8(csv).unwrap(), "case,tip_x_mm,trusted\n1,1.5,true\n2,,\n3,-2,false\n");
    let bytes = std::fs::read(&path).unwrap();
    let has = |words: &[u8]| bytes.windows(words.len()).any(|part| part == words);
    assert!(has(b"unit.tip_x_mm") && has(b"ibr.note") && !has(b"unit.trusted"));
}

/// 20 million rows of the same numbers are a file of some kilobytes, and are refused before they are read.
#[cfg(feature = "parquet")]
#[test]
fn a_table_that_takes_too_much_memory_is_refused_before_it_is_read() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/parquet/twenty_million_rows.parquet");
    let error = data::read_parquet(&path).unwrap_err();
    let said = format!("{error} {}", error.help());
    let words = "20000000 rows of 4 columns take 0.64 GB (allowed 0 to 0.60 GB)";
    assert!(said.contains(words) && said.contains("one file for every run"), "{said}");
}
