//! Colours by what they are for. Every plot is drawn with the light values; a web page may replace them by CSS variables.

/// What a colour is used for; `INKS` gives its light and dark value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ink {
    /// Background of charts and pages, white in the light scheme.
    Paper,
    /// Text and main marks, the colour of highest contrast.
    #[default]
    Ink,
    /// Secondary text, such as notes and asides.
    Muted,
    /// Axis lines and their tick marks.
    Axis,
    /// Grid lines, paler than the axes.
    Grid,
    /// Soft fills: bands, the body at rest.
    Soft,
    /// Most negative end of the heat map, for values of −1.
    HeatNegative,
    /// Most positive end of the heat map, for values of 1.
    HeatPositive,
    /// Series colour, counted from 0 and repeated after `SERIES`.
    Series(usize),
}

pub(crate) const SERIES: usize = 8;
const FIRST_SERIES: usize = 8;

/// CSS variable, light value, dark value.
type Shade = (&'static str, [u8; 3], [u8; 3]);

/// In the order of [`Ink`]. Series hues are dark (light theme) or light
/// (dark theme) enough for text, differ in lightness and hue, and avoid a red–green pair of equal lightness.
const INKS: [Shade; FIRST_SERIES + SERIES] = [
    ("--paper", [0xFF, 0xFF, 0xFF], [0x14, 0x18, 0x1D]),
    ("--ink", [0x1B, 0x1F, 0x24], [0xE8, 0xEB, 0xEF]),
    ("--muted", [0x5B, 0x64, 0x70], [0xA3, 0xAD, 0xB8]),
    ("--axis", [0x9A, 0xA3, 0xAD], [0x5E, 0x68, 0x73]),
    ("--grid", [0xE3, 0xE6, 0xEA], [0x2B, 0x32, 0x3A]),
    ("--soft", [0xEE, 0xF1, 0xF5], [0x21, 0x28, 0x30]),
    ("--heat-negative", [0x6A, 0xAE, 0xDB], [0x1F, 0x5F, 0x99]),
    ("--heat-positive", [0xF0, 0x93, 0x5A], [0xA3, 0x48, 0x1A]),
    ("--series-1", [0x0B, 0x66, 0xA8], [0x62, 0xB4, 0xF0]),
    ("--series-2", [0xB8, 0x4A, 0x00], [0xFF, 0x9A, 0x5E]),
    ("--series-3", [0x00, 0x78, 0x5A], [0x43, 0xC9, 0x9B]),
    ("--series-4", [0x9A, 0x3F, 0x86], [0xE0, 0x8F, 0xD0]),
    ("--series-5", [0x83, 0x60, 0x00], [0xDD, 0xB2, 0x4A]),
    ("--series-6", [0x50, 0x58, 0x78], [0xA9, 0xB3, 0xD6]),
    ("--series-7", [0x00, 0x72, 0x80], [0x4C, 0xC6, 0xD6]),
    ("--series-8", [0x8C, 0x2F, 0x39], [0xF0, 0x91, 0x9B]),
];

impl Ink {
    pub(crate) fn rgb(self) -> [u8; 3] {
        INKS[self.index()].1
    }

    fn index(self) -> usize {
        match self {
            Ink::Paper => 0,
            Ink::Ink => 1,
            Ink::Muted => 2,
            Ink::Axis => 3,
            Ink::Grid => 4,
            Ink::Soft => 5,
            Ink::HeatNegative => 6,
            Ink::HeatPositive => 7,
            Ink::Series(i) => FIRST_SERIES + i % SERIES,
        }
    }
}

/// CSS declarations of every plot colour, e.g. `--ink:#1B1F24;…`, light then dark, for a rule of a page that inlines plots.
pub fn colours() -> [String; 2] {
    let of = |value: fn(&Shade) -> [u8; 3]| INKS.iter().map(|ink| format!("{}:{};", ink.0, hex(value(ink)))).collect();
    [of(|ink| ink.1), of(|ink| ink.2)]
}

/// The plot with its colours replaced by `var(--ink)` and so on, so that it follows the theme of the page.
pub(crate) fn with_css_variables(svg: &str) -> String {
    INKS.iter().fold(svg.to_owned(), |svg, (name, light, _)| {
        svg.replace(&format!("\"{}\"", hex(*light)), &format!("\"var({name})\""))
    })
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contrast ratio of WCAG 2.2: (L₁ + 0.05)/(L₂ + 0.05) of the relative luminances.
    fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
        let linear = |c: u8| match f64::from(c) / 255.0 {
            c if c <= 0.04045 => c / 12.92,
            c => ((c + 0.055) / 1.055).powf(2.4),
        };
        let luminance = |[r, g, b]: [u8; 3]| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    fn value(role: Ink, dark: bool) -> [u8; 3] {
        let (_, light, night) = INKS[role.index()];
        if dark { night } else { light }
    }

    #[test]
    fn text_colours_reach_contrast_aa_on_paper_and_on_soft_fills() {
        for theme in [false, true] {
            for role in [Ink::Ink, Ink::Muted].into_iter().chain((0..SERIES).map(Ink::Series)) {
                for ground in [Ink::Paper, Ink::Soft] {
                    let ratio = contrast(value(role, theme), value(ground, theme));
                    assert!(ratio >= 4.5, "{role:?} on {ground:?} (dark: {theme}): {ratio:.2}");
                }
            }
        }
    }

    #[test]
    fn cell_numbers_reach_contrast_aa_on_the_strongest_heat() {
        for theme in [false, true] {
            for heat in [Ink::HeatNegative, Ink::HeatPositive] {
                let ratio = contrast(value(Ink::Ink, theme), value(heat, theme));
                assert!(ratio >= 4.5, "{heat:?} (dark: {theme}): {ratio:.2}");
            }
        }
    }

    #[test]
    fn no_two_inks_share_a_light_value() {
        for (i, a) in INKS.iter().enumerate() {
            assert!(INKS[i + 1..].iter().all(|b| b.1 != a.1), "{} is not unique", a.0);
        }
    }

    #[test]
    fn inlined_plots_name_variables_instead_of_values() {
        let themed = with_css_variables("<rect fill=\"#1B1F24\" stroke=\"#0B66A8\"/>");
        assert_eq!(themed, "<rect fill=\"var(--ink)\" stroke=\"var(--series-1)\"/>");
    }
}
