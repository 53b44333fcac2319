//! From fits to a verdict, and what else is to be said of the data.

pub mod assemble;
pub mod bending_alarm;
pub mod closest;
pub mod decide;
pub mod lack_of_fit;
pub mod limits;
pub mod patterns;
pub mod pressures;
pub mod stands_out;
