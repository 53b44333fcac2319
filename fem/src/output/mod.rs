//! What a run leaves behind.
//!
//! | module | writes |
//! |---|---|
//! | [`vtu`], [`pvd`] | frames for ParaView and their time series |
//! | [`history`] | `history.csv`: energies, balance, chambers and probes over time |
//! | [`centre_line`] | `centre_line.csv`: the middle of every section over time |
//! | [`checkpoint`] | where a stopped run goes on, to the bit |
//! | [`picture`] | a PNG of the deformed mesh |
//! | [`deck`] | the problem for another solver |
//!
//! Files that are replaced (frames, series, checkpoints) are written under another name and renamed, so that a reader, a
//! full disk or a kill never meets half a file. Tables grow line by line and are cut back to the checkpoint on resume:
//! an interrupted and resumed run leaves the same bytes as an uninterrupted one.

pub(crate) mod centre_line;
pub(crate) mod checkpoint;
pub(crate) mod deck;
mod frame;
pub(crate) mod history;
pub(crate) mod picture;
pub(crate) mod pvd;
mod table;
pub(crate) mod vtu;

pub(crate) use frame::Frame;
