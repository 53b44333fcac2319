#!/usr/bin/env bash
# The cases of this folder by the engine and by CalculiX 2.20 (Debian: calculix-ccx): two programs that share no code, within 3 %.
# tests/foreign/calculix.sh [IBR]
# Skipped with a word where ccx is absent. Takes about three minutes on one core.
set -euo pipefail
command -v ccx > /dev/null || { echo "calculix: skipped: no ccx here"; exit 0; }
ibr=$(realpath "${1:-target/release/ibr}")
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1
for case in $(python3 "$here/compare.py" cases); do
  "$ibr" --quiet simulate "$here/$case.toml" --out "$work/$case" > "$work/$case.txt" 2>&1
  "$ibr" --quiet simulate "$here/$case.toml" --export "$work/$case/deck.inp" --for calculix > "$work/$case.txt" 2>&1
  (cd "$work/$case" && timeout 600 ccx deck > ccx.txt) || { tail -5 "$work/$case/ccx.txt"; echo "$case: CalculiX stops"; exit 1; }
done
python3 "$here/compare.py" table "$work"
