//! Tells cargo that a new folder under `sets/` means the crate must be built again; it generates nothing.

fn main() {
    println!("cargo::rerun-if-changed=sets");
}
