//! `ibr`: models of pneumatic bending actuators on inflated-beam robots, held against measurements.
//!
//! This crate is the facade of the workspace; each part can be used alone.
//!
//! | crate | what it is |
//! |---|---|
//! | [`models`] | reduced-order virtual-work model: a list of physical effects; microseconds; no files, no printing |
//! | [`fem`] | explicit finite element engine for thin fabric: meshes, shells, contact, robots, cases |
//! | [`data`] | measurements as plain structs: marker tables, bench tests, descriptions |
//! | [`compare`] | the only crate that knows both sides: accuracy, noise, diagnosis, extension, reports |
//!
//! ```
//! use ibr::models::{Loads, Model, Scenario, Target, shipped};
//!
//! let scenario = Scenario::parse(shipped("cpam").unwrap()).unwrap();
//! let model = Model::new(&scenario);
//! let mut state = model.prediction();
//! model.predict(&Loads::uniform(2e3, 20e3), &mut state).unwrap();
//! let pressure_pa = model.pressure_for(Target::TipHeight(state.tip.y_m), 2e3, &mut state).unwrap();
//! assert!((pressure_pa - 20e3).abs() < 1e-3);
//! ```

pub mod pages;

pub use compare;
pub use data;
pub use fem;
pub use models;
pub use report;
