//! Measurements of inflated-beam robots as plain structs.
//!
//! `data` reads marker tables ([`read_markers`], [`load()`]), their descriptions ([`About`]) and the numbers of the
//! reference paper ([`published()`]); it converts units on reading and never sees a model.

pub mod about;
mod agreement;
mod align;
mod atomic;
pub mod bench;
mod cells;
pub mod check;
mod columns;
mod correction;
pub mod coupons;
pub mod dataset;
pub mod error;
mod header;
pub mod import;
mod lines;
pub mod load;
mod lost;
mod parquet;
mod policy;
mod predicted;
pub mod published;
mod ramps;
pub mod read;
mod rows;
pub mod sets;
mod space;
mod streams;
pub mod table;
mod tidy;
mod units;
pub mod write;

#[cfg(test)]
mod tests;

pub use about::{
    About, AboutRun, BENDING_TEST, Direct, Geometry, MarkerStation, MeasuredValue, Provenance, parse_about, read_about,
};
pub use atomic::write_atomically;
pub use bench::{Bench, bench, parse_bench};
pub use check::{CheckReport, check};
pub use correction::{CorrectionTable, parse_correction};
pub use coupons::{Coupon, CouponDefaults, Direction, Pulled, parse_coupons, read_coupons};
pub use dataset::{Dataset, Hold, IN_KPA, Lost, Marker, Phase};
pub use error::{ClockTracks, DataError, Fault, Location, Result};
pub use lines::Progress;
pub use load::load;
pub use lost::losses;
pub use parquet::read_parquet;
pub use policy::is_a_room;
pub use predicted::{Predictions, parse_predictions};
pub use published::{Published, PublishedActuator, PublishedFabric, PublishedFact, PublishedProtocol, published};
pub use read::{ReadOptions, markers_of_table, parse_markers, read_markers};
pub use sets::{SetInfo, set_about, set_file, sets};
pub use table::{Column, Table};
pub use write::{about_toml, set_files, write_markers_csv};
