//! `[mesh]`: a generator with its parameters, or a mesh file.

use super::range::{
    Checked, FreeTable, LENGTH, Range, Text, at_once, choice, find, number, plain, plain_number, refuse, unknown_name,
};
use crate::mesh::Part;
use crate::mesh::check::{check_open, near, rim};
use crate::mesh::file::MeshFile;
use crate::mesh::generate::{self, Around, Cap, Tube};
use crate::policy;
use crate::problem::Chamber;
use crate::vec3::{bounds, extent, norm, sub};
use crate::{FemError, Mesh, Result};
use std::path::Path;
use toml::{Spanned, Value};

/// Reads the mesh file that a case names in `[mesh] file`; the path is as written there.
pub(crate) type ReadMesh<'a> = &'a mut dyn FnMut(&Path) -> Result<MeshFile>;

/// A generator of meshes as cases name it.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct MeshGenerator {
    /// Name of the generator in `[mesh] generator`.
    pub name: &'static str,
    /// One plain sentence for a user.
    pub sentence: &'static str,
    /// Values that the generator takes, in their order.
    pub keys: &'static [GeneratorKey],
    #[serde(skip)]
    make: fn(&[f64]) -> Result<Mesh>,
}

/// One value that a generator of meshes takes.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct GeneratorKey {
    /// Key, with the unit as suffix.
    pub key: &'static str,
    /// Value if it is left out, as typed; null: it must be given.
    pub default: Option<f64>,
    /// Meaning in a few words, for documents and messages.
    pub meaning: &'static str,
    #[serde(skip)]
    kind: ParameterKind,
}

#[derive(Debug, Clone, Copy)]
enum ParameterKind {
    Length,
    Gap,
    Angle,
    Count,
    /// One of these words; its position is the value.
    Word(&'static [&'static str]),
}

const COUNT: Range = plain(1.0, 10_000.0, "a whole number of elements");
const ANGLE: Range = Range { si: std::f64::consts::PI / 180.0, ..plain(-90.0, 90.0, "write degrees") };
const OPENING: Range = Range { low: 0.0, high: 100.0, too_small: "0 starts flat", ..LENGTH };
const CAPS: [Cap; 3] = [Cap::Triangles, Cap::Quads, Cap::Open];

const fn length(key: &'static str, meaning: &'static str) -> GeneratorKey {
    GeneratorKey { key, default: None, meaning, kind: ParameterKind::Length }
}

const fn count(key: &'static str, meaning: &'static str) -> GeneratorKey {
    GeneratorKey { key, default: None, meaning, kind: ParameterKind::Count }
}

const fn cap(key: &'static str, meaning: &'static str) -> GeneratorKey {
    optional(key, ParameterKind::Word(&["triangles", "quads", "open"]), meaning)
}

const fn optional(key: &'static str, kind: ParameterKind, meaning: &'static str) -> GeneratorKey {
    GeneratorKey { key, default: Some(0.0), meaning, kind }
}

const GAP: GeneratorKey = optional("gap_mm", ParameterKind::Gap, "distance of the two layers at the start");
const WARP: GeneratorKey =
    optional("warp_deg", ParameterKind::Angle, "angle of the warp to the axis, counter-clockwise seen from outside");

