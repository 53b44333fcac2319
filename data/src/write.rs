//! Writing: marker tables, descriptions, and files that are either whole or not there.

use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

use spelling::files::{clear, folder_of, replace};

use crate::about::{About, Direct, MeasuredValue};
use crate::dataset::Dataset;
use crate::error::DataError;
use crate::units::{kpa, mm};

/// Writes the tidy marker table of a dataset: mm and kPa with four decimals, so that the same data give the same bytes.
/// `z_mm` and pressures of more channels are there if the dataset has them. A column `s_mm` follows if every marker has a station, and `p_gauge_kpa` if there are readings of a gauge. The pressures set
/// are those of the holds (means over runs). What a run lost has no rows.
///
/// # Errors
/// The writer fails.
pub fn write_markers_csv(dataset: &Dataset, out: &mut dyn Write) -> Result<(), DataError> {
    let stations = dataset.markers.iter().all(|marker| marker.station_m.is_some());
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa");
    (1..=dataset.more_channels()).for_each(|channel| text.push_str(&format!(",p_act_{channel}_kpa")));
    text.push_str(",phase,marker,x_mm,y_mm");
    text.push_str(if dataset.z_m.is_some() { ",z_mm" } else { "" });
    text.push_str(if stations { ",s_mm" } else { "" });
    text.push_str(if dataset.gauge_pa.is_some() { ",p_gauge_kpa\n" } else { "\n" });
    for (run, label) in dataset.runs.iter().enumerate() {
        for hold in 0..dataset.holds.len() {
            add_rows(&mut text, dataset, run, label, hold, stations);
        }
        out.write_all(text.as_bytes()).map_err(|cause| cannot_write(&dataset.name, &cause))?;
        text.clear();
    }
    Ok(())
}

/// A set as the files of its folder by name: `about.toml` and `markers.csv`.
///
/// # Errors
/// As [`write_markers_csv`].
pub fn set_files(dataset: &Dataset, about: &About) -> Result<[(String, Vec<u8>); 2], DataError> {
    let mut csv = Vec::new();
    write_markers_csv(dataset, &mut csv)?;
    Ok([("about.toml".into(), about_toml(about).into_bytes()), ("markers.csv".into(), csv)])
}

fn add_rows(text: &mut String, dataset: &Dataset, run: usize, label: &str, hold: usize, stations: bool) {
    let Dataset { actuator, holds, markers, samples_per_hold, .. } = dataset;
    for sample in 0..*samples_per_hold {
        let pressures = std::iter::once(holds[hold].p_body_pa).chain(holds[hold].channels_pa()).map(kpa);
        let state: Vec<String> = std::iter::once(holds[hold].t_s[sample]).chain(pressures).map(fixed).collect();
        let state = state.join(",");
        let gauge = dataset.gauge(run).map(|all| format!(",{}", fixed(kpa(all[hold * samples_per_hold + sample]))));
        let gauge = gauge.unwrap_or_default();
        for (index, marker) in markers.iter().enumerate().filter(|(m, _)| !dataset.is_lost(run, hold, *m)) {
            let place = dataset.place(run, hold, sample, index).into_iter().flatten();
            let place = place.map(|value| fixed(mm(value))).collect::<Vec<_>>().join(",");
            let (phase, name) = (holds[hold].phase.word(), quoted(&marker.name));
            let station = marker.station_m.filter(|_| stations).map_or(String::new(), |s| format!(",{}", fixed(mm(s))));
            // Writing into a String cannot fail.
            let _ =
                writeln!(text, "{},{},{state},{phase},{name},{place}{station}{gauge}", quoted(label), quoted(actuator));
        }
    }
}

/// Four decimals, without a minus sign before zero.
fn fixed(value: f64) -> String {
    let text = format!("{value:.4}");
    if text == "-0.0000" { "0.0000".to_string() } else { text }
}

/// A label as a CSV cell.
pub(crate) fn quoted(label: &str) -> String {
    if label.contains([',', '"', ';', '\t', '\n', '\r']) {
        format!("\"{}\"", label.replace('"', "\"\""))
    } else {
        label.to_string()
    }
}

