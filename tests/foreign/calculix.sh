#!/usr/bin/env bash
# The cases of this folder by the engine and by CalculiX 2.20 (Debian: calculix-ccx): two programs that share no code, within 3 %.
# Decks of the shipped robots and cases: CalculiX reads them, and every node where the deck has it.
# tests/foreign/calculix.sh [IBR]
# Skipped with a word where ccx is absent. Takes about four minutes on one core.
set -euo pipefail
. "$(dirname "$0")/common"
command -v ccx > /dev/null || skip "no ccx here"
decks=()
for name in pillow tube spam cpam epam fpam; do
  "$ibr" --quiet simulate "$name" --export "$work/$name-full.inp" --for calculix > "$work/$name.txt" 2>&1
  { sed '/^\*STEP/,$d' "$work/$name-full.inp"; printf '*STEP\n*NO ANALYSIS\n*NODE FILE, OUTPUT=2D\nU\n*END STEP\n'; } > "$work/$name.inp"
  # CalculiX ends with 201 where nothing is to be computed.
  (cd "$work" && timeout 300 ccx "$name" > "$name.out") || [ $? = 201 ] || { tail -5 "$work/$name.out"; echo "$name: CalculiX stops"; exit 1; }
  ! grep -i '\*ERROR' "$work/$name.out" || { echo "$name: CalculiX finds an error"; exit 1; }
  decks+=("$work/$name")
done
python3 "$here/compare.py" nodes "${decks[@]}"
for case in $(python3 "$here/compare.py" cases); do
  "$ibr" --quiet simulate "$here/$case.toml" --out "$work/$case" > "$work/$case.txt" 2>&1
  "$ibr" --quiet simulate "$here/$case.toml" --export "$work/$case/deck.inp" --for calculix > "$work/$case.txt" 2>&1
  (cd "$work/$case" && timeout 600 ccx deck > ccx.txt) || { tail -5 "$work/$case/ccx.txt"; echo "$case: CalculiX stops"; exit 1; }
done
python3 "$here/compare.py" table "$work"
