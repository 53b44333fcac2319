//! The numbers that decide a verdict. Each says what it is, in which unit, and so which error it trades for which.
//!
//! What only steers a search (steps, rounds, starts) stays where it is used: it moves no verdict.

/// Of the level α, the share that the effects get; the tests for lack of fit get the rest.
pub const SHARE_OF_EFFECTS: f64 = 0.8;
/// A second effect is looked for if more than this share of the error is left, and more than that many mm: the catalogue's
/// laws are not the real ones to the last twentieth.
pub const WORTH_A_SECOND: (f64, f64) = (0.05, 0.15);
/// More than this share of the error left by one effect, or by two, and more than that many mm, means that the catalogue
/// does not explain it. Errors are those beyond noise and scatter between runs.
pub const LEFT_OVER: [(f64, f64); 2] = [(0.2, 0.05), (0.15, 0.05)];
/// A place that stands out with more than this share of the error is not explained: the law of a uniform robot, however wrong
/// its form, leaves uniform bending.
pub const PLACE_LEFT: f64 = 0.1;
/// Left over by more than this share, a trace along yet another effect says the same as a lack of fit.
pub const MOST_LEFT: (f64, f64) = (0.5, 0.05);

/// Differences below this do not decide.
pub const SAME_EVIDENCE: f64 = 6.0;
/// Share of the best gain that counts as [`SAME_EVIDENCE`].
pub const FORM: f64 = 0.05;
/// One standard deviation of the size, as a factor.
pub const SIZE_FACTOR: f64 = 3.0;
/// Least price of a parameter, where hardly any information is left.
pub const LEAST_PRICE: f64 = 1.0;
/// Sizes beyond this factor from the typical one are equally odd.
pub const ODDEST: f64 = 1e3;

/// Another attempt, or a second effect, must bring the error in mm below this share; a second effect, or within the tolerance.
pub const CLOSER: f64 = 0.8;

/// B that moves by more than this with an effect is said so.
pub const BENDING_MOVES: f64 = 0.2;

/// A base that leaves more than this share of the measured movement does not fit at all.
pub const NO_FIT: f64 = 0.5;
/// Standard deviations by which a bending test and the markers disagree.
pub const DISAGREE: f64 = 3.0;

/// Components of unit vectors that differ by less are the same.
pub const SAME_DIRECTION: f64 = 0.05;

/// Above this share stray samples are the noise, and none is replaced.
pub const MOST_REPLACED: f64 = 0.05;
/// A run stands out below this p, corrected for the number of runs.
pub const RUN_STANDS_OUT: f64 = 0.001;

/// Contributions this opposite cancel.
pub const CANCELS: f64 = -0.95;

/// Share of the error left up to which the best of the catalogue is named as a part of the answer.
pub const MOSTLY: f64 = 0.25;

/// Costs of two starts that differ by more than this end in different minima.
pub const SAME_MINIMUM: f64 = 1.0;
/// A bound is binding if the data would gain this much beyond it: two standard errors.
pub const BINDING: f64 = 4.0;

/// Standard deviations by which the noise of a test may carry its value beyond a physical bound.
pub const BEYOND_BOUNDS: f64 = 5.0;

/// Normal quantile of nine in ten.
pub const Z_POWER: f64 = 1.2816;
/// λ below which an experiment is not worth its time.
pub const WORTHLESS: f64 = 3.0;

/// Share of the squares of a misfit that a pattern must hold to be told.
pub const PATTERN_TELLS: f64 = 0.25;
/// An error at what was left out that falls to less than this share speaks for a law; markers have the same.
pub const PREDICTS: f64 = 0.7;

/// Chance of the shift where nothing is shifted, above which nothing is told.
pub const SHIFT_CHANCE: f64 = 1e-3;
/// Share that a shift may leave of the mean over runs. A lens that bulges the image is off at the base too, grows otherwise
/// from there, and leaves a third without any noise; 1300 sets of `ibr bench discovery` without a slip left 0.28 or more.
pub const SHIFT_LEAVES: f64 = 0.2;
/// Heading of the last marker beyond which a hold is not nearly straight \[rad\].
pub const NEARLY_STRAIGHT: f64 = 0.8;