/// The text of an `about.toml` that reads back as `about`.
pub fn about_toml(about: &About) -> String {
    let string = |value: &str| toml::Value::from(value).to_string();
    let mut text = String::new();
    let mut line = |key: &str, value: String| text.push_str(&format!("{key} = {value}\n"));
    line("title", string(&about.title));
    line("provenance", string(about.provenance.word()));
    line("source", string(&about.source));
    line("licence", string(&about.licence));
    about.actuator.iter().for_each(|kind| line("actuator", string(kind)));
    about.notes.iter().for_each(|notes| line("notes", string(notes)));
    if let Some(geometry) = &about.geometry {
        text.push_str("\n[geometry]\n");
        let lengths = [
            ("body_radius_mm", Some(geometry.body_radius_m)),
            ("body_length_mm", Some(geometry.body_length_m)),
            ("pouch_length_mm", geometry.pouch_length_m),
            ("pouch_width_mm", geometry.pouch_width_m),
            ("fold_mm", geometry.fold_m),
            ("arm_mm", geometry.arm_m),
        ];
        for (key, length) in lengths {
            length.iter().for_each(|&length| text.push_str(&format!("{key} = {}\n", tidy_mm(length))));
        }
        geometry.pouches.iter().for_each(|count| text.push_str(&format!("pouches = {count}\n")));
    }
    if !about.markers.is_empty() {
        let names: Vec<_> = about.markers.iter().map(|marker| string(&marker.name)).collect();
        let stations: Vec<_> = about.markers.iter().map(|marker| tidy_mm(marker.station_m)).collect();
        text.push_str(&format!("\n[markers]\nnames = [{}]\ns_mm = [{}]\n", names.join(", "), stations.join(", ")));
    }
    if about.direct != Direct::default() {
        let Direct { pressure, frame } = about.direct;
        text.push_str(&format!("\n[direct]\npressure = {pressure}\nframe = {frame}\n"));
    }
    if let Some([stiffness, sd]) = about.bending_nm2 {
        text.push_str(&format!("\n[bending]\nstiffness_nm2 = {stiffness:?}\nsd_nm2 = {sd:?}\n"));
    }
    for MeasuredValue { effect, key, value, sd, .. } in &about.measured {
        // A table is opened once; its parameters follow each other.
        let header = format!("\n[measured.{effect}]\n");
        if !text.contains(&header) {
            text.push_str(&header);
        }
        text.push_str(&format!("{key} = [{value:?}, {sd:?}]\n"));
    }
    if let Some([x, y]) = about.gravity_direction {
        text.push_str(&format!("\n[gravity]\ndirection = [{x:?}, {y:?}]\n"));
    }
    for run in &about.runs {
        let [x, y] = run.tip_force_n;
        text.push_str(&format!("\n[[run]]\nid = {}\ntip_force_n = [{x:?}, {y:?}]\n", string(&run.id)));
        run.session.iter().for_each(|session| text.push_str(&format!("session = {}\n", string(session))));
    }
    text
}

/// Millimetres rounded to a nanometre, so that 0.36 m is `360.0` and not `360.00000000000006`.
fn tidy_mm(length_m: f64) -> String {
    format!("{:?}", (mm(length_m) * 1e6).round() / 1e6)
}

/// Writes `bytes` to `path`, whole or not at all, and removes what a kill left of earlier tries. The folder must exist.
///
/// # Errors
/// The folder does not exist or is not writable, or the disk is full; an earlier file at `path` is then untouched.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), DataError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    clear(&folder_of(path), &|whole| whole == name);
    replace(path, &mut |out| out.write_all(bytes)).map_err(|cause| cannot_write(&path.display().to_string(), &cause))
}

pub(crate) fn cannot_write(shown: &str, cause: &std::io::Error) -> DataError {
    let help = match cause.kind() {
        std::io::ErrorKind::NotFound => "the folder does not exist: create it, or give another with --out",
        std::io::ErrorKind::PermissionDenied => "the folder is not writable: give another, or change its permissions",
        std::io::ErrorKind::StorageFull => "free some disk space, or give a folder on another disk",
        _ => "give another path",
    };
    DataError::file(shown, format!("cannot write: {cause}"), help)
}
