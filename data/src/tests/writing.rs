//! Round trips through CSV, tables and files.

use super::{read, table};
use crate::{Column, DataError, Dataset, Table, load, read_parquet, write_atomically, write_markers_csv};

fn csv(dataset: &Dataset) -> String {
    let mut bytes = Vec::new();
    write_markers_csv(dataset, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn a_table_written_reads_back_to_the_last_decimal_and_to_the_same_bytes() {
    let data = read(&table(3, 7)).unwrap();
    let text = csv(&data);
    let again = read(&text).unwrap();
    assert_eq!((&again.runs, &again.markers), (&data.runs, &data.markers));
    assert_eq!(csv(&again), text);
    assert!(again.coordinates_m.iter().zip(&data.coordinates_m).all(|(a, b)| (a - b).abs() <= 0.5001e-7));
    assert_eq!(text.lines().nth(1), Some("1,epam,0.0000,2.0000,0.0000,load,1,60.0000,0.1000"));
}

#[test]
fn stations_are_written_where_all_are_known_and_labels_are_quoted() {
    let mut data = read(&table(1, 1)).unwrap();
    data.markers[0].station_m = Some(0.06);
    assert!(!csv(&data).contains("s_mm"));
    data.markers[1].station_m = Some(0.36);
    data.markers[1].name = "tip, \"white\"".to_string();
    let again = read(&csv(&data)).unwrap();
    assert_eq!(again.markers, data.markers);
}

#[test]
fn zero_is_written_without_a_sign() {
    let mut data = read(&table(1, 1)).unwrap();
    data.coordinates_m[1] = -1e-9;
    assert!(csv(&data).lines().nth(1).unwrap().ends_with(",0.0000"));
}

#[test]
fn a_dataset_as_a_table_goes_through_csv_unchanged() {
    let data = read(&table(2, 5)).unwrap();
    let table = data.to_table();
    assert_eq!((table.rows(), table.columns.len()), (2 * 5 * 5 * 2, 9));
    let mut bytes = Vec::new();
    table.to_csv(&mut bytes).unwrap();
    let again = read(std::str::from_utf8(&bytes).unwrap()).unwrap();
    assert!(again.coordinates_m.iter().zip(&data.coordinates_m).all(|(a, b)| (a - b).abs() <= 1e-16));
}

#[test]
fn numbers_of_a_table_are_written_so_that_they_read_back_exactly() {
    let columns = vec![
        ("a".to_string(), Column::F64(vec![0.1 + 0.2, f64::NAN, -1e-300])),
        ("b".to_string(), Column::I64(vec![1, -2, i64::MAX])),
        ("c, d".to_string(), Column::Str(vec!["x".into(), "y,\"z\"".into(), String::new()])),
    ];
    let mut bytes = Vec::new();
    Table { columns }.to_csv(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let tiny = format!("{}", -1e-300);
    assert_eq!(
        text,
        format!("a,b,\"c, d\"\n0.30000000000000004,1,x\n,-2,\"y,\"\"z\"\"\"\n{tiny},9223372036854775807,\n")
    );
    assert_eq!(tiny.parse::<f64>().unwrap(), -1e-300);
}

#[test]
fn a_file_is_replaced_whole_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.html");
    write_atomically(&path, b"first").unwrap();
    write_atomically(&path, b"second").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"second");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_folder_that_does_not_exist_is_a_clear_error_and_an_earlier_file_survives() {
    let folder = tempfile::tempdir().unwrap();
    let error = write_atomically(&folder.path().join("no/report.html"), b"x").unwrap_err();
    assert!(error.help().contains("the folder does not exist"), "{error}");
    // A folder in the place of the file makes the last step, the renaming, fail.
    let taken = folder.path().join("taken");
    std::fs::create_dir(&taken).unwrap();
    std::fs::write(taken.join("earlier"), b"x").unwrap();
    assert!(matches!(write_atomically(&taken, b"x"), Err(DataError::File(_))));
    assert!(taken.join("earlier").exists());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
}

#[test]
fn a_dataset_whose_parts_do_not_fit_is_refused() {
    let good = read(&table(2, 5)).unwrap();
    assert_eq!(good.clone().checked().unwrap(), good);
    let short = Dataset { coordinates_m: good.coordinates_m[1..].to_vec(), ..good.clone() };
    let mut nan = good.clone();
    nan.coordinates_m[3] = f64::NAN;
    let mut times = good.clone();
    times.holds[1].t_s.pop();
    let empty = Dataset { runs: Vec::new(), coordinates_m: Vec::new(), ..good };
    for bad in [short, nan, times, empty] {
        assert!(matches!(bad.checked(), Err(DataError::Content(_))));
    }
}

#[cfg(feature = "parquet")]
#[test]
fn a_parquet_file_gives_the_same_dataset_and_the_same_errors_as_csv() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("markers.parquet");
    let data = read(&table(2, 5)).unwrap();
    let mut table = data.to_table();
    table.to_parquet(&path, &[]).unwrap();
    assert_eq!(read_parquet(&path).unwrap(), table);
    let (again, _) = load(&path.display().to_string(), &mut |_, _| ()).unwrap();
    assert_eq!((&again.runs, &again.holds), (&data.runs, &data.holds));
    assert!(again.coordinates_m.iter().zip(&data.coordinates_m).all(|(a, b)| (a - b).abs() <= 1e-16));
    table.columns.retain(|(name, _)| name != "p_act_kpa");
    table.to_parquet(&path, &[]).unwrap();
    let error = load(&path.display().to_string(), &mut |_, _| ()).unwrap_err();
    assert!(error.message().starts_with("column p_act_kpa is missing"), "{error}");
    std::fs::write(&path, b"no parquet").unwrap();
    assert!(read_parquet(&path).unwrap_err().message().starts_with("not a readable Parquet file"));
}

#[cfg(not(feature = "parquet"))]
#[test]
fn without_parquet_support_the_error_says_how_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("markers.parquet");
    std::fs::write(&path, b"x").unwrap();
    for error in [
        read(&table(1, 1)).unwrap().to_table().to_parquet(&path, &[]).unwrap_err(),
        read_parquet(&path).unwrap_err(),
        load(&path.display().to_string(), &mut |_, _| ()).unwrap_err(),
    ] {
        assert!(matches!(error, DataError::Content(_)) && error.help().contains("--features"), "{error}");
    }
}

#[test]
fn readings_of_a_gauge_are_written_and_read_back() {
    let mut data = read(&table(2, 5)).unwrap();
    let count = data.runs.len() * data.holds.len() * data.samples_per_hold;
    data.gauge_pa = Some((0..count).map(|i| 100.0 * i as f64).collect());
    let text = csv(&data);
    assert_eq!(text.lines().next(), Some("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm,p_gauge_kpa"));
    let again = read(&text).unwrap();
    assert_eq!(again.gauge_pa, data.gauge_pa);
    assert_eq!(again.gauge(1).unwrap()[0], 2500.0);
    let mut bytes = Vec::new();
    data.to_table().to_csv(&mut bytes).unwrap();
    assert_eq!(read(std::str::from_utf8(&bytes).unwrap()).unwrap().gauge_pa, data.gauge_pa);
    let short = Dataset { gauge_pa: Some(vec![0.0; count - 1]), ..data };
    assert!(short.checked().unwrap_err().message().contains("readings of the gauge"));
}
