//! The numbers that decide a verdict, and the decisions that several places take by them. Each states its meaning, its unit, and
//! so which error it trades for which. `tests/policy.sh` moves every one of them and names the tests that fail then.
//!
//! What only steers a search (steps, rounds, starts) stays where it is used: it moves no verdict.

use crate::directions::DirectionRow;
use data::Hold;

mod slips;
mod study;
#[cfg(test)]
mod tests;

pub use slips::*;
pub use study::*;

/// Of the level α, the share that the effects get; the tests for lack of fit get the rest.
pub const SHARE_OF_EFFECTS: f64 = 0.8;

/// A second effect is looked for if more than this share of the error is left: the catalogue's laws are not the real ones to the
/// last twentieth.
pub const WORTH_A_SECOND: f64 = 0.05;
/// And if more than this is left \[mm\].
pub const WORTH_A_SECOND_MM: f64 = 0.15;
/// More than this share of the error left by one effect means that the catalogue does not explain it. Errors are those beyond noise
/// and scatter between runs.
pub const LEFT_BY_ONE: f64 = 0.2;
/// The same share where two effects were fitted together.
pub const LEFT_BY_TWO: f64 = 0.15;
/// Less is nothing left over, whatever its share \[mm\].
pub const LEAST_LEFT_MM: f64 = 0.05;
/// A significant place with more than this share of the error is not explained: the law of a uniform robot, however wrong
/// its form, leaves uniform bending.
pub const PLACE_LEFT: f64 = 0.1;
/// Left over by more than this share, a trace along yet another effect means the same as a lack of fit.
pub const MOST_LEFT: f64 = 0.5;

/// Whether what an effect leaves of an error is worth a second one.
pub fn is_worth_a_second(after_mm: f64, before_mm: f64) -> bool {
    after_mm > WORTH_A_SECOND_MM.max(WORTH_A_SECOND * before_mm)
}

/// Whether one effect, or two, leave more of an error than the form of their laws may.
pub fn is_left_over(effects: usize, after_mm: f64, before_mm: f64) -> bool {
    let share = if effects > 1 { LEFT_BY_TWO } else { LEFT_BY_ONE };
    after_mm > LEAST_LEFT_MM.max(share * before_mm)
}

/// Whether an effect leaves most of an error.
pub fn is_most(after_mm: f64, before_mm: f64) -> bool {
    after_mm > MOST_LEFT * before_mm
}

/// Least share of the remaining misfit that a pattern must explain to be shown.
const LEAST_SHARE_OF_A_HINT: f64 = 0.5;

/// Whether a pattern explains enough of the remaining misfit to send somebody to the robot.
pub fn is_worth_a_look(share: f64) -> bool {
    share >= LEAST_SHARE_OF_A_HINT
}

/// Whether a place with that gain, compared with a fit's gain, holds a share of the error; amplitudes, as far as they were seen.
pub fn is_a_place_left(gain: f64, of_fit: f64) -> bool {
    gain - 1.0 > PLACE_LEFT * PLACE_LEFT * (of_fit + gain)
}

/// Differences of a criterion below this do not decide.
pub const SAME_EVIDENCE: f64 = 6.0;
/// Share of the best gain that counts as [`SAME_EVIDENCE`].
pub const FORM: f64 = 0.05;
/// One standard deviation of the size, as a factor.
pub const SIZE_FACTOR: f64 = 3.0;
/// Least price of a parameter, where hardly any information is left.
pub const LEAST_PRICE: f64 = 1.0;
/// Beyond this multiple of its usual size an effect is measured before it is believed: more than half of the pressure lost, of 0.15.
pub const UNUSUAL_SIZE: f64 = 10.0 / 3.0;

/// Whether an effect of so many times its usual size is.
pub fn is_unusual_size(times: f64) -> bool {
    times > UNUSUAL_SIZE
}

/// Sizes beyond this factor from the typical one are equally odd.
pub const ODDEST: f64 = 1e3;
/// Width of the prior of a law's shape about the usual one, as a share of its range. Assumed: between the median (0.19) and the
/// root mean square (0.34) of what the formulas of `ibr bench discovery` ask for.
pub const SHAPE: f64 = 0.25;
/// Gain below which an effect does not help: less than one parameter of noise.
pub const HELPS: f64 = 1.0;
/// Gain below which a name is a hint.
pub const HINT: f64 = 25.0;
/// Gain above which a name without a rival is called identified: of such names 19 in 20 are true on `ibr bench discovery`, sets with two
/// effects and with something outside the catalogue among them.
pub const IDENTIFIED: f64 = 200.0;

/// Share of the stated sets that hold a true effect, over all sets of `ibr bench discovery` with a verdict that names: one effect and
/// two, none, outside the catalogue, wrong instruments, an effect too many. It is printed with a set, and a row of that table holds it.
pub const COVERED: f64 = 0.94;