/// Mesh generators that cases may name, each with its keys.
#[rustfmt::skip]
pub const GENERATORS: &[MeshGenerator] = &[
    MeshGenerator {
        name: "pillow", sentence: "Two squares welded along their four edges.",
        keys: &[length("side_mm", "side of the flat square"), count("elements", "elements along a side, even"), GAP],
        make: |v| generate::pillow(v[0], v[1] as usize, v[2]),
    },
    MeshGenerator {
        name: "disc_balloon", sentence: "Two discs welded along their rim.",
        keys: &[length("diameter_mm", "diameter of the flat disc"), count("elements", "elements across the core, even")],
        make: |v| generate::disc_balloon(0.5 * v[0], v[1] as usize),
    },
    MeshGenerator {
        name: "long_pouch", sentence: "A strip of an endlessly wide pouch: two strips welded at their ends, open at the sides.",
        keys: &[
            length("length_mm", "flat length between the welds"), length("width_mm", "width of the strip"),
            count("elements_along", "elements between the welds, even"),
            count("elements_across", "elements across the strip, even"), GAP,
        ],
        make: |v| generate::long_pouch(v[0], v[1], v[2] as usize, v[3] as usize, v[4]),
    },
    MeshGenerator {
        name: "flat_tube", sentence: "A fabric muscle: a flat tube with welded ends and its warp at an angle.",
        keys: &[
            length("width_mm", "flat width"), length("length_mm", "length between the welds"),
            count("elements_across", "elements across the flat width, even"),
            count("elements_along", "elements along the tube, a multiple of 4"), WARP, GAP,
        ],
        make: |v| generate::flat_tube(v[0], v[1], v[2] as usize, v[3] as usize, v[4], v[5]),
    },
    MeshGenerator {
        name: "tube", sentence: "An inflated cylinder along x with caps.",
        keys: &[
            length("diameter_mm", "diameter"), length("length_mm", "length"),
            count("elements_around", "elements around the circumference"), count("elements_along", "elements along the axis"),
            cap("base_cap", "how the end at x = 0 is closed"), cap("tip_cap", "how the other end is closed"), WARP,
        ],
        make: |v| {
            let caps = [CAPS[v[4] as usize], CAPS[v[5] as usize]];
            let (around, along) = (Around::Even(v[2] as usize), v[3] as usize);
            generate::tube(&Tube { radius_m: 0.5 * v[0], length_m: v[1], around, along, caps, warp_rad: v[6] })
        },
    },
    MeshGenerator {
        name: "sphere", sentence: "A sphere of quads.",
        keys: &[length("diameter_mm", "diameter"), count("elements", "elements along a sixth of a great circle")],
        make: |v| generate::sphere(0.5 * v[0], v[1] as usize),
    },
    MeshGenerator {
        name: "plate", sentence: "A flat rectangle.",
        keys: &[
            length("length_mm", "side along x"), length("width_mm", "side along y"),
            count("elements_along", "elements along x"), count("elements_across", "elements along y"),
        ],
        make: |v| generate::plate(v[0], v[1], v[2] as usize, v[3] as usize, None),
    },
    MeshGenerator {
        name: "crossed_sheets", sentence: "Two strips, one across the other.",
        keys: &[
            length("length_mm", "length of a strip"), length("width_mm", "width of a strip"),
            count("elements", "elements across a strip"), GeneratorKey { default: None, ..GAP },
        ],
        make: |v| generate::crossed_sheets(v[0], v[1], v[2] as usize, v[3]),
    },
];

pub(super) fn mesh(table: &Spanned<FreeTable>, read_mesh: ReadMesh) -> Checked<MeshFile> {
    match (entry(table, "generator")?, entry(table, "file")?) {
        (Some(_), Some(file)) => at_once("a generator and a file", file.span()),
        (None, Some(file)) => from_file(table, &file, read_mesh),
        (Some(name), None) => generated(table, &name).map(MeshFile::from),
        (None, None) => {
            let message = "[mesh] has no shape";
            let help = "write generator = \"pillow\" or file = \"robot.inp\"";
            refuse(message, help, table.span())
        }
    }
}

/// Help below the fault of a mesh that is not a sheet.
const CORRECT: &str = "\ncorrect the mesh: its file, or the values of its generator";

/// Refuses a mesh that cannot be simulated: bad elements, chambers that leak.
pub(super) fn check(table: &Spanned<FreeTable>, mesh: &Mesh, chambers: &[Chamber]) -> Checked<()> {
    let names: Vec<&str> = chambers.iter().map(|c| c.name.as_str()).collect();
    match check_open(mesh, &names, &open_at(mesh, chambers)) {
        Err(FemError::Mesh(message)) => {
            // Every set may be an opening: does the mesh close then?
            let all: Vec<&str> = mesh.sets.keys().map(String::as_str).collect();
            let opens = chambers.iter().all(|c| c.open_axis.is_none()) && check_open(mesh, &names, &all).is_ok();
            let open = if opens { open_axis(mesh, &names) } else { None };
            let help = open.map_or(CORRECT.to_string(), |(chamber, axes)| {
                format!("\nit is open between planes: write open_axis = \"{axes}\" in [chamber.{chamber}]")
            });
            Err(FemError::case(message + &help, table.span()))
        }
        other => other.map(|_| ()),
    }
}

