//! What was measured, and how well: runs, markers, gauges and tables of a bench, and the noise of their means.

pub mod bench;
pub(crate) mod data_slope;
pub(crate) mod directions;
pub mod evidence;
pub(crate) mod gauge;
pub(crate) mod hold_scatter;
pub(crate) mod layout;
pub mod noise;
pub(crate) mod noise_summary;
pub(crate) mod prepare;
pub(crate) mod run_scatter;
