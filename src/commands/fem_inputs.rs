//! What finite element commands are given: cases and robots by name, pressures, sizes, times.

use super::inputs::quantity;
use crate::prelude::*;
use fem::session::{RunSettings, RunSource, rounded};
use ibr::fe_source;

const PUBLISHED: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

/// Robots as typed and as read, and their entries in the manifest.
type Robots = (Vec<(RunSource, Scenario)>, Vec<Input>);

pub(super) fn robots(specs: &[String]) -> Result<Robots> {
    let own: Vec<String> = PUBLISHED.map(String::from).to_vec();
    let specs = if specs.is_empty() { &own } else { specs };
    let (mut found, mut inputs) = (Vec::new(), Vec::new());
    for spec in specs {
        let source = fe_source(spec)?;
        let message = format!("{spec} is not the scenario of a robot");
        let help = "give scenarios such as spam cpam epam fpam";
        refuse_if(!source.is_robot(), message, help)?;
        inputs.push(Input::of(spec, source.text.as_bytes()));
        let (scenario, _) = source.robot_run()?;
        found.push((source, scenario));
    }
    Ok((found, inputs))
}

/// How runs are made that are kept in a folder by their hash.
pub(super) fn kept(folder: &Path, context: &Context) -> RunSettings {
    let further = Some(ibr::pages::run_plots as fem::session::Further);
    let (folder, threads) = (Some(folder.to_path_buf()), context.threads);
    RunSettings { folder, threads, frames: false, further, maker: maker(), ..RunSettings::default() }
}

/// Reads `--pressure` as comma-separated pressures with units \[kPa\].
pub(super) fn pressures(text: &str) -> Result<Vec<f64>> {
    let one = |p: &str| Ok(rounded(quantity("--pressure", p, Quantity::Pressure)? / 1e3));
    text.split(',').map(one).collect()
}

/// A list of quantities with units, in `1/factor` SI.
pub(super) fn list(option: &str, text: &str, kind: Quantity, factor: f64) -> Result<Vec<f64>> {
    let one = |t: &str| Ok(rounded(quantity(option, t, kind)? * factor));
    text.split(',').filter(|t| !t.trim().is_empty()).map(one).collect()
}

/// Element sizes of body and actuator \[mm\], from `3mm` for both or `8mm/3mm`; several with commas between.
pub(super) fn sizes(text: &str) -> Result<Vec<[f64; 2]>> {
    let one = |size: &str| match rounded(quantity("--mesh", size, Quantity::Length)? * 1e3) {
        mm if (0.5..=50.0).contains(&mm) => Ok(mm),
        mm => Err(Failure::usage(format!("--mesh {mm}mm is out of range"), "write 0.5mm to 50mm, for example 8mm/3mm")),
    };
    let pair = |text: &str| {
        let (body, actuator) = text.split_once('/').unwrap_or((text, text));
        Ok([one(body)?, one(actuator)?])
    };
    text.split(',').map(pair).collect()
}

/// A time of an option, above zero \[s\].
pub(super) fn seconds(option: &str, text: &str) -> Result<f64> {
    // A year is more than any run or checkpoint needs, and less than a duration can hold.
    match quantity(option, text, Quantity::Time)? {
        s if s > 0.0 && s < 3.2e7 => Ok(s),
        _ => Err(Failure::usage(format!("{option} {text} is out of range"), format!("write for example {option} 30s"))),
    }
}
