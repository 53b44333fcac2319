//! Tables that are read, and what comes out.

use super::{read, read_bytes, table};
use crate::{Column, Dataset, Phase, ReadOptions, Table, load, markers_of_table, parse_about};

#[test]
fn a_table_becomes_the_tensor_in_si_units() {
    let data = read(&table(3, 7)).unwrap();
    assert_eq!((data.name.as_str(), data.actuator.as_str()), ("markers", "epam"));
    assert_eq!(data.runs, ["1", "2", "3"]);
    assert_eq!(data.holds.len(), 5);
    assert_eq!((data.samples_per_hold, data.coordinates_m.len()), (5, 3 * 5 * 5 * 2 * 2));
    let pressures: Vec<_> = data.holds.iter().map(|hold| (hold.p_act_pa, hold.phase, hold.occurrence)).collect();
    let load = |p| (p, Phase::Load, 0);
    assert_eq!(pressures, [load(0.0), load(1e4), load(2e4), load(3e4), (0.0, Phase::Unload, 0)]);
    assert!(data.holds.iter().all(|hold| hold.p_body_pa == 2000.0));
    let [x, y] = data.xy(1, 3, 4, 1);
    assert!((x - 0.3597).abs() < 1e-12 && (y - 0.1202).abs() < 1e-12, "{x} {y}");
}

#[test]
fn samples_are_means_of_consecutive_frames_of_nearly_equal_number() {
    // 7 frames at 0, 0.5 … 3 s in 5 bins: frames 0 | 1 | 2,3 | 4 | 5,6.
    let data = read(&table(1, 7)).unwrap();
    assert_eq!(data.holds[0].t_s, [0.0, 0.5, 1.25, 2.0, 2.75]);
    assert_eq!(data.holds[1].t_s, [5.0, 5.5, 6.25, 7.0, 7.75]);
}

#[test]
fn the_smallest_series_sets_the_number_of_samples() {
    let text = table(2, 6);
    let last = text.trim_end().lines().last().unwrap();
    // Two frames of one marker in one hold are lost: four are left there.
    let lost: Vec<_> =
        text.lines().filter(|line| *line != last && !line.starts_with("2,ePAM,22,2,0,unload,2")).collect();
    let data = read(&(lost.join("\n") + "\n")).unwrap();
    assert_eq!(data.samples_per_hold, 4);
    assert_eq!(read(&table(2, 1)).unwrap().samples_per_hold, 1);
}

#[test]
fn rows_by_time_and_rows_by_marker_give_the_same_data() {
    let text = table(2, 6);
    let (header, rows) = text.split_once('\n').unwrap();
    let mut by_marker: Vec<&str> = rows.lines().collect();
    by_marker.sort_by_key(|row| (row.split(',').next(), row.split(',').nth(6)));
    assert_ne!(by_marker, rows.lines().collect::<Vec<_>>());
    assert_eq!(read(&format!("{header}\n{}\n", by_marker.join("\n"))).unwrap(), read(&text).unwrap());
}

#[test]
fn units_delimiters_marks_comments_case_and_extra_columns_do_not_change_the_data() {
    let text = table(2, 5);
    let expected = read(&text).unwrap();
    let (header, rows) = text.split_once('\n').unwrap();
    let semicolons =
        format!("\u{feff}# camera 3\n# second line\n{header}\n{rows}").replace(',', ";").replace('\n', "\r\n");
    assert_eq!(read(&semicolons).unwrap(), expected);
    let tabs = text.replace(',', "\t");
    assert_eq!(read(&tabs).unwrap(), expected);
    let extra: Vec<_> = rows.lines().map(|row| format!("\"a, b\",{row},0.3")).collect();
    let upper = header.replace("x_mm", "X_MM").replace("p_act_kpa", "p_act_kPa");
    assert_eq!(read(&format!("note,{upper},x_px\n{}", extra.join("\n"))).unwrap(), expected);
    let in_m: Vec<String> = rows.lines().map(|row| convert(row, 7, 1e3)).map(|row| convert(&row, 3, 1e-3)).collect();
    let header = header.replace("x_mm", "x_m").replace("p_body_kpa", "p_body_pa");
    let expected = Dataset { pressure_units: ["kPa", "Pa"], ..expected };
    assert_eq!(read(&format!("{header}\n{}", in_m.join("\n"))).unwrap(), expected);
}

