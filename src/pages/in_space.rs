//! The page of a scenario compared with a dataset in x, y and z.

use super::compare::origin;
use super::figures::{LINE_POINTS, MOST_POSES};
use super::{Files, Imprint, PageError, Values, effect};
use crate::shown::in_space::SpaceAnswer;
use crate::words::hold_name;
use ::compare::study::in_space::{InSpace, SpaceMarker, SpaceVariant, loads};
use data::{Column, Table};
use models::Model;
use report::{Drawn, MeasuredPoint, ShapePose, Shapes, shapes};

/// The page and its files.
///
/// # Errors
/// What cannot be drawn.
pub fn space_page(study: &InSpace, imprint: &Imprint) -> Result<Files, PageError> {
    let mut files = Files::default();
    let first = &study.variants[0];
    files.plot("shapes", seen(study, 1)?);
    if study.axes == 3 {
        files.plot("shapes_z", seen(study, 2)?);
    }
    files.table("markers", markers(study))?;
    let name = &first.scenario.name;
    let values = Values::new()
        .with("title", format!("{name} held against {}", study.dataset.name))
        .with("lead", lead(study))
        .with("found", SpaceAnswer::of(name, study))
        .with("provenance", origin(name, &study.dataset, study.about.as_ref(), &study.warnings))
        .with("axes", if study.axes == 3 { "x, y, z" } else { "x, y" });
    files.page("in_space.html", values, imprint)?;
    Ok(files)
}

/// Centre lines and markers of the first model, and the markers measured, with an axis upwards.
fn seen(study: &InSpace, axis: usize) -> Result<Drawn, PageError> {
    let first = &study.variants[0];
    let model = Model::new(&first.scenario);
    let mut state = model.prediction();
    let mut poses = Vec::new();
    let pressed = study.dataset.holds.iter().enumerate().filter(|(_, hold)| hold.sum_act_pa() > 0.0);
    for (index, hold) in pressed.take(MOST_POSES) {
        model.predict(&loads(hold), &mut state)?;
        let own = || first.markers.iter().filter(move |m| m.hold == index);
        let flat = |values: &[f64]| [values[0], values[axis]];
        let point = |m: &SpaceMarker| MeasuredPoint { at_mm: flat(&m.measured_mm), half_width_mm: flat(&m.scatter_mm) };
        let line = model.centre_line_in_space(&state, LINE_POINTS);
        poses.push(ShapePose {
            label: hold_name(&first.holds[index]).split(" kPa").next().map_or(String::new(), |p| format!("{p} kPa")),
            curve_mm: line.iter().map(|p| flat(&p.map(|v| v * 1e3))).collect(),
            predicted_mm: own().map(|m| flat(&m.predicted_mm)).collect(),
            measured: own().map(point).collect(),
        });
    }
    let across = ["y, towards azimuth 0\u{b0} [mm]", "z, towards azimuth 90\u{b0} [mm]"][axis - 1];
    Ok(shapes(&Shapes {
        title: "Predicted and measured shape".into(),
        across: across.into(),
        rest_mm: vec![[0.0, 0.0], [1e3 * first.scenario.length_m, 0.0]],
        body_radius_mm: 1e3 * first.scenario.radius_m,
        poses,
    })?)
}

/// Every marker at every hold of every model, one row each.
pub fn markers(study: &InSpace) -> Table {
    let rows: Vec<(&SpaceVariant, &SpaceMarker)> =
        study.variants.iter().flat_map(|v| v.markers.iter().map(move |m| (v, m))).collect();
    let texts = |value: &dyn Fn(&SpaceVariant, &SpaceMarker) -> String| {
        Column::Str(rows.iter().map(|(v, m)| value(v, m)).collect())
    };
    let numbers = |value: &dyn Fn(&SpaceMarker) -> f64| Column::F64(rows.iter().map(|(_, m)| value(m)).collect());
    let holds = &study.dataset.holds;
    let mut columns = vec![
        ("model".to_string(), texts(&|v, _| v.label.clone())),
        ("phase".to_string(), texts(&|_, m| holds[m.hold].phase.word().into())),
        ("marker".to_string(), texts(&|_, m| m.marker.clone())),
        ("p_body_kpa".to_string(), numbers(&|m| 1e-3 * holds[m.hold].p_body_pa)),
    ];
    for channel in 0..=study.dataset.more_channels() {
        let name = if channel == 0 { "p_act_kpa".into() } else { format!("p_act_{channel}_kpa") };
        let of = |m: &SpaceMarker| 1e-3 * holds[m.hold].channels_pa().nth(channel).unwrap_or(f64::NAN);
        columns.push((name, numbers(&of)));
    }
    for (k, axis) in ["x", "y", "z"].iter().take(study.axes).enumerate() {
        columns.push((format!("{axis}_mm"), numbers(&|m| m.measured_mm[k])));
        columns.push((format!("predicted_{axis}_mm"), numbers(&|m| m.predicted_mm[k])));
    }
    Table { columns }
}

/// The answer in a paragraph.
fn lead(study: &InSpace) -> String {
    let first = &study.variants[0];
    let size = match first.overall.systematic_mm {
        Some(mm) => format!("{mm:.2} mm per coordinate beyond noise"),
        None => format!("{:.2} mm rms per coordinate; the noise is unknown with one run", first.overall.rmse_mm),
    };
    let tip = first
        .worst()
        .map_or(String::new(), |hold| format!("; the outermost marker by up to {:.1} mm", hold.tip_distance_mm));
    format!("**{}** misses the data by {size}{tip}, of {:.1} mm.", effect(&first.label), study.d_max_mm)
}
