#!/usr/bin/env bash
# Remakes the finite element runs, hypercubes and data sets that come with the program, in about an hour on two cores. What is finished in FOLDER
# is kept, so that it can be interrupted. Usage: docs/stored.sh FOLDER
set -euo pipefail
folder="$(realpath -m "${1:?write docs/stored.sh FOLDER}")"
cd "$(dirname "$0")/.."
ibr="${IBR:-target/release/ibr}"
robots="epam cpam spam fpam"
mkdir -p "$folder/scenarios"

# Five seeds of every robot, up and down, at its own body pressure and at 4 kPa; then the maps, with what carries a departure.
kpa=5kPa,10kPa,15kPa,20kPa,25kPa,30kPa
for robot in $robots; do
    sed '/^\[body\]/,/^\[/s/^pressure_kpa *=.*/pressure_kpa = 4.0/' "models/scenarios/$robot.toml" > "$folder/scenarios/$robot.toml"
done
# shellcheck disable=SC2086
"$ibr" compare --engines $robots --seeds 5 --pressure "$kpa" --runs "$folder/runs" --out "$folder/page" > "$folder/own.txt"
"$ibr" compare --engines "$folder"/scenarios/*.toml --seeds 5 --pressure "$kpa" --runs "$folder/runs" --out "$folder/page4" > "$folder/4kpa.txt"
"$ibr" breakdown epam cpam --carriers --runs "$folder/runs" --out "$folder/map" > "$folder/map.txt"
"$ibr" breakdown spam fpam --carriers --body-pressure 4kPa --pouch "" --runs "$folder/runs" --out "$folder/map2" > "$folder/map2.txt"
# shellcheck disable=SC2086
"$ibr" compare --engines $robots --seeds 5 --pressure "$kpa" --runs "$folder/runs" --out "$folder/page" > "$folder/engines.txt"
cp "$folder/page/runs.json" compare/assets/fem-runs.json

# Robots over everything that nobody measured.
cube() {
    local name="$1" robot="$2" count="$3"
    shift 3
    "$ibr" simulate "$robot" --uncertain "$count" "$@" --out "$folder/cubes/$name" > "$folder/$name.txt"
    cp "$folder/cubes/$name/uncertain.json" "compare/assets/uncertain/$name.json"
}
cube epam epam 30
cube cpam cpam 30
cube fpam fpam 30
cube spam spam 30
cube spam-face spam 12 --set tape_margin_mm=0
cube spam-seams spam 12 --set taped=seams

# Marker data of the stored runs, by a program that has them.
cargo build --release --quiet
ibr=target/release/ibr
for robot in $robots; do
    "$ibr" data fem "$robot-textbook" --stored --seed 21 --force --out "data/sets/fem-$robot" > "$folder/fem-$robot.txt"
    rm "data/sets/fem-$robot/manifest.json"
done
cp "$folder/cubes/epam/markers.png" docs/robots/epam-uncertain.png
cp "$folder/cubes/epam/tornado.png" docs/robots/epam-tornado.png
