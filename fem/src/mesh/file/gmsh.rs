//! Gmsh, versions 4.1 and 2.2, as text: <https://gmsh.info/doc/texinfo/gmsh.html#Gmsh-file-formats>.
//!
//! Physical surfaces are parts. Physical lines and points are node sets, and so are further physical surfaces of the same
//! elements.

use std::collections::HashMap;

use super::build::{Builder, MeshFile};
use super::scan::{Scan, place, whole};

/// Sections that say nothing about nodes and elements.
const LEFT_OUT: [&str; 8] = [
    "$Periodic",
    "$Comments",
    "$NodeData",
    "$ElementData",
    "$ElementNodeData",
    "$InterpolationScheme",
    "$Parametrizations",
    "$GhostElements",
];
/// What a group without a name is called, by dimension.
const KINDS: [&str; 3] = ["point", "line", "surface"];
const AS_TEXT: &str = "write it as text: gmsh FILE.msh -save -setnumber Mesh.Binary 0 -format msh41 -o TEXT.msh";

#[derive(Default)]
struct Gmsh {
    new: bool,
    builder: Builder,
    /// Names of physical groups by dimension and number.
    names: HashMap<(u64, u64), String>,
    /// Physical groups of entities by dimension and number.
    groups: HashMap<(u64, u64), Vec<u64>>,
}

pub(super) fn read(scan: &mut Scan) -> Result<MeshFile, String> {
    let mut gmsh = Gmsh::default();
    while let Some(section) = scan.line() {
        match section {
            "$MeshFormat" => gmsh.new = version(scan)?,
            "$PhysicalNames" => gmsh.names(scan)?,
            "$Entities" => gmsh.entities(scan)?,
            "$Nodes" if gmsh.new => gmsh.blocks_of_nodes(scan)?,
            "$Nodes" => gmsh.nodes(scan)?,
            "$Elements" if gmsh.new => gmsh.blocks_of_elements(scan)?,
            "$Elements" => gmsh.elements(scan)?,
            known if LEFT_OUT.contains(&known) => {
                gmsh.builder.ignore(known, scan.number);
                let end = known.replace('$', "$End");
                while scan.row(&end)?.first().is_none_or(|word| *word != end) {}
                continue;
            }
            "$PartitionedEntities" => return Err("the mesh is cut into partitions; save it without them".into()),
            "$NOD" => return Err(format!("this is version 1 of the format; {AS_TEXT}")),
            other => return Err(format!("unknown section `{other}`; remove it, or {AS_TEXT}")),
        }
        let end = section.replace('$', "$End");
        match scan.row(&end)?[..] {
            [word] if word == end => {}
            ref other => {
                return Err(format!("expected `{end}`, found `{}`; is a count too small?", other.join(" ")));
            }
        }
    }
    gmsh.builder.finish()
}

/// Whether nodes and elements come in blocks.
fn version(scan: &mut Scan) -> Result<bool, String> {
    let row = scan.row("the version")?;
    match row[..] {
        [_, "1", ..] => Err(format!("this is a binary file; {AS_TEXT}")),
        ["4.1", "0", ..] => Ok(true),
        ["2" | "2.0" | "2.1" | "2.2", "0", ..] => Ok(false),
        _ => Err(format!("version `{}` is not read (4.1 and 2.2 are); {AS_TEXT}", row.join(" "))),
    }
}

impl Gmsh {
    fn names(&mut self, scan: &mut Scan) -> Result<(), String> {
        for _ in 0..one_count(scan, "the number of names")? {
            let row = scan.row("a physical name")?;
            let [dimension, tag, ref name @ ..] = row[..] else {
                return Err("expected dimension, number and name".into());
            };
            let name = name.join(" ").trim_matches('"').to_string();
            self.names.insert((whole(dimension)?, whole(tag)?), name);
        }
        Ok(())
    }

    fn entities(&mut self, scan: &mut Scan) -> Result<(), String> {
        let row = scan.row("the numbers of entities")?;
        for (dimension, count) in row.iter().enumerate() {
            for _ in 0..scan.count(count)? {
                let row = scan.row("an entity")?;
                // A point has its place, all others the corners of their box.
                let at = if dimension == 0 { 4 } else { 7 };
                let (Some(tag), Some(count)) = (row.first(), row.get(at)) else {
                    return Err(format!("an entity of dimension {dimension} needs {} numbers", at + 1));
                };
                let tags = row.iter().skip(at + 1).take(scan.count(count)?);
                // A minus sign gives the direction of a line, which a set does not have.
                let tags = tags.map(|t| whole(t.trim_start_matches('-'))).collect::<Result<_, String>>()?;
                self.groups.insert((dimension as u64, whole(tag)?), tags);
            }
        }
        Ok(())
    }

    fn nodes(&mut self, scan: &mut Scan) -> Result<(), String> {
        for _ in 0..one_count(scan, "the number of nodes")? {
            let row = scan.row("a node")?;
            let [tag, ref xyz @ ..] = row[..] else { return Err("expected a node".into()) };
            self.builder.node(whole(tag)?, place(xyz)?)?;
        }
        Ok(())
    }

