//! `ibr.h` is the header of the code. After a change: `WRITE=1 cargo test -p ibr-capi --test header`.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::path::Path;

#[test]
fn the_header_is_that_of_the_code() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    let sources = ["src/lib.rs"].map(|file| folder.join(file));
    let made =
        sources.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| builder.with_src(file));
    let mut bytes = Vec::new();
    made.generate().unwrap().write(&mut bytes);
    let made = String::from_utf8(bytes).unwrap();
    // What Rust calls safety is a promise of C in any case; links of its documents lead nowhere here.
    let made = made.replace("// # Safety\n", "").replace("[`", "").replace("`]", "").replace('`', "");
    let path = folder.join("ibr.h");
    if std::env::var_os("WRITE").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    assert!(std::fs::read_to_string(&path).unwrap_or_default() == made, "capi/ibr.h is not that of the code: WRITE=1");
}