/// Sets at which chambers may be open: where one may be, its edges must lie in planes, and which sets they belong to does not matter.
pub(super) fn open_at<'a>(mesh: &'a Mesh, chambers: &[Chamber]) -> Vec<&'a str> {
    match chambers.iter().any(|c| c.open_axis.is_some()) {
        true => mesh.sets.keys().map(String::as_str).collect(),
        false => Vec::new(),
    }
}

/// The first chamber with open edges, and the fewest axes whose planes at the ends of the mesh have them all.
fn open_axis<'a>(mesh: &Mesh, chambers: &[&'a str]) -> Option<(&'a str, &'static str)> {
    let name = chambers.iter().find(|name| !rim(mesh, name).is_empty())?;
    let rim = rim(mesh, name);
    let [low, high] = bounds((0..mesh.points.len()).map(|i| mesh.start_of(i)));
    let near = near(mesh, &rim);
    // A flat sheet is at both ends of its normal; whether it is half a chamber cannot be seen.
    let at_end = |edge: &[u32; 2], k: usize| {
        let lies = |end: f64| edge.iter().all(|n| (mesh.start_of(*n as usize)[k] - end).abs() <= near);
        high[k] > low[k] + near && (lies(low[k]) || lies(high[k]))
    };
    let all = ["x", "y", "z", "xy", "xz", "yz", "xyz"];
    let fits = |axes: &&str| rim.iter().all(|edge| axes.bytes().any(|axis| at_end(edge, usize::from(axis - b'x'))));
    Some((*name, all.into_iter().find(fits)?))
}

/// A text of the table, if it is there.
fn entry(table: &Spanned<FreeTable>, key: &str) -> Checked<Option<Text>> {
    let Some(value) = find(table.get_ref(), key) else { return Ok(None) };
    match value.get_ref() {
        Value::String(text) => Ok(Some(Spanned::new(value.span(), text.clone()))),
        _ => refuse(format!("{key} must be a text"), format!("for example {key} = \"pillow\""), value.span()),
    }
}

fn from_file(table: &Spanned<FreeTable>, file: &Text, read_mesh: ReadMesh) -> Checked<MeshFile> {
    if let Some((key, _)) = table.get_ref().iter().find(|(key, _)| !["file", "unit"].contains(&key.get_ref().as_str()))
    {
        return Err(unknown_name("key of a mesh from a file", key, &["file", "unit"]));
    }
    match read_mesh(Path::new(file.get_ref())) {
        Err(FemError::Io { path, source }) => {
            let message = format!("the mesh file {} cannot be read: {source}", path.display());
            let help = "the path counts from the folder of the case file";
            refuse(message, help, file.span())
        }
        Err(FemError::Mesh(message)) => Err(FemError::case(message, file.span())),
        Ok(read) => in_metres(read, file, entry(table, "unit")?),
        Err(other) => Err(other),
    }
}

/// Units of foreign files, and how many make a metre.
const UNITS: [(&str, f64); 4] = [("m", 1.0), ("cm", 100.0), ("mm", 1000.0), ("in", 1.0 / 0.0254)];
/// No mesh is as small as a whole \[m\].
const SMALLEST_M: f64 = 1e-3;

/// The mesh in metres, and what was understood.
fn in_metres(mut file: MeshFile, named: &Text, unit: Option<Text>) -> Checked<MeshFile> {
    let Some(unit) = unit else {
        let [x, y, z] = extent(file.mesh.points.iter().copied());
        let message = format!("{} ({}) does not say its unit", named.get_ref(), file.format);
        let help = format!("its size is {x:.4} × {y:.4} × {z:.4}: write unit = \"mm\" (or m, cm, in) below file");
        return refuse(message, help, named.span());
    };
    let per_m = choice("unit", &unit, &UNITS)?;
    for x in file.mesh.points.iter_mut().flatten() {
        *x /= per_m;
    }
    let side = median_side_m(&file.mesh);
    let largest = extent(file.mesh.points.iter().copied()).into_iter().fold(0.0, f64::max);
    if policy::is_coarse(side) {
        let message =
            format!("half of the elements of this mesh have sides over {side:.2} m: it looks like millimetres");
        return refuse(message, "write unit = \"mm\"", unit.span());
    }
    if largest < SMALLEST_M {
        let message = format!("the whole mesh is {:.4} mm long: it looks like metres", largest * 1e3);
        return refuse(message, "write unit = \"m\"", unit.span());
    }
    file.told.insert(0, understood(&file, named.get_ref(), unit.get_ref()));
    Ok(file)
}

