//! Where model and measurement meet: predictions at the points of a dataset, calibration, generated data, the published
//! numbers, run time against accuracy, and the pages made of them.

pub mod calibrate;
pub mod columns;
pub mod comparison;
pub mod engines;
pub mod eye;
pub mod generate;
pub mod paper;
pub mod predict;
pub mod published;
pub mod seen;
pub mod uncertain;

pub use calibrate::{Calibration, Knob, calibrate};
pub use comparison::{Comparison, Contender, Variant, compare, compare_all};
pub use engines::breakdown;
pub use generate::{Generator, HoldScatter, generate, parse_protocol};
pub(crate) use predict::first_slope;
pub use predict::{Predicted, fit_scenario, predict_dataset};
pub use published::tradeoff::{Timing, time_prediction};
pub use published::{Rung, one_number, published_ladders, tradeoff};

#[cfg(test)]
mod space_tests;
#[cfg(test)]
pub(crate) mod tests;
