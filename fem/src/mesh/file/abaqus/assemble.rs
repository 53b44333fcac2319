//! Makes a mesh of an Abaqus file: instances at their places, parts by section, sets, surfaces.

use std::collections::{HashMap, HashSet};

use super::super::build::{Builder, MeshFile, Surface};
use super::super::scan::Scan;
use super::model::{ElementSides, FileContent, FileSection, Instance, NamedSet, Orientation, SetMember};
use crate::vec3::{V3, add, cross, dot, norm, scale, sub};

/// A fault, and its line.
type LineFault = (usize, String);
/// A node or an element: its instance and its number there.
type NumberedItem = (usize, u64);

fn at(line: usize) -> impl Fn(String) -> LineFault {
    move |message| (line, message)
}

/// Sets by instance, kind and name in capitals.
type Sets = HashMap<(usize, bool, String), Vec<NumberedItem>>;

#[derive(Default)]
struct MeshAssembly {
    builder: Builder,
    nodes: HashMap<NumberedItem, u32>,
    /// Nodes in the order of the mesh.
    items: Vec<NumberedItem>,
    elements: HashMap<NumberedItem, (Vec<u32>, String)>,
    sets: Sets,
    /// More than one instance has elements: names need theirs.
    several: bool,
}

/// The mesh; a fault sets the line that is named.
pub(super) fn mesh(model: &FileContent, scan: &mut Scan) -> Result<MeshFile, String> {
    let bodies = model.instances.iter().map(|instance| &model.bodies[instance.body]);
    let several = bodies.filter(|body| !body.elements.is_empty()).count() > 1;
    let mut assembly = MeshAssembly { several, ..MeshAssembly::default() };
    match assembly.all(model) {
        Ok(()) => assembly.builder.finish(),
        Err((line, message)) => {
            scan.number = line;
            Err(message)
        }
    }
}

impl MeshAssembly {
    fn all(&mut self, model: &FileContent) -> Result<(), LineFault> {
        for (what, line) in model.ignored.iter() {
            self.builder.ignore(what, *line);
        }
        for (i, instance, (number, place, line)) in model.each(|body| &body.nodes) {
            let next = self.items.len() as u64;
            self.items.push((i, *number));
            let node = self.builder.node(next, stand(instance, *place)).map_err(at(*line))?;
            if self.nodes.insert((i, *number), node).is_some() {
                return Err((*line, format!("node {number} is there twice; renumber one of them")));
            }
        }
        self.numbers(model)?;
        // Sets of the assembly may name sets of its instances.
        for i in (1..model.instances.len()).chain([0]) {
            for group in &model.bodies[model.instances[i].body].groups {
                let found = self.members(model, i, group).map_err(at(group.line))?;
                let all = self.sets.entry((i, group.of_elements, group.name.to_ascii_uppercase())).or_default();
                let known: HashSet<NumberedItem> = all.iter().copied().collect();
                all.extend(found.into_iter().filter(|item| !known.contains(item)));
            }
        }
        self.parts(model)?;
        self.node_sets(model);
        for (i, _, sides) in model.each(|body| &body.surfaces) {
            let surface = self.surface(model, i, sides).map_err(at(sides.line))?;
            self.builder.surfaces.push(surface);
        }
        Ok(())
    }

    fn numbers(&mut self, model: &FileContent) -> Result<(), LineFault> {
        for (i, _, element) in model.each(|body| &body.elements) {
            let corner = |n: &u64| {
                let found = self.nodes.get(&(i, *n)).copied();
                found.ok_or_else(|| (element.line, format!("node {n} does not exist")))
            };
            let corners = element.nodes.iter().map(corner).collect::<Result<Vec<u32>, LineFault>>()?;
            if self.elements.insert((i, element.number), (corners, String::new())).is_some() {
                return Err((element.line, format!("element {} is there twice; renumber one", element.number)));
            }
        }
        Ok(())
    }

    fn members(&self, model: &FileContent, scope: usize, group: &NamedSet) -> Result<Vec<NumberedItem>, String> {
        let scope = group.instance.as_deref().map_or(Ok(scope), |name| instance(model, name))?;
        let (mut found, mut seen) = (Vec::new(), HashSet::new());
        for member in &group.members {
            let more = match member {
                SetMember::Range(first, last, 1) if first == last => vec![(scope, *first)],
                SetMember::Range(first, last, step) => self.range(scope, group.of_elements, [*first, *last, *step]),
                SetMember::Named(name) => self.named(model, scope, group.of_elements, name)?,
                SetMember::NodesOf(name) => {
                    let elements = self.named(model, scope, true, name)?;
                    let corners =
                        elements.iter().filter_map(|item| self.elements.get(item)).flat_map(|(nodes, _)| nodes);
                    found.extend(corners.map(|node| self.items[*node as usize]));
                    continue;
                }
            };
            let known = |item: &NumberedItem| match group.of_elements {
                true => self.elements.contains_key(item),
                false => self.nodes.contains_key(item),
            };
            if let Some((_, number)) = more.iter().find(|item| !known(item)) {
                let kind = if group.of_elements { "element" } else { "node" };
                return Err(format!("set `{}` has {kind} {number}, which does not exist", group.name));
            }
            found.extend(more);
        }
        found.retain(|item| seen.insert(*item));
        Ok(found)
    }

