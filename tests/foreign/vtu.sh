#!/usr/bin/env bash
# Frames and exported meshes in meshio, PyVista and VTK: the same points, arrays and fields in all, and the numbers of history.csv.
# tests/foreign/vtu.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs meshio=5.3.5 pyvista=0.49.1
sed 's/frames = false/frames = true/' "$here/strip.toml" > "$work/strip.toml"
cd "$work"
"$ibr" --quiet simulate strip.toml --out run > /dev/null
"$ibr" --quiet simulate strip.toml --export mesh.vtu > mesh.txt
check
