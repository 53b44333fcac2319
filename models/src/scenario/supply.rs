//! `[supply]`: time constant of the valve and flow of its line.

use super::given::{Checked, Given, refuse};
use super::raw::Entries;
use crate::line::{Line, REFERENCE_PA};
use toml::Spanned;

/// b where the data sheet has none: between a tube and a sharp orifice.
const USUAL_RATIO: f64 = 0.3;

pub(super) fn line(table: &Spanned<Entries>) -> Checked<Line> {
    let supply = Given::new("supply", table)?;
    let [valve, conductance, ratio, volume] =
        ["valve_time_s", "conductance_l_per_s_bar", "critical_ratio", "volume_ml"].map(|key| supply.number(key));
    let (valve, ratio) = (valve?, ratio?);
    let flow_per_s = match (conductance?, volume?) {
        (Some(conductance), Some(volume)) => REFERENCE_PA * conductance / volume,
        (None, None) if ratio.is_none() && valve.is_some() => f64::INFINITY,
        _ => {
            let help = "give valve_time_s, or conductance_l_per_s_bar with volume_ml, or all three";
            return refuse("[supply] is not complete".into(), help, supply.span);
        }
    };
    Ok(Line { valve_time_s: valve.unwrap_or(0.0), flow_per_s, critical_ratio: ratio.unwrap_or(USUAL_RATIO) })
}
