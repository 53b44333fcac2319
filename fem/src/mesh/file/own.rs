//! Our own format (`.ibrmesh`), which holds all that a mesh is. `docs/case.md` describes it.

use std::path::Path;

use super::scan::{Scan, cut_off, number};
use crate::FemError;
use crate::mesh::names::meant;
use crate::mesh::{Mesh, Part, Tie};

/// Words that begin a block.
const KEYWORDS: [&str; 14] = [
    "mesh",
    "nodes",
    "membrane",
    "start",
    "part",
    "front",
    "back",
    "layer",
    "warp",
    "quads",
    "triangles",
    "set",
    "ties",
    "end",
];

/// Reads the text of one of our own mesh files; `path` is named in messages.
///
/// # Errors
/// [`FemError::MeshFile`] with the line of the first fault.
pub fn parse(text: &str, path: &Path) -> Result<Mesh, FemError> {
    let mut reader = Reader { scan: Scan::new(text), mesh: Mesh::default() };
    reader.mesh().map_err(|message| FemError::MeshFile {
        path: path.to_path_buf(),
        line: reader.scan.number.max(1),
        message,
    })?;
    Ok(reader.mesh)
}

struct Reader<'a> {
    scan: Scan<'a>,
    mesh: Mesh,
}

impl<'a> Reader<'a> {
    fn mesh(&mut self) -> Result<(), String> {
        match self.scan.words('#')[..] {
            ["mesh", "1"] => {}
            ["mesh", version] => {
                return Err(format!("mesh format {version} is not known; this program reads `mesh 1`"));
            }
            _ => return Err("a mesh file begins with the line `mesh 1`".into()),
        }
        loop {
            let words = self.scan.words('#');
            match words[..] {
                [] => return Err("the file ends without `end`: it was cut off; write it again".into()),
                ["end", nodes, elements] => return self.end(nodes, elements),
                [keyword, ref rest @ ..] => self.block(keyword, rest)?,
            }
        }
    }

    fn block(&mut self, keyword: &str, rest: &[&'a str]) -> Result<(), String> {
        match (keyword, rest) {
            ("nodes", [count]) if self.mesh.points.is_empty() => {
                self.mesh.points = self.rows(count, "node", "x y z", vector)?;
            }
            ("nodes", [_]) => return Err("a second block of nodes; put all nodes in one".into()),
            ("start", [count]) => self.mesh.start = self.places(keyword, count, self.mesh.start.len())?,
            ("membrane", [count]) => self.mesh.membrane = self.places(keyword, count, self.mesh.membrane.len())?,
            ("part", [name]) => self.part(name)?,
            ("front", [name]) => once(&mut self.current()?.front, name, keyword)?,
            ("back", [name]) => once(&mut self.current()?.back, name, keyword)?,
            ("layer", [layer]) => {
                let known = layer.parse().map_err(|_| format!("expected a layer number from 0, found `{layer}`"))?;
                self.current()?.layer = known;
            }
            ("warp", [count]) => {
                self.current()?;
                let rows = self.rows(count, "warp direction", "x y z", vector)?;
                self.current()?.warp.extend(rows);
            }
            ("quads", [count]) => {
                self.current()?;
                let rows = self.rows(count, "quad", "4 node numbers", element::<4>)?;
                self.current()?.quads.extend(rows);
            }
            ("triangles", [count]) => {
                self.current()?;
                let rows = self.rows(count, "triangle", "3 node numbers", element::<3>)?;
                self.current()?.triangles.extend(rows);
            }
            ("set", [name, count]) => self.set(name, count)?,
            ("ties", [count]) => {
                let ties = self.rows(count, "tie", "node, then node and weight in pairs", tie)?;
                self.mesh.ties.extend(ties);
            }
            _ => return Err(misunderstood(keyword, rest.len())),
        }
        Ok(())
    }

    /// The part that lines belong to.
    fn current(&mut self) -> Result<&mut Part, String> {
        self.mesh.parts.last_mut().ok_or_else(|| "this belongs to a part; write `part NAME` before it".to_string())
    }

    /// Places of all nodes, of which there were `before`.
    fn places(&mut self, kind: &str, count: &str, before: usize) -> Result<Vec<[f64; 3]>, String> {
        if before > 0 {
            return Err(format!("a second block of {kind} places; put all in one"));
        }
        let places = self.rows(count, &format!("{kind} place"), "x y z", vector)?;
        let (found, wanted) = (places.len(), self.mesh.points.len());
        if found == wanted {
            Ok(places)
        } else {
            Err(format!("{found} {kind} places for {wanted} nodes; give one per node"))
        }
    }

    fn part(&mut self, name: &str) -> Result<(), String> {
        if self.mesh.parts.iter().any(|part| part.name == name) {
            return Err(format!("part `{name}` exists already; use another name"));
        }
        self.mesh.parts.push(Part { name: name.into(), ..Part::default() });
        Ok(())
    }

    fn set(&mut self, name: &str, count: &str) -> Result<(), String> {
        if self.mesh.sets.contains_key(name) {
            return Err(format!("set `{name}` exists already; use another name"));
        }
        let count = self.scan.count(count)?;
        let mut nodes = Vec::with_capacity(count);
        while nodes.len() < count {
            let words = self.row(nodes.len(), count, "node of the set", "node numbers")?;
            for word in words {
                nodes.push(node(word, self.mesh.points.len())?);
            }
        }
        if nodes.len() > count {
            return Err(format!("set `{name}` has {} nodes up to here, but its first line says {count}", nodes.len()));
        }
        self.mesh.sets.insert(name.into(), nodes);
        Ok(())
    }

    /// The rows of a block, each understood by `parse` from its words and the number of nodes.
    fn rows<T>(
        &mut self,
        count: &str,
        what: &str,
        form: &str,
        parse: impl Fn(&[&str], usize) -> Result<T, String>,
    ) -> Result<Vec<T>, String> {
        let count = self.scan.count(count)?;
        let mut rows = Vec::with_capacity(count);
        while rows.len() < count {
            let words = self.row(rows.len(), count, what, form)?;
            rows.push(parse(&words, self.mesh.points.len())?);
        }
        Ok(rows)
    }

    /// Words of the next row of a block.
    fn row(&mut self, done: usize, count: usize, what: &str, form: &str) -> Result<Vec<&'a str>, String> {
        let (words, row) = (self.scan.words('#'), done + 1);
        match words.first() {
            None => Err(cut_off(&format!("{what} {row} of {count}"))),
            Some(word) if KEYWORDS.contains(word) => Err(format!(
                "expected {what} {row} of {count} ({form}), found `{word}`; correct the count or add the lines"
            )),
            Some(_) => Ok(words),
        }
    }

