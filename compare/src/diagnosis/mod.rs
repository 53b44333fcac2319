//! Which physical effect is missing, and when the data cannot tell.

mod options;
mod result;

pub use options::Options;
pub use result::*;
