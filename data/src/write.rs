//! Marker tables and descriptions as text.

use std::io::Write;

use crate::about::{About, Direct};
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
    let list = |values: Vec<String>| format!("[{}]", values.join(", "));
    let pair = |[a, b]: [f64; 2]| format!("[{a:?}, {b:?}]");
    let (mut text, mut open) = (String::new(), String::new());
    let mut line = |table: &str, key: &str, value: String| {
        // Every run has a separate table, which begins with its label.
        if open != table || key == "id" {
            open = table.to_string();
            text.push_str(&format!("\n[{table}]\n"));
        }
        text.push_str(&format!("{key} = {value}\n"));
    };
    line("", "title", string(&about.title));
    line("", "provenance", string(about.provenance.word()));
    line("", "source", string(&about.source));
    line("", "licence", string(&about.licence));
    for (key, value) in [("actuator", &about.actuator), ("notes", &about.notes)] {
        value.iter().for_each(|value| line("", key, string(value)));
    }
    if let Some(geometry) = &about.geometry {
        let lengths = [
            ("body_radius_mm", Some(geometry.body_radius_m)),
            ("body_length_mm", Some(geometry.body_length_m)),
            ("pouch_length_mm", geometry.pouch_length_m),
            ("pouch_width_mm", geometry.pouch_width_m),
            ("fold_mm", geometry.fold_m),
            ("arm_mm", geometry.arm_m),
        ];
        for (key, length) in lengths {
            length.iter().for_each(|length| line("geometry", key, tidy_mm(*length)));
        }
        geometry.pouches.iter().for_each(|count| line("geometry", "pouches", count.to_string()));
    }
    if !about.markers.is_empty() {
        let markers = about.markers.iter();
        line("markers", "names", list(markers.clone().map(|marker| string(&marker.name)).collect()));
        line("markers", "s_mm", list(markers.map(|marker| tidy_mm(marker.station_m)).collect()));
    }
    if about.direct != Direct::default() {
        line("direct", "pressure", about.direct.pressure.to_string());
        line("direct", "frame", about.direct.frame.to_string());
    }
    if let Some([stiffness, sd]) = about.bending_nm2 {
        line("bending", "stiffness_nm2", format!("{stiffness:?}"));
        line("bending", "sd_nm2", format!("{sd:?}"));
    }
    for found in &about.measured {
        line(&format!("measured.{}", found.effect), &found.key, pair([found.value, found.sd]));
    }
    about.gravity_direction.iter().for_each(|way| line("gravity", "direction", pair(*way)));
    for run in &about.runs {
        line("[run]", "id", string(&run.id));
        line("[run]", "tip_force_n", pair(run.tip_force_n));
        run.session.iter().for_each(|session| line("[run]", "session", string(session)));
    }
    text
}

/// Millimetres rounded to a nanometre, so that 0.36 m is `360.0` and not `360.00000000000006`.
fn tidy_mm(length_m: f64) -> String {
    format!("{:?}", (mm(length_m) * 1e6).round() / 1e6)
}
