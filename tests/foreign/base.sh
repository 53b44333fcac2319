#!/usr/bin/env bash
# A model of another simulator lacks one effect: `ibr diagnose --base` names it, and the correction helps on data that were left out.
# MuJoCo has a chain of hinges and SoRoMoX a rod of constant curvatures, both with stiffness and drive from `ibr export` of a robot without the effect.
# tests/foreign/base.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs mujoco=4.0.0 soromox=0.5.0
check "$ibr"
