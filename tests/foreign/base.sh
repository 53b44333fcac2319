#!/usr/bin/env bash
# A model of another simulator lacks one effect: `ibr diagnose --base` names it, and the correction helps on data that were left out.
# MuJoCo has a chain of hinges and SoRoMoX a rod of constant curvatures, both with stiffness and drive from `ibr export` of a robot without the effect.
# tests/foreign/base.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs mujoco=4.0.0 soromox=0.5.0 pandas=3.1.1 matplotlib=3.11.2
check "$ibr"
# The same in notebooks, where the package of this tree was built: python/test.sh
package=$(realpath -m "$here/../../target/python-package")
[ -d "$package" ] || exit 0
cells='import json, sys
made = json.load(open(sys.argv[1]))
exec("\n".join("".join(cell["source"]) for cell in made["cells"] if cell["cell_type"] == "code"))'
for notebook in "$here"/../../python/notebooks/[45]-*.ipynb; do
  name=$(basename "$notebook" .ipynb)
  mkdir "$name"
  (cd "$name" && PYTHONPATH=$package MPLBACKEND=agg "$python" -c "$cells" "$notebook" > out.txt)
  echo "$name: $(grep -o 'left-out: .*' "$name/out.txt")"
done
