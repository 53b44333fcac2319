//! Content of an Abaqus file.

/// Content of a file, in its order.
#[derive(Default)]
pub(super) struct FileContent {
    /// The first one is the text outside of parts.
    pub(super) bodies: Vec<Body>,
    /// The first one is the first body where it is.
    pub(super) instances: Vec<Instance>,
    /// Surfaces that a pressure acts on.
    pub(super) pressed: Vec<String>,
    pub(super) ignored: Vec<(String, usize)>,
}

impl FileContent {
    /// All items of a kind, instance by instance, with the instance and its number.
    pub(super) fn each<T: 'static>(&self, of: fn(&Body) -> &Vec<T>) -> impl Iterator<Item = (usize, &Instance, &T)> {
        let all = self.instances.iter().enumerate();
        all.flat_map(move |(i, at)| of(&self.bodies[at.body]).iter().map(move |item| (i, at, item)))
    }
}

/// Nodes and elements with numbers of their own.
#[derive(Default)]
pub(super) struct Body {
    pub(super) name: String,
    pub(super) nodes: Vec<(u64, [f64; 3], usize)>,
    pub(super) elements: Vec<FileElement>,
    pub(super) groups: Vec<NamedSet>,
    pub(super) surfaces: Vec<ElementSides>,
    pub(super) sections: Vec<FileSection>,
    pub(super) orientations: Vec<Orientation>,
}

pub(super) struct FileSection {
    pub(super) set: String,
    pub(super) orientation: Option<String>,
    pub(super) line: usize,
}

pub(super) struct Orientation {
    pub(super) name: String,
    /// Points a, b and c; the axis of the last turn and its angle.
    pub(super) rows: Vec<Vec<f64>>,
    /// The kind that is not read.
    pub(super) other: Option<String>,
    pub(super) line: usize,
}

pub(super) struct FileElement {
    pub(super) number: u64,
    pub(super) nodes: Vec<u64>,
    pub(super) set: Option<String>,
    pub(super) line: usize,
}

/// A node set or an element set.
pub(super) struct NamedSet {
    pub(super) name: String,
    pub(super) of_elements: bool,
    /// Made by a program for itself.
    pub(super) internal: bool,
    pub(super) instance: Option<String>,
    pub(super) members: Vec<SetMember>,
    pub(super) line: usize,
}

pub(super) enum SetMember {
    Range(u64, u64, u64),
    Named(String),
    /// Nodes of the elements of a set.
    NodesOf(String),
}

pub(super) struct ElementSides {
    pub(super) name: String,
    pub(super) rows: Vec<(String, String)>,
    pub(super) line: usize,
}

/// Placement of a part: moved, then turned about an axis through two points.
#[derive(Default)]
pub(super) struct Instance {
    pub(super) name: String,
    pub(super) body: usize,
    pub(super) moved: [f64; 3],
    pub(super) turned: Option<([f64; 3], [f64; 3], f64)>,
}
