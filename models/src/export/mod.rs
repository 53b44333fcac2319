//! A robot for programs that cannot link this crate: tables over the pressure as C code, and its linear form.

mod c;
mod fit;
mod linear;
mod table;
mod untabulated;

pub use c::Origin;
pub use linear::{Joint, Linear};
pub use table::{Bound, Table};
pub use untabulated::{MOST_BYTES, MOST_MISS, Untabulated};