    /// The numbers of a generated range that exist.
    fn range(&self, scope: usize, of_elements: bool, [first, last, step]: [u64; 3]) -> Vec<NumberedItem> {
        let within = |item: &NumberedItem| {
            item.0 == scope && (first..=last).contains(&item.1) && (item.1 - first).is_multiple_of(step)
        };
        let mut found: Vec<NumberedItem> = match of_elements {
            true => self.elements.keys().copied().filter(within).collect(),
            false => self.nodes.keys().copied().filter(within).collect(),
        };
        found.sort_unstable();
        found
    }

    /// A set by its name, or by `INSTANCE.NAME`; or one item as `INSTANCE.NUMBER`.
    fn named(
        &self,
        model: &FileContent,
        scope: usize,
        of_elements: bool,
        name: &str,
    ) -> Result<Vec<NumberedItem>, String> {
        if let Ok(number) = name.parse() {
            return Ok(vec![(scope, number)]);
        }
        if let Some(items) = self.sets.get(&(scope, of_elements, name.to_ascii_uppercase())) {
            return Ok(items.clone());
        }
        if let Some((before, after)) = name.split_once('.')
            && let Ok(inner) = instance(model, before.trim_matches('"'))
        {
            return self.named(model, inner, of_elements, after.trim_matches('"'));
        }
        let kind = if of_elements { "element" } else { "node" };
        Err(format!("unknown {kind} set `{name}`; define it above this line"))
    }

    /// Elements by section, else by the set of their keyword line, else by instance.
    fn parts(&mut self, model: &FileContent) -> Result<(), LineFault> {
        let mut turned = Vec::new();
        for (i, inst, FileSection { set, orientation, line }) in model.each(|body| &body.sections) {
            let items = self.named(model, i, true, set).map_err(at(*line))?;
            for item in items {
                let name = self.prefixed(model, item.0, set);
                if let Some((_, part)) = self.elements.get_mut(&item).filter(|(_, part)| part.is_empty()) {
                    *part = name;
                }
            }
            if let Some(name) = orientation {
                let orientation = orientation_of(model, inst, name).map_err(at(*line))?;
                turned.push((self.prefixed(model, i, set), orientation, inst));
            }
        }
        for (i, inst, element) in model.each(|body| &body.elements) {
            let given = &self.elements[&(i, element.number)];
            let (corners, part) = (given.0.clone(), given.1.clone());
            let other = match (&element.set, inst.name.as_str()) {
                (Some(set), _) => self.prefixed(model, i, set),
                (None, "") => "sheet".to_string(),
                (None, name) => name.to_string(),
            };
            let part = if part.is_empty() { other } else { part };
            self.builder.element(&part, &corners).map_err(at(element.line))?;
            self.elements.insert((i, element.number), (corners, part));
        }
        for (part, orientation, inst) in turned {
            if let Some(fault) = &orientation.other {
                let what = format!("*ORIENTATION `{}` (line {}), {fault}", orientation.name, orientation.line);
                self.builder.unread.push((part, what));
                continue;
            }
            let warp = warp(orientation).map_err(at(orientation.line))?;
            let turned = sub(stand(inst, warp), stand(inst, [0.0; 3]));
            self.builder.warp(&part, turned, &format!("*ORIENTATION `{}`", orientation.name));
        }
        Ok(())
    }

    /// The name of something in an instance.
    fn prefixed(&self, model: &FileContent, scope: usize, name: &str) -> String {
        match self.several && scope > 0 {
            true => format!("{}.{name}", model.instances[scope].name),
            false => name.to_string(),
        }
    }

    /// Node sets, and element sets that are no part.
    fn node_sets(&mut self, model: &FileContent) {
        for of_elements in [false, true] {
            let named = model.each(|body| &body.groups).map(|(i, _, group)| (i, group));
            for (i, group) in named.filter(|(_, g)| g.of_elements == of_elements && !g.internal) {
                let name = self.prefixed(model, i, &group.name);
                let parts = &self.builder.mesh.parts;
                let is_part = of_elements && parts.iter().any(|part| part.name.eq_ignore_ascii_case(&name));
                let key = (i, of_elements, group.name.to_ascii_uppercase());
                let Some(items) = self.sets.get(&key).filter(|_| !is_part) else { continue };
                let nodes: Vec<u32> = match of_elements {
                    false => items.iter().map(|item| self.nodes[item]).collect(),
                    true => items.iter().flat_map(|item| self.elements[item].0.clone()).collect(),
                };
                self.builder.set(&name, nodes);
            }
        }
    }

