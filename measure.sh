#!/usr/bin/env bash
# The size of this repository: lines and characters of code without tests, in one format for every version; circles of files; named
# constants; type names with two meanings; the binary. `./measure.sh build` times a clean build too. Needs rustfmt and awk.
set -euo pipefail
cd "$(dirname "$0")"
product="models fem data compare report src sweep spelling python capi web"
development="challenge verification fuzz"
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

# Without test files and without what stands behind `#[cfg(test)]` at the end of a file.
for part in $product $development; do
  find "$part" -path '*/target' -prune -o -name '*.rs' -print | grep '/src/\|^src/' |
    grep -v '/tests/\|tests\.rs$\|/tests.rs$' | while read -r file; do
    mkdir -p "$copy/$(dirname "$file")"
    awk '/^#\[cfg\(test\)\]/ { held = $0; next }
         held && /^mod .*\{/ { exit }
         held && /^mod / { held = ""; next }
         held { print held; held = "" }
         { print }' "$file" > "$copy/$file"
  done
done
find "$copy" -name '*.rs' -print0 | xargs -0 -n 64 rustfmt --edition 2024 --config max_width=100,use_small_heuristics=Default,skip_children=true 2> /dev/null ||
  find "$copy" -name '*.rs' -print0 | xargs -0 -n 1 rustfmt --edition 2024 --config max_width=100,use_small_heuristics=Default > /dev/null 2>&1 || true

lines() { for part in "$@"; do find "$copy/$part" -name '*.rs' -exec cat {} +; done | wc -l; }
code() { for part in "$@"; do find "$copy/$part" -name '*.rs' -exec cat {} +; done | sed 's,^ *//.*,,; s/^ *//' | tr -d '\n' | wc -c; }
printf '%-44s %s\n' "lines of the product, without tests, width 100" "$(lines $product)"
printf '%-44s %s\n' "lines of the development crates" "$(lines $development)"
for part in $product $development; do printf '  %-42s %s\n' "$part" "$(lines "$part")"; done
printf '%-44s %s\n' "characters of code of the product" "$(code $product)"

printf '%-44s %s\n' "circles of files" "$(cargo test --release --quiet -p ibr-spelling --test circles -- --nocapture | grep -c ' files: ')"
printf '%-44s %s\n' "named constants of numbers" "$(grep -rhE '^\s*(pub )?(pub\([a-z]+\) )?const [A-Z_0-9]+: (f64|usize|u32|u64)' "$copy" | wc -l)"
# A type that the rest of its crate, or everybody, sees; and every type.
meanings() { grep -rhoE "^\s*($1)(struct|enum|trait) [A-Z][A-Za-z0-9]*" "$copy" --include='*.rs' | awk '{ print $NF }' | sort | uniq -d | wc -l; }
printf '%-44s %s\n' "public type names with two meanings" "$(meanings 'pub ')"
printf '%-44s %s\n' "type names with two meanings, private too" "$(meanings '(pub(\([a-z :]+\))? )?')"
printf '%-44s %s\n' "files over 400 lines" "$(find $product $development -name '*.rs' -not -path '*/target/*' | xargs wc -l | awk '$1 > 400 && $2 != "total"' | wc -l)"
# A word has a letter or a digit; the JSON's keys are a table apart.
words() { cat "$@" | tr -s '[:space:]' '\n' | grep -c '[[:alnum:]]'; }
printf '%-44s %s\n' "words of README and docs, without json.md" "$(words README.md $(ls docs/*.md | grep -v json.md))"
printf '%-44s %s\n' "words of docs/json.md" "$(words docs/json.md)"
if [ "${1:-}" = build ]; then
  target=$(mktemp -d)
  trap 'rm -rf "$copy" "$target"' EXIT
  TIMEFORMAT='%U user CPU-s of a clean release build'
  time CARGO_TARGET_DIR="$target" cargo build --release --quiet
  printf '%-44s %s MB\n' "binary" "$(($(stat -c %s "$target/release/ibr") / 1000000))"
fi