fn convert(row: &str, column: usize, divisor: f64) -> String {
    let mut cells: Vec<String> = row.split(',').map(str::to_string).collect();
    cells[column] = (cells[column].parse::<f64>().unwrap() / divisor).to_string();
    cells.join(",")
}

#[test]
fn a_y_down_column_is_turned() {
    let text = table(2, 5);
    let (header, rows) = text.split_once('\n').unwrap();
    let turned: Vec<String> = rows.lines().map(|row| convert(row, 8, -1.0)).collect();
    let text_down = format!("{}\n{}", header.replace("y_mm", "y_down_mm"), turned.join("\n"));
    assert_eq!(read(&text_down).unwrap(), read(&text).unwrap());
}

#[test]
fn holds_repeated_at_one_pressure_are_counted_and_pressure_scatter_between_runs_is_no_new_hold() {
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for (run, gain) in [(1, 0.97), (2, 1.03)] {
        for (hold, (p, phase)) in [(0.0, "load"), (20.0, "load"), (0.0, "unload"), (20.0, "load")].iter().enumerate() {
            text += &format!("{run},spam,{hold},2,{},{phase},1,60,{p}\n", p * gain);
        }
    }
    let data = read(&text).unwrap();
    let seen: Vec<_> = data.holds.iter().map(|hold| (hold.p_act_pa.round(), hold.occurrence)).collect();
    assert_eq!(seen, [(0.0, 0), (20_000.0, 0), (0.0, 0), (20_000.0, 1)]);
}

#[test]
fn holds_in_another_order_are_aligned_by_pressure_and_phase() {
    let head = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n";
    let text = format!(
        "{head}1,spam,0,2,0,load,1,60,0\n1,spam,1,2,10,load,1,60,1\n1,spam,2,2,20,load,1,60,2\n\
                        2,spam,0,2,0,load,1,60,0\n2,spam,1,2,20,load,1,60,2\n2,spam,2,2,10,load,1,60,1\n"
    );
    let data = read(&text).unwrap();
    assert_eq!(data.run(0), data.run(1));
    assert_eq!(data.holds[2].t_s, [1.5]);
}

#[test]
fn runs_one_after_the_other_on_one_clock_begin_together() {
    let text = table(2, 5);
    let later: Vec<String> =
        text.lines().map(|row| if row.starts_with("2,") { shift(row, 100.0) } else { row.to_string() }).collect();
    let data = read(&later.join("\n")).unwrap();
    assert_eq!(data.holds, read(&text).unwrap().holds);
    let clock: Vec<String> =
        text.lines().map(|row| if row.starts_with('r') { row.to_string() } else { shift(row, 1e6) }).collect();
    assert_eq!(read(&clock.join("\n")).unwrap().holds[0].t_s[0], 0.0);
}

fn shift(row: &str, by_s: f64) -> String {
    let mut cells: Vec<String> = row.split(',').map(str::to_string).collect();
    cells[2] = (cells[2].parse::<f64>().unwrap() + by_s).to_string();
    cells.join(",")
}

