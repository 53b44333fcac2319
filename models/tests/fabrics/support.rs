//! Repeatable random numbers, strains, and a uniaxial test.

use models::Fabric;

pub(crate) const FRESH: [f64; 2] = [0.0; 2];

pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A strain with entries up to `limit`, of all sizes, pulled or pushed.
    pub(crate) fn strain(&mut self, limit: f64) -> [f64; 3] {
        let size = limit * 10f64.powf(self.between(-3.0, 0.0));
        [self.between(-size, size), self.between(-size, size), self.between(-size, size)]
    }
}

/// Tension over stretch per thickness at a small strain, pulled at `angle` to warp: E \[Pa\] of a uniaxial test, from the
/// tangent: 1/(tE) = v·T⁻¹v with v = [c², s², cs].
pub(crate) fn modulus(fabric: &dyn Fabric, angle_deg: f64, at: f64) -> f64 {
    let (s, c) = angle_deg.to_radians().sin_cos();
    let v = [c * c, s * s, c * s];
    // Newton on S(e) = N v, from rest: strain along the pull is then [c², s², cs]·e, with the shear as engineering strain.
    let mut e = [0.0; 3];
    for _ in 0..20 {
        let off: [f64; 3] = {
            let now = fabric.tension(e, &FRESH);
            std::array::from_fn(|i| at * v[i] - now[i])
        };
        let step = solve(fabric.tangent(e, &FRESH), off);
        e = std::array::from_fn(|i| e[i] + step[i]);
    }
    let strain = v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
    at / strain / fabric.thickness_m()
}

/// x of m x = b by Cramer's rule.
pub(crate) fn solve(m: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let det = |m: [[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    std::array::from_fn(|k| {
        let mut with = m;
        (0..3).for_each(|i| with[i][k] = b[i]);
        det(with) / det(m)
    })
}

/// Largest difference over the largest entry of `a`, or over `floor`.
pub(crate) fn apart<const N: usize>(a: [f64; N], b: [f64; N], floor: f64) -> f64 {
    let size = a.iter().fold(floor, |m, x| m.max(x.abs()));
    a.iter().zip(b).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs())) / size
}
