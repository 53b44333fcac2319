//! Numbers, pressures and names in words, the same in texts and on pages.

use compare::study::in_space::{SpaceHold, SpaceVariant};
use models::Loads;

/// A number with `digits` decimals, or a dash where there is none.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "–".into(), |v| format!("{v:.digits$}"))
}

/// Pressures of the channels \[kPa\]; one number where they are equal.
pub fn pressure_words(loads: &Loads) -> String {
    let p = loads.actuator_pa;
    if p.iter().all(|x| *x == p[0]) {
        return format!("{:.3}", p[0] / 1e3);
    }
    p.map(|x| format!("{:.3}", x / 1e3).trim_end_matches('0').trim_end_matches('.').to_string()).join("/")
}

/// An effect as it is called in words.
pub(crate) fn effect(name: &str) -> String {
    name.replace('_', " ")
}

/// A sentence with its effects called so.
pub(crate) fn in_words(sentence: &str) -> String {
    let names = models::effects::EFFECTS.iter().map(|e| e.name);
    names.fold(sentence.to_string(), |text, name| text.replace(name, &effect(name)))
}

/// Values along the axes with their signs: `+0.1, -2.3, +0.0`.
pub(crate) fn along(values: &[f64]) -> String {
    values.iter().map(|v| format!("{v:+.2}")).collect::<Vec<_>>().join(", ")
}

/// `20/10 kPa load (body 2)`.
pub(crate) fn hold_name(hold: &SpaceHold) -> String {
    let channels: Vec<String> = hold.p_act_channels_kpa.iter().map(|p| format!("{p:.0}")).collect();
    let again = if hold.occurrence > 0 { format!(" ({})", hold.occurrence + 1) } else { String::new() };
    format!("{} kPa {}{again} (body {:.0})", channels.join("/"), hold.phase, hold.p_body_kpa)
}

/// Where a model misses most in space, in sentences.
pub(crate) fn misses(variant: &SpaceVariant) -> Vec<String> {
    let (all, names) = (&variant.overall, ["x", "y", "z"]);
    let within = all.systematic_mm.zip(all.noise_floor_mm).filter(|(beyond, noise)| beyond < noise);
    let within =
        within.map(|(beyond, noise)| format!("Over all holds {beyond:.2} mm are beyond a noise of {noise:.2} mm."));
    let tip = variant.worst().map(|hold| {
        let (name, off, axes) = (hold_name(hold), hold.tip_distance_mm, along(&hold.tip_error_mm));
        format!(
            "The outermost marker is off most at {name}: {off:.2} mm, model minus measurement along the axes {axes} mm."
        )
    });
    let total: f64 = all.rmse_axes_mm.iter().map(|v| v * v).sum();
    let share = |(name, v): (&&str, &f64)| format!("{name} {:.0} %", 100.0 * v * v / total);
    let shares: Vec<String> = names.iter().zip(&all.rmse_axes_mm).map(share).collect();
    let shares = (total > 0.0).then(|| format!("Of the mean square error: {}.", shares.join(", ")));
    within.into_iter().chain(tip).chain(shares).collect()
}