fn understood(file: &MeshFile, name: &str, unit: &str) -> String {
    let mesh = &file.mesh;
    let count = |count: usize, kind: &str| (count > 0).then(|| format!("{count} {kind}"));
    let part = |part: &Part| {
        let counts = [count(part.quads.len(), "quads"), count(part.triangles.len(), "triangles")];
        format!("`{}` ({})", part.name, counts.into_iter().flatten().collect::<Vec<_>>().join(", "))
    };
    let parts: Vec<String> = mesh.parts.iter().map(part).collect();
    let sets: Vec<String> = mesh.sets.iter().map(|(name, nodes)| format!("`{name}` ({})", nodes.len())).collect();
    let sets = if sets.is_empty() { "none".into() } else { sets.join(", ") };
    let [x, y, z] = extent(mesh.points.iter().copied()).map(|m| m * 1e3);
    format!(
        "{name}: {} in {unit}, {x:.1} × {y:.1} × {z:.1} mm, {} nodes; parts: {}; node sets: {sets}",
        file.format,
        mesh.points.len(),
        parts.join(", ")
    )
}

fn median_side_m(mesh: &Mesh) -> f64 {
    let side = |nodes: &[u32]| norm(sub(mesh.points[nodes[0] as usize], mesh.points[nodes[1] as usize]));
    let mut sides: Vec<f64> = mesh.faces().map(side).collect();
    sides.sort_by(f64::total_cmp);
    sides.get(sides.len() / 2).copied().unwrap_or(0.0)
}

fn generated(table: &Spanned<FreeTable>, name: &Text) -> Checked<Mesh> {
    let names: Vec<&str> = GENERATORS.iter().map(|g| g.name).collect();
    let Some(generator) = GENERATORS.iter().find(|g| g.name == name.get_ref()) else {
        return Err(unknown_name("generator", name, &names));
    };
    let keys: Vec<&str> = generator.keys.iter().map(|k| k.key).collect();
    let foreign = |key: &&Text| key.get_ref() != "generator" && !keys.contains(&key.get_ref().as_str());
    if let Some(key) = table.get_ref().keys().find(foreign) {
        return Err(unknown_name(&format!("key of generator \"{}\"", generator.name), key, &keys));
    }
    let values = generator.keys.iter().map(|key| value(table, key)).collect::<Checked<Vec<f64>>>()?;
    (generator.make)(&values).map_err(|error| match error {
        FemError::Mesh(message) => FemError::case(message + CORRECT, table.span()),
        other => other,
    })
}

fn value(table: &Spanned<FreeTable>, key: &GeneratorKey) -> Checked<f64> {
    let (v, span) = match (find(table.get_ref(), key.key), key.default) {
        (Some(value), _) => (typed(key, value)?, value.span()),
        (None, Some(default)) => (default, table.span()),
        (None, None) => {
            let message = format!("[mesh] lacks {}", key.key);
            let help = format!("add {} = …: {}", key.key, key.meaning);
            return refuse(message, help, table.span());
        }
    };
    match key.kind {
        ParameterKind::Length => number(key.key, v, span, &LENGTH),
        ParameterKind::Gap => number(key.key, v, span, &OPENING),
        ParameterKind::Angle => number(key.key, v, span, &ANGLE),
        ParameterKind::Count if v.fract() == 0.0 => number(key.key, v, span, &COUNT),
        ParameterKind::Count => refuse(format!("{} must be a whole number, not {v}", key.key), key.meaning, span),
        ParameterKind::Word(_) => Ok(v),
    }
}

/// A value as typed: a number, or the position of a word.
fn typed(key: &GeneratorKey, value: &Spanned<Value>) -> Checked<f64> {
    let ParameterKind::Word(words) = key.kind else { return plain_number(key.key, value) };
    let word = value.get_ref().as_str().unwrap_or_default();
    match words.iter().position(|w| *w == word) {
        Some(at) => Ok(at as f64),
        None => refuse(
            format!("{} = {} is not understood", key.key, value.get_ref()),
            format!("write one of \"{}\"", words.join("\", \"")),
            value.span(),
        ),
    }
}
