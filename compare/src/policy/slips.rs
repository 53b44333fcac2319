//! The numbers by which data look like a slip.

/// Holds within this share of the highest pressure of the lowest are the lowest.
pub const LOWEST: f64 = 0.02;
/// Chance of the shift where nothing is shifted, above which no shift is reported.
pub const SHIFT_CHANCE: f64 = 1e-3;
/// Share that a shift may leave of the mean over runs. A lens that bulges the image is off at the base too, grows otherwise
/// from there, and leaves a third without any noise; 1300 sets of `ibr bench discovery` without a slip left 0.28 or more.
pub const SHIFT_LEAVES: f64 = 0.2;
/// Heading of the last marker beyond which a hold is not nearly straight \[rad\].
pub const NEARLY_STRAIGHT: f64 = 0.8;
/// A distance that undoing a slip takes to less than this share of it is called far less. Undoing a slip that is not there
/// leaves more than before, so that anything below 1 would do without noise.
pub const FAR_LESS: f64 = 0.5;
/// Beyond this factor either way it is not a camera's scale: the catalogue's `camera_scale` ends there.
pub const NO_SCALE: f64 = 1.25;
/// How near a factor must be to the factor of a unit to be called by it.
pub const NEAR_UNIT: f64 = 0.1;
/// Half of the distance of two markers must be this many times what a marker is usually off: labels of markers closer together than
/// the noise cannot be checked.
pub const LABELS_CLEAR: f64 = 3.0;

/// Whether a pressure is the lowest of a protocol, of its lowest and highest.
pub fn is_lowest(pressure_pa: f64, [low_pa, high_pa]: [f64; 2]) -> bool {
    pressure_pa <= low_pa + LOWEST * high_pa
}

/// Whether a shift explains a mean over runs: its squares without and with it, and the chance of that where nothing is shifted.
pub fn is_a_shift([before, after]: [f64; 2], chance: f64) -> bool {
    after < SHIFT_LEAVES * SHIFT_LEAVES * before && chance < SHIFT_CHANCE
}

/// Whether a hold whose last marker heads so far off is straight enough to show the origin \[rad\].
pub fn is_nearly_straight(heading: f64) -> bool {
    heading < NEARLY_STRAIGHT
}

/// Whether a distance is so much less than another that chance is excluded.
pub fn is_far_less(after_m: f64, before_m: f64) -> bool {
    after_m < FAR_LESS * before_m
}

/// Whether a factor on positions is none that a camera makes.
pub fn is_no_scale(factor: f64) -> bool {
    !(1.0 / NO_SCALE..=NO_SCALE).contains(&factor)
}

/// Whether a factor is the factor of a unit, from their quotient.
pub fn is_near_unit(quotient: f64) -> bool {
    (quotient - 1.0).abs() < NEAR_UNIT
}

/// Whether two markers that are apart by twice that can be distinguished where markers are usually off by so much.
pub fn labels_are_clear(half_apart_m: f64, usual_m: f64) -> bool {
    half_apart_m > LABELS_CLEAR * usual_m
}

/// A pressure that is less than this below another is not below it \[Pa\]: the tolerance of a hold.
pub const NOT_BELOW_PA: f64 = 500.0;
/// An undone slip of a pressure must be that much better than anything else, by the sums of squares and what numbers cost.
pub const SLIP_CLEARLY: f64 = 4.0;
/// A stiffness within this factor of the scenario's needs no slip to explain it; beyond, it is one standard deviation.
pub const SAME_STIFFNESS: f64 = 2.0;

/// Whether a pressure is another one or above it \[Pa\].
pub fn is_not_below(pressure_pa: f64, other_pa: f64) -> bool {
    pressure_pa > other_pa - NOT_BELOW_PA
}

/// Whether a criterion is better than another one beyond doubt of a slip.
pub fn is_clearly_better(criterion: f64, other: f64) -> bool {
    criterion + SLIP_CLEARLY < other
}

/// Whether a fitted stiffness may be the scenario's; any may, where that is zero because it is unknown \[N·m²\].
pub fn is_same_stiffness(fitted: f64, told: f64) -> bool {
    told == 0.0 || (1.0 / SAME_STIFFNESS..=SAME_STIFFNESS).contains(&(fitted / told))
}
