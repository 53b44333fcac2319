#!/usr/bin/env bash
# Remakes the pictures of docs/guide.md, docs/accuracy.md and README.md; with --check, names those that would change and fails.
set -euo pipefail
cd "$(dirname "$0")/.."
[ "${IBR:-}" ] || cargo build --release --quiet
ibr="${IBR:-target/release/ibr}"
made="$(mktemp -d)"
trap 'rm -rf "$made"' EXIT

"$ibr" --quiet diagnose epam-textbook synthetic-epam --out "$made/diagnosis" > "$made/text"
"$ibr" --quiet ladder epam-textbook synthetic-epam --out "$made/ladder" > "$made/text"
"$ibr" --quiet diagnose epam-textbook --published --out "$made/published" > "$made/text"
"$ibr" --quiet demo --out "$made/demo" > "$made/text"

changed=0
figure() {
    cmp -s "$made/$1" "docs/$2" && return
    changed=1
    echo "docs/$2"
    [ "${check:-}" ] || cp "$made/$1" "docs/$2"
}
[ "${1:-}" != --check ] || check=yes
for name in missing_moment residuals_before ranking before_after candidates finite_elements; do
    figure "diagnosis/$name.png" "diagnosis/$name.png"
done
figure ladder/waterfall.png diagnosis/waterfall.png
figure published/one_number_epam.png diagnosis/one_number_epam.png
figure demo/breaking.png breaking.png
figure demo/robot.svg robots/epam.svg
[ -z "${check:-}" ] || exit "$changed"
