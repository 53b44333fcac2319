#!/bin/sh
# Builds web/dist/ibr.html: the page with the library in it, one file that needs no network.
set -eu
cd "$(dirname "$0")/.."
target=wasm32-unknown-unknown
has() { [ -d "$(rustc --print sysroot)/lib/rustlib/$target" ]; }
has || rustup target add $target || true
has || { echo "web: absent: Rust's standard library for $target. Get it: rustup target add $target"; exit 3; }
command -v node > /dev/null || { echo "web: absent: node (20 or newer), which puts the page together"; exit 3; }
# Nothing on the page draws at random; a library that could asks for a source of it.
CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER="$PWD/web/link.sh" \
CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS='--cfg getrandom_backend="unsupported"' \
    cargo rustc --quiet --package ibr-web --lib --profile web --target $target --crate-type cdylib
node web/inline.mjs "${CARGO_TARGET_DIR:-target}/$target/web/ibr_web.wasm"