    fn blocks_of_nodes(&mut self, scan: &mut Scan) -> Result<(), String> {
        let [blocks, in_all] = first_counts(scan, "the number of blocks of nodes")?;
        let mut found = 0;
        for _ in 0..blocks {
            let row = scan.row("a block of nodes")?;
            let [_, _, _, count] = row[..] else { return Err(block(&row)) };
            let count = scan.count(count)?;
            found += count;
            let mut tags = Vec::with_capacity(count);
            for _ in 0..count {
                tags.push(whole(scan.row("the number of a node")?.first().unwrap_or(&""))?);
            }
            for tag in tags {
                let row = scan.row("the place of a node")?;
                self.builder.node(tag, place(&row)?)?;
            }
        }
        same(in_all, found, "nodes")
    }

    fn elements(&mut self, scan: &mut Scan) -> Result<(), String> {
        for _ in 0..one_count(scan, "the number of elements")? {
            let row = scan.row("an element")?;
            let [_, kind, tags, ref rest @ ..] = row[..] else { return Err("expected an element".into()) };
            let tags = scan.count(tags)?;
            if rest.len() < tags {
                return Err(format!("expected {tags} tags, found {} words", rest.len()));
            }
            let (tags, nodes) = rest.split_at(tags);
            let (dimension, corners) = shape(kind)?;
            let tag = |k: usize| tags.get(k).map_or(Ok(0), |t| whole(t.trim_start_matches('-')));
            let names = match (tag(0)?, tag(1)?) {
                (0, entity) => vec![format!("{}_{entity}", KINDS[dimension])],
                (physical, _) => vec![self.name(dimension, physical)],
            };
            self.element(dimension, corners, &names, nodes)?;
        }
        Ok(())
    }

    fn blocks_of_elements(&mut self, scan: &mut Scan) -> Result<(), String> {
        let [blocks, in_all] = first_counts(scan, "the number of blocks of elements")?;
        let mut found = 0;
        for _ in 0..blocks {
            let row = scan.row("a block of elements")?;
            let [dimension, tag, kind, count] = row[..] else { return Err(block(&row)) };
            let (_, corners) = shape(kind)?;
            let entity = (whole(dimension)?, whole(tag)?);
            let dimension = shape(kind)?.0;
            let physical = self.groups.get(&entity).filter(|groups| !groups.is_empty());
            let names = match physical {
                Some(groups) => groups.iter().map(|group| self.name(dimension, *group)).collect(),
                None => vec![format!("{}_{}", KINDS[dimension], entity.1)],
            };
            let count = scan.count(count)?;
            found += count;
            for _ in 0..count {
                let row = scan.row("an element")?;
                self.element(dimension, corners, &names, row.get(1..).unwrap_or(&[]))?;
            }
        }
        same(in_all, found, "elements")
    }

    fn name(&self, dimension: usize, physical: u64) -> String {
        let named = self.names.get(&(dimension as u64, physical)).cloned();
        named.unwrap_or_else(|| format!("{}_{physical}", KINDS[dimension]))
    }

    fn element(&mut self, dimension: usize, corners: usize, names: &[String], words: &[&str]) -> Result<(), String> {
        if words.len() != corners {
            return Err(format!("expected {corners} node numbers, found {}", words.len()));
        }
        let nodes = self.builder.find(words)?;
        let as_part = match names.first() {
            Some(first) if dimension == 2 => usize::from(self.builder.element(first, &nodes)?),
            _ => 0,
        };
        for name in names[as_part..].iter() {
            self.builder.set(name, nodes.iter().copied());
        }
        Ok(())
    }
}

/// Dimension and number of nodes of a kind of element.
fn shape(kind: &str) -> Result<(usize, usize), String> {
    match kind {
        "15" => Ok((0, 1)),
        "1" => Ok((1, 2)),
        "2" => Ok((2, 3)),
        "3" => Ok((2, 4)),
        "4" | "5" | "6" | "7" => Err(format!(
            "elements of type {kind} are solids, and only sheets are supported: mesh surfaces only (gmsh -2), or save physical surfaces only"
        )),
        _ => Err(format!(
            "elements of type {kind} are not read; write straight lines, triangles and quadrilaterals (Mesh.ElementOrder = 1)"
        )),
    }
}

fn one_count(scan: &mut Scan, what: &str) -> Result<usize, String> {
    let row = scan.row(what)?;
    let [count] = row[..] else { return Err(format!("expected {what}, found `{}`", row.join(" "))) };
    scan.count(count)
}

/// How many blocks follow, and how many lines are in all of them.
fn first_counts(scan: &mut Scan, what: &str) -> Result<[usize; 2], String> {
    let row = scan.row(what)?;
    let count = |k: usize| scan.count(row.get(k).unwrap_or(&""));
    Ok([count(0)?, count(1)?])
}

fn same(said: usize, found: usize, what: &str) -> Result<(), String> {
    if said == found {
        Ok(())
    } else {
        Err(format!("the section announces {said} {what}, and its blocks contain {found}"))
    }
}

fn block(row: &[&str]) -> String {
    format!("expected four whole numbers at the begin of a block, found `{}`; is a count too small?", row.join(" "))
}
