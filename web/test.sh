#!/bin/sh
# Builds the page and tries it in a browser; says in a word what is absent where it cannot.
set -eu
cd "$(dirname "$0")/.."
absent() { echo "web: skipped: $1"; exit 0; }
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || absent "no chromium"
command -v npm > /dev/null || absent "no npm"
built=0; web/build.sh || built=$?
[ $built -ne 3 ] || absent "see above"
[ $built -eq 0 ] || exit $built
folder=${CARGO_TARGET_DIR:-target}/web-test
[ -d "$folder/node_modules/playwright-core" ] ||
    npm install --silent --no-fund --no-audit --prefix "$folder" playwright-core@1.49.1 || absent "npm cannot get playwright-core"
cargo build --quiet --release --bin ibr
node web/test.mjs "${CARGO_TARGET_DIR:-target}/release/ibr" "$chromium" "$folder"