#[test]
fn markers_are_ordered_by_station_wherever_it_comes_from() {
    let text = table(2, 5);
    let far_first =
        text.replace(",load,1,", ",load,9,").replace(",load,2,", ",load,root,").replace(",load,9,", ",load,tip,");
    let far_first = far_first.replace(",unload,1,", ",unload,tip,").replace(",unload,2,", ",unload,root,");
    assert_eq!(read(&far_first).unwrap().markers[0].name, "tip");
    let about =
        "title='t'\nprovenance='measured'\nsource='s'\nlicence='l'\n[markers]\nnames=['tip','root']\ns_mm=[360,60]";
    let about = parse_about("about.toml", about).unwrap();
    let data = read_bytes(far_first.as_bytes(), ReadOptions { about: Some(&about), ..ReadOptions::default() }).unwrap();
    let markers: Vec<_> = data.markers.iter().map(|marker| (marker.name.as_str(), marker.station_m)).collect();
    assert_eq!(markers, [("root", Some(0.06)), ("tip", Some(0.36))]);
    let (header, rows) = text.split_once('\n').unwrap();
    let rows: Vec<_> =
        rows.lines().map(|row| format!("{row},{}", if row.contains("load,2,") { 30 } else { 90 })).collect();
    let data = read(&format!("{header},s_mm\n{}", rows.join("\n"))).unwrap();
    assert_eq!(data.markers[0].station_m, Some(0.03));
}

#[test]
fn one_of_several_actuators_is_chosen_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.csv");
    let epam = table(1, 5);
    let spam: String = epam.lines().skip(1).map(|row| row.replace("ePAM", "sPAM") + "\n").collect();
    std::fs::write(&path, epam.clone() + &spam).unwrap();
    let spec = |kind: &str| format!("{}{kind}", path.display());
    assert_eq!(load(&spec("#spam"), &mut |_, _| ()).unwrap().0.actuator, "spam");
    assert_eq!(load(&spec("#EPAM"), &mut |_, _| ()).unwrap().0.coordinates_m, read(&epam).unwrap().coordinates_m);
    let error = load(&spec(""), &mut |_, _| ()).unwrap_err();
    assert_eq!(error.message(), "several actuators in one file: epam and spam");
    assert!(error.help().contains("#epam"), "{}", error.help());
    let error = load(&spec("#fpam"), &mut |_, _| ()).unwrap_err();
    assert_eq!(error.message(), "no rows of actuator fpam; found epam, spam");
}

#[test]
fn a_folder_is_loaded_with_its_description_and_name() {
    let folder = tempfile::tempdir().unwrap();
    let set = folder.path().join("monday");
    std::fs::create_dir(&set).unwrap();
    std::fs::write(set.join("markers.csv"), table(2, 5)).unwrap();
    let (data, about) = load(&set.display().to_string(), &mut |_, _| ()).unwrap();
    assert!(data.name == "monday" && about.is_none());
    let text = "title='t'\nprovenance='measured'\nsource='s'\nlicence='l'\nactuator='ePAM'\n[[run]]\nid='2'\ntip_force_n=[0,0.3]";
    std::fs::write(set.join("about.toml"), text).unwrap();
    let about = load(&set.display().to_string(), &mut |_, _| ()).unwrap().1.unwrap();
    assert_eq!((about.tip_force_n("2"), about.tip_force_n("1")), ([0.0, 0.3], [0.0, 0.0]));
}

#[test]
fn a_gauge_that_reads_just_below_zero_counts_as_zero() {
    let data = read(&table(1, 5).replace(",2,0,load", ",2,-0.04,load")).unwrap();
    assert_eq!(data.holds[0].p_act_pa, 0.0);
}

#[test]
fn a_table_at_hand_is_read_as_its_file_would_be() {
    let wanted = read(&table(3, 7)).unwrap();
    let mut at_hand = wanted.to_table();
    assert_eq!(markers_of_table("markers", &at_hand, None).unwrap(), wanted);
    if let Some((_, Column::F64(y))) = at_hand.columns.iter_mut().find(|(name, _)| name == "y_mm") {
        y.pop();
    }
    let error = markers_of_table("markers", &at_hand, None).unwrap_err();
    assert!(error.to_string().starts_with("markers, column y_mm: column y_mm has"), "{error}");
    let nothing = markers_of_table("markers", &Table::default(), None).unwrap_err();
    assert!(nothing.help().contains("run,actuator"), "{}", nothing.help());
}
