//! Pressures typed with their unit, as on a command line.

pub use spelling::quantity::{Quantity, parse};

/// Reads a comma-separated list of pressures; in each, `/` separates supply channels: `10kPa/20kPa,30kPa`.
///
/// # Errors
/// Like [`parse`]; also too many channels or a negative pressure.
pub fn parse_pressures(text: &str) -> Result<Vec<[f64; crate::CHANNELS]>, String> {
    text.split(',').map(channels).collect()
}

fn channels(text: &str) -> Result<[f64; crate::CHANNELS], String> {
    let given = text.split('/').map(|p| parse(p, Quantity::Pressure)).collect::<Result<Vec<f64>, String>>()?;
    if let Some(p) = given.iter().find(|p| **p < 0.0) {
        return Err(format!("`{text}`: {} kPa is below zero; pressures are gauge pressures", p / 1e3));
    }
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
}
