//! One algorithm from any pattern to elements: the wall cut into wall, face and seams, and the sheet panel by panel.

use models::Scenario;
use models::actuators::pattern::{ChamberBottom, Panel, Pattern};

use super::RobotSettings;
use super::lines::{GridLines, StripLines, weld_m};
use crate::Result;
use crate::mesh::generate::{Around, Cap, Tube, tube};
use crate::mesh::{Mesh, Part};
use crate::vec3::{V3, where_so};

pub(super) const BODY: &str = "body";
pub(super) const ACTUATOR: &str = "actuator";
/// The ring at the base, open there and held.
pub(super) const BASE: &str = "base";
/// Parts made of the wall: at the sides of the actuator, and under it.
pub(super) const WALL: &str = "wall";
pub(super) const FACE: &str = "face";
/// The wall with the bottom sheet stuck to it beyond the welds.
pub(super) const MARGIN: &str = "margin";
/// Parts made of welded layers are called `seam_` and their number, the wall's included.
pub(super) const SEAM: &str = "seam_";

/// The name of a part or chamber of the strip with that index: the first has the plain name.
pub(super) fn of_strip(name: &str, strip: usize) -> String {
    if strip == 0 { name.into() } else { format!("{name}_{}", strip + 1) }
}

/// The plain name of a part, whatever its strip.
pub(super) fn plain(name: &str) -> &str {
    match name.rsplit_once('_') {
        Some((plain, strip)) if !name.starts_with(SEAM) && strip.bytes().all(|b| b.is_ascii_digit()) => plain,
        _ => name,
    }
}

/// The mesh of a robot; a pattern for every strip.
pub(super) fn sew(
    scenario: &Scenario,
    patterns: &[Pattern],
    settings: &RobotSettings,
    lines: &GridLines,
) -> Result<Mesh> {
    let mut mesh = body(scenario, lines)?;
    mesh.sets.remove("middle");
    let wall = std::mem::take(&mut mesh.parts[0]);
    let radius_m = scenario.radius_m;
    let sewer = |(strip, pattern)| Sewer {
        strip,
        pattern,
        own: &lines.strips[strip],
        lines,
        radius_m,
        gap_m: settings.layer_gap_m,
        weld_m: weld_m(settings),
    };
    let sewers: Vec<Sewer> = patterns.iter().enumerate().map(sewer).collect();
    let mut parts = sorted(&sewers, lines, &wall.quads);
    parts.extend(mesh.parts.drain(1..));
    for sewer in &sewers {
        let mut sheet = sewer.sheet(&mut mesh.points);
        if scenario.actuator.turns != 0.0 {
            sheet.iter_mut().for_each(|part| part.warp = along_strip(scenario, &mesh.points, part));
        }
        parts.extend(sheet);
    }
    mesh.parts = parts;
    let n = lines.angles.len() as u32;
    for (k, ring) in lines.markers.iter().enumerate() {
        let first = *ring as u32 * n;
        mesh.name(format!("marker_{}", k + 1), (first..first + n).collect());
    }
    if !scenario.is_spatial() {
        // The taut generator runs opposite the middle of the strip.
        let far = (lines.strips[0].s_m.len() - 1 + lines.angles.len()) / 2;
        let generator = (0..lines.x_m.len()).map(|i| i as u32 * n + far as u32).collect();
        mesh.name("far_generator", generator);
    }
    Ok(mesh)
}

