//! `ibr data import`

use super::inputs::quantity;
use super::{Context, Outcome};
use crate::cli::Import;
use crate::failure::Failure;
use crate::output::{Input, check_folder, check_set_folder, spares_inputs, write_files};
use data::import::{FileAxis, FilePlace, ImportOptions, Imported, Offset, QUANTITIES, Scale, import, read_board};
use ibr::pages::{Files, tracks_plot};
use models::scenario::quantity::Quantity;
use serde_json::json;
use spelling::units::{Dimension, units_of};
use std::path::Path;

/// Three runs of an ePAM with sealed edges as DeepLabCut writes them, and the log of their pressures.
const EXAMPLE: [(&str, &str); 4] = [
    ("run1.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run1.csv")),
    ("run2.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run2.csv")),
    ("run3.csv", include_str!("../../data/tests/cases/c01-deeplabcut/run3.csv")),
    ("pressure.csv", include_str!("../../data/tests/cases/c01-deeplabcut/pressure.csv")),
];

pub fn run(args: &Import, context: &mut Context) -> Result<Outcome, Failure> {
    if let Some(folder) = &args.example {
        return make_example(folder, context);
    }
    let options = options(args)?;
    if let Some(folder) = &args.out {
        check_set_folder(folder, args.force)?;
    }
    let mut tell =
        |done: u64, total: u64| (context.progress)("reading tracks", Some(done as f64 / total.max(1) as f64));
    let made = import(&args.files, &options, &mut tell)?;
    let mut text = told(&made);
    match &args.out {
        Some(folder) => {
            let (files, inputs) = (files(&made)?, inputs(args));
            spares_inputs(folder, &files, &inputs.iter().map(|input| input.name.clone()).collect::<Vec<_>>())?;
            write_files(folder, &files, &inputs, context)?;
            text.push_str(&format!(
                "\nmarkers.csv, about.toml and tracks in {}; answer the questions in about.toml, then\n  ibr data check {0}\n",
                folder.display()
            ));
        }
        None => text.push_str("\nNothing was written: add --out FOLDER\n"),
    }
    Ok(Outcome::new(text, to_json(&made, args)))
}

fn make_example(folder: &Path, context: &mut Context) -> Result<Outcome, Failure> {
    check_folder(folder)?;
    if let Some((name, _)) = EXAMPLE.iter().find(|(name, _)| folder.join(name).exists()) {
        let message = format!("{} exists", folder.join(name).display());
        return Err(Failure::usage(message, "give another folder to --example"));
    }
    let mut files = Files::default();
    EXAMPLE.iter().for_each(|(name, text)| files.text(name, (*text).to_string()));
    write_files(folder, &files, &[], context)?;
    let shown = folder.display();
    let text = format!(
        "Three runs of DeepLabCut at 30 frames per second and 3.1 px to a millimetre, the base at pixel 212, 540\n\
         ibr data import {shown}/run*.csv --pressure {shown}/pressure.csv --fps 30 --scale 3.1px/mm --base 212,540 --actuator epam\n"
    );
    let names: Vec<String> = EXAMPLE.iter().map(|(name, _)| folder.join(name).display().to_string()).collect();
    Ok(Outcome::new(text, json!({"schema": "ibr.data.import.example", "version": 1, "files": names})))
}

/// Runs with a picture.
const MOST_PICTURES: usize = 10;

/// What was understood, a line each.
fn told(made: &Imported) -> String {
    let set = &made.dataset;
    let lines: String = made.told.iter().map(|line| format!("- {line}\n")).collect();
    let count = |n: usize, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
    let sizes = [(set.runs.len(), "run"), (set.holds.len(), "hold"), (set.markers.len(), "marker")];
    format!("{}\n{lines}", sizes.map(|(n, word)| count(n, word)).join(", "))
}

fn to_json(made: &Imported, args: &Import) -> serde_json::Value {
    let set = &made.dataset;
    let names = set.markers.iter().map(|marker| marker.name.as_str()).collect::<Vec<_>>();
    json!({
        "schema": "ibr.data.import", "version": 1, "program": made.program, "runs": set.runs, "markers": names,
        "holds": set.holds.len(), "told": made.told, "folder": args.out.as_ref().map(|out| out.display().to_string()),
    })
}

