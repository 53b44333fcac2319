//! What was measured, and how well: runs, markers, gauges and tables of a bench, and the noise of their means.

pub mod bench;
pub mod data_slope;
pub mod directions;
pub mod evidence;
pub mod gauge;
pub mod hold_scatter;
pub mod layout;
pub mod noise;
pub mod noise_summary;
pub mod prepare;
pub mod run_scatter;
