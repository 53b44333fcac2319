//! A robot for programs that cannot link this crate: tables over the pressure as C code, and its linear form, also for simulators.

mod c;
mod fit;
mod fmu;
mod linear;
mod mjcf;
mod rigid;
mod table;
mod urdf;

pub use c::Origin;
pub use fit::{MOST_BYTES, MOST_MISS, Untabulated};
pub use linear::{Joint, Linear};
pub use rigid::Surroundings;
pub use table::{Bound, Table};
