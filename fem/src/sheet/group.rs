//! Elements in groups of eight, structure of arrays, so that one vector instruction serves eight elements.

use super::reference::Reference;

/// Elements per group: one AVX-512 register of f64, two of AVX2.
pub const LANES: usize = 8;
/// One number for each element of a group.
pub type Lane = [f64; LANES];

/// Eight elements of one kind, section and pair of chambers.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Group {
    /// Corner nodes, numbered within the patch; a triangle repeats its third.
    pub node: [[u32; LANES]; 4],
    /// Shape gradients, see [`Reference::b`] \[1/m\].
    pub b: [[Lane; 2]; 2],
    /// Hourglass offsets s_a \[m\].
    pub s: [Lane; 2],
    /// Reference area \[m²\]; 0 for an empty lane.
    pub area: Lane,
    /// Hourglass stiffness k \[N/m\].
    pub hourglass: Lane,
    /// Viscosity times area η A \[N m s\].
    pub viscosity: Lane,
    /// 1 where the element's energy is this lane's to count, 0 where another lane or patch counts it.
    pub own: Lane,
    /// 1 in lanes that hold an element.
    pub real: Lane,
}

/// One element before packing.
#[derive(Debug, Clone)]
pub struct Item {
    /// Corner nodes, 3 or 4.
    pub node: Vec<u32>,
    /// Reference data.
    pub reference: Reference,
    /// Hourglass stiffness \[N/m\].
    pub hourglass: f64,
    /// Viscosity \[N s/m\].
    pub viscosity: f64,
    /// Whether this patch counts its energy.
    pub own: bool,
    /// Part number.
    pub part: u32,
    /// Number of the element in mesh order.
    pub element: u32,
}

impl Group {
    /// Packs up to eight elements, of which the first `counted_before` are counted by an earlier group. An empty lane
    /// repeats the last element with no area, stiffness or pressure, so that its arithmetic stays finite and its forces
    /// vanish.
    pub fn pack(items: &[Item], counted_before: usize) -> Group {
        let mut group = Group {
            node: [[0; LANES]; 4],
            b: [[[0.0; LANES]; 2]; 2],
            s: [[0.0; LANES]; 2],
            area: [0.0; LANES],
            hourglass: [0.0; LANES],
            viscosity: [0.0; LANES],
            own: [0.0; LANES],
            real: [0.0; LANES],
        };
        for lane in 0..LANES {
            let item = &items[lane.min(items.len() - 1)];
            for corner in 0..4 {
                group.node[corner][lane] = item.node[corner.min(item.node.len() - 1)];
            }
            for a in 0..2 {
                group.b[0][a][lane] = item.reference.b[0][a];
                group.b[1][a][lane] = item.reference.b[1][a];
                group.s[a][lane] = item.reference.s[a];
            }
            if lane < items.len() {
                group.area[lane] = item.reference.area;
                group.hourglass[lane] = item.hourglass;
                group.viscosity[lane] = item.viscosity * item.reference.area;
                group.own[lane] = f64::from(u8::from(item.own && lane >= counted_before));
                group.real[lane] = 1.0;
            }
        }
        group
    }
}