    /// The parts that a surface covers, and on which side.
    fn surface(&self, model: &FileContent, scope: usize, sides: &ElementSides) -> Result<Surface, String> {
        let mut covered: HashMap<(String, bool), HashSet<NumberedItem>> = HashMap::new();
        let mut fault = None;
        for (set, side) in &sides.rows {
            let back = match side.as_str() {
                "SNEG" => true,
                "SPOS" => false,
                _ => {
                    fault = Some(format!("surface `{}` does not say SPOS or SNEG for `{set}`", sides.name));
                    continue;
                }
            };
            for item in self.named(model, scope, true, set)? {
                let Some((_, part)) = self.elements.get(&item) else {
                    return Err(format!("surface `{}` has element {}, which does not exist", sides.name, item.1));
                };
                covered.entry((part.clone(), back)).or_default().insert(item);
            }
        }
        let size = |name: &str| self.builder.mesh.parts.iter().find(|part| part.name == name).map_or(0, |p| p.len());
        for ((part, _), items) in &covered {
            let (some, all) = (items.len(), size(part));
            if some < all {
                fault = Some(format!(
                    "surface `{}` has {some} of the {all} elements of part `{part}`: give these a section of their own",
                    sides.name
                ));
            }
        }
        let name = self.prefixed(model, scope, &sides.name);
        let in_instance = format!("{}.{}", model.instances[scope].name, sides.name);
        let is_pressed =
            model.pressed.iter().any(|it| it.eq_ignore_ascii_case(&name) || it.eq_ignore_ascii_case(&in_instance));
        let mut faces: Vec<(String, bool)> = covered.into_keys().collect();
        faces.sort();
        Ok(Surface { name, faces, is_pressed, fault })
    }
}

/// Place of an instance by its name.
fn instance(model: &FileContent, name: &str) -> Result<usize, String> {
    let found = model.instances.iter().skip(1).position(|instance| instance.name.eq_ignore_ascii_case(name));
    found.map(|at| at + 1).ok_or_else(|| format!("unknown instance `{name}`; define it above this line"))
}

/// An orientation by its name: of the part, else of the assembly.
fn orientation_of<'a>(model: &'a FileContent, inst: &Instance, name: &str) -> Result<&'a Orientation, String> {
    let bodies = [inst.body, 0].into_iter().flat_map(|body| &model.bodies[body].orientations);
    let mut named = bodies.filter(|it| it.name.eq_ignore_ascii_case(name));
    named.next().ok_or_else(|| format!("unknown *ORIENTATION `{name}`; define it, or leave ORIENTATION out"))
}

/// The warp of a rectangular orientation. x' points from c to a, and y' to the side of b; about the axis that is most normal to the
/// sheet, the two others are turned, and the first that follows it (x' after z') is laid onto the sheet.
fn warp(orientation: &Orientation) -> Result<V3, String> {
    let rows = &orientation.rows;
    let points = rows.first().map_or(&[][..], Vec::as_slice);
    let c = match points.len() {
        6 => [0.0; 3],
        9 => [points[6], points[7], points[8]],
        count => return Err(format!("expected 6 or 9 numbers below *ORIENTATION (points a, b and c), found {count}")),
    };
    let [a, b] = [0, 3].map(|k| sub([points[k], points[k + 1], points[k + 2]], c));
    let across = cross(a, b);
    if !(norm(across) > 0.0 && norm(across).is_finite()) {
        return Err("points a, b and c of *ORIENTATION are on one line; write three that span a plane".into());
    }
    let unit = |v: [f64; 3]| scale(v, 1.0 / norm(v));
    let axes = [unit(a), unit(cross(across, a)), unit(across)];
    let turn = rows.get(1).map_or(&[][..], Vec::as_slice);
    let about = match turn.first().copied().unwrap_or(1.0) {
        axis if [1.0, 2.0, 3.0].contains(&axis) => axis as usize,
        other => return Err(format!("the second row of *ORIENTATION is an axis (1, 2 or 3) and degrees, not {other}")),
    };
    let (sin, cos) = turn.get(1).copied().unwrap_or(0.0).to_radians().sin_cos();
    Ok(add(scale(axes[about % 3], cos), scale(axes[(about + 1) % 3], sin)))
}

/// Place of a point of a part in an instance: moved, then turned by Rodrigues' formula.
fn stand(instance: &Instance, place: V3) -> V3 {
    let moved = add(place, instance.moved);
    let Some((from, to, angle)) = instance.turned else { return moved };
    let axis = sub(to, from);
    if norm(axis) == 0.0 {
        return moved;
    }
    let (k, r) = (scale(axis, 1.0 / norm(axis)), sub(moved, from));
    let (sin, cos) = angle.sin_cos();
    let along = scale(k, dot(k, r) * (1.0 - cos));
    add(from, add(add(scale(r, cos), scale(cross(k, r), sin)), along))
}