/// Standard deviation of a shape that is searched in such a range.
pub fn shape_sd(lower: f64, upper: f64) -> f64 {
    SHAPE * (upper - lower)
}

/// Whether an effect helps at all, of its gain.
pub fn helps(gain: f64) -> bool {
    gain > HELPS
}

/// Whether a name with that gain is only a hint.
pub fn is_a_hint(gain: f64) -> bool {
    gain < HINT
}

/// Whether a name with that gain is the one of this catalogue, if it has no rival.
pub fn is_beyond_doubt(gain: f64) -> bool {
    gain > IDENTIFIED
}

/// Whether an explanation cannot be separated from the best one, by a criterion of both.
pub fn is_alike(criterion: f64, best: f64) -> bool {
    criterion - best < SAME_EVIDENCE
}

/// Whether a criterion is as good as another one, to [`SAME_EVIDENCE`].
pub fn is_as_good(criterion: f64, other: f64) -> bool {
    criterion < other + SAME_EVIDENCE
}

/// Another attempt, or a second effect, must bring the error in mm below this share; a second effect, or within the tolerance.
pub const CLOSER: f64 = 0.8;
/// Share of the error left up to which the best of the catalogue is named as a part of the answer.
pub const MOSTLY: f64 = 0.25;
/// An error that falls to less than this share speaks for what was added.
pub const FALLS: f64 = 0.7;
/// Contributions this opposite cancel: the cosine between them.
pub const CANCELS: f64 = -0.95;

/// A robot made otherwise is diagnosed if its base leaves less than this multiple of the error. The textbook sPAM and ePAM on their finite
/// elements have 1.1 and 1.3: 1 loses both, and 4.5 changes nothing but the time.
pub const MADE_OTHERWISE: f64 = 1.5;

/// Whether another design may be the robot's, of the errors of both bases.
pub fn may_be_made_so(other_mm: f64, own_mm: f64) -> bool {
    other_mm < MADE_OTHERWISE * own_mm
}

/// Whether an error is less than another by a fifth.
pub fn is_closer(after_mm: f64, before_mm: f64) -> bool {
    after_mm < CLOSER * before_mm
}

/// Whether an error falls so far that this speaks for what was added: at what was left out of a fit, at other data, of a ledger.
pub fn falls(after: f64, before: f64) -> bool {
    after < FALLS * before
}

/// Whether so little of an error is left that an answer outside the catalogue has most of it from the catalogue.
pub fn is_mostly_gone(after_mm: f64, before_mm: f64) -> bool {
    after_mm <= MOSTLY * before_mm
}

/// Whether two contributions with that cosine between them do.
pub fn cancel(cosine: f64) -> bool {
    cosine < CANCELS
}

/// A stiffness that moves by more than this share is reported.
pub const BENDING_MOVES: f64 = 0.2;
/// A base that leaves more than this share of the measured movement does not fit at all.
pub const NO_FIT: f64 = 0.5;
/// Standard deviations by which a separate test and the markers disagree.
pub const DISAGREE: f64 = 3.0;
/// Standard deviations by which the noise of a test may carry its value beyond a physical bound.
pub const BEYOND_BOUNDS: f64 = 5.0;
/// Largest B searched \[N·m²\]: 100 times what a 0.2 mm coated fabric would need at these sizes.
pub const MOST_BENDING: f64 = 200.0;
/// Costs of two starts that differ by more than this end in different minima.
pub const SAME_MINIMUM: f64 = 1.0;
/// A range that ends where physics does not is searched once more, so many times as far.
pub const WIDER: f64 = 10.0;
/// A bound is binding if the data would gain this much beyond it: two standard errors.
pub const BINDING: f64 = 4.0;

/// Whether a bending stiffness moved so far that something else is in it \[N·m²\].
pub fn bending_moves(from: f64, to: f64) -> bool {
    (to - from).abs() > BENDING_MOVES * from.max(1e-3)
}

/// Whether a base leaves so much of a movement that scenario and data are of different robots.
pub fn does_not_fit(left_mm: f64, moved_mm: f64) -> bool {
    left_mm > NO_FIT * moved_mm
}

/// Whether two findings that differ by so many standard deviations contradict each other.
pub fn disagree(deviations: f64) -> bool {
    deviations.abs() > DISAGREE
}

/// Whether a value may be one within these bounds, of its standard deviation.
pub fn is_within([lower, upper]: [f64; 2], value: f64, sd: f64) -> bool {
    (lower - BEYOND_BOUNDS * sd..=upper + BEYOND_BOUNDS * sd).contains(&value)
}

/// Whether a fit ended in another minimum than the least.
pub fn is_another_minimum(cost: f64, least: f64) -> bool {
    cost - least > SAME_MINIMUM
}

