//! Wavefront OBJ: <http://www.martinreddy.net/gfx/3d/OBJ.spec>. Objects and groups are parts; lines and points node sets.

use super::MeshFile;
use super::build::Builder;
use super::scan::{Scan, place};

/// Words about colour, smoothing and texture.
const LEFT_OUT: [&str; 7] = ["vn", "vt", "vp", "s", "usemtl", "mtllib", "mg"];

/// Reads it.
pub(super) fn read(scan: &mut Scan) -> Result<MeshFile, String> {
    let mut builder = Builder::default();
    let (mut object, mut group, mut count) = (String::new(), String::new(), 0);
    loop {
        let words = scan.words('#');
        let name = [&group, &object].into_iter().find(|name| !name.is_empty()).cloned().unwrap_or("sheet".into());
        match words[..] {
            [] => return builder.finish(),
            ["v", ref xyz @ ..] => {
                count += 1;
                builder.node(count, place(xyz)?)?;
            }
            ["o", ref words @ ..] => (object, group) = (words.join("_"), String::new()),
            ["g", ref words @ ..] => group = words.join("_"),
            ["f", ref corners @ ..] => {
                let nodes = vertices(&builder, corners, count)?;
                if nodes.len() > 4 {
                    return Err(format!("a face of {} corners; export triangles and quadrilaterals", nodes.len()));
                }
                builder.element(&name, &nodes)?;
            }
            ["l" | "p", ref corners @ ..] => {
                let nodes = vertices(&builder, corners, count)?;
                builder.set(&name, nodes);
            }
            [word, ..] if LEFT_OUT.contains(&word) => builder.ignore(word, scan.number),
            [word, ..] => {
                return Err(format!("`{word}` is not understood; export vertices (v), faces (f), objects and groups"));
            }
        }
    }
}

/// Vertices of a face, without texture and normal: `7`, `7/1`, `7//3`, or `-1` for the last one so far.
fn vertices(builder: &Builder, corners: &[&str], count: u64) -> Result<Vec<u32>, String> {
    let vertex = |corner: &&str| {
        let word = corner.split('/').next().unwrap_or("");
        match word.strip_prefix('-').and_then(|back| back.parse::<u64>().ok()) {
            Some(back) if back <= count => (count + 1 - back).to_string(),
            _ => word.to_string(),
        }
    };
    let words: Vec<String> = corners.iter().map(vertex).collect();
    builder.find(&words.iter().map(String::as_str).collect::<Vec<_>>())
}
