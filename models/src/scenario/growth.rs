//! `[growth]`: numbers of a robot that grows by eversion at its tip.

use super::given::{Checked, Given, fault};
use super::raw::Entries;
use toml::Spanned;

/// What growth by eversion takes, measured on the tube; [`crate::grown`] has its mechanics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Force Y = ½ P A at which a tube without tail tension halts \[N\].
    pub tip_force_n: f64,
    /// Force ½ P A at which it starts from rest, and more than ½ P A by which inverting it starts \[N\].
    pub break_away_n: f64,
    /// Coefficient of friction μ of the tail on the wall \[-\].
    pub friction: f64,
    /// Weight w of the tail per length \[N/m\].
    pub tail_weight_n_per_m: f64,
    /// Pull T₀ of the spool on the tail at the base \[N\].
    pub base_tension_n: f64,
    /// Speed v₁ of the tip 1 N beyond the halt \[m/s\]; `None`: not measured.
    pub speed_at_1n_m_per_s: Option<f64>,
    /// Exponent n of the speed \[-\].
    pub exponent: f64,
}

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