/// Above this share stray samples are the noise, and none is replaced.
pub const MOST_REPLACED: f64 = 0.05;
/// A run is an outlier below this p, corrected for the number of runs.
pub const RUN_STANDS_OUT: f64 = 0.001;
/// A pair of holds scatters otherwise below this p, corrected for the number of pairs.
pub const HOLD_STANDS_OUT: f64 = 0.01;
/// And if run or hold scatters by more than this factor more than the others.
pub const RUN_SCATTERS: f64 = 1.5;
/// Runs of which one can be identified as the odd one, and for which p-values are given.
pub const FEWEST_RUNS: usize = 3;
/// Fewest holds that show how single holds scatter.
pub const FEWEST_HOLDS: usize = 3;
/// Errors last through a hold if the scatter of its samples explains the scatter of its readings with a smaller chance than this.
pub const READINGS_LAST: f64 = 0.05;
/// Share of a kind of scatter of holds that errors of whole runs leave, from which on it is looked for.
pub const NEW_IN_HOLDS: f64 = 0.05;
/// Tests take the variance of a kind of scatter of holds for so many standard errors larger. From a third to three times as many, no row of
/// a right model in `tests/laboratory.rs` exceeds what it may.
pub const HOLD_VARIANCE_ERRORS: f64 = 1.0;
/// Scatter of holds is printed from so many standard errors of its variance on.
pub const HOLD_SCATTER_PRINTED: f64 = 2.0;
/// Standard errors by which a pressure falls that runs down during a hold.
pub const RUNS_DOWN: f64 = 4.0;
/// Specification of the sensors, the least scatter ever assumed in a test: pressure 0.3 % of the reading, a gauge's gain too, alignment
/// 0.1 mm in x and y, rotation 0.5 mrad.
pub const SENSOR_SD: DirectionRow = [0.003, 1e-4, 1e-4, 5e-4, 1e-4, 5e-4, 5e-4];
/// Standard deviation of a gauge's zero \[Pa\]. Assumed: 0.25 % of a span of 40 kPa.
pub const ZERO_SD_PA: f64 = 100.0;
/// Standard deviation of one reading \[Pa\], where there are no repeats to take it from. Assumed.
pub const READING_SD_PA: f64 = 50.0;
/// Least standard deviation of one reading \[Pa\]: the last digit.
pub const LEAST_READING_SD_PA: f64 = 20.0;
/// Multiple of the noise that counts as standing out where no p-value can be given (two runs, or σ supplied).
pub const MANY_TIMES_THE_NOISE: f64 = 5.0;
/// Mean square of whitened residuals from which a misfit counts: as much again as the noise, which several hundred values never are by
/// chance.
pub const MISSES: f64 = 2.0;
/// Mean square of whitened residuals, a misfit of three times the noise, from which a fit allows for it (chosen, `docs/accuracy.md`):
/// s² then grows by that factor, so that scatter between runs, which is not a misfit, keeps its small share. With few runs a
/// law that misses would otherwise hide in it.
pub const MISFIT: f64 = 10.0;
/// Half-width over value above which the profile is followed.
pub const WIDE: f64 = 0.3;
/// A pressure informs about a parameter if its share of the squared weights is above this.
pub const PRESSURE_TELLS: f64 = 1e-3;

/// Whether a law misses data by more than noise, of the mean square of its whitened residuals.
pub fn misses(mean_square: f64) -> bool {
    mean_square > MISSES
}

/// Whether it misses by so much that a fit allows for it.
pub fn is_a_misfit(mean_square: f64) -> bool {
    mean_square >= MISFIT
}

/// Whether stray samples are so few that the other runs may stand in for them.
pub fn are_strays(share: f64, runs: usize) -> bool {
    share <= MOST_REPLACED && runs >= FEWEST_RUNS
}

/// Whether scatter of holds of a kind is printed, of its variance and the standard error of that.
pub fn holds_scatter(variance: f64, error: f64) -> bool {
    variance > HOLD_SCATTER_PRINTED * error
}

/// Whether the scatter of two holds is not one, of the chance of that for any pair and of their quotient.
pub fn is_uneven(p_corrected: f64, ratio: f64) -> bool {
    p_corrected < HOLD_STANDS_OUT && ratio > RUN_SCATTERS
}

/// Whether a pressure runs down that falls by so many standard errors between the first and the last sample of a hold.
pub fn runs_down(deviations: f64) -> bool {
    deviations.abs() > RUNS_DOWN
}

/// Whether a run that scatters so many times as much as the others is not one of them.
pub fn run_stands_out(p_corrected: f64, ratio: f64) -> bool {
    p_corrected < RUN_STANDS_OUT && ratio > RUN_SCATTERS
}

