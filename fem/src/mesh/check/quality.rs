//! How good the elements are, in their stress-free shape.

use std::fmt;

use super::chamber::Closed;
use super::elements::{corner, stress_free};
use crate::mesh::Mesh;
use crate::mesh::geometry::{area, dot, norm, sub};

/// Report of a mesh that passed [`super::check`]; `Display` prints it as a small table.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// Number of nodes.
    pub nodes: usize,
    /// Elements by part.
    pub parts: Vec<PartCount>,
    /// Lengths of element sides \[m\].
    pub side_m: Spread,
    /// Largest ratio of longest to shortest side; 1 is best.
    pub aspect: Worst,
    /// Largest deviation of a corner from 90° (quads) or 60° (triangles) \[degrees\]; 0 is best.
    pub skew_deg: Worst,
    /// Smallest ratio of smallest to largest corner area (Jacobian) of a quad; 1 is best.
    pub jacobian_ratio: Worst,
    /// Largest distance of the corners of a quad from its mean plane over the root of its area; 0 is flat.
    pub warpage: Worst,
    /// Volume of every chamber at the start \[m³\].
    pub volumes_m3: Vec<(String, f64)>,
    /// Edges at which a chamber touches itself (pouches of one supply line sharing a seam).
    pub seams: usize,
}

/// Elements of one part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PartCount {
    /// Name.
    pub name: String,
    /// 4-node elements.
    pub quads: usize,
    /// 3-node elements.
    pub triangles: usize,
}

/// Smallest, median and largest of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// Median.
    pub median: f64,
    /// Largest.
    pub max: f64,
}

/// The worst value of a measure, and the element that has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Worst {
    /// Value.
    pub value: f64,
    /// Name of the part.
    pub part: String,
    /// Element in the part, counted from 1, quads first.
    pub element: usize,
}

/// Aspect ratio, skew \[degrees\], Jacobian ratio, warpage of one element.
type Measures = [f64; 4];
/// Measures of an ideal element, and whether larger is worse.
const IDEAL: [(f64, bool); 4] = [(1.0, true), (0.0, true), (1.0, false), (0.0, true)];

/// Measures all elements.
pub(super) fn measure(mesh: &Mesh, closed: Closed) -> Quality {
    let mut worst: [Option<(f64, usize, usize)>; 4] = [None; 4];
    let mut sides = Vec::with_capacity(4 * mesh.elements());
    for (p, part) in mesh.parts.iter().enumerate() {
        for i in 0..part.len() {
            let mut corners = [[0.0; 3]; 4];
            let x = stress_free(mesh, part.nodes(i), &mut corners);
            let measures = measures(x, &mut sides);
            for ((record, value), (_, larger)) in worst.iter_mut().zip(measures).zip(IDEAL) {
                let beaten = record.is_none_or(|(old, ..)| if larger { value > old } else { value < old });
                if beaten {
                    *record = Some((value, p, i));
                }
            }
        }
    }
    let mut named = worst.iter().zip(IDEAL).map(|(record, (ideal, _))| {
        let (value, p, i) = record.unwrap_or((ideal, 0, 0));
        Worst { value, part: mesh.parts.get(p).map_or(String::new(), |part| part.name.clone()), element: i + 1 }
    });
    let mut next = || named.next().unwrap_or(Worst { value: 0.0, part: String::new(), element: 0 });
    let count = |part: &crate::mesh::Part| PartCount {
        name: part.name.clone(),
        quads: part.quads.len(),
        triangles: part.triangles.len(),
    };
    Quality {
        nodes: mesh.points.len(),
        parts: mesh.parts.iter().map(count).collect(),
        side_m: spread(sides),
        aspect: next(),
        skew_deg: next(),
        jacobian_ratio: next(),
        warpage: next(),
        volumes_m3: closed.volumes_m3,
        seams: closed.seams,
    }
}

/// Measures one element and notes the lengths of its sides.
fn measures(x: &[[f64; 3]], sides: &mut Vec<f64>) -> Measures {
    let normal = area(x);
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0f64);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0f64);
    let mut skew = 0.0f64;
    let ideal = if x.len() == 4 { 90.0 } else { 60.0 };
    for k in 0..x.len() {
        let (next, last) = (sub(x[(k + 1) % x.len()], x[k]), sub(x[(k + x.len() - 1) % x.len()], x[k]));
        let jacobian = dot(corner(x, k), normal) / norm(normal);
        (shortest, longest) = (shortest.min(norm(next)), longest.max(norm(next)));
        (smallest, largest) = (smallest.min(jacobian), largest.max(jacobian));
        skew = skew.max((jacobian.atan2(dot(next, last)).to_degrees() - ideal).abs());
        sides.push(norm(next));
    }
    if x.len() == 3 {
        return [longest / shortest, skew, 1.0, 0.0];
    }
    let lift = (0..3).map(|k| (x[0][k] - x[1][k] + x[2][k] - x[3][k]) * normal[k]).sum::<f64>() / norm(normal);
    [longest / shortest, skew, smallest / largest, 0.25 * lift.abs() / norm(normal).sqrt()]
}

fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_unstable_by(f64::total_cmp);
    let at = |i: usize| values.get(i).copied().unwrap_or(0.0);
    Spread { min: at(0), median: at(values.len() / 2), max: at(values.len().saturating_sub(1)) }
}

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.parts.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(14);
        writeln!(f, "{:<width$}  {:>9}  {:>9}", "part", "quads", "triangles")?;
        for part in &self.parts {
            writeln!(f, "{:<width$}  {:>9}  {:>9}", part.name, part.quads, part.triangles)?;
        }
        writeln!(f, "{:<width$}  {:>9}", "nodes", self.nodes)?;
        let Spread { min, median, max } = self.side_m;
        let [min, median, max] = [min, median, max].map(|side| side * 1e3);
        writeln!(f, "{:<width$}  {min:.3} / {median:.3} / {max:.3} mm (smallest / median / largest)", "side")?;
        for (name, worst, unit) in [
            ("aspect ratio", &self.aspect, ""),
            ("skew", &self.skew_deg, "°"),
            ("Jacobian ratio", &self.jacobian_ratio, ""),
            ("warpage", &self.warpage, ""),
        ] {
            let Worst { value, part, element } = worst;
            writeln!(f, "{name:<width$}  {value:.3}{unit} at worst, element {element} of `{part}`")?;
        }
        for (name, volume) in &self.volumes_m3 {
            writeln!(f, "{:<width$}  {:.3} cm³ at the start", format!("chamber {name}"), volume * 1e6)?;
        }
        if self.seams > 0 {
            writeln!(f, "{:<width$}  {} edges where a chamber touches itself", "seams", self.seams)?;
        }
        Ok(())
    }
}