fn files(made: &Imported) -> Result<Files, Failure> {
    let mut files = Files::default();
    for (k, track) in made.tracks.iter().take(MOST_PICTURES).enumerate() {
        let name = if k == 0 { "tracks".to_string() } else { format!("tracks-{}", k + 1) };
        files.plot(&name, tracks_plot(track)?);
    }
    files.text("about.toml", made.about_toml.clone());
    files.text("markers.csv", made.markers_csv.clone());
    Ok(files)
}

fn inputs(args: &Import) -> Vec<Input> {
    let read = args.files.iter().chain(&args.pressure).chain(&args.board);
    read.map(|path| Input::of(&path.display().to_string(), &std::fs::read(path).unwrap_or_default())).collect()
}

fn options(args: &Import) -> Result<ImportOptions, Failure> {
    let pressure = |option: &str, text: &Option<String>| {
        text.as_ref().map(|text| quantity(option, text, Quantity::Pressure)).transpose()
    };
    let bin_pa = pressure("--bin", &args.bin)?;
    if let Some(text) = args.bin.as_ref().filter(|_| bin_pa.is_some_and(|bin| bin <= 0.0)) {
        return Err(Failure::usage(format!("--bin {text} is not above zero"), "write for example --bin 2kPa"));
    }
    Ok(ImportOptions {
        pressure_logs: args.pressure.clone(),
        scale: scale(args)?,
        base: args.base.as_ref().map(|text| place(text)),
        axes: args.axes.as_ref().map(|text| axes(text)).transpose()?,
        turn_rad: quantity("--turn", &args.turn, Quantity::Angle)?,
        likelihood: args.likelihood.map(|limit| within("--likelihood", limit, [0.0, 1.0])).transpose()?,
        frames_per_s: args.fps.map(|fps| within("--fps", fps, [1e-3, 1e6])).transpose()?,
        offset: offset(args.clock_offset.as_deref())?,
        body_pa: pressure("--body-pressure", &args.body_pressure)?,
        room_pa: pressure("--room", &args.room)?,
        pressure_unit_pa: args
            .pressure_unit
            .as_ref()
            .map(|unit| quantity("--pressure-unit", &format!("1{unit}"), Quantity::Pressure))
            .transpose()?,
        bin_pa,
        least_hold_s: seconds("--hold", &args.hold)?,
        least_frames: args.frames as usize,
        settle_s: seconds("--settle", &args.settle)?,
        columns: args.map.iter().map(|text| column(text)).collect::<Result<_, _>>()?,
        actuator: args.actuator.clone(),
        markers: args.markers.iter().map(|name| name.trim().to_string()).collect(),
        stations_m: args.stations.iter().map(|text| station(text)).collect::<Result<_, _>>()?,
    })
}

fn within(option: &str, value: f64, [low, high]: [f64; 2]) -> Result<f64, Failure> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(Failure::usage(
        format!("{option} {value} is not from {low} to {high}"),
        format!("see ibr data import --help for {option}"),
    ))
}