/// Normal quantile of nine in ten.
pub const Z_POWER: f64 = 1.2816;
/// λ below which an experiment is not worth its time.
pub const WORTHLESS: f64 = 3.0;

/// Whether an experiment that parts two explanations by λ is worth its time.
pub fn is_worth_its_time(lambda: f64) -> bool {
    lambda >= WORTHLESS
}

/// Share of the squares of a misfit that a pattern must hold to be reported.
pub const PATTERN_TELLS: f64 = 0.25;

/// Levels of actuator pressure from which a law is learned: one is left out, and two determine a slope.
pub const FEWEST_LEVELS: usize = 3;

/// Ratios P/p within this fraction match.
pub const SAME_RATIO: f64 = 0.03;
/// Body pressures must differ by more than this fraction, or the pair tests nothing.
pub const BODY_DIFFERENCE: f64 = 0.10;
/// Actuator pressures below this count as "no pressure" \[Pa\]: a vented regulator still reads a little.
pub const ZERO_PRESSURE_PA: f64 = 100.0;
/// Pressures within this fraction are one level.
pub const SAME_PRESSURE: f64 = 0.05;
/// Components of unit vectors that differ by less are the same.
pub const SAME_DIRECTION: f64 = 0.05;

/// Whether the highest pressure of an actuator is clearly below the highest of its body \[Pa\].
pub fn is_never_above(act_pa: f64, body_pa: f64) -> bool {
    act_pa < body_pa - ZERO_PRESSURE_PA
}

/// Whether two ratios P/p differ by a factor within [`SAME_RATIO`].
pub fn is_same_ratio(one: f64, other: f64) -> bool {
    (one / other).ln().abs() <= SAME_RATIO
}

/// Whether two body pressures are so different that the scaling law can be tested.
pub fn bodies_differ(one_pa: f64, other_pa: f64) -> bool {
    (one_pa / other_pa).ln().abs() > BODY_DIFFERENCE
}

/// Whether two pressures are one level \[Pa\].
pub fn is_same_pressure(one_pa: f64, other_pa: f64) -> bool {
    (one_pa - other_pa).abs() <= (SAME_PRESSURE * one_pa.abs().max(other_pa.abs())).max(ZERO_PRESSURE_PA)
}

/// Whether two holds have the same pressures in the body and in every supply channel.
pub fn same_pressures(one: &Hold, other: &Hold) -> bool {
    is_same_pressure(one.p_body_pa, other.p_body_pa) && same_channels(one, other)
}

/// Whether two holds have the same pressure in every supply channel.
pub fn same_channels(one: &Hold, other: &Hold) -> bool {
    one.channels_pa().zip(other.channels_pa()).all(|(a, b)| is_same_pressure(a, b))
}

/// No robot is this long \[m\]; a larger number is a unit mistake.
pub const FARTHEST_M: f64 = 1e3;
/// Lengths within this fraction are the same.
pub const SAME_LENGTH: f64 = 0.02;

/// Whether two predictions of a marker bend to opposite sides \[m\].
pub fn bend_apart(one_m: f64, other_m: f64) -> bool {
    one_m * other_m < 0.0 && one_m.abs().min(other_m.abs()) > SMALL_DEFLECTION_M
}

/// Whether a number can be a place on a robot \[m\].
pub fn is_a_length(value_m: f64) -> bool {
    value_m.is_finite() && value_m.abs() <= FARTHEST_M
}

/// Whether a robot has another length than is stated of it; not if one of the two is unknown (NaN).
pub fn is_other_length(one_m: f64, other_m: f64) -> bool {
    (one_m - other_m).abs() > SAME_LENGTH * other_m.abs()
}

/// A difference of shapes that does not matter \[m\].
pub const TOLERANCE_M: f64 = 1.5e-4;
/// Its share of the largest deflection, if that is more.
pub const TOLERANCE: f64 = 0.005;
/// Deflections below this are left out of the restricted accuracy \[m\].
pub const SMALL_DEFLECTION_M: f64 = 5e-3;

/// Whether a marker has moved enough for a relative error, of the standard deviation of its mean \[m\].
pub fn has_moved(y_m: f64, sd_m: f64) -> bool {
    y_m.abs() > SMALL_DEFLECTION_M.max(MANY_TIMES_THE_NOISE * sd_m)
}

/// Whether an error is within the tolerance: whatever is missing, no name of it would matter.
pub fn is_good_enough(error_mm: f64, tolerance_mm: f64) -> bool {
    error_mm <= tolerance_mm
}

/// The error below which a model is good enough: max(0.15 mm, 0.5 % of d_max) \[m\].
pub fn tolerance_m(d_max_m: f64) -> f64 {
    TOLERANCE_M.max(TOLERANCE * d_max_m)
}
