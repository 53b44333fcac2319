//! What is typed for `ibr data import`, as the library takes it.

use super::inputs::quantity;
use crate::cli::Import;
use crate::failure::Failure;
use data::import::{FileAxis, FilePlace, ImportOptions, Offset, QUANTITIES, Scale, read_board};
use models::scenario::quantity::Quantity;
use spelling::units::{Dimension, units_of};

/// All of them.
pub fn options(args: &Import) -> Result<ImportOptions, Failure> {
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
