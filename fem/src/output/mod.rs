//! What a run leaves behind: ParaView files, history, checkpoints.

pub mod bytes;
