//! A picture of the deformed mesh, without a display: parallel projection, z-buffer, flat shading.
//!
//! Elements have one colour each, from a perceptually even colour map between two limits, darkened where they turn away
//! from the light. Nothing here feeds back into a run.

mod cut;
mod ink;
mod look;
mod notes;
mod raster;

pub(crate) use cut::{Cut, section};
pub(crate) use look::PictureLook;
pub use look::Viewpoint;
pub(crate) use notes::round_above;
pub(crate) use raster::{Image, viridis};

use crate::vec3::{V3, cross, dot, norm, sub};
use crate::{FemError, Mesh, Result};
use look::{FINE, Placing};
use raster::{Canvas, Corner};

/// Largest width and height: what a report can show, and 0.8 GB while drawing.
const MOST_PIXELS: usize = 4096;
/// Smallest width and height: room for the colour bar.
const FEWEST_PIXELS: usize = 128;
/// Edges of elements that are shorter than this many pixels would only darken the picture.
const SHORTEST_EDGE: f64 = 5.0;
const PLAIN: [f64; 3] = [0.62, 0.68, 0.76];

/// Draws the mesh with its nodes at `positions` \[m\], elements coloured by `values` (mesh order, any unit; empty: grey).
pub(crate) fn render(mesh: &Mesh, positions: &[V3], values: &[f64], look: &PictureLook) -> Result<Image> {
    check(mesh, positions, values, look)?;
    let axes = look.view.axes();
    let seen: Vec<[f64; 3]> = positions.iter().map(|p| axes.map(|axis| dot(axis, *p))).collect();
    let all: Vec<usize> = (0..mesh.elements()).collect();
    Ok(drawn(look, axes, &seen, values, &all, |canvas, place, colour| {
        for (index, nodes) in mesh.faces().enumerate() {
            let corners: Vec<[f64; 3]> = nodes.iter().map(|&node| seen[node as usize]).collect();
            let light = shade(&corners);
            let corners: Vec<Corner> = corners.into_iter().map(|p| place.on_canvas(p)).collect();
            let edge = if look.marks { FINE as f64 * 0.5 } else { 0.0 };
            canvas.element(&corners, colour(index).map(|c| c * light), edge, SHORTEST_EDGE * FINE as f64);
        }
    }))
}

/// An image with room for the points `seen`; `fill` draws the elements in their colours, with notes. Only the `shown` elements count
/// for the end of the colour bar.
fn drawn(
    look: &PictureLook,
    axes: [V3; 3],
    seen: &[V3],
    values: &[f64],
    shown: &[usize],
    fill: impl FnOnce(&mut Canvas, &Placing, &dyn Fn(usize) -> V3),
) -> Image {
    let limits = look.limits.unwrap_or_else(|| range(values));
    let with_bar = look.marks && !values.is_empty();
    let place = Placing::of(seen, look, with_bar);
    let mut canvas = Canvas::new(look.width * FINE, look.height * FINE);
    fill(&mut canvas, &place, &|element| values.get(element).map_or(PLAIN, |&value| viridis(share(value, limits))));
    let mut image = canvas.averaged(FINE);
    let beyond = shown.iter().filter_map(|element| values.get(*element)).any(|value| *value > limits.1);
    notes::draw(&mut image, look, &place, axes, with_bar.then_some((limits, beyond)));
    image
}

/// The bytes of an image as PNG; empty if it cannot be encoded, which needs an image whose size contradicts its pixels.
pub(crate) fn png_bytes(image: &Image) -> Vec<u8> {
    let mut bytes = Vec::new();
    if encode(image, &mut bytes).is_err() {
        bytes.clear();
    }
    bytes
}

fn encode(image: &Image, out: &mut dyn std::io::Write) -> std::io::Result<()> {
    let mut encoder = png::Encoder::new(out, image.width as u32, image.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.rgb)?;
    Ok(writer.finish()?)
}

fn check(mesh: &Mesh, positions: &[V3], values: &[f64], look: &PictureLook) -> Result<()> {
    let refuse = |message: String| Err(FemError::Problem(format!("picture: {message}")));
    let (nodes, elements) = (mesh.points.len(), mesh.elements());
    let sizes = FEWEST_PIXELS..=MOST_PIXELS;
    if !sizes.contains(&look.width) || !sizes.contains(&look.height) {
        let (width, height) = (look.width, look.height);
        let message = format!("{width} x {height} pixels; give {FEWEST_PIXELS} to {MOST_PIXELS} each");
        return refuse(message);
    }
    if positions.len() != nodes || !(values.is_empty() || values.len() == elements) {
        let (p, v) = (positions.len(), values.len());
        let message = format!("{p} positions and {v} values for {nodes} nodes and {elements} elements");
        return refuse(message);
    }
    if let Some(node) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return refuse(format!("node {} is at {:?}", node + 1, positions[node]));
    }
    if let Some(element) = values.iter().position(|value| !value.is_finite()) {
        let message = format!("the value of element {} is {}", element + 1, values[element]);
        return refuse(message);
    }
    if let Some(node) = mesh.faces().flatten().find(|&&node| node as usize >= nodes) {
        let message = format!("an element has node {}, the mesh has {nodes}", node + 1);
        return refuse(message);
    }
    match look.limits {
        Some((low, high)) if !(low < high && (high - low).is_finite()) => {
            let message = format!("the colour limits {low} and {high} must be finite and rising");
            refuse(message)
        }
        _ => Ok(()),
    }
}

/// Smallest and largest value, a little apart if they are the same.
fn range(values: &[f64]) -> (f64, f64) {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
    if low < high { (low, high) } else { (low, low + low.abs().max(1e-300) * 1e-3) }
}

/// Position of a value between the limits, 0 to 1.
fn share(value: f64, (low, high): (f64, f64)) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

/// Brightness of an element whose corners are given to the right, up and towards the viewer; both sides are lit.
fn shade(corners: &[V3]) -> f64 {
    // From above and the left, mostly from the viewer; half of it also reaches round, so that colours stay readable.
    const LIGHT: [f64; 3] = [-0.36, 0.48, 0.8];
    let last = corners.len() - 1;
    let normal = cross(sub(corners[2], corners[0]), sub(corners[last], corners[last - 2]));
    let length = norm(normal);
    if length == 0.0 {
        return 1.0;
    }
    let towards = normal[2].signum();
    0.7 + 0.3 * towards * dot(normal, LIGHT) / length
}

#[cfg(test)]
#[path = "picture_tests.rs"]
mod tests;