/// The body as a tube with its nodes on the lines.
fn body(scenario: &Scenario, lines: &GridLines) -> Result<Mesh> {
    let (n, rings) = (lines.angles.len(), lines.x_m.len());
    let mut mesh = tube(&Tube {
        radius_m: scenario.radius_m,
        length_m: scenario.length_m,
        around: Around::Angles(lines.angles.clone()),
        along: rings - 1,
        caps: [Cap::Open, Cap::Triangles],
        warp_rad: 0.0,
    })?;
    let (wall, cap) = mesh.points.split_at_mut(rings * n);
    for (i, p) in wall.iter_mut().enumerate() {
        *p = lines.place(i / n, i % n, scenario.radius_m);
    }
    if lines.turned_rad() != 0.0 {
        let (sin, cos) = lines.turned_rad().sin_cos();
        cap.iter_mut().for_each(|p| *p = [p[0], cos * p[1] - sin * p[2], sin * p[1] + cos * p[2]]);
    }
    Ok(mesh)
}

fn sorted(sewers: &[Sewer], lines: &GridLines, quads: &[[u32; 4]]) -> Vec<Part> {
    let n = lines.angles.len();
    let mut parts = vec![Part::round(BODY, WALL, Vec::new())];
    for (e, quad) in quads.iter().enumerate() {
        let (row, column) = (e / n, e % n);
        let placed = sewers.iter().map(|sewer| (sewer, sewer.place(row, column)));
        let (name, front) = match placed.into_iter().find(|(_, place)| *place != WallPlace::Beside) {
            None | Some((_, WallPlace::Beside)) => (WALL.into(), None),
            Some((_, WallPlace::Weld(layers))) => (format!("{SEAM}{layers}"), None),
            Some((_, WallPlace::Margin)) => (MARGIN.into(), None),
            Some((sewer, WallPlace::Under)) if sewer.pattern.joint == ChamberBottom::Seams => (WALL.into(), None),
            Some((sewer, WallPlace::Under)) => (of_strip(FACE, sewer.strip), Some(of_strip(ACTUATOR, sewer.strip))),
        };
        let at = parts.iter().position(|p| p.name == name).unwrap_or_else(|| {
            parts.push(Part { front, ..Part::round(BODY, &name, Vec::new()) });
            parts.len() - 1
        });
        parts[at].quads.push(*quad);
    }
    parts.retain(|p| !p.is_empty());
    parts.iter_mut().for_each(|p| p.warp = vec![[1.0, 0.0, 0.0]]);
    parts
}

/// The warp of a slanted strip, one for every element: cos β e_x + sin β e_θ.
fn along_strip(scenario: &Scenario, points: &[V3], part: &Part) -> Vec<V3> {
    let cos = scenario.actuator.cos_slant(scenario.radius_m);
    let sin = scenario.actuator.sin_slant(scenario.radius_m);
    let warp = |quad: &[u32; 4]| {
        let [y, z] = [1, 2].map(|k| quad.iter().map(|node| points[*node as usize][k]).sum::<f64>());
        [cos, -sin * z / y.hypot(z), sin * y / y.hypot(z)]
    };
    part.quads.iter().map(warp).collect()
}

struct Sewer<'a> {
    strip: usize,
    pattern: &'a Pattern,
    own: &'a StripLines,
    lines: &'a GridLines,
    radius_m: f64,
    gap_m: f64,
    weld_m: f64,
}

