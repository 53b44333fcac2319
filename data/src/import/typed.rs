//! What the caller knows of a tracking file, as people type it. Errors name the mistake and what to type.

use super::columns::QUANTITIES;
use super::options::{FileAxis, FilePlace, Offset, Scale};
use spelling::quantity::{Quantity, parse};
use spelling::units::{Dimension, Range, units_of};
use std::str::FromStr;

/// `X,Y`, `X,Y,Z` or the name of a marker.
impl FromStr for FilePlace {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<FilePlace, Self::Err> {
        let numbers = text.split(',').map(|part| part.trim().parse().ok());
        let numbers = numbers.collect::<Option<Vec<f64>>>().unwrap_or_default();
        let is_place = matches!(numbers.len(), 2 | 3) && numbers.iter().all(|v| v.is_finite());
        Ok(if is_place { FilePlace::At(numbers) } else { FilePlace::Marker(text.trim().to_string()) })
    }
}

/// Reads an axis as typed: `x`, `-y`, `+z`.
impl FromStr for FileAxis {
    type Err = String;

    fn from_str(text: &str) -> Result<FileAxis, String> {
        let text = text.trim();
        let turned = text.starts_with('-');
        let letter = text.trim_start_matches(['-', '+']);
        let mut axes = ["x", "y", "z"].iter();
        match axes.position(|known| known.eq_ignore_ascii_case(letter)) {
            Some(index) => Ok(FileAxis { index, turned }),
            None => Err(format!("`{text}` is not an axis: write x, y or z, or -y where it is turned")),
        }
    }
}

/// The file's axis along the robot and the one towards the actuator: `x,-y`.
///
/// ```
/// let [along, towards] = data::import::typed::axes("x,-y").unwrap();
/// assert_eq!((along.index, towards.index, towards.turned), (0, 1, true));
/// assert!(data::import::typed::axes("x,x").is_err());
/// ```
///
/// # Errors
/// Not two axes, or one twice.
pub fn axes(text: &str) -> Result<[FileAxis; 2], String> {
    let example = "write the file's axis along the robot and the one towards the actuator, for example x,-y";
    let wrong = || not_understood(text, example);
    let (along, towards) = text.split_once(',').ok_or_else(wrong)?;
    let both = [along.parse::<FileAxis>()?, towards.parse()?];
    if both[0].index == both[1].index { Err(wrong()) } else { Ok(both) }
}

/// `3.1px/mm`, `0.32mm/px`, the unit of the file's numbers, or a known distance: `a:b=40mm`, `10,20:300,25=90mm`.
impl FromStr for Scale {
    type Err = String;

    fn from_str(text: &str) -> Result<Scale, String> {
        let text = text.trim();
        if text.contains(':') {
            return known_distance(text);
        }
        let metres = |word: &str| {
            let digit = word.rfind(|c: char| c.is_ascii_digit() || c == '.');
            let (number, unit) = word.split_at(digit.map_or(0, |last| last + 1));
            let number = if number.trim().is_empty() { Some(1.0) } else { above_zero(number) };
            let unit = units_of(Dimension::LENGTH).find(|known| known.symbol == unit.trim());
            Some(number? * unit?.factor())
        };
        let pixels = |word: &str| above_zero(word.trim().strip_suffix("px")?);
        let is_whole = |scale: &Scale| match scale {
            Scale::PixelsPerMetre(value) | Scale::Unit(value) => value.is_normal(),
            _ => true,
        };
        let per_metre = |left: &str, right: &str| Some(pixels(left)? / metres(right)?);
        let found = match text.split_once('/') {
            None if !text.starts_with(char::is_alphabetic) => None,
            None => metres(text).map(Scale::Unit),
            Some((left, "px")) => metres(left).map(|metres| Scale::PixelsPerMetre(1.0 / metres)),
            Some((left, right)) => per_metre(left, right).map(Scale::PixelsPerMetre),
        };
        let example =
            "write 3.1px/mm, 0.32mm/px, the unit of the file's numbers (mm, cm, m), or a known distance (a:b=40mm)";
        match found {
            Some(scale) if is_whole(&scale) => Ok(scale),
            Some(_) => Err(format!("`{text}` rounds to 0: {example}")),
            None => Err(not_understood(text, example)),
        }
    }
}

fn not_understood(text: &str, example: &str) -> String {
    format!("`{text}` is not understood: {example}")
}

/// Two markers or places and how far they are apart.
fn known_distance(text: &str) -> Result<Scale, String> {
    let example = "write two markers or places and their distance: a:b=40mm or 10,20:300,25=90mm";
    let wrong = || not_understood(text, example);
    let (places, length) = text.rsplit_once('=').ok_or_else(wrong)?;
    let (a, b) = places.split_once(':').ok_or_else(wrong)?;
    let length_m = parse(length, Quantity::Length)?;
    let place = |text: &str| text.parse().unwrap_or_else(|never| match never {});
    if length_m > 0.0 { Ok(Scale::Known([place(a), place(b)], length_m)) } else { Err(wrong()) }
}

