//! Medit (`.mesh`), as text: <https://www.ljll.fr/frey/publications/RT-0253.pdf>. Numbers at triangles and quadrilaterals
//! are parts, those at edges and vertices node sets.

use super::MeshFile;
use super::build::Builder;
use super::scan::{Scan, cut_off, place, whole};

/// Blocks that say nothing about nodes and elements, and numbers in a row of them.
const LEFT_OUT: [(&str, usize); 11] = [
    ("Corners", 1),
    ("Ridges", 1),
    ("RequiredVertices", 1),
    ("RequiredEdges", 1),
    ("RequiredTriangles", 1),
    ("Normals", 3),
    ("Tangents", 3),
    ("NormalAtVertices", 2),
    ("NormalAtTriangleVertices", 3),
    ("NormalAtQuadrilateralVertices", 3),
    ("TangentAtVertices", 2),
];
const SOLIDS: [&str; 4] = ["Tetrahedra", "Hexahedra", "Prisms", "Pyramids"];

/// The words of a file, whose line breaks mean nothing.
struct Words<'a, 'b> {
    scan: &'b mut Scan<'a>,
    row: std::vec::IntoIter<&'a str>,
}

impl<'a> Words<'a, '_> {
    fn next(&mut self) -> Option<&'a str> {
        if let Some(word) = self.row.next() {
            return Some(word);
        }
        self.row = self.scan.words('#').into_iter();
        self.row.next()
    }

    fn take(&mut self, count: usize, what: &str) -> Result<Vec<&'a str>, String> {
        (0..count).map(|_| self.next().ok_or_else(|| cut_off(what))).collect()
    }

    fn count(&mut self, what: &str) -> Result<usize, String> {
        let word = self.next().ok_or_else(|| cut_off(what))?;
        self.scan.count(word)
    }
}

/// Reads it.
pub(super) fn read(scan: &mut Scan) -> Result<MeshFile, String> {
    let mut words = Words { scan, row: Vec::new().into_iter() };
    let (mut builder, mut dimension, mut nodes) = (Builder::default(), 3, 0);
    while let Some(keyword) = words.next() {
        match keyword {
            "End" => break,
            "MeshVersionFormatted" => drop(words.take(1, "the version")?),
            "Dimension" => dimension = words.count("the dimension")?,
            "Vertices" if !(2..=3).contains(&dimension) => return Err(format!("dimension {dimension} is not 2 or 3")),
            "Vertices" => {
                for _ in 0..words.count("the number of vertices")? {
                    let row = words.take(dimension + 1, "a vertex")?;
                    let flat = [row[0], row[1], "0"];
                    nodes += 1;
                    let node = builder.node(nodes, if dimension == 2 { place(&flat)? } else { place(&row)? })?;
                    group(&mut builder, "vertices", row[dimension], &[node])?;
                }
            }
            "Edges" => rows(&mut words, &mut builder, "edges", 2)?,
            "Triangles" => rows(&mut words, &mut builder, "surface", 3)?,
            "Quadrilaterals" => rows(&mut words, &mut builder, "surface", 4)?,
            solids if SOLIDS.contains(&solids) && words.count("their number")? > 0 => {
                return Err(format!("`{solids}` are solids; sheets are wanted: export triangles and quadrilaterals"));
            }
            solids if SOLIDS.contains(&solids) => {}
            other => {
                let Some((_, size)) = LEFT_OUT.iter().find(|(name, _)| *name == other) else {
                    return Err(format!("unknown keyword `{other}`; remove its block, or is a count too small?"));
                };
                builder.ignore(other, words.scan.number);
                let count = words.count("its number of rows")?;
                words.take(count * size, "its rows")?;
            }
        }
    }
    builder.finish()
}

fn rows(words: &mut Words, builder: &mut Builder, kind: &str, corners: usize) -> Result<(), String> {
    for _ in 0..words.count("the number of rows")? {
        let row = words.take(corners + 1, "a row of nodes and a number")?;
        let nodes = builder.find(&row[..corners])?;
        if corners > 2 {
            builder.element(&format!("{kind}_{}", whole(row[corners])?), &nodes)?;
        } else {
            group(builder, kind, row[corners], &nodes)?;
        }
    }
    Ok(())
}

/// Adds nodes to the set of a number; 0 is none.
fn group(builder: &mut Builder, kind: &str, word: &str, nodes: &[u32]) -> Result<(), String> {
    let number = whole(word)?;
    if number > 0 {
        builder.set(&format!("{kind}_{number}"), nodes.iter().copied());
    }
    Ok(())
}
