//! Pressures typed with their unit, as on a command line.

use spelling::units::Range;

pub use spelling::quantity::{Quantity, parse};

/// Largest number of pressures in one list; longer ones are refused.
pub const MOST: usize = 100_000;

/// Reads a comma-separated list of pressures; in each, `/` separates supply channels: `10kPa/20kPa,30kPa`. A range is its first
/// value, its last and the step: `0:30:0.5kPa`; the last is met where whole steps lead there.
///
/// # Errors
/// Like [`parse`]; also too many channels or pressures, a negative pressure, and a range that leads nowhere.
pub fn parse_pressures(text: &str) -> Result<Vec<[f64; crate::CHANNELS]>, String> {
    let mut all = Vec::new();
    for part in text.split(',') {
        match part.contains(':') {
            true => all.extend(range(part, MOST)?.into_iter().map(|pa| [pa; crate::CHANNELS])),
            false => all.push(channels(part)?),
        }
        if all.len() > MOST {
            return Err(format!("more than {MOST} pressures; ibr sweep computes more, in parts"));
        }
    }
    Ok(all)
}

fn range(text: &str, most: usize) -> Result<Vec<f64>, String> {
    let wrong =
        |why: &str| format!("`{text}` {why}; write first:last:step with the unit at the end, for example 0:30:0.5kPa");
    let [first, last, step] = text.split(':').collect::<Vec<_>>()[..] else { return Err(wrong("is not a range")) };
    let unit = step.trim_start_matches(|c: char| c.is_ascii_digit() || ".+-eE ".contains(c));
    let value = |number: &str| match number.trim().parse::<f64>() {
        Ok(_) => parse(&format!("{}{unit}", number.trim()), Quantity::Pressure),
        Err(_) => parse(number, Quantity::Pressure),
    };
    let [first, last, step] = [value(first)?, value(last)?, parse(step, Quantity::Pressure)?];
    if first < 0.0 || last < first || step <= 0.0 {
        return Err(wrong("does not lead from a pressure to a higher one"));
    }
    // A hair more than a whole number of steps is a whole number.
    let steps = ((last - first) / step * (1.0 + 1e-12) + 1e-9).floor();
    if steps >= most as f64 {
        return Err(format!("`{text}` has more than {most} pressures; ibr sweep computes more, in parts"));
    }
    Ok((0..=steps as usize).map(|i| (first + i as f64 * step).min(last)).collect())
}

fn channels(text: &str) -> Result<[f64; crate::CHANNELS], String> {
    let given = text.split('/').map(|p| parse(p, Quantity::Pressure)).collect::<Result<Vec<f64>, String>>()?;
    let bounded = |p: &f64| Range::ACTUATOR_PRESSURE.check(*p).map(drop);
    given.iter().try_for_each(bounded).map_err(|(message, help)| format!("`{text}`: {message}; {help}"))?;
    match given.as_slice() {
        [one] => Ok([*one; crate::CHANNELS]),
        many if many.len() <= crate::CHANNELS => {
            let mut all = [0.0; crate::CHANNELS];
            all[..many.len()].copy_from_slice(many);
            Ok(all)
        }
        many => Err(format!("`{text}` names {} channels; there are {}", many.len(), crate::CHANNELS)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_separated_by_slashes() {
        assert_eq!(parse_pressures("10kPa/20kPa,5kPa").unwrap(), [[10e3, 20e3, 0.0, 0.0], [5e3; 4]]);
        assert!(parse_pressures("1kPa/1kPa/1kPa/1kPa/1kPa").is_err());
        assert!(parse_pressures("-1kPa").is_err());
    }

    #[test]
    fn a_range_has_both_ends_and_one_unit() {
        let all = parse_pressures("0:30:0.01kPa").unwrap();
        assert_eq!((all.len(), all[0], all[3000]), (3001, [0.0; 4], [30e3; 4]));
        assert!((all[1999][0] - 19.99e3).abs() < 1e-6);
        assert_eq!(parse_pressures("1kPa,0.1bar:0.2bar:4kPa").unwrap(), [[1e3; 4], [10e3; 4], [14e3; 4], [18e3; 4]]);
        for bad in
            ["0:30kPa", "30:0:1kPa", "0:30:0kPa", "0:30:1", "-5:30:1kPa", "0:30:1e-9kPa", "0:1:2:3kPa", "a:30:1kPa"]
        {
            assert!(parse_pressures(bad).is_err(), "{bad}");
        }
        assert!(parse_pressures("0:30:1e-9kPa").unwrap_err().contains("ibr sweep"));
    }
}
