//! Elements in groups of eight, structure of arrays, so that one vector instruction serves eight elements.

use super::reference::Reference;

/// Elements per group: one AVX-512 register of f64, two of AVX2.
pub const LANES: usize = 8;
/// One number for each element of a group.
pub type Lane = [f64; LANES];

/// Eight elements of one kind, section and pair of chambers.
#[derive(Debug, Clone)]
pub struct Group {
    /// Place of its constants in a table.
    pub constants: u32,
    /// Corner nodes by lane, numbered within the patch; a triangle repeats its third.
    pub node: [[u32; 4]; LANES],
}

/// What eight elements hold from start to end. In a structured mesh most groups share theirs, which then stay in the
/// first cache.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Constants {
    /// Shape gradients, see [`Reference::b`] \[1/m\].
    pub b: [[Lane; 2]; 2],
    /// Hourglass offsets s_a \[m\].
    pub s: [Lane; 2],
    /// Reference area \[m²\]; 0 for an empty lane.
    pub area: Lane,
    /// Reference area times what the law's answer is per: 2 t C₁₀ \[N/m\] for films, 1 for others.
    pub amount: Lane,
    /// Share of compression that a film does not carry.
    pub relief: Lane,
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
    /// What the law's answer is per, and the share of compression that a film does not carry.
    pub law: [f64; 2],
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
    /// Corner nodes of up to eight elements; an empty lane repeats the last.
    pub fn pack(items: &[Item], constants: u32) -> Group {
        let item = |lane: usize| &items[lane.min(items.len() - 1)].node;
        let corner = |lane: usize| std::array::from_fn(|c| item(lane)[c.min(item(lane).len() - 1)]);
        Group { constants, node: std::array::from_fn(corner) }
    }
}

/// Numbers that differ by less than this share of the element's size are rounding of the same number.
const ALIKE: f64 = 1e-12;

impl Constants {
    /// Packs up to eight elements, of which the first `counted_before` are counted by an earlier group. An empty lane
    /// repeats the last element with no area, stiffness or pressure, so that its arithmetic stays finite and its forces
    /// vanish.
    pub fn pack(items: &[Item], counted_before: usize) -> Constants {
        let zero = [0.0; LANES];
        let mut constants = Constants {
            b: [[zero; 2]; 2],
            s: [zero; 2],
            area: zero,
            amount: zero,
            relief: zero,
            hourglass: zero,
            viscosity: zero,
            own: zero,
            real: zero,
        };
        for lane in 0..LANES {
            let item = &items[lane.min(items.len() - 1)];
            for a in 0..2 {
                constants.b[0][a][lane] = item.reference.b[0][a];
                constants.b[1][a][lane] = item.reference.b[1][a];
                constants.s[a][lane] = item.reference.s[a];
            }
            if lane < items.len() {
                constants.area[lane] = item.reference.area;
                constants.amount[lane] = item.reference.area * item.law[0];
                constants.relief[lane] = item.law[1];
                constants.hourglass[lane] = item.hourglass;
                constants.viscosity[lane] = item.viscosity * item.reference.area;
                constants.own[lane] = f64::from(u8::from(item.own && lane >= counted_before));
                constants.real[lane] = 1.0;
            }
        }
        constants
    }

    /// The same for constants that are equal but for rounding, save where they lie just beside a step of it.
    pub fn key(&self) -> Vec<i64> {
        let steps = |value: f64| (value / ALIKE).round() as i64;
        let mut key = Vec::new();
        for lane in 0..LANES {
            // Lengths may be zero but for rounding: they are told in sizes of the element.
            let size = self.area[lane].sqrt();
            key.extend(self.b.as_flattened().iter().map(|b| steps(b[lane] * size)));
            key.extend(self.s.iter().map(|s| steps(s[lane] / size)));
            let positive = [self.area, self.amount, self.relief, self.hourglass, self.viscosity].map(|of| of[lane]);
            key.extend(positive.map(leading_bits));
            key.extend([self.own[lane], self.real[lane]].map(|flag| flag as i64));
        }
        key
    }
}

/// Sign, exponent and the 40 leading bits of the fraction, rounded.
pub fn leading_bits(value: f64) -> i64 {
    (value.to_bits() as i64 + (1 << 11)) >> 12
}
