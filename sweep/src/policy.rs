//! The numbers that decide what a sweep refuses and how it is cut.

/// Cases of a study; more were hardly meant.
pub const MOST_CASES: usize = 20_000_000;
/// Parts of one engine that a study is cut into, as far as [`PART`] allows: few files, and enough of them for many shards to share evenly.
pub const PARTS: usize = 96;
/// Fewest and most cases of the reduced model in one part: from a millisecond of work to some seconds.
pub const PART: [usize; 2] = [256, 65_536];
