//! Puts the page of `web/build.sh` into the program, where it was built before.

use std::path::Path;

fn main() {
    let web = Path::new(env!("CARGO_MANIFEST_DIR")).join("web");
    let page = web.join("dist/ibr.html");
    // A watched file that does not exist would build everything that depends on this crate anew in every call of cargo.
    let watched = if page.exists() { &page } else { &web };
    println!("cargo::rerun-if-changed={}", watched.display());
    let value = if page.exists() { format!("Some(include_str!({page:?}))") } else { "None".to_string() };
    let out = Path::new(&std::env::var("OUT_DIR").expect("cargo gives a folder")).join("page.rs");
    std::fs::write(out, format!("pub(crate) const PAGE: Option<&str> = {value};\n"))
        .expect("the folder can be written");
}
