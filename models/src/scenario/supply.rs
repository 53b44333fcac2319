//! `[supply]`: valve and line.

use super::check::{Checked, optional, refuse};
use super::raw::RawSupply;
use crate::line::{Line, REFERENCE_PA};
use spelling::units::Range;
use toml::Spanned;

const TIME: Range = Range {
    name: "valve time",
    unit: "s",
    too_large: "write seconds: 0.05 for 50 ms",
    ..Range::plain(0.0, 60.0, "0 is a valve without lag")
};
const CONDUCTANCE: Range = Range {
    name: "conductance",
    unit: "l/(s bar)",
    // dm³/(s·bar) in m³/(s·Pa).
    si: 1e-8,
    ..Range::plain(1e-4, 1e3, "write litres per second and bar (ISO 6358), for example 0.1")
};
const RATIO: Range = Range { name: "critical ratio", ..Range::plain(0.0, 0.8, "0.2 to 0.5 are usual") };
const VOLUME: Range = Range {
    name: "volume",
    unit: "ml",
    si: 1e-6,
    ..Range::plain(0.01, 1e6, "write millilitres of actuator and tube, for example 400")
};
/// b where the data sheet has none: between a tube and a sharp orifice.
const USUAL_RATIO: f64 = 0.3;

/// The line; conductance and volume belong together.
pub(super) fn line(raw: &Spanned<RawSupply>) -> Checked<Line> {
    let supply = raw.get_ref();
    let valve = optional(&supply.valve_time_s, &TIME)?;
    let conductance = optional(&supply.conductance_l_per_s_bar, &CONDUCTANCE)?;
    let (ratio, volume) = (optional(&supply.critical_ratio, &RATIO)?, optional(&supply.volume_ml, &VOLUME)?);
    let flow_per_s = match (conductance, volume) {
        (Some(conductance), Some(volume)) => REFERENCE_PA * conductance / volume,
        (None, None) if ratio.is_none() && valve.is_some() => f64::INFINITY,
        _ => {
            let help = "give valve_time_s, or conductance_l_per_s_bar with volume_ml, or all three";
            return refuse("[supply] is not complete".into(), help, raw.span());
        }
    };
    Ok(Line { valve_time_s: valve.unwrap_or(0.0), flow_per_s, critical_ratio: ratio.unwrap_or(USUAL_RATIO) })
}
