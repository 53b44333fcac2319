//! Makes cargo rebuild the crate when a folder is added under `sets/`; it generates nothing.

fn main() {
    println!("cargo::rerun-if-changed=sets");
}