fn scale(args: &Import) -> Result<Scale, Failure> {
    if let Some(text) = &args.known_distance {
        let help = "write two markers or places and their distance: a:b=40mm or 10,20:300,25=90mm";
        let wrong = || Failure::usage(format!("--known-distance {text} is not understood"), help);
        let (places, length) = text.rsplit_once('=').ok_or_else(wrong)?;
        let (a, b) = places.split_once(':').ok_or_else(wrong)?;
        let length_m = quantity("--known-distance", length, Quantity::Length)?;
        return if length_m > 0.0 { Ok(Scale::Known([place(a), place(b)], length_m)) } else { Err(wrong()) };
    }
    if let (Some(board), Some(square)) = (&args.board, &args.square) {
        return Ok(Scale::Board(read_board(board)?, quantity("--square", square, Quantity::Length)?));
    }
    let Some(text) = args.scale.as_deref().map(str::trim) else { return Ok(Scale::OfFile) };
    let help = "write 3.1px/mm, 0.32mm/px, or the unit of the file's numbers: mm, cm, m";
    let wrong = || Failure::usage(format!("--scale {text} is not understood"), help);
    let unit =
        |word: &str| units_of(Dimension::LENGTH).find(|unit| unit.symbol == word.trim()).map(|unit| unit.factor());
    let value = |number: &str| number.trim().parse::<f64>().ok().filter(|v| *v > 0.0 && v.is_finite());
    match text.split_once('/') {
        None => unit(text).map(Scale::Unit).ok_or_else(wrong),
        Some((left, "px")) => {
            let at = left.find(|c: char| c.is_alphabetic()).unwrap_or(left.len());
            let metres = value(&left[..at]).zip(unit(&left[at..])).map(|(number, factor)| number * factor);
            metres.map(|metres| Scale::PixelsPerMetre(1.0 / metres)).ok_or_else(wrong)
        }
        Some((left, right)) => {
            let pixels = left.strip_suffix("px").and_then(value);
            pixels.zip(unit(right)).map(|(pixels, factor)| Scale::PixelsPerMetre(pixels / factor)).ok_or_else(wrong)
        }
    }
}

/// `X,Y` or a marker.
fn place(text: &str) -> FilePlace {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.filter(|numbers| matches!(numbers.len(), 2 | 3)) {
        Some(numbers) => FilePlace::At(numbers),
        None => FilePlace::Marker(text.trim().to_string()),
    }
}

fn axes(text: &str) -> Result<[FileAxis; 2], Failure> {
    let axis = |word: &str| {
        let (turned, letter) =
            word.trim().strip_prefix('-').map_or((false, word.trim().trim_start_matches('+')), |rest| (true, rest));
        let index = ["x", "y", "z"].iter().position(|known| known.eq_ignore_ascii_case(letter))?;
        Some(FileAxis { index, turned })
    };
    let found = text.split_once(',').and_then(|(along, towards)| Some([axis(along)?, axis(towards)?]));
    let help = "write the file's axis along the robot and the one towards the actuator, for example x,-y";
    found
        .filter(|[a, b]| a.index != b.index)
        .ok_or_else(|| Failure::usage(format!("--axes {text} is not understood"), help))
}

fn offset(text: Option<&str>) -> Result<Offset, Failure> {
    match text {
        None => Ok(Offset::Same),
        Some("find") => Ok(Offset::Find),
        Some(text) => Ok(Offset::Given(seconds("--clock-offset", text)?)),
    }
}

fn seconds(option: &str, text: &str) -> Result<f64, Failure> {
    let at = text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len());
    let unit = units_of(Dimension::TIME).find(|unit| unit.symbol == text[at..].trim());
    let found = text[..at].trim().parse::<f64>().ok().zip(unit).map(|(value, unit)| unit.to_si(value));
    found.filter(|v| v.is_finite()).ok_or_else(|| {
        Failure::usage(format!("{option} {text} is no time"), format!("write a number and s, ms or min: {option} 0.5s"))
    })
}

fn column(text: &str) -> Result<(String, String), Failure> {
    let wrong = || {
        let help = format!("write WHAT=COLUMN, where WHAT is one of {}", QUANTITIES.join(", "));
        Failure::usage(format!("--map {text} is not understood"), help)
    };
    let (what, column) = text.split_once('=').ok_or_else(wrong)?;
    let known = QUANTITIES.contains(&what.trim());
    if known { Ok((what.trim().to_string(), column.trim().to_string())) } else { Err(wrong()) }
}

fn station(text: &str) -> Result<(String, f64), Failure> {
    let help = "write MARKER=LENGTH for every marker, for example --stations a=90mm,b=210mm";
    let wrong = || Failure::usage(format!("--stations {text} is not understood"), help);
    let (name, length) = text.rsplit_once('=').ok_or_else(wrong)?;
    let length_m = quantity("--stations", length, Quantity::Length)?;
    if length_m >= 0.0 { Ok((name.trim().to_string(), length_m)) } else { Err(wrong()) }
}
