//! Pressure logs of LabVIEW, serial monitors, files without names, clocks and dates: the reference, or what to type.

use super::{case, equals_reference, pixels, read, refused, told};
use data::import::{ImportOptions, Imported, Offset, import};

const RUNS: [&str; 3] =
    ["cases/c01-deeplabcut/run1.csv", "cases/c01-deeplabcut/run2.csv", "cases/c01-deeplabcut/run3.csv"];

fn log(name: &str) -> ImportOptions {
    pixels(&format!("cases/c26-pressure-loggers/{name}"))
}

/// The clocks of the loggers begin at midnight, the camera's at 10:11:12.
const BEGIN: Offset = Offset::Given(36_672.0);

#[test]
fn labview_text_is_read() {
    let made = read(&RUNS, &log("labview.lvm"));
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    told(&made, &["pressure log: read as LabVIEW text"]);
}

#[test]
fn a_serial_monitor_is_read() {
    let options = ImportOptions { pressure_unit_pa: Some(1e3), offset: BEGIN, ..log("arduino_serial.txt") };
    let made = read(&RUNS, &options);
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    told(&made, &["read as the text of a serial monitor"]);
    let unit = ImportOptions { pressure_unit_pa: None, ..options.clone() };
    refused(&RUNS, &unit, &["arduino_serial.txt", "pb names no unit", "--pressure-unit kPa"]);
}

#[test]
fn a_log_without_names_is_read_with_names_and_refused_without() {
    let plain = log("arduino_noheader.csv");
    let words = ["arduino_noheader.csv:1", "1000, 2.00, 0.00", "--log-columns t_s,p_body_kpa,p_act_kpa"];
    refused(&RUNS, &plain, &words);
    let names = |names: &str| names.split(',').map(str::to_string).collect::<Vec<_>>();
    let made = read(&RUNS, &ImportOptions { log_columns: names("t_ms,p_body_kpa,p_act_kpa"), ..plain.clone() });
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    refused(&RUNS, &ImportOptions { log_columns: names("t_ms,p_kpa"), ..plain }, &["names 2 columns, the row has 3"]);
}

#[test]
fn options_that_a_log_with_names_and_units_does_not_need_are_reported() {
    let plain = || log("labview.lvm");
    let names = ["t_s", "p_act_kpa", "p_body_kpa"].map(String::from).to_vec();
    for file in ["cases/c26-pressure-loggers/labview.lvm", "cases/c01-deeplabcut/pressure.csv"] {
        let named = ImportOptions { log_columns: names.clone(), ..pixels(file) };
        told(&read(&RUNS, &named), &["pressure log: its columns have names: --log-columns was not used"]);
    }
    let psi = ImportOptions { pressure_unit_pa: Some(6894.757), ..plain() };
    told(&read(&RUNS, &psi), &["column p_act (kPa) names its unit: --pressure-unit was not used for it"]);
    let kpa = read(&RUNS, &ImportOptions { pressure_unit_pa: Some(1e3), ..plain() });
    assert!(kpa.told.iter().all(|told| !told.contains("--pressure-unit")), "{:?}", kpa.told);
}

/// A column that the caller skips needs no unit, and one without a unit has the caller's name.
#[test]
fn names_of_the_caller_stand_for_names_without_units() {
    let names = |names: &str| names.split(',').map(str::to_string).collect::<Vec<_>>();
    let row = |t: f64, pressures: &str| format!("{},0.4,{pressures}", 1e3 * t);
    let read = |given: &str| {
        let options = ImportOptions { log_columns: names(given), ..pixels("") };
        other("Clock,Pressure (V),Inner (V),Outer (V)\n", row, ImportOptions { body_pa: None, ..options })
    };
    let made = read("t_ms,-,p_body_kpa,p_act_kpa").unwrap();
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    assert!(made.told.iter().all(|word| !word.contains("--log-columns")), "{:?}", made.told);
}

/// A long table with pressures of any names: the refusal names their columns.
#[test]
fn columns_that_may_be_pressures_are_named() {
    let text = std::fs::read_to_string(case("cases/reference_markers.csv")).unwrap();
    let text = text.replacen("p_body_kpa,p_act_kpa", "Body,Sensor", 1);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.csv");
    std::fs::write(&path, text).unwrap();
    let files = [path];
    super::refused_paths(&files, &ImportOptions::default(), &["--pressure log.csv", "--map p_act=Sensor,p_body=Body"]);
    let typed = [("p_act", "Sensor"), ("p_body", "Body")].map(|(a, b)| (a.to_string(), b.to_string())).to_vec();
    let options = ImportOptions { columns: typed, pressure_unit_pa: Some(1e3), ..ImportOptions::default() };
    assert!(import(&files, &options, &mut |_, _| ()).is_ok());
}

