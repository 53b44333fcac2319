#!/usr/bin/env bash
# Licences of the crates that `ibr` is linked from, one a line; with --texts their notices too, to pass on with a binary.
set -euo pipefail
cd "$(dirname "$0")"
sources="${CARGO_HOME:-$HOME/.cargo}/registry/src"

cargo tree --package ibr --edges normal,no-proc-macro --prefix none --format '{p} | {l}' | sed 's/ (\*)//' |
  grep -v "($PWD" | sort -u | while read -r name version _ licence; do
    echo "$name ${version#v}: $licence"
    [ "${1:-}" = --texts ] || continue
    find "$sources"/*/"$name-${version#v}" -maxdepth 1 -type f \
      \( -iname 'licen[sc]e*' -o -iname 'copying*' -o -iname 'notice*' \) -exec cat {} + -exec echo \;
  done
if [ "${1:-}" = --texts ]; then cat assets/DejaVuSans-LICENSE.txt data/sets/*/LICENSE; fi
