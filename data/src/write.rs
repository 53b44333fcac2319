//! Marker tables and descriptions as text.

use std::io::Write;

use crate::about::{About, Direct, MeasuredValue};
use crate::atomic::cannot_write;
use crate::dataset::Dataset;
use crate::error::Result;
use crate::table::{Column, Table};
use crate::units::mm;

/// Writes the tidy marker table of a dataset: mm and kPa with four decimals, so that the same data give the same bytes.
/// The columns are as in [`Dataset::to_table`]. Pressures are means over the runs of a hold. What a run lost has no rows.
pub fn write_markers_csv(dataset: &Dataset, out: &mut dyn Write) -> Result<()> {
    let Table { mut columns } = dataset.to_table();
    // Phase and marker come before the place.
    let labels: Vec<_> = columns.drain(2..4).collect();
    let place = columns.iter().position(|(name, _)| name == "x_mm").unwrap_or(columns.len());
    columns.splice(place..place, labels);
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = names.join(",") + "\n";
    let rows = columns.first().map_or(0, |(_, column)| column.len());
    for row in 0..rows {
        let cell = |(_, column): &(String, Column)| match column {
            Column::F64(values) => fixed(values[row]),
            other => other.cell(row),
        };
        text.push_str(&(columns.iter().map(cell).collect::<Vec<_>>().join(",") + "\n"));
    }
    out.write_all(text.as_bytes()).map_err(|cause| cannot_write(&dataset.name, &cause))
}

/// A set as the files of its folder by name: `about.toml` and `markers.csv`.
pub fn set_files(dataset: &Dataset, about: &About) -> Result<[(String, Vec<u8>); 2]> {
    let mut csv = Vec::new();
    write_markers_csv(dataset, &mut csv)?;
    Ok([("about.toml".into(), about_toml(about).into_bytes()), ("markers.csv".into(), csv)])
}

/// Four decimals, without a minus sign before zero.
fn fixed(value: f64) -> String {
    let text = format!("{value:.4}");
    if text == "-0.0000" { "0.0000".to_string() } else { text }
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
