#!/usr/bin/env bash
# maturin 1.16.0: `maturin build --release` ignores `profile` of [tool.maturin] in pyproject.toml, without a word. The same two as flags
# (`--release --profile tiny`) are an error. A project whose wheel has a Cargo profile of its own, for its size, gets a wheel of Cargo's
# release profile from the command line that its users and its CI type, and the small one from `pip wheel`.
#
#   command                   folder of Cargo that it fills
#   maturin build             target/tiny
#   maturin build --release   target/release
#   pip wheel .               target/tiny
#
# Way round it: no --release where the project names a profile. Needs Rust and python3 with venv. Ends with 1 where maturin answers otherwise.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
command -v cargo > /dev/null || { echo "skipped: no cargo here"; exit 0; }
python3 -m venv venv
export PATH=$work/venv/bin:$PATH
pip install --quiet maturin==1.16.0
maturin --version

mkdir -p small/src && cd small
printf '[package]\nname = "small"\nversion = "0.1.0"\nedition = "2021"\n[profile.tiny]\ninherits = "release"\nopt-level = "z"\n' > Cargo.toml
printf 'fn main() {}\n' > src/main.rs
{
  printf '[build-system]\nrequires = ["maturin==1.16.0"]\nbuild-backend = "maturin"\n[project]\nname = "small"\nversion = "0.1.0"\n'
  printf '[tool.maturin]\nbindings = "bin"\nprofile = "tiny"\n'
} > pyproject.toml

# filled COMMAND...: which of both folders Cargo filled.
filled() {
  rm -rf target
  "$@" > log.txt 2>&1 || { echo "error"; return; }
  for profile in tiny release; do [ ! -e "target/$profile/small" ] || echo "$profile"; done
}
found="$(filled maturin build) $(filled maturin build --release) $(filled pip wheel --no-deps --no-build-isolation .)"
found="$found $(filled maturin build --release --profile tiny)"
echo "maturin build, with --release, pip wheel, with both flags: $found"
[ "$found" = "tiny release tiny error" ] || { echo "maturin answers otherwise: this finding is out of date"; exit 1; }
