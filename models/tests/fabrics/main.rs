//! Laws that every fabric obeys, over the list; and the exact answers of each law.

#![allow(clippy::unwrap_used)]

mod errors;
mod laminate;
mod laws;
mod support;
mod tension_field;
mod uniaxial;
mod woven;
mod wrinkling_film;
