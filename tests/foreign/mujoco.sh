#!/usr/bin/env bash
# `ibr export mjcf` and `ibr export urdf` in MuJoCo: the tip at the working point and after settling from the straight robot, within
# 0.2 mm of `ibr predict`, for every shipped robot over its range, and with gravity.
# tests/foreign/mujoco.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs mujoco=4.0.0
cd "$work"
for robot in spam cpam epam fpam heavy; do
  name=$robot
  options=()
  if [ "$robot" = heavy ]; then name=epam options=(--effect gravity:weight_n_per_m=1); fi
  for pressure in 5 10 20 30; do
    of=("$name" "${options[@]}" --pressure "${pressure}kPa")
    "$ibr" --quiet --json predict "${of[@]}" > "$robot-$pressure.json"
    "$ibr" --quiet export mjcf "${of[@]}" --joints 12 --mass 0.1 --out "$robot-$pressure.xml" > /dev/null
    "$ibr" --quiet export urdf "${of[@]}" --joints 12 --mass 0.1 --out "$robot-$pressure.urdf" > /dev/null
  done
done
check
