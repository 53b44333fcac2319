//! Reduced-order models of pneumatic bending actuators on inflated-beam robots.
//!
//! A model is a list of physical effects in a virtual-work balance ([`term`]). It reads no files and prints nothing; a
//! controller links this crate alone.
//!
//! ```
//! let scenario = models::Scenario::parse(models::shipped("epam-textbook").unwrap()).unwrap();
//! let model = models::Model::new(&scenario);
//! let mut state = model.prediction();
//! model.predict(&models::Loads::uniform(2e3, 30e3), &mut state).unwrap();
//! assert!((state.markers[5][1] - 0.16155).abs() < 1e-6);
//! ```

pub mod actuators;
mod assemble;
pub mod assembly;
mod batch;
pub mod body;
mod catalogue;
pub mod comer_levy;
pub mod cutting;
mod drawn;
pub mod effects;
pub mod error;
pub mod export;
pub mod fabrics;
mod follow;
pub mod formula;
mod gases;
mod growth;
mod gusset;
mod gusset_table;
mod held;
mod history;
mod inverse;
mod known;
mod limits;
mod line;
mod linkage;
mod machine;
mod model;
pub mod muscle;
mod pouch_shape;
mod reach;
mod robot;
mod root;
pub mod scenario;
mod section;
mod shape;
pub mod site;
pub mod space;
mod statics;
mod steer;
mod supply;
pub mod term;
mod tip_stiffness;
pub mod trig;
pub mod weave;

pub use assembly::Moment;
pub use batch::Batch;
pub use catalogue::Catalogue;
pub use error::{ScenarioError, Unsolved};
pub use fabrics::Fabric;
pub use follow::{Each, HOLD_S, Step};
pub use formula::Formula;
pub use gases::{BODY_GAS, GASES, GasVolumes};
pub use growth::{Grown, Retraction, TailArc, grown, longest_grown_m, longest_retractable_m};
pub use inverse::{Target, TipSlope};
pub use known::Known;
pub use limits::{Beyond, LOADS, Limit, collapse_length_m, collapse_loads};
pub use line::{InLine, Line};
pub use machine::Machine;
pub use model::{Model, Prediction, Tip};
pub use pouch_shape::PouchShape;
pub use scenario::{EffectChoice, Scenario, shipped};
pub use steer::{Aim, End, Limits, Steered, Steering};
pub use supply::Supply;
pub use term::{Account, CHANNELS, LedgerLine, Loads, Memory, Pose, Remembering, Row, RowKind, Term};
pub use tip_stiffness::TipStiffness;

/// Words of a catalogue.
pub(crate) type Text = &'static str;
