#!/usr/bin/env bash
# `ibr export fmu` in FMPy: its description is valid, and tip and markers follow `ibr predict --follow`, with a supply line too.
# tests/foreign/fmu.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs fmpy=0.3.32
command -v cc > /dev/null || skip "no cc here"
cd "$work"
"$ibr" new epam > plain.toml
{ cat plain.toml; printf '\n[supply]\nvalve_time_s = 0.05\nconductance_l_per_s_bar = 0.1\nvolume_ml = 400\n'; } > line.toml
for robot in plain line; do
  "$ibr" --quiet export fmu "$robot.toml" --pressure 0:40kPa --out "$robot.fmu" > /dev/null
  # The set pressure acts from a line to the next.
  awk 'BEGIN { print "t_s,p_kpa"; for (i = 0; i <= 100; i++) print i / 100 "," (i < 20 ? 0 : i < 60 ? 30 : 12) }' |
    "$ibr" predict "$robot.toml" --follow > "$robot.csv"
done
check