    fn end(&mut self, nodes: &str, elements: &str) -> Result<(), String> {
        let (nodes, elements) = (self.scan.count(nodes)?, self.scan.count(elements)?);
        let found = (self.mesh.points.len(), self.mesh.elements());
        if found != (nodes, elements) {
            let (n, e) = found;
            return Err(format!("`end` says {nodes} nodes and {elements} elements, but there are {n} and {e}"));
        }
        match self.scan.words('#').first() {
            None => Ok(()),
            Some(word) => Err(format!("`{word}` after `end`; remove what follows")),
        }
    }
}

/// Sets a name that may be given once.
fn once(slot: &mut Option<String>, name: &str, keyword: &str) -> Result<(), String> {
    match slot.replace(name.into()) {
        None => Ok(()),
        Some(_) => Err(format!("a second `{keyword}` in the same part; keep one")),
    }
}

fn misunderstood(keyword: &str, words: usize) -> String {
    let form = match keyword {
        "part" | "front" | "back" => "NAME, one word",
        "set" => "NAME COUNT",
        "layer" => "NUMBER",
        "end" => "NODES ELEMENTS",
        "mesh" => return "a second `mesh`; a file holds one mesh".into(),
        known if KEYWORDS.contains(&known) => "COUNT",
        number if number.parse::<f64>().is_ok() => {
            return format!(
                "expected a keyword, found `{number}`; has the block before more lines than its count says?"
            );
        }
        _ => {
            let meant = meant(keyword, KEYWORDS);
            return format!("unknown keyword `{keyword}`{meant} (known: {})", KEYWORDS.join(", "));
        }
    };
    format!("`{keyword}` has {words} words after it; write `{keyword} {form}`")
}

fn vector(words: &[&str], _nodes: usize) -> Result<[f64; 3], String> {
    let [x, y, z] = words else { return Err(format!("expected x y z, found {} words", words.len())) };
    Ok([number(x)?, number(y)?, number(z)?])
}

fn element<const N: usize>(words: &[&str], nodes: usize) -> Result<[u32; N], String> {
    if words.len() != N {
        return Err(format!("expected {N} node numbers, found {}", words.len()));
    }
    let mut element = [0; N];
    for (slot, word) in element.iter_mut().zip(words) {
        *slot = node(word, nodes)?;
    }
    Ok(element)
}

fn tie(words: &[&str], nodes: usize) -> Result<Tie, String> {
    let ([follower, rest @ ..], true) = (words, words.len() >= 3 && words.len() % 2 == 1) else {
        return Err("expected a node, then pairs of node and weight".into());
    };
    let pair = |pair: &[&str]| Ok((node(pair[0], nodes)?, number(pair[1])?));
    Ok(Tie { node: node(follower, nodes)?, to: rest.chunks_exact(2).map(pair).collect::<Result<_, String>>()? })
}

/// A node number counted from 1, as a place in the list.
fn node(word: &str, nodes: usize) -> Result<u32, String> {
    let number: u64 = word.parse().map_err(|_| format!("expected a node number, found `{word}`"))?;
    if number == 0 {
        return Err("there is no node 0; node numbers count from 1".into());
    }
    if number > nodes as u64 {
        let hint = if nodes == 0 { "; the block `nodes` comes first" } else { "" };
        return Err(format!("there is no node {number}: the file has {nodes} nodes{hint}"));
    }
    u32::try_from(number - 1).map_err(|_| format!("node number {number} is too large"))
}
