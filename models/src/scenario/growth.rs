//! `[growth]`: numbers of a robot that grows by eversion at its tip.

use super::given::{Checked, Given, fault};
use super::raw::Entries;
use super::stated::Growth;
use toml::Spanned;

pub(super) fn growth(table: &Spanned<Entries>) -> Checked<Growth> {
    let given = Given::new("growth", table)?;
    let (Some(tip_force_n), Some(friction)) = (given.number("tip_force_n")?, given.number("friction")?) else {
        return fault("[growth] is not complete")
            .help("give tip_force_n and friction, for example tip_force_n = 2.3 and friction = 0.3")
            .at(given.span);
    };
    let break_away_n = given.number("break_away_n")?.unwrap_or(tip_force_n);
    if break_away_n < tip_force_n {
        return fault(format!("break_away_n = {break_away_n} is below tip_force_n = {tip_force_n}"))
            .help("a tube starts at a higher force than it halts; exchange the two, or leave break_away_n out")
            .at(given.span_of("break_away_n"));
    }
    let (speed_at_1n_m_per_s, exponent) = (given.number("speed_at_1n_m_per_s")?, given.number("exponent")?);
    if speed_at_1n_m_per_s.is_none() && exponent.is_some() {
        return fault("exponent without a speed")
            .help("add speed_at_1n_m_per_s, the speed 1 N beyond the halt, or remove exponent")
            .at(given.span_of("exponent"));
    }
    Ok(Growth {
        tip_force_n,
        break_away_n,
        friction,
        tail_weight_n_per_m: given.number("tail_weight_n_per_m")?.unwrap_or(0.0),
        base_tension_n: given.number("base_tension_n")?.unwrap_or(0.0),
        speed_at_1n_m_per_s,
        exponent: exponent.unwrap_or(1.0),
    })
}
