//! A robot for programs that cannot link this crate: tables over the pressure as C code, and its linear form.

mod c;
mod fit;
mod linear;
mod table;

pub use c::Origin;
pub use linear::{Joint, Linear};
pub use table::{Bound, MOST_BYTES, MOST_MISS, Table, Untabulated};
