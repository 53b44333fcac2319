//! How a picture is made, and where things are on it.

use super::ink::letter_size;
use super::raster::Corner;
use crate::vec3::{V3, bounds, where_so};

/// Pixels are drawn this many times finer in both directions, then averaged: smooth outlines.
pub(super) const FINE: usize = 2;

/// Letters in the longest number next to the bar, with its sign of more: ≥ -1.2e-300.
pub(super) const LONGEST: f64 = 8.0;

/// Place of the viewer, far away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Viewpoint {
    /// At +z: x to the right, y up.
    Side,
    /// At +y: x to the right, z down.
    Top,
    /// At +x: z to the left, y up.
    End,
    /// At equal x, y and z: y up.
    Isometric,
    /// At equal x, −y and z: z up, for sheets that lie in x–y.
    IsometricZUp,
}

impl Viewpoint {
    /// Unit vectors to the right, up, and towards the viewer.
    pub fn axes(self) -> [V3; 3] {
        let a = 0.5_f64.sqrt();
        let b = (1.0_f64 / 6.0).sqrt();
        let c = (1.0_f64 / 3.0).sqrt();
        match self {
            Viewpoint::Side => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Viewpoint::Top => [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
            Viewpoint::End => [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
            Viewpoint::Isometric => [[a, 0.0, -a], [-b, 2.0 * b, -b], [c, c, c]],
            Viewpoint::IsometricZUp => [[a, a, 0.0], [-b, b, 2.0 * b], [c, -c, c]],
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PictureLook {
    pub view: Viewpoint,
    /// Width in pixels, 128 to 4096.
    pub width: usize,
    /// Height in pixels, 128 to 4096.
    pub height: usize,
    /// Values of the two ends of the colour map; `None`: smallest and largest value.
    pub limits: Option<(f64, f64)>,
    /// Draw the outlines of elements where they are large enough, the colour map with numbers at the right (≥ marks a value beyond
    /// the limits), the axes and a length at the bottom left.
    pub marks: bool,
    /// Line at the top: name and unit of the quantity shown.
    pub title: String,
}

impl Default for PictureLook {
    fn default() -> PictureLook {
        let (width, height) = (960, 600);
        PictureLook { view: Viewpoint::Isometric, width, height, limits: None, marks: true, title: String::new() }
    }
}

/// Transform from metres in the picture's plane to fine pixels.
pub(super) struct Placing {
    scale: f64,
    middle: [f64; 2],
    centre: [f64; 2],
}

impl Placing {
    pub(super) fn of(seen: &[V3], look: &PictureLook, with_bar: bool) -> Placing {
        let [low, high] = bounds(seen.iter().copied());
        let margin = 0.04 * look.width.min(look.height) as f64;
        let [top, right, bottom] = room(look, with_bar);
        let (width, height) = (look.width as f64 - right, look.height as f64 - top - bottom);
        let room = [width - 2.0 * margin, height - 2.0 * margin];
        let scale = (room[0] / (high[0] - low[0])).min(room[1] / (high[1] - low[1]));
        // A mesh without extent, or without nodes, is drawn at any scale.
        let scale = Some(scale).filter(|scale| scale.is_finite() && *scale > 0.0).unwrap_or(1.0);
        let fine = FINE as f64;
        let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        Placing { scale: scale * fine, middle, centre: [0.5 * width * fine, (top + 0.5 * height) * fine] }
    }

    pub(super) fn pixels_per_m(&self) -> f64 {
        self.scale / FINE as f64
    }

    pub(super) fn on_canvas(&self, p: V3) -> Corner {
        Corner {
            x: self.centre[0] + (p[0] - self.middle[0]) * self.scale,
            y: self.centre[1] - (p[1] - self.middle[1]) * self.scale,
            depth: p[2],
        }
    }
}

/// Room that the notes take \[pixels\]: at the top, at the right, at the bottom.
fn room(look: &PictureLook, with_bar: bool) -> V3 {
    let size = letter_size(look.height);
    let top = where_so(!look.title.is_empty(), 2.0 * size);
    let right = where_so(with_bar, (1.8 + 0.62 * LONGEST) * size);
    [top, right, where_so(look.marks, 5.0 * size)]
}
