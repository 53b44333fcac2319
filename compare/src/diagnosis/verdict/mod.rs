//! From fits to a verdict, and what else is to be said of the data.

pub(crate) mod assemble;
pub(crate) mod bending_alarm;
pub(crate) mod closest;
pub(crate) mod decide;
pub(crate) mod lack_of_fit;
pub(crate) mod left_patterns;
pub(crate) mod limits;
pub(crate) mod patterns;
pub(crate) mod pressures;
