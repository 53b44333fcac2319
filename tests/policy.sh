#!/usr/bin/env bash
# Moves every constant of each policy.rs by half, down and up, and says which tests of its crate fail then.
# A constant that no test misses decides nothing that anybody checked: the script then ends with 1.
# One build for all: in a copy of the tree the constants become functions that read POLICY="NAME FACTOR".
# tests/policy.sh [NAME...]
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TARGET_DIR=$PWD/target
copy=$PWD/target/policy
rm -rf "$copy" && mkdir -p "$copy"
{ git ls-files -z; git ls-files -oz --exclude-standard; } | tar -c --null -T - | tar -xC "$copy"
cd "$copy"

constant='^pub(\([a-z]+\))? const ([A-Z_0-9]+): ([^=]+) = (.*);'
names() { sed -nE "s/$constant/\2/p" "$@"; }
levers() { # a file of constants: they become functions, here and where they are used
  local all
  all=$(names "$1" | paste -sd '|')
  grep -rlE "policy::($all)\b" --include='*.rs' "${1%%/*}" | xargs -r sed -Ei "s/\bpolicy::($all)\b/policy::lever_\1()/g"
  sed -Ei "/^pub(\([a-z]+\))? const/!s/\b($all)\b/lever_\1()/g
    s/$constant/pub fn lever_\2() -> \3 { Lever::moved(\4, factor(\"\2\")) }/" "$1"
  cat >> "$1" <<'RUST'
trait Lever { fn moved(self, by: f64) -> Self; }
impl Lever for f64 { fn moved(self, by: f64) -> f64 { self * by } }
impl Lever for usize { fn moved(self, by: f64) -> usize { (self as f64 * by).round() as usize } }
impl<T: Lever, const N: usize> Lever for [T; N] { fn moved(self, by: f64) -> [T; N] { self.map(|x| x.moved(by)) } }
fn factor(name: &str) -> f64 {
    let text = std::env::var("POLICY").unwrap_or_default();
    text.split_once(' ').filter(|set| set.0 == name).map_or(1.0, |set| set.1.parse().unwrap())
}
RUST
}
decisions="policy:: boundaries:: decide:: order:: next:: story:: problem:: source:: interval:: residuals:: guard:: generate::tests::twenty"
quick="--skip _tests:: --skip diagnosis::tests --skip bench::tests --skip intervals_of_made_up --skip stands_out::tests"
failing() { # of the first set of tests in which any fails
  for set in "$@"; do
    { "$program" $set 2> /dev/null || true; } | sed -nE 's/^test (.*) \.\.\. FAILED$/\1/p' | paste -sd ' ' | grep . && return
  done || true
}

missed=0
for policy in */src/policy.rs; do
  crate=${policy%%/*}
  files=$(find "$policy" "${policy%.rs}" -name "*.rs" ! -name tests.rs 2> /dev/null || true)
  all=$(names $files)
  for file in $files; do levers "$file"; done
  program=$(cargo test --release -p "ibr-$crate" --lib --no-run 2>&1 | sed -nE 's/.*Executable .*\((.*)\)/\1/p')
  cd "$crate"
  [ -z "$(failing "$decisions" "$quick")" ] || { echo "$crate: tests fail as it is"; exit 1; }
  for name in $all; do
    [[ $# = 0 || " $* " = *" $name "* ]] || continue
    down=$(POLICY="$name 0.5" failing "$decisions" "$quick" "") up=$(POLICY="$name 1.5" failing "$decisions" "$quick" "")
    printf '%s %s\n  x0.5: %s\n  x1.5: %s\n' "$crate" "$name" "${down:--}" "${up:--}"
    [ -n "$down$up" ] || missed=$((missed + 1))
  done
  cd ..
done
echo "$missed constants move and no test fails"
[ "$missed" = 0 ]
