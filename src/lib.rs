//! `ibr`: models of pneumatic bending actuators on inflated-beam robots, compared with measurements.
//!
//! What a user does, as functions: [`ScenarioFile::read`] and [`Evidence::read`], then [`compare`](fn@compare) (how far off, and
//! where), [`diagnose`] (which physical effect is missing), [`extend`] (a new scenario with it), [`validate`] (does it help on
//! other data). [`ladder`] repeats the middle; [`predict`] gives shapes at pressures, [`simulate`] runs finite elements.
//! Every [`Error`] names the place and the fault and, by [`Error::help`], gives the remedy. Long work reports its [`Progress`].
//!
//! Control ([`Predictor`]): the pressure that lifts the tip to 60 mm, and the slope that corrects it.
//!
//! ```
//! use ibr::models::Target;
//! use ibr::{Predictor, ScenarioFile};
//!
//! let robot = Predictor::new(&ScenarioFile::read("epam")?.scenario);
//! let (loads, at) = robot.inverse(Target::TipHeight(0.060), None)?;
//! assert!((at.tip.y_m - 0.060).abs() < 1e-9 && robot.jacobian(&loads)?[0].y_per_pa > 0.0);
//! # Ok::<(), ibr::Error>(())
//! ```
//!
//! A model compared with a camera:
//!
//! ```
//! use ibr::{Evidence, ScenarioFile};
//!
//! let robot = ScenarioFile::read("epam-textbook")?;
//! let found = ibr::compare(&robot, &Evidence::read("synthetic-epam")?)?;
//! assert!(found.error_mm() > 20.0, "the bare model bends too far");
//! # Ok::<(), ibr::Error>(())
//! ```
//!
//! `examples/` has both at length, and seven more: each states its physics and what it prints. The crates below can be used alone:
//!
//! | module | what it is |
//! |---|---|
//! | [`models`] | reduced-order virtual-work model: a list of physical effects; microseconds; no files, no printing |
//! | [`fem`] | explicit finite element engine for thin fabric: meshes, shells, contact, robots, cases |
//! | [`data`] | measurements as plain structs: marker tables, bench tests, descriptions |
//! | [`import`] | files of tracking programs and pressure logs become marker tables |
//! | [`study`] | the only crate that knows both sides: accuracy, noise, diagnosis, extension |
//! | [`report`] | charts and pages of plain structs; [`pages`] makes them of results |
//! | [`compared`] | a comparison with all that the command prints of it |
//! | [`shown`] | results as text and as the JSON of the command |
//! | [`program`] | the command line as one call |
//! | [`studies`] | robots in finite elements that come with the library by name |

// The commands say `ibr::` as any program would.
extern crate self as ibr;

mod asked;
mod cli;
mod commands;
pub mod compared;
mod context;
mod failure;
mod follow;
mod import_typed;
mod interval;
mod meter;
mod output;
pub mod pages;
mod predict;
mod predictor;
mod prelude;
pub mod program;
pub mod shown;
mod stream;
pub mod studies;
mod studio;
mod tables;
pub mod words;
mod zip;

pub use ::{compare as study, sweep};
pub use ::compare::diagnosis::{Diagnosis, Options as DiagnosisOptions, diagnose};
pub use ::compare::extension::{EffectWish, add};
pub use ::compare::ladder::{Climb, ladder};
pub use ::compare::study::comparison::{Contender, Variant, compare_all};
pub use ::compare::validation::{BeforeAfter, Validation, validate};
pub use ::compare::{CompareError as Error, Comparison, Evidence, Extension, Progress, ScenarioFile, compare, extend};
pub use asked::{CommandAnswer, ask};
pub use data;
pub use data::import;
pub use fem;
pub use fem::session::{FeRun, RunSettings as FeSettings, RunSource as FeSource, simulate, simulate_all};
pub use follow::{Followed, Follower, follow};
pub use import_typed::import_typed;
pub use interval::{PressureInterval, Unmeasured, pressure_interval};
pub use models;
pub use models::{HOLD_S, Loads, Scenario};
pub use predict::{AtPressure, predict, predict_for, predict_near};
pub use predictor::{Predictor, check_fed};
pub use report;
pub use stream::pressures_of;
pub use studies::fe_source;
