#!/usr/bin/env bash
# Builds what a release holds, in target/release-files: the program as one static file, the wheel, the page, the C library, the site
# of the documents, and the SHA-256 of each. What needs a tool that is absent is left out with a word.
#   ./release.sh [page|program|wheel|capi|site]...    all of them without a word
set -euo pipefail
cd "$(dirname "$0")"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
grep -q "^version: $version$" CITATION.cff || { echo "CITATION.cff has another version than $version"; exit 1; }
grep -q "^## $version " CHANGELOG.md || { echo "CHANGELOG.md has no chapter $version"; exit 1; }
files=target/release-files
mkdir -p "$files"

# Static: runs on any Linux of this processor, whatever its C library. The page is in it where it was built before; completions and
# manual pages come with it, in the folders where a system looks for them below /usr/local.
program() {
  local target folder
  target=$(rustc -vV | sed -n 's/^host: //p')
  RUSTFLAGS="-C target-feature=+crt-static" cargo build --quiet --release --target "$target" --bin ibr
  folder=ibr-$version-$target
  rm -rf "target/$folder" && mkdir -p "target/$folder/bin" "target/$folder/share/man/man1"
  cp "target/$target/release/ibr" "target/$folder/bin/"
  (
    cd "target/$folder"
    bin/ibr man --out share/man/man1
    mkdir -p share/bash-completion/completions share/zsh/site-functions share/fish/vendor_completions.d
    bin/ibr completions bash > share/bash-completion/completions/ibr
    bin/ibr completions zsh > share/zsh/site-functions/_ibr
    bin/ibr completions fish > share/fish/vendor_completions.d/ibr.fish
    bin/ibr --version
  )
  tar czf "$files/$folder.tar.gz" -C target "$folder"
}
# With zig as linker the wheel asks for glibc 2.17 only; else for that of this machine.
wheel() {
  command -v maturin > /dev/null || { echo "wheel: absent: maturin. Get it: pip install maturin ziglang"; return; }
  local old=()
  python3 -c 'import ziglang' 2> /dev/null && old=(--zig --compatibility manylinux2014)
  maturin build --quiet --out "$files" "${old[@]}"
}
page() {
  web/build.sh || { [ $? = 3 ] && return; }
  cp web/dist/ibr.html "$files/ibr-$version.html"
}
capi() {
  cargo build --quiet --release --package ibr-capi
  tar czf "$files/ibr-capi-$version.tar.gz" -C capi ibr.h -C ../target/release libibr_capi.a
}
site() {
  docs/site.sh > "$files/site.log" || { [ $? = 3 ] && cat "$files/site.log" && return; }
  tar czf "$files/ibr-site-$version.tar.gz" -C target/site book
}
# The text of the tag is the version's chapter of the change log.
{ echo "ibr $version" && sed -n "/^## $version /,/^## /{/^## /d;p}" CHANGELOG.md; } > "$files/tag.txt"
for part in ${*:-page program wheel capi site}; do
  "$part"
done
cd "$files" && sha256sum ibr-* > SHA256SUMS && cat SHA256SUMS