/// A distance that undoing a slip takes to less than this share of it is called far less. Undoing a slip that is not there
/// leaves more than before, so that anything below 1 would do without noise.
pub const FAR_LESS: f64 = 0.5;

/// Beyond this factor either way it is no camera's scale: the catalogue's `camera_scale` ends there.
pub const NO_SCALE: f64 = 1.25;
/// How near a factor must be to that of a unit to be called by it.
pub const NEAR_UNIT: f64 = 0.1;

/// Runs from which on it can be said which is the odd one.
pub const RUNS_TO_TELL: usize = 3;

/// Then half of their distance must be this many times what a marker is usually off: of markers closer together than the noise no
/// label can be told.
pub const LABELS_CLEAR: f64 = 3.0;

/// Half-width over value above which the profile is followed.
pub const WIDE: f64 = 0.3;
/// Mean square of whitened residuals from which a misfit counts: as much again as the noise, which several hundred values never are by
/// chance.
pub const MISSES: f64 = 2.0;
/// A pressure tells of a parameter if its share of the squared weights is above this.
pub const PRESSURE_TELLS: f64 = 1e-3;

/// Multiple of the noise that counts as standing out where no p-value can be given (two runs, or σ supplied).
pub const MANY_TIMES_THE_NOISE: f64 = 5.0;

/// Fewest runs for which p-values are given.
pub const RUNS_FOR_P: usize = 3;

/// Mean square of whitened residuals, a misfit of three times the noise, from which a fit allows for it (chosen, `docs/accuracy.md`): s² then grows by that factor, so that scatter
/// between runs, which is no misfit, stays as small as it is beside it. With few runs a law that misses would otherwise hide in it.
pub const MISFIT: f64 = 10.0;

/// Ratios P/p within this fraction match.
pub const SAME_RATIO: f64 = 0.03;
/// Body pressures must differ by more than this fraction, or the pair tests nothing.
pub const BODY_DIFFERENCE: f64 = 0.10;
/// Difference of a model's shapes that counts as none: 0.15 mm, or 0.5 % of its largest deflection if more.
pub const MODEL_TOLERANCE_M: f64 = 1.5e-4;

/// Deflections below this are left out of the restricted accuracy \[m\].
pub const SMALL_DEFLECTION_M: f64 = 5e-3;

/// Pressures within this fraction are one level.
pub const SAME_PRESSURE: f64 = 0.05;

/// How exactly the shared numbers of a camera are told where nothing is wrong with it: distance of the tracked line over R, scale, roll \[rad\].
pub const CAMERA_AS_TOLD: [f64; 3] = [0.02, 0.002, 0.001];
/// Prior weights of the kinds of hypotheses: nothing is missing, one effect, two, a law that nobody wrote down, a fault.
pub const PRIOR_NOTHING: f64 = 0.5;
/// One effect of the catalogue.
pub const PRIOR_ONE: f64 = 0.35;
/// Two of them.
pub const PRIOR_TWO: f64 = 0.05;
/// A law that nobody wrote down.
pub const PRIOR_UNKNOWN: f64 = 0.05;
/// A fault of a place, a hold or a marker.
pub const PRIOR_FAULT: f64 = 0.05;
/// Single effects of which pairs are weighed.
pub const PAIRED: usize = 6;
/// Share by which the form of a law errs for every doubling of bend or pressure: what `challenge::bench::width` learns from pairs of laws
/// for the same effect.
pub const FORM_WIDTH: f64 = 0.084;
/// Share of the evidence that a set holds, and of what is not nothing that makes an alarm.
pub const RULED: f64 = 0.95;
/// p of what the best hypothesis leaves, below which it does not meet the data.
pub const UNMET: f64 = 1e-3;
