#!/usr/bin/env bash
# Builds the Python package with the release build of the workspace, installs it into an environment of its own in target/ and
# runs its tests against target/release/ibr. Needs python3 with venv, and the registry of pip the first time.
set -euo pipefail
cd "$(dirname "$0")/.."
skip() { echo "skipped: $*"; exit 0; }

command -v python3 > /dev/null || skip "no python3"
[ -x target/release/ibr ] || skip "no target/release/ibr: cargo build --release makes it"
home=target/python
[ -x $home/bin/pip ] || python3 -m venv $home || skip "python3 has no venv"
$home/bin/python -c 'import maturin, numpy, pandas, polars, matplotlib, pytest, nbclient, ipykernel' 2> /dev/null ||
  $home/bin/pip install --quiet maturin numpy pandas polars matplotlib pytest nbclient ipykernel ||
  skip "pip does not reach its registry"

rm -rf target/wheels
PATH="$PWD/$home/bin:$PATH" CARGO_TARGET_DIR=target $home/bin/maturin build --release --quiet --out target/wheels
$home/bin/pip install --quiet --force-reinstall --no-deps target/wheels/ibr-*.whl
IBR_WHEEL=$(ls target/wheels/ibr-*.whl) MPLBACKEND=Agg $home/bin/python -m pytest -q -p no:cacheprovider python/tests "$@"
