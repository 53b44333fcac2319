//! Exact solutions: closed forms that tests, benches and documents share.
//!
//! Every item is a pure function or a small plain struct in SI units, and depends on nothing outside this folder, so that
//! it can judge the rest of the crate; only [`tube`] takes a fabric law from outside, because it holds for any. Above each
//! item stand the equation, the symbols, where it holds, and its origin: whether the source was read, is known second
//! hand, or the result was derived for this project. [`oracle_table`] lists numbers computed independently of this code,
//! each with the precision it is known to; the tests run over that list.
//!
//! | to verify | use |
//! |---|---|
//! | tube, its ends, its bending | [`tube`], [`shell`], [`beam`], [`inflated_cantilever`] |
//! | pouch, balloon, airbag | [`pouch`], [`elastic_pouch`], [`balloon`], [`pillow`] |
//! | strip in bending | [`plate`], [`elastica`], [`fold`] |
//! | fabric in a testing machine | [`coupon`], [`membrane`] |
//! | actuators | [`hinge`], [`mckibben`], [`fpam`] |
//! | contact | [`sliding`] |

pub mod balloon;
pub mod beam;
pub mod coupon;
pub mod elastic_pouch;
pub mod elastica;
pub mod fold;
pub mod fpam;
pub mod hinge;
pub mod inflated_cantilever;
pub mod mckibben;
pub mod membrane;
pub mod oracles;
pub mod pillow;
pub mod plate;
pub mod pouch;
pub mod shell;
pub mod sliding;
mod solve;
pub mod tube;

pub use oracles::{OracleRow, oracle_table};
