//! `ibr data check | list | generate | fem`

use super::inputs::{self, quantity};
use super::{Context, Outcome, list};
use crate::cli::{DataCommand, Generate};
use crate::failure::Failure;
use crate::output::{check_folder, write_files};
use crate::shown::check::check_text;
use compare::Evidence;
use compare::slips::slips;
use compare::study::generate::{Generator, about, generate, parse_protocol};
use ibr::pages::Files;
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
    let Evidence { dataset, about, .. } = inputs::evidence(spec, context)?;
    let mut report = data::check(&dataset, about.as_ref());
    let stations_m: Option<Vec<f64>> = dataset.markers.iter().map(|marker| marker.station_m).collect();
    let radius_m = about.as_ref().and_then(|about| about.geometry.as_ref()).map(|geometry| geometry.body_radius_m);
    if let Some((stations_m, radius_m)) = stations_m.zip(radius_m) {
        report.warnings.extend(slips(&dataset, &stations_m, radius_m));
    }
    Ok(Outcome::new(check_text(&report), json!({"schema": "ibr.data.check", "version": 1, "check": report})))
}

fn make(args: &Generate, context: &mut Context) -> Result<Outcome, Failure> {
    let generator = generator(args)?;
    check_folder(&args.out)?;
    let named = inputs::scenario(&args.scenario)?;
    if named.markers_m.is_empty() {
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
    files.files.push(("truth.toml".into(), named.text.clone().into_bytes()));
    write_files(&args.out, &files, &inputs::named(&named, [])?, context)?;
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
