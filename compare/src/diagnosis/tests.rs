//! Laws of the diagnosis.
