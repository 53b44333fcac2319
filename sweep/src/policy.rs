//! The numbers that decide what a sweep refuses and how it is cut.

/// Cases of a study; more were hardly meant.
pub const MOST_CASES: usize = 20_000_000;
/// Cases of the reduced model in one part: some milliseconds of work, and a file of some hundred kB.
pub const PART: usize = 8192;
/// Cases that the Sobol sequence has.
pub const MOST_SOBOL: usize = 65_536;
