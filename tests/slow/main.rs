//! Slow tests.
