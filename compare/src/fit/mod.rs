//! Linear algebra and least squares of all fits, and the intervals of what was fitted.

pub mod basis;
pub mod interval;
pub mod least_squares;
pub mod whiten;
