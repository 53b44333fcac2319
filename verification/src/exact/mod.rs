//! Exact solutions: closed forms that tests, benches and documents share.
//!
//! Every item is a pure function or a small plain struct in SI units. Above each stand the equation, the symbols, where it
//! holds, and its origin: whether the source was read, is known second hand, or the result was derived for this project.
//! [`oracle_table`] lists numbers computed independently of this code, each with the precision it is known to. What a
//! product's law has in common with them is the product's ([`models::comer_levy`], [`models::fabrics::BiasExtension`]).
//!
//! | to verify | use |
//! |---|---|
//! | tube, its ends, its bending | [`tube`], [`shell`], [`beam`], [`inflated_cantilever`] |
//! | pouch, balloon, airbag | [`pouch`], [`elastic_pouch`], [`balloon`] |
//! | strip in bending | [`elastica`], [`fold`] |
//! | fabric in a testing machine | [`coupon`], [`membrane`] |
//! | actuators | [`hinge`], [`mckibben`], [`fpam`] |

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
mod oracles;
pub mod pouch;
pub mod shell;
mod solve;
pub mod tube;

use oracles::KnownSections;
pub use oracles::OracleRow;

/// Closed forms with known numbers, in the order of `known.txt`.
const FORMS: &[fn() -> KnownSections] = &[
    pouch::known,
    elastic_pouch::known,
    hinge::known,
    mckibben::known,
    fpam::known,
    tube::known,
    beam::known,
    inflated_cantilever::known,
    shell::known,
    elastica::known,
    fold::known,
    coupon::known,
    membrane::known,
    balloon::known,
];

/// Every oracle, in the order of `known.txt`.
pub fn oracle_table() -> Vec<OracleRow> {
    oracles::table(FORMS)
}
