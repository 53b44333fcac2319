//! `ibr data check | list | generate | fem`

use super::inputs::{self, quantity};
use super::tables::{number, table};
use super::{Context, Outcome, list};
use crate::cli::{DataCommand, Generate};
use crate::failure::Failure;
use crate::output::{check_folder, write_files};
use compare::slips::slips;
use compare::study::generate::{Generator, generate, parse_protocol};
use data::{About, CheckReport, Dataset, Direct, Geometry, MarkerStation, Provenance};
use ibr::pages::Files;
use models::Scenario;
use models::scenario::quantity::Quantity;
use serde_json::json;
use std::path::Path;

pub fn run(command: &DataCommand, context: &mut Context) -> Result<Outcome, Failure> {
    match command {
        DataCommand::Check { data } => check(data, context),
        DataCommand::List => list::run(Some("datasets")),
        DataCommand::Generate(args) => make(args, context),
        DataCommand::Fem(args) => super::data_fem::run(args, context),
    }
}

fn check(spec: &str, context: &mut Context) -> Result<Outcome, Failure> {
    if let Some(bench) = data::bench::bench(spec)? {
        let words =
            format!("{spec}: {}, {} rows ({})\n", bench.kind.sentence, bench.rows.len(), bench.provenance.word());
        let check = json!({"kind": bench.kind.name, "rows": bench.rows.len(), "provenance": bench.provenance.word()});
        return Ok(Outcome::new(words, json!({"schema": "ibr.data.check", "version": 1, "check": check})));
    }
    let (dataset, about, _) = inputs::dataset(spec, context)?;
    let mut report = data::check(&dataset, about.as_ref());
    let stations_m: Option<Vec<f64>> = dataset.markers.iter().map(|marker| marker.station_m).collect();
    let radius_m = about.as_ref().and_then(|about| about.geometry.as_ref()).map(|geometry| geometry.body_radius_m);
    if let Some((stations_m, radius_m)) = stations_m.zip(radius_m) {
        report.warnings.extend(slips(&dataset, &stations_m, radius_m));
    }
    Ok(Outcome::new(check_text(&report), json!({"schema": "ibr.data.check", "version": 1, "check": report})))
}

fn check_text(report: &CheckReport) -> String {
    let mut out = format!(
        "{}: {} runs of actuator {}, {} holds, {} markers, {} samples per hold{}\n",
        report.name,
        report.runs.len(),
        report.actuator,
        report.holds.len(),
        report.markers.len(),
        report.samples_per_hold,
        report.provenance.as_ref().map_or(String::new(), |p| format!(" ({p})"))
    );
    let holds = report.holds.iter().map(|h| {
        let cells = [format!("{:.2}", h.p_act_kpa), format!("{:.2}", h.p_body_kpa), h.phase.into()];
        let rest = [format!("{:.1}", h.duration_s), number(h.scatter_mm, 2)];
        let read = h.gauge_kpa.map(|kpa| format!("{kpa:.2}"));
        cells.into_iter().chain(rest).chain(read).collect()
    });
    let head = ["P [kPa]", "body [kPa]", "phase", "duration [s]", "scatter of runs [mm]", "gauge [kPa]"];
    let head = &head[..head.len() - usize::from(report.holds.iter().any(|h| h.gauge_kpa.is_none()))];
    out.push_str(&table(head, 0, holds.collect()));
    let markers = report.markers.iter().map(|m| vec![m.name.clone(), number(m.s_mm, 1), number(m.scatter_mm, 2)]);
    out.push_str(&table(&["marker", "station [mm]", "scatter of runs [mm]"], 1, markers.collect()));
    for o in &report.outliers {
        out.push_str(&format!(
            "outlier: run {}, hold {}, sample {}, marker {}: {:+.1}, {:+.1} mm off\n",
            o.run,
            o.hold + 1,
            o.sample + 1,
            o.marker,
            o.dx_mm,
            o.dy_mm
        ));
    }
    for [a, b] in &report.identical_runs {
        out.push_str(&format!("runs {a} and {b} are identical copies\n"));
    }
    report.warnings.iter().for_each(|w| out.push_str(&format!("note: {w}\n")));
    out
}

