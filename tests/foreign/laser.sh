#!/usr/bin/env bash
# Patterns as programs of cutters read them: the DXF in ezdxf, the SVG in svgelements, with which MeerK40t reads.
# tests/foreign/laser.sh [IBR]
# Inkscape, where it is, must not lose the lines of the SVG in its own DXF.
set -euo pipefail
. "$(dirname "$0")/common"
needs ezdxf=1.4.5 svgelements=1.9.6
cd "$work"
for robot in spam cpam epam fpam; do
  "$ibr" --quiet --json pattern "$robot" --kerf 0.2mm --out "$robot.dxf" > "$robot.json"
  "$ibr" --quiet pattern "$robot" --out "$robot.svg" > /dev/null
done
check
