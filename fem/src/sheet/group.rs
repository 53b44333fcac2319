//! Elements in groups of eight, structure of arrays, so that one vector instruction serves eight elements.

use super::reference::Reference;

/// Elements per group: one AVX-512 register of f64, two of AVX2.
pub(crate) const LANES: usize = 8;
/// One number for each element of a group.
pub(crate) type Lane = [f64; LANES];

/// Eight elements of one kind, section and pair of chambers.
#[derive(Debug, Clone)]
pub(crate) struct ElementGroup {
    /// Places of its shape and its stock in their tables.
    pub shape: u32,
    pub(crate) stock: u32,
    /// Corner nodes by lane, numbered within the patch; a triangle repeats its third.
    pub node: [[u32; 4]; LANES],
}

/// Stress-free shape of eight elements and what follows from it. In a structured mesh most groups share theirs, which then
/// stays in the first cache; where every element has its own, as in a wavy robot, this is what each step must fetch.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct RestShape {
    /// Gradients of the shape functions by lane, as [`Reference::b`] \[1/m\].
    pub b: [[Lane; 2]; 2],
    /// A quarter of the hourglass offsets s_a \[m\].
    pub s: [Lane; 2],
    /// Reference area \[m²\]; 0 for an empty lane.
    pub area: Lane,
    /// Hourglass stiffness k \[N/m\]; 0 for an empty lane.
    pub hourglass: Lane,
    /// Viscosity times area η A \[N m s\]; 0 for an empty lane.
    pub viscosity: Lane,
}

/// What eight elements are made of and who counts them.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct Stock {
    /// What the law's answer is per: 2 t C₁₀ \[N/m\] for films, 1 for others.
    pub per: Lane,
    /// Root of the energy of compression, per `per`, at which a film wrinkles.
    pub flat: Lane,
    /// 1 where the element's energy is this lane's to count, 0 where another lane or patch counts it.
    pub own: Lane,
    /// 1 in lanes that hold an element.
    pub real: Lane,
}

#[derive(Debug, Clone)]
pub(crate) struct Item {
    pub node: Vec<u32>,
    pub reference: Reference,
    /// The lanes `per` and `flat` of [`Stock`].
    pub law: [f64; 2],
    pub hourglass: f64,
    pub viscosity: f64,
    /// Whether this patch counts its energy.
    pub own: bool,
    pub part: u32,
    /// Number of the element in mesh order.
    pub element: u32,
}

impl ElementGroup {
    /// Corner nodes of up to eight elements; an empty lane repeats the last.
    pub(crate) fn pack(items: &[Item], shape: u32, stock: u32) -> ElementGroup {
        let item = |lane: usize| &items[lane.min(items.len() - 1)].node;
        let corner = |lane: usize| std::array::from_fn(|c| item(lane)[c.min(item(lane).len() - 1)]);
        ElementGroup { shape, stock, node: std::array::from_fn(corner) }
    }
}

/// Numbers that differ by less than this share of the element's size are rounding of the same number.
const ALIKE: f64 = 1e-12;

impl RestShape {
    /// Packs up to eight elements. An empty lane repeats the last one without area and stiffness, so that its arithmetic stays
    /// finite and its forces vanish.
    pub(crate) fn pack(items: &[Item]) -> RestShape {
        let zero = [0.0; LANES];
        let mut shape = RestShape { b: [[zero; 2]; 2], s: [zero; 2], area: zero, hourglass: zero, viscosity: zero };
        for lane in 0..LANES {
            let item = &items[lane.min(items.len() - 1)];
            for a in 0..2 {
                shape.b[0][a][lane] = item.reference.b[0][a];
                shape.b[1][a][lane] = item.reference.b[1][a];
                shape.s[a][lane] = 0.25 * item.reference.s[a];
            }
            if lane < items.len() {
                shape.area[lane] = item.reference.area;
                shape.hourglass[lane] = item.hourglass;
                shape.viscosity[lane] = item.viscosity * item.reference.area;
            }
        }
        shape
    }

    /// The same for shapes that are equal but for rounding, save where they are close to a step of it.
    pub(crate) fn key(&self) -> Vec<i64> {
        let steps = |value: f64| (value / ALIKE).round() as i64;
        let mut key = Vec::new();
        for lane in 0..LANES {
            // Lengths may be zero but for rounding: they are measured in sizes of the element.
            let size = self.area[lane].sqrt();
            key.extend(self.b.as_flattened().iter().map(|b| steps(b[lane] * size)));
            key.extend(self.s.iter().map(|s| steps(s[lane] / size)));
            key.extend([self.area, self.hourglass, self.viscosity].map(|of| leading_bits(of[lane])));
        }
        key
    }
}

impl Stock {
    /// Packs up to eight elements, of which the first `counted_before` are counted by an earlier group.
    pub(crate) fn pack(items: &[Item], counted_before: usize) -> Stock {
        let zero = [0.0; LANES];
        let mut stock = Stock { per: zero, flat: zero, own: zero, real: zero };
        for (lane, item) in items.iter().enumerate() {
            stock.per[lane] = item.law[0];
            stock.flat[lane] = item.law[1];
            stock.own[lane] = f64::from(u8::from(item.own && lane >= counted_before));
            stock.real[lane] = 1.0;
        }
        stock
    }

    pub(crate) fn key(&self) -> Vec<i64> {
        let all = [self.per, self.flat, self.own, self.real];
        all.as_flattened().iter().map(|value| leading_bits(*value)).collect()
    }
}

/// Sign, exponent and the 40 leading bits of the fraction, rounded.
pub(crate) fn leading_bits(value: f64) -> i64 {
    (value.to_bits() as i64 + (1 << 11)) >> 12
}