fn make(args: &Generate, context: &mut Context) -> Result<Outcome, Failure> {
    let generator = generator(args)?;
    check_folder(&args.out)?;
    let named = inputs::scenario(&args.scenario)?;
    if named.scenario.markers_m.is_empty() {
        let message = format!("the scenario {} has no marker stations", args.scenario);
        return Err(Failure::usage(
            message,
            "add [markers] with s_mm = [30, 90, 150] to it: places in mm from the base",
        ));
    }
    folder_is_free(&args.out, args.force)?;
    let name = args.out.file_name().map_or("synthetic".into(), |n| n.to_string_lossy().into_owned());
    let dataset = generate(&named.scenario, &name, &generator)?;
    let mut csv = Vec::new();
    data::write_markers_csv(&dataset, &mut csv)?;
    let about = about(&named.scenario, &dataset, &generator);
    let mut files = Files::default();
    files.files.push(("about.toml".into(), data::about_toml(&about).into_bytes()));
    files.files.push(("markers.csv".into(), csv));
    files.files.push(("truth.toml".into(), named.text.into_bytes()));
    write_files(&args.out, &files, &[named.input], context)?;
    let text = format!("{} values of {} runs in {}\n", dataset.xy_m.len(), dataset.runs.len(), args.out.display());
    let json = json!({"schema": "ibr.data.generate", "version": 1, "folder": args.out.display().to_string(), "runs": dataset.runs.len()});
    Ok(Outcome::new(text, json))
}

fn generator(args: &Generate) -> Result<Generator, Failure> {
    Ok(Generator {
        seed: args.seed,
        runs: args.runs as usize,
        protocol: parse_protocol(&args.protocol)?,
        camera_sd_m: scatter("--sigma", &args.scatter.sigma)?,
        pressure_sd: pressure_scatter(args.scatter.pressure_scatter)?,
        alignment_sd_m: scatter("--alignment", &args.scatter.alignment)?,
        gauge: args.gauge,
        ..Generator::default()
    })
}

/// Refuses a folder with data in it, unless forced.
pub fn folder_is_free(folder: &Path, force: bool) -> Result<(), Failure> {
    if !force && folder.join("markers.csv").exists() {
        let message = format!("{} already holds a dataset", folder.display());
        return Err(Failure::usage(message, "choose another folder, or add --force to replace it"));
    }
    Ok(())
}

/// A scatter of pressures as typed in per cent, as a share.
pub fn pressure_scatter(percent: f64) -> Result<f64, Failure> {
    if (0.0..=50.0).contains(&percent) {
        return Ok(percent / 100.0);
    }
    Err(Failure::usage(format!("--pressure-scatter {percent} is not from 0 to 50 per cent"), "2 is usual"))
}

/// A scatter of lengths as typed \[m\].
pub fn scatter(option: &str, text: &str) -> Result<f64, Failure> {
    match quantity(option, text, Quantity::Length)? {
        v if (0.0..=0.1).contains(&v) => Ok(v),
        v => Err(Failure::usage(format!("{option} {v} m is not from 0 to 100 mm"), "1mm is usual")),
    }
}

/// Description of generated data.
pub fn about(scenario: &Scenario, dataset: &Dataset, g: &Generator) -> About {
    let shape = &scenario.actuator.shape;
    let stations = dataset.markers.iter().zip(&scenario.markers_m);
    About {
        title: format!("Synthetic markers of {}", scenario.name),
        provenance: Provenance::Synthetic,
        source: format!("ibr data generate, seed {}", g.seed),
        licence: "CC0-1.0".into(),
        actuator: Some(dataset.actuator.clone()),
        geometry: Some(Geometry {
            body_radius_m: scenario.radius_m,
            body_length_m: scenario.length_m,
            pouch_length_m: Some(shape.length_m),
            pouch_width_m: Some(shape.width_m),
            pouches: Some(scenario.actuator.count),
            fold_m: (shape.fold_m > 0.0).then_some(shape.fold_m),
            arm_m: scenario.actuator.arm_m,
        }),
        markers: stations.map(|(m, s)| MarkerStation { name: m.name.clone(), station_m: *s }).collect(),
        gravity_direction: None,
        direct: Direct::default(),
        bending_nm2: None,
        measured: Vec::new(),
        runs: vec![],
        notes: Some(format!(
            "Not a measurement. Camera noise {} mm per coordinate; run to run: pressure {} %, alignment {} mm, rotation {} mrad. \
             The recorded pressures are the set ones.",
            g.camera_sd_m * 1e3,
            g.pressure_sd * 100.0,
            g.alignment_sd_m * 1e3,
            g.rotation_sd * 1e3
        )),
    }
}
