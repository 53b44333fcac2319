//! Options of `ibr data import`, as the library takes them.

use super::inputs::{bounded, positive, quantity};
use crate::cli::Import;
use crate::prelude::*;
use data::import::typed::{axes, column, station};
use data::import::{ImportOptions, Scale, read_board};
use spelling::quantity::Quantity;
use spelling::units::Range;

pub(crate) fn options(args: &Import) -> Result<ImportOptions> {
    let bin_pa = optional(&args.bin, |text| quantity("--bin", text, Quantity::Pressure))?;
    if let Some(text) = args.bin.as_ref().filter(|_| bin_pa.is_some_and(|bin| bin <= 0.0)) {
        return Err(Failure::usage(format!("--bin {text} is not above zero"), "write for example --bin 2kPa"));
    }
    let unit = |unit: &str| quantity("--pressure-unit", &format!("1{unit}"), Quantity::Pressure);
    Ok(ImportOptions {
        pressure_logs: args.pressure.clone(),
        scale: scale(args)?,
        base: optional(&args.base, |text| understood("--base", text.parse()))?,
        axes: optional(&args.axes, |text| understood("--axes", axes(text)))?,
        turn_rad: quantity("--turn", &args.turn, Quantity::Angle)?,
        likelihood: args.likelihood.map(likelihood).transpose()?,
        frames_per_s: args.fps.map(frames_per_s).transpose()?,
        offset: optional(&args.clock_offset, |text| understood("--clock-offset", text.parse()))?.unwrap_or_default(),
        body_pa: optional(&args.body_pressure, |text| {
            bounded("--body-pressure", text, Quantity::Pressure, &Range::BODY_PRESSURE)
        })?,
        room_pa: optional(&args.room, |text| quantity("--room", text, Quantity::Pressure))?,
        pressure_unit_pa: optional(&args.pressure_unit, unit)?,
        log_columns: args.log_columns.iter().map(|name| name.trim().to_string()).collect(),
        bin_pa,
        least_hold_s: quantity("--hold", &args.hold, Quantity::Time)?,
        least_frames: args.frames as usize,
        settle_s: quantity("--settle", &args.settle, Quantity::Time)?,
        columns: args.map.iter().map(|text| understood("--map", column(text))).collect::<Result<_, _>>()?,
        actuator: args.actuator.clone(),
        markers: args.markers.iter().map(|name| name.trim().to_string()).collect(),
        stations_m: args
            .stations
            .iter()
            .map(|text| understood("--stations", station(text)))
            .collect::<Result<_, _>>()?,
    })
}

fn scale(args: &Import) -> Result<Scale> {
    let Some(board) = &args.board else {
        return Ok(optional(&args.scale, |text| understood("--scale", text.parse()))?.unwrap_or_default());
    };
    let message = format!("--board {board} has no side of a square");
    let unsized_board = || Failure::usage(message, "write for example --board corners.csv=25mm");
    let (file, square) = board.rsplit_once('=').ok_or_else(unsized_board)?;
    let square_m = positive("--board FILE=LENGTH", Some(&square.to_string()))?.unwrap_or_default();
    Ok(Scale::Board(read_board(Path::new(file))?, square_m))
}

fn optional<T>(text: &Option<String>, read: impl Fn(&str) -> Result<T>) -> Result<Option<T>> {
    text.as_deref().map(read).transpose()
}

fn understood<T, E: std::fmt::Display>(option: &str, typed: Result<T, E>) -> Result<T> {
    typed.map_err(|message| Failure::usage(format!("{option}: {message}"), "see ibr data import --help"))
}

fn frames_per_s(fps: f64) -> Result<f64> {
    Range::FRAME_RATE.check(fps).map_err(|(message, help)| Failure::usage(format!("--fps: {message}"), help))
}

fn likelihood(limit: f64) -> Result<f64> {
    let refused = || Failure::usage(format!("--likelihood {limit} is not from 0 to 1"), "see ibr data import --help");
    Some(limit).filter(|limit| (0.0..=1.0).contains(limit)).ok_or_else(refused)
}
