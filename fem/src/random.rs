//! Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood 2014).

/// Even numbers in 0..1 from a seed.
pub(crate) struct Draws(pub u64);

impl Draws {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A standard normal number from a seed and a counter (Box–Muller).
pub(crate) fn gaussian(seed: u64, counter: u64) -> f64 {
    let of = (seed ^ 0x9E37_79B9_7F4A_7C15).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    let draw = |salt: u64| Draws(of.wrapping_add(counter * 2 + salt)).next();
    (-2.0 * (1.0 - draw(0)).ln()).sqrt() * (std::f64::consts::TAU * draw(1)).cos()
}
