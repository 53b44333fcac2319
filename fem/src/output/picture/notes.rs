//! What explains a picture: title, colour bar, scale, axes.

use super::ink::{letter_size, line, stroke, width, write};
use super::look::{LONGEST, PictureLook, Placing};
use super::raster::{Image, bytes, viridis};
use crate::vec3::V3;

/// Colours of the axes x, y, z.
const AXES: [(&str, [f64; 3]); 3] = [("x", [0.78, 0.16, 0.16]), ("y", [0.13, 0.53, 0.2]), ("z", [0.15, 0.35, 0.75])];

/// Draws all notes; the bar if there is a range of colours, with a sign of more if values go beyond it.
pub(super) fn draw(
    image: &mut Image,
    look: &PictureLook,
    place: &Placing,
    axes: [V3; 3],
    bar: Option<((f64, f64), bool)>,
) {
    let size = letter_size(image.height);
    write(image, [0.6 * size, 1.5 * size], size, &look.title);
    if let Some((limits, beyond)) = bar {
        draw_bar(image, limits, beyond);
    }
    if look.marks {
        draw_axes(image, axes);
        draw_scale(image, place.pixels_per_m());
    }
}

/// The colour map at the right with numbers at its ends and quarters.
fn draw_bar(image: &mut Image, (low, high): (f64, f64), beyond: bool) {
    let size = letter_size(image.height);
    let left = image.width as f64 - (1.2 + 0.62 * LONGEST) * size;
    let (top, bottom) = (image.height / 5, image.height - image.height / 5);
    for row in top..bottom {
        let colour = bytes(viridis((bottom - 1 - row) as f64 / (bottom - 1 - top).max(1) as f64));
        let first = 3 * (row * image.width + left as usize);
        image.rgb[first..first + 3 * size as usize].as_chunks_mut::<3>().0.fill(colour);
    }
    for quarter in 0..=4 {
        let share = f64::from(quarter) / 4.0;
        let row = bottom as f64 - share * (bottom - top) as f64;
        let number = short(low + share * (high - low));
        let text = if beyond && quarter == 4 { format!("≥ {number}") } else { number };
        let tick = left + size.floor();
        stroke(image, [tick, row], [tick + 0.25 * size, row], 1.0);
        write(image, [tick + 0.5 * size, row + 0.36 * size], size, &text);
    }
}

/// The axes that are not seen end-on, at the bottom left.
fn draw_axes(image: &mut Image, [right, up, _]: [V3; 3]) {
    let size = letter_size(image.height);
    let (origin, length) = ([2.6 * size, image.height as f64 - 2.4 * size], 1.5 * size);
    for (k, (name, colour)) in AXES.iter().enumerate() {
        let way = [right[k], -up[k]];
        let seen = way[0].hypot(way[1]);
        if seen < 0.1 {
            continue;
        }
        let tip = [0, 1].map(|i| origin[i] + length * way[i]);
        line(image, origin, tip, 2.0, *colour);
        for side in [-1.0, 1.0] {
            let across = [-way[1] / seen * side, way[0] / seen * side];
            let barb = [0, 1].map(|i| tip[i] - 0.35 * size * way[i] / seen + 0.2 * size * across[i]);
            line(image, tip, barb, 2.0, *colour);
        }
        let beside = [0, 1].map(|i| tip[i] + 0.6 * size * way[i] / seen);
        write(image, [beside[0] - 0.5 * width(size, name), beside[1] + 0.3 * size], size, name);
    }
}

/// A round length of about a fifth of the width, next to the axes.
fn draw_scale(image: &mut Image, pixels_per_m: f64) {
    let size = letter_size(image.height);
    let length_mm = round_below(0.2 * image.width as f64 / pixels_per_m * 1e3);
    let (left, row) = (6.5 * size, image.height as f64 - 1.6 * size);
    let right = left + length_mm * 1e-3 * pixels_per_m;
    stroke(image, [left, row], [right, row], 2.0);
    for x in [left, right].into_iter() {
        stroke(image, [x, row - 0.35 * size], [x, row + 0.35 * size], 1.5);
    }
    let text = format!("{} mm", short(length_mm));
    write(image, [0.5 * (left + right - width(size, &text)), row - 0.7 * size], size, &text);
}

/// The largest of 1, 2, 5 times a power of ten that is not above `value`; 1 for a value that is not a length.
fn round_below(value: f64) -> f64 {
    let ten = power_of_ten(value);
    let step = [5.0, 2.0].into_iter().find(|step| step * ten <= value * (1.0 + 1e-9));
    step.unwrap_or(1.0) * ten
}

/// A round number, with round quarters, from `value` to a third above: where a colour scale may end.
pub(crate) fn round_above(value: f64) -> f64 {
    let ten = power_of_ten(value);
    let steps = [1.0, 1.2, 1.6, 2.0, 2.4, 3.0, 4.0, 5.0, 6.0, 8.0].into_iter();
    steps.map(|step| step * ten).find(|round| *round >= value * (1.0 - 1e-9)).unwrap_or(10.0 * ten)
}

/// The power of ten below; 1 for a value that is not positive.
fn power_of_ten(value: f64) -> f64 {
    if value > 0.0 && value.is_finite() { 10_f64.powf(value.log10().floor()) } else { 1.0 }
}

/// Four digits at most, as a person would write them.
fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (0.01..10_000.0).contains(&size) {
        let decimals = 2 - size.log10().floor().clamp(-2.0, 2.0) as i32;
        let text = format!("{value:.*}", decimals as usize);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{value:.1e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_written_short() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-12.345, "-12.3"),
            (123.4, "123"),
            (9876.0, "9876"),
            (0.0123, "0.0123"),
            (1.2e7, "1.2e7"),
            (-3e-9, "-3.0e-9"),
        ] {
            assert_eq!(short(value), text);
            assert!(text.len() as f64 <= LONGEST);
        }
    }

    #[test]
    fn round_numbers_are_next_to_what_they_stand_for() {
        for (value, below, above) in
            [(1.0, 1.0, 1.0), (1.1, 1.0, 1.2), (3.7, 2.0, 4.0), (5.0, 5.0, 5.0), (8.3, 5.0, 10.0), (0.034, 0.02, 0.04)]
        {
            assert!((round_below(value) / below - 1.0).abs() < 1e-12, "{value}");
            assert!((round_above(value) / above - 1.0).abs() < 1e-12, "{value}: {}", round_above(value));
        }
        assert_eq!((round_below(f64::NAN), round_below(0.0), round_below(-3.0)), (1.0, 1.0, 1.0));
    }
}
