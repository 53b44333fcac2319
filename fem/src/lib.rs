//! The explicit finite element engine; not built yet.
