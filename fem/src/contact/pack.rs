//! Pairs of nodes and faces in groups of eight: the part of contact that runs every step.
//!
//! ```text
//! n = s e₁×e₂/|e₁×e₂|    d = (p − a)·n    w₁ = ((p − a)×e₂)·m/m²    w₂ = (e₁×(p − a))·m/m²    m = e₁×e₂
//! ```

use pulp::Simd;

use super::record::{Record, Touch};
use crate::sheet::group::{LANES, Lane};
use crate::sheet::lanes::{V, axes, inner, product};
use crate::vec3::Nodes;

#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Pack {
    /// Node and the corners of the face.
    pub node: [[u32; LANES]; 4],
    pub sign: Lane,
    pub(crate) rest_m: Lane,
    pub(crate) stiffness_n_m: Lane,
    pub(crate) damping_n_s_m: Lane,
    /// Depth and damping force of the step before.
    pub last_m: Lane,
    pub(crate) damped_n: Lane,
    /// Position of the record in the chunk.
    pub record: [u32; LANES],
}

/// Geometry of eight pairs at one moment.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Touches {
    pub(crate) depth_m: Lane,
    pub normal: [Lane; 3],
    pub w1: Lane,
    pub(crate) w2: Lane,
}

impl Touches {
    pub(super) const NONE: Touches = Touches { depth_m: [0.0; 8], normal: [[0.0; 8]; 3], w1: [0.0; 8], w2: [0.0; 8] };

    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> Touch {
        let (w1, w2) = (self.w1[lane], self.w2[lane]);
        let normal = [self.normal[0][lane], self.normal[1][lane], self.normal[2][lane]];
        Touch { depth_m: self.depth_m[lane], normal, weights: [1.0 - w1 - w2, w1, w2] }
    }
}

impl Pack {
    /// Pairs of these records; unused lanes repeat the first pair with a gap that never closes.
    pub(super) fn new(records: &[Record], members: &[u32]) -> Pack {
        let first = members.first().map_or(0, |at| *at);
        let of = |lane: usize| &records[members.get(lane).copied().unwrap_or(first) as usize];
        let lanes = |value: fn(&Record) -> f64| std::array::from_fn(|lane| value(of(lane)));
        let ids = |k: usize| std::array::from_fn(|lane| if k == 0 { of(lane).node } else { of(lane).corners[k - 1] });
        let mut pack = Pack {
            node: [ids(0), ids(1), ids(2), ids(3)],
            sign: lanes(|r| r.sign),
            rest_m: lanes(|r| r.rest_m),
            stiffness_n_m: lanes(|r| r.stiffness_n_m),
            damping_n_s_m: lanes(|r| r.damping_n_s_m),
            last_m: lanes(|r| r.last_m),
            damped_n: lanes(|r| r.damped_n),
            record: std::array::from_fn(|lane| members.get(lane).copied().unwrap_or(first)),
        };
        for lane in members.len()..LANES {
            (pack.rest_m[lane], pack.damped_n[lane], pack.record[lane]) = (f64::NEG_INFINITY, 0.0, u32::MAX);
            pack.last_m[lane] = f64::NEG_INFINITY;
        }
        pack
    }

    /// Gives the records back what the step before left.
    pub(super) fn unload(&self, records: &mut [Record]) {
        for lane in 0..LANES {
            if let Some(record) = records.get_mut(self.record[lane] as usize) {
                (record.last_m, record.damped_n) = (self.last_m[lane], self.damped_n[lane]);
                record.rest_m = self.rest_m[lane];
                record.wanted_m = record.wanted_m.max(record.rest_m);
            }
        }
    }

    /// Depth, normal and weights of all lanes; false if none of them touches or did in the step before.
    #[inline(always)]
    pub(super) fn measure<S: Simd>(&self, simd: S, x: &Nodes, touches: &mut Touches) -> bool {
        let mut any = false;
        for part in 0..LANES / S::F64_LANES {
            let p = rows(simd, x, &self.node[0], part);
            let a = rows(simd, x, &self.node[1], part);
            let b = rows(simd, x, &self.node[2], part);
            let c = rows(simd, x, &self.node[3], part);
            let e1 = axes!(k => b[k] - a[k]);
            let e2 = axes!(k => c[k] - a[k]);
            let r = axes!(k => p[k] - a[k]);
            let m = product(e1, e2);
            let inverse = inner(m, m).inverse();
            let per = V::load(simd, &self.sign, part) * inverse.sqrt();
            let normal = axes!(k => m[k] * per);
            let depth = V::load(simd, &self.rest_m, part) - inner(r, normal);
            any |= depth.max(V::load(simd, &self.last_m, part)).largest() > 0.0;
            depth.store(&mut touches.depth_m, part);
            (inner(product(r, e2), m) * inverse).store(&mut touches.w1, part);
            (inner(product(e1, r), m) * inverse).store(&mut touches.w2, part);
            for (normal, to) in normal.into_iter().zip(&mut touches.normal) {
                normal.store(to, part);
            }
        }
        any
    }
}

/// Positions of one of the nodes of every lane.
#[inline(always)]
pub(super) fn rows<S: Simd>(simd: S, x: &Nodes, node: &[u32; LANES], part: usize) -> [V<S>; 3] {
    let mut out = [[0.0; LANES]; 3];
    for lane in 0..S::F64_LANES {
        let p = &x[node[part * S::F64_LANES + lane] as usize];
        (out[0][lane], out[1][lane], out[2][lane]) = (p[0], p[1], p[2]);
    }
    V::load_all(simd, &out, 0)
}
