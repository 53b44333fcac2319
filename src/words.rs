//! Numbers, pressures and names in words, the same in texts and on pages.

use compare::residuals::HoldLabel;
use models::Loads;

/// A number with `digits` decimals, or a dash where there is none.
///
/// ```
/// assert_eq!([ibr::words::number(Some(1.26), 1), ibr::words::number(None, 1)], ["1.3", "–"]);
/// ```
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

pub(crate) fn effect(name: &str) -> String {
    name.replace('_', " ")
}

/// A sentence with its effects called so.
pub(crate) fn in_words(sentence: &str) -> String {
    let names = models::effects::EFFECTS.iter().map(|e| e.name);
    names.fold(sentence.to_string(), |text, name| text.replace(name, &effect(name)))
}

/// Name of a hold in tables, for example `20/10 kPa load (body 2)`.
pub(crate) fn hold_name(hold: &HoldLabel) -> String {
    let [act, body] = [kpa(hold.p_act_kpa, &hold.p_act_channels_kpa), format!("{:.0}", hold.p_body_kpa)];
    format!("{act} kPa {} (body {body})", hold.phase)
}

/// `20`, or `20/10` where supply channels have pressures of their own.
pub(crate) fn kpa(first: f64, channels: &[f64]) -> String {
    match channels {
        [] => format!("{first:.0}"),
        all => all.iter().map(|p| format!("{p:.0}")).collect::<Vec<_>>().join("/"),
    }
}

/// The text with every control character but line ends and tabs as `?`, one for each of its bytes, so that places in it stay.
pub(crate) fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '\n' | '\t' => out.push(c),
            '\r' if rest.peek() == Some(&'\n') => out.push(c),
            c if c.is_control() => out.extend(std::iter::repeat_n('?', c.len_utf8())),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_shown_and_places_stay() {
        let text = "a\u{1b}[31mred\u{9b}2J\u{7}\rb\tµ\r\nend\n";
        assert_eq!(printable(text), "a?[31mred??2J??b\tµ\r\nend\n");
        assert_eq!(printable(text).len(), text.len());
    }
}
