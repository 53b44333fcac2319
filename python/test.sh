#!/usr/bin/env bash
# Tests of the Python package, against the command that was built beside it.
#   python/test.sh            the package of the workspace's release build: cargo build --release --workspace
#   python/test.sh --wheel    the wheel as users get it, installed, its size too; without Parquet most crates are built anew
# Needs python3 with venv, and the registry of pip the first time. What follows goes to pytest.
set -euo pipefail
cd "$(dirname "$0")/.."
skip() { echo "skipped: $*"; exit 0; }

command -v python3 > /dev/null || skip "no python3"
home=$PWD/target/python
[ -x "$home/bin/pip" ] || python3 -m venv "$home" || skip "python3 has no venv"
"$home/bin/python" -c 'import maturin, numpy, pandas, polars, pyarrow, matplotlib, pytest, nbclient, ipykernel, mypy, joblib, dask' 2> /dev/null ||
  "$home/bin/pip" install --quiet maturin numpy pandas polars pyarrow matplotlib pytest nbclient ipykernel mypy pandas-stubs joblib dask ||
  skip "pip does not reach its registry"

"$home/bin/pip" uninstall --quiet --yes ibr 2> /dev/null
if [ "${1:-}" = --wheel ]; then
  shift
  rm -rf target/wheels
  PATH="$home/bin:$PATH" CARGO_TARGET_DIR=target "$home/bin/maturin" build --quiet --out target/wheels
  IBR_WHEEL=$(ls "$PWD"/target/wheels/ibr-*.whl)
  export IBR_WHEEL
  "$home/bin/pip" install --quiet --no-deps "$IBR_WHEEL"
else
  [ -e target/release/lib_ibr.so ] || skip "no target/release/lib_ibr.so: cargo build --release --workspace makes it"
  rm -rf target/python-package
  mkdir -p target/python-package
  cp -r python/ibr target/python-package/
  cp target/release/lib_ibr.so target/python-package/ibr/_ibr.abi3.so
  export PYTHONPATH=$PWD/target/python-package
fi
[ -x target/release/ibr ] || skip "no target/release/ibr: cargo build --release makes it"
export PATH="$home/bin:$PATH"
"$home/bin/python" -m pytest -q -p no:cacheprovider python/tests "$@"
