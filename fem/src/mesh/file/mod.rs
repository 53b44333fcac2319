//! Plain text mesh files (`.mesh`).
//!
//! ```text
//! mesh 1                  # format version
//! nodes 6                 # then one line per node: x y z [m], stress free
//! 0 0 0
//! 0.1 0 0
//! 0.1 0.1 0
//! 0 0.1 0
//! 0.2 0 0
//! 0.2 0.1 0
//! part cloth              # what follows belongs to this part
//! front air               # chamber at the front, if any
//! back body               # chamber at the back, if any
//! layer 2                 # contact layer; 0 unless said
//! warp 1                  # warp directions: 1 for the part, or one per element (quads first)
//! 1 0 0
//! quads 1                 # node numbers count from 1, counter-clockwise seen from the front
//! 1 2 3 4
//! triangles 1
//! 2 5 3
//! set left 2              # then the node numbers, any number per line
//! 1 4
//! ties 1                  # node, then pairs of node and weight
//! 6  3 0.5  5 0.5
//! end 6 2                 # nodes and elements in total: a file that was cut off is noticed
//! ```
//!
//! Blocks `membrane N` and `start N` after `nodes` give the places at which the membrane is free of stress and at which the
//! nodes start, if they differ. `#` starts a comment; empty lines are skipped; spaces are free.

mod read;

pub use read::{parse, read};

/// Words that begin a block.
const KEYWORDS: [&str; 14] = [
    "mesh",
    "nodes",
    "membrane",
    "start",
    "part",
    "front",
    "back",
    "layer",
    "warp",
    "quads",
    "triangles",
    "set",
    "ties",
    "end",
];

#[cfg(test)]
mod tests;