/// The reference's pressures with other times and another head.
fn other(head: &str, row: impl Fn(f64, &str) -> String, options: ImportOptions) -> Result<Imported, data::DataError> {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(case("cases/c01-deeplabcut/pressure.csv")).unwrap();
    let line = |line: &str| {
        let (time, pressures) = line.split_once(',').unwrap();
        row(time.parse().unwrap(), pressures)
    };
    let path = folder.path().join("other.csv");
    std::fs::write(&path, text.lines().skip(1).map(line).fold(head.to_string(), |all, line| all + &line + "\n"))
        .unwrap();
    let files = RUNS.map(case);
    import(&files, &ImportOptions { pressure_logs: vec![path], ..options }, &mut |_, _| ())
}

fn clock(t: f64) -> String {
    let t = t + 36_672.0;
    format!("{:02}:{:02}:{:06.3}", (t / 3600.0) as u32 % 24, (t / 60.0) as u32 % 60, t % 60.0)
}

#[test]
fn dates_and_clocks_units_below_names_and_lines_above_them_are_read() {
    let begin = || ImportOptions { offset: BEGIN, ..log("labview.lvm") };
    for (head, date) in [
        ("Timestamp,Body (kPa),Pressure (kPa)\n", "2026-03-02T"),
        ("Date/Time,Body (kPa),Pressure (kPa)\n", "02.03.2026 "),
        ("Date,Time,Body (kPa),Pressure (kPa)\n", "3/2/2026,"),
        ("Device: DAQ\nSerial 12\n\nDate,Time,Body,Pressure\n,[s],[kPa],[kPa]\n", "2026-03-02,"),
    ] {
        let made = other(head, |t, pressures| format!("{date}{},{pressures}", clock(t)), begin());
        let made = made.unwrap_or_else(|error| panic!("{head}: {error}; {}", error.help()));
        assert_eq!(equals_reference(&made, 3, 0.0).len(), 3, "{head}");
    }
    let late = 86_400.0 - 15.0 - 36_672.0;
    let offset = Offset::Given(86_400.0 - 15.0);
    let row = |t: f64, pressures: &str| format!("{},{pressures}", clock(t + late));
    let made = other("time,p_body_kpa,p_act_kpa\n", row, ImportOptions { offset, ..begin() }).unwrap();
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3, "a clock goes on after midnight");
    let error = other("when,volts\n", |t, _| format!("{t},1"), begin()).unwrap_err();
    assert!(
        error.to_string().contains("no column of the pressure log is the time") && error.help().contains("--map t=")
    );
}

#[test]
fn two_readings_at_one_time_that_differ_are_refused() {
    let head = "time_s,p_body_kpa,p_act_kpa\n";
    let twice = |more: &'static str| move |t: f64, p: &str| format!("{t},{p}") + if t == 6.0 { more } else { "" };
    let error = other(head, twice("\n6,2,55"), log("labview.lvm")).unwrap_err();
    let said = format!("{error} | {}", error.help());
    let words = ["other.csv:6", "both 10.0 and 55.0 kPa at 6 s", "delete the wrong row", "decimals"];
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
    let made = other(head, twice("\n6,2,10"), log("labview.lvm")).unwrap();
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    assert!(other(head, twice("\n6,2.05,10.1"), log("labview.lvm")).is_ok(), "noise of a sensor");
}

/// A LabVIEW file of the reference's pressures with another header before its second part.
fn in_segments(change: impl Fn(f64) -> f64, names: &str) -> Result<Imported, data::DataError> {
    let head = |names: &str| {
        format!(
            "Channels\t2\t\nY_Unit_Label\tkPa\tkPa\nX0\t0\t0\nDelta_X\t0.5\t0.5\n***End_of_Header***\t\nX_Value\t{names}\n"
        )
    };
    let first = "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\n".to_string();
    let row = |t: f64, pressures: &str| {
        let begin = if t == 11.0 { format!("\n{}", head(names)) } else { String::new() };
        format!("{begin}{}\t{}", if t < 11.0 { t } else { change(t) }, pressures.replace(',', "\t"))
    };
    other(&(first + &head("p_body\tp_act")), row, log("labview.lvm"))
}

#[test]
fn segments_of_a_labview_file_are_one_log() {
    let made = in_segments(|t| t, "p_body\tp_act").unwrap();
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 3);
    told(&made, &["read as LabVIEW text of 2 segments"]);
    let same = in_segments(|t| t - 10.0, "p_body\tp_act").unwrap_err();
    assert!(same.to_string().contains("other.csv:24: the time of the pressure log goes back"), "{same}");
    let exchanged = in_segments(|t| t, "p_act\tp_body").unwrap_err();
    assert!(exchanged.to_string().contains("other.csv:23: this segment has other channels"), "{exchanged}");
}