/// Reads `find`, or a time with or without its unit.
impl FromStr for Offset {
    type Err = String;

    fn from_str(text: &str) -> Result<Offset, String> {
        if text.trim() == "find" {
            return Ok(Offset::Find);
        }
        let time = parse(text, Quantity::Time).map(Offset::Given);
        time.map_err(|message| format!("{message}; or write find"))
    }
}

/// The column that holds a quantity: `t=Time`.
///
/// # Errors
/// No equals sign, or a quantity that no table holds.
pub fn column(text: &str) -> Result<(String, String), String> {
    match text.split_once('=').map(|(what, column)| (what.trim(), column.trim())) {
        Some((what, column)) if QUANTITIES.contains(&what) => Ok((what.to_string(), column.to_string())),
        _ => {
            let example = format!("write QUANTITY=COLUMN, where QUANTITY is one of {}", QUANTITIES.join(", "));
            Err(not_understood(text, &example))
        }
    }
}

/// A marker and its station \[m\]: `a=90mm`.
///
/// ```
/// assert_eq!(data::import::typed::station("a=90mm"), Ok(("a".to_string(), 0.09)));
/// assert!(data::import::typed::station("a=90").unwrap_err().contains("unit"));
/// ```
///
/// # Errors
/// No equals sign, or a length out of the bounds of a station.
pub fn station(text: &str) -> Result<(String, f64), String> {
    let example = "write MARKER=LENGTH for every marker, for example a=90mm,b=210mm";
    let wrong = || not_understood(text, example);
    let (name, length) = text.rsplit_once('=').ok_or_else(wrong)?;
    let length_m = parse(length, Quantity::Length)?;
    Range::STATION.check(length_m).map_err(|(message, help)| format!("`{text}`: {message}; {help}"))?;
    Ok((name.trim().to_string(), length_m))
}

fn above_zero(number: &str) -> Option<f64> {
    number.trim().parse().ok().filter(|v: &f64| *v > 0.0 && v.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_and_places_are_read_and_others_refused() {
        assert_eq!("4 px/mm".parse(), Ok(Scale::PixelsPerMetre(4.0 / 1e-3)));
        assert_eq!("0.25mm/px".parse(), Ok(Scale::PixelsPerMetre(1.0 / 0.25e-3)));
        assert_eq!("4px/2cm".parse(), Ok(Scale::PixelsPerMetre(4.0 / 0.02)));
        assert_eq!("cm".parse(), Ok(Scale::Unit(0.01)));
        for wrong in [
            "",
            "4",
            "4mm",
            "px/mm",
            "0px/mm",
            "-1px/mm",
            "nanpx/mm",
            "4px/kPa",
            "mm/4px",
            "4px",
            "1e-320mm/px",
            "1e-310mm/px",
        ] {
            assert!(wrong.parse::<Scale>().is_err_and(|message| message.contains("3.1px/mm")), "{wrong}");
        }
        let known = "10,20:tip=90mm".parse();
        assert_eq!(known, Ok(Scale::Known([FilePlace::At(vec![10.0, 20.0]), FilePlace::Marker("tip".into())], 0.09)));
        assert!(["a:b", "a=4mm", "a:b=0mm", "a:b=4"].iter().all(|wrong| wrong.parse::<Scale>().is_err()));
    }

    #[test]
    fn axes_offsets_columns_and_stations_are_read_and_others_refused() {
        let axis = |index, turned| FileAxis { index, turned };
        assert_eq!(axes("x,-y"), Ok([axis(0, false), axis(1, true)]));
        assert_eq!(axes("+Z, x"), Ok([axis(2, false), axis(0, false)]));
        assert!(["x", "x,x", "x,-x", "x,w", ""].iter().all(|wrong| axes(wrong).is_err()));
        assert_eq!("-20ms".parse(), Ok(Offset::Given(-0.02)));
        assert_eq!("find".parse(), Ok(Offset::Find));
        assert!("soon".parse::<Offset>().is_err());
        assert_eq!(column("t=Time (s)"), Ok(("t".into(), "Time (s)".into())));
        assert!(["t", "q=Time"].iter().all(|wrong| column(wrong).is_err()));
        assert_eq!(station("a=90mm"), Ok(("a".into(), 0.09)));
        assert!(["a", "a=-1mm", "a=0mm", "a=9"].iter().all(|wrong| station(wrong).is_err()));
    }
}
