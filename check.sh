#!/usr/bin/env bash
# The whole check of this repository, and all that CI runs. `./check.sh fast` is the short form while editing:
# no release build, no slow tests. `./check.sh all` also builds and tries the page in a browser and a sweep through Slurm and HyperQueue,
# and compares the engine with other programs, where these are installed.
# Needs Rust (rust-version in Cargo.toml) with rustfmt and clippy, and the C compiler that Rust links with.
set -euo pipefail
cd "$(dirname "$0")"
export CARGO_TERM_COLOR=${CARGO_TERM_COLOR:-never} RUSTDOCFLAGS="-D warnings"

step() { printf '\n== %s (%ss)\n' "$*" "$SECONDS"; }

step format
cargo fmt --all --check
step clippy
cargo clippy --workspace --all-targets -- -D warnings
cargo clippy --workspace --test slow --test zoo -- -D warnings
step docs
cargo doc --workspace --no-deps --quiet
if [ "${1:-}" = fast ]; then
  step fast tests
  cargo test --workspace --quiet
else
  # One profile and one set of crates for everything, so that the dependencies are built once.
  step release build
  cargo build --release --workspace --all-targets --quiet
  step fast tests
  cargo test --workspace --release --quiet
  step broken inputs, ten thousand for every reader
  ./target/release/ibr-fuzz all --cases 10000 --keep target/fuzz-found
  step slow tests
  cargo test --workspace --release --quiet --test slow
  step bad input
  cargo test --workspace --release --quiet --test zoo
  step known numbers
  ./target/release/ibr verify
  # Benches end with 1 where they miss what is wanted: on a shared machine, or with few sets, that is no fault.
  step Python
  python/test.sh
  step speed
  ./target/release/ibr bench || [ $? = 1 ]
  step each case of the diagnosis bench runs
  cargo bench --workspace --quiet --bench diagnose -- --test > /dev/null
  if [ "${1:-}" = all ]; then
    step the page in a browser
    web/test.sh
    step a sweep through Slurm and HyperQueue
    tests/clusters.sh
    for foreign in tests/foreign/*.sh; do
      step "${foreign#tests/}"
      "$foreign"
    done
  fi
fi
printf '\nall checks passed in %ss\n' "$SECONDS"
