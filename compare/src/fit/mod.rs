//! Linear algebra and least squares of all fits, and the intervals of what was fitted.

pub(crate) mod basis;
pub(crate) mod interval;
pub(crate) mod least_squares;
pub(crate) mod numbers;
pub(crate) mod whiten;