impl Sewer<'_> {
    fn place(&self, row: usize, column: usize) -> WallPlace {
        let (s, welds) = (&self.own.s_m, &self.own.welds);
        let [first, last] = [welds[0][0], welds[welds.len() - 1][1]];
        if column < self.own.first || column + 1 >= self.own.first + s.len() || !(first..last).contains(&row) {
            return WallPlace::Beside;
        }
        let column = column - self.own.first;
        let middle = 0.5 * (s[column] + s[column + 1]);
        let side_weld_m = where_so(self.pattern.side_welds, self.weld_m);
        if middle.abs() > 0.5 * self.pattern.width_m + side_weld_m {
            return WallPlace::Margin;
        }
        if middle.abs() > 0.5 * self.pattern.width_m {
            // The sheet's edge on the wall, and the bottom sheet between them.
            return WallPlace::Weld(2 + self.pattern.layers_at(middle));
        }
        match welds.iter().any(|weld| (weld[0]..weld[1]).contains(&row)) {
            true => WallPlace::Weld(1 + self.pattern.layers_at(middle)),
            false => WallPlace::Under,
        }
    }

    /// The panels of all units; nodes of the sheet are added to `points`.
    fn sheet(&self, points: &mut Vec<V3>) -> Vec<Part> {
        let part = |(layer, panel)| part(layer, panel, self.strip);
        let mut parts: Vec<Part> = self.pattern.panels.iter().enumerate().map(part).collect();
        for pair in self.own.welds.windows(2) {
            self.unit(points, &mut parts, [pair[0][1], pair[1][0]]);
        }
        parts
    }

    fn unit(&self, points: &mut Vec<V3>, parts: &mut [Part], [first, last]: [usize; 2]) {
        let path = self.path();
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(last - first + 1);
        for ring in first..=last {
            let inside = first < ring && ring < last;
            let mut row: Vec<u32> = path.iter().map(|stop| self.node(points, ring, stop, inside)).collect();
            if inside && self.pattern.joint == ChamberBottom::Seams {
                // The sheet runs round: its last stop is its first, whose node is not needed twice.
                points.pop();
                row[path.len() - 1] = row[0];
            }
            rows.push(row);
        }
        for pair in rows.windows(2) {
            for (q, stop) in path.iter().enumerate().skip(1) {
                parts[stop.panel].quads.push([pair[0][q - 1], pair[0][q], pair[1][q], pair[1][q - 1]]);
            }
        }
    }

    /// Stops of the cross-section, one per grid line, folds once; each stop ends an element of its panel.
    fn path(&self) -> Vec<Stop> {
        let panels = &self.pattern.panels;
        let mut stops: Vec<Stop> = Vec::new();
        for (k, panel) in panels.iter().enumerate() {
            let [from, to] = [panel.from_m, panel.to_m].map(|s| self.own.column(s));
            let columns: Vec<usize> = if from < to { (from..=to).collect() } else { (to..=from).rev().collect() };
            let level = panel.level as f64;
            stops.extend(columns.iter().skip(usize::from(k > 0)).map(|c| Stop { panel: k, column: *c, level }));
            if let (Some(next), Some(stop)) = (panels.get(k + 1), stops.last_mut()) {
                stop.level = 0.5 * (panel.level + next.level) as f64;
            }
        }
        let ends = [0, stops.len() - 1];
        let level = match self.pattern.joint {
            ChamberBottom::Seams => 0.5 * (panels[0].level + panels[panels.len() - 1].level) as f64,
            _ => 0.0,
        };
        ends.iter().for_each(|end| stops[*end].level = level);
        stops
    }

    /// The wall's node at a weld or joined edge, or a new one above it.
    fn node(&self, points: &mut Vec<V3>, ring: usize, stop: &Stop, inside: bool) -> u32 {
        if !inside || stop.level == 0.0 {
            return (ring * self.lines.angles.len() + stop.column) as u32;
        }
        points.push(self.lines.place(ring, stop.column, self.radius_m + stop.level * self.gap_m));
        (points.len() - 1) as u32
    }
}

/// Where an element of the wall is.
#[derive(PartialEq)]
enum WallPlace {
    Beside,
    Under,
    Weld(usize),
    /// Stuck to the bottom sheet beyond its welds.
    Margin,
}

/// A grid line of the cross-section.
struct Stop {
    panel: usize,
    column: usize,
    /// Height above the wall in layers.
    level: f64,
}

/// A part without elements. The warp is along the strip; angles are the section's.
fn part(layer: usize, panel: &Panel, strip: usize) -> Part {
    Part {
        name: of_strip(panel.name, strip),
        warp: vec![[1.0, 0.0, 0.0]],
        back: Some(of_strip(ACTUATOR, strip)),
        layer: layer as u32 + 1,
        ..Part::default()
    }
}
