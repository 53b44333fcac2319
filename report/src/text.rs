//! The one font, its registration and its metrics.

use crate::ReportError;
use ab_glyph::{Font, FontRef};
use std::sync::OnceLock;

/// Family name under which the font is registered, and which SVG viewers look up first.
pub(crate) const FAMILY: &str = "DejaVu Sans";
const BYTES: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

/// The font, registered with plotters on the first call.
pub(crate) fn font() -> Result<&'static FontRef<'static>, ReportError> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    let load = || {
        // A browser has its own fonts, and paints no bitmap here.
        #[cfg(not(target_family = "wasm"))]
        plotters::style::register_font(FAMILY, plotters::style::FontStyle::Normal, BYTES).ok()?;
        FontRef::try_from_slice(BYTES).ok()
    };
    FONT.get_or_init(load).as_ref().ok_or(ReportError::Font)
}

/// Characters with their positions (ink start, in em from the text's start), and the total advance in em, with kerning.
pub(crate) fn lay_out(text: &str) -> Result<(Vec<(char, f64)>, f64), ReportError> {
    let font = font()?;
    let em = f64::from(font.units_per_em().unwrap_or(1000.0));
    let (mut pen, mut previous, mut placed) = (0.0, None, Vec::new());
    for letter in text.chars() {
        let id = font.glyph_id(letter);
        if let Some(previous) = previous {
            pen += f64::from(font.kern_unscaled(previous, id)) / em;
        }
        placed.push((letter, pen + f64::from(font.h_side_bearing_unscaled(id)) / em));
        pen += f64::from(font.h_advance_unscaled(id)) / em;
        previous = Some(id);
    }
    Ok((placed, pen))
}

/// Font height over em: ab_glyph sizes fonts by their height.
pub(crate) fn height_per_em() -> Result<f64, ReportError> {
    let font = font()?;
    Ok(f64::from(font.height_unscaled()) / f64::from(font.units_per_em().unwrap_or(1000.0)))
}

/// Width of a text at em size `size`, in the unit of `size`; 0 where the font is missing (drawing reports that).
pub(crate) fn width(text: &str, size: f64) -> f64 {
    lay_out(text).map_or(0.0, |(_, advance)| advance * size)
}

/// The text, cut with an ellipsis to at most `room`.
pub(crate) fn fit(text: &str, size: f64, room: f64) -> String {
    let text = clean(text);
    if width(&text, size) <= room {
        return text;
    }
    let mut kept = text.chars().take(400).collect::<String>();
    while !kept.is_empty() && width(&format!("{}…", kept.trim_end()), size) > room {
        kept.pop();
    }
    format!("{}…", kept.trim_end())
}

/// The text broken at spaces into at most `lines` lines no wider than `room`; the last is cut if need be.
pub(crate) fn wrap(text: &str, size: f64, room: f64, lines: usize) -> Vec<String> {
    let text = clean(text);
    let mut out: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        let last = out.len() - 1;
        let longer = if out[last].is_empty() { word.to_owned() } else { format!("{} {word}", out[last]) };
        if out[last].is_empty() || width(&longer, size) <= room || out.len() >= lines {
            out[last] = longer;
        } else {
            out.push(word.to_owned());
        }
    }
    out.into_iter().map(|line| fit(&line, size, room)).collect()
}

fn clean(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_symbol_that_plots_use() {
        let font = font().unwrap();
        for letter in "κθεΦσχγηρπµΔ²³°±×−→·–…≤≥⁻⁰¹⁴⁵⁶⁷⁸⁹₀₁√∞äüéß".chars()
        {
            assert_ne!(font.glyph_id(letter).0, 0, "no glyph for {letter}");
        }
    }

    #[test]
    fn fitted_text_stays_inside_its_room() {
        let cut = fit("a label far too long for the room it is given", 13.0, 100.0);
        assert!(cut.ends_with('…') && width(&cut, 13.0) <= 100.0);
        assert_eq!(fit("short", 13.0, 100.0), "short");
    }

    #[test]
    fn wrapped_text_keeps_all_words_when_lines_suffice() {
        let lines = wrap("sealed edge loss of a pouch", 13.0, 90.0, 4);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 13.0) <= 90.0));
        assert_eq!(lines.join(" "), "sealed edge loss of a pouch");
    }
}
