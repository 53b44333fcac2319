#!/usr/bin/env bash
# Builds target/site/book/index.html: all documents as one site that can be searched, with the gallery; then follows every link in it.
# Needs mdbook (cargo install mdbook); ends with 3 where it is absent.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v mdbook > /dev/null || { echo "site: absent: mdbook. Get it: cargo install mdbook"; exit 3; }

site=${CARGO_TARGET_DIR:-target}/site
rm -rf "$site" && mkdir -p "$site/src"
# Every file keeps its place, so that links are the same in the tree and on the site.
cp -r --parents README.md ARCHITECTURE.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE-MIT LICENSE-APACHE \
    benches/README.md docs examples/session.rs src/lib.rs studies "$site/src"

cat > "$site/book.toml" << 'END'
[book]
title = "ibr"
description = "Models of pneumatic bending actuators on inflated-beam robots, compared with measurements"
src = "src"
[output.html]
preferred-dark-theme = "navy"
[output.html.print]
enable = false
END

# Chapters in the order in which a reader meets them. A document that is not named here comes at the end by its title.
chapters="docs/guide docs/scenario docs/effects docs/robots docs/accuracy docs/theory docs/case docs/characterize docs/python docs/web
docs/control docs/sweep docs/design docs/json docs/verification/README ARCHITECTURE CONTRIBUTING benches/README CHANGELOG"
rest=$(cd "$site/src" && find . -name '*.md' ! -path ./README.md | sed 's|^\./||; s|\.md$||' | sort)
title() { sed -n '0,/^# /s/^# //p' "$site/src/$1.md"; }
{
    echo "[ibr](README.md)"
    echo "[Gallery](gallery.md)"
    for chapter in $chapters $(grep -vxFf <(tr ' ' '\n' <<< "$chapters") <<< "$rest"); do
        echo "- [$(title "$chapter")]($chapter.md)"
    done
} > "$site/SUMMARY.md"

# The gallery: every picture that a document shows, with the words that stand for it there. A README is the index of its folder.
{
    echo "# Gallery"
    (cd "$site/src" && grep -oHE '!\[[^]]+\]\([^)]+\)' README.md docs/*.md docs/verification/README.md) |
        while IFS=: read -r page picture; do
            words=${picture#*[} file=${picture##*(}
            file=$(realpath -m --relative-to="$site/src" "$site/src/$(dirname "$page")/${file%)}")
            printf '%s\t%s\t%s\n' "$file" "${words%%]*}" "$page"
        done | sort -u -t "$(printf '\t')" -k 1,1 |
        while IFS="$(printf '\t')" read -r file words page; do
            printf '\n## %s\n\n![%s](%s)\n\n[%s](%s)\n' "$words" "$words" "$file" "$(title "${page%.md}")" "${page/README.md/index.md}"
        done
} > "$site/src/gallery.md"
mv "$site/SUMMARY.md" "$site/src/"
mdbook build "$site"

dead=0
while read -r page; do
    for link in $(grep -oE '(href|src)="[^"#?]+' "$page" | sed 's/^[a-z]*="//' | grep -vE '^(https?|mailto|data|javascript):' | sort -u); do
        case $link in /*) target=$site/book$link ;; *) target=$(dirname "$page")/$link ;; esac
        [ -e "$target" ] || { echo "site: ${page#"$site/book/"}: $link leads nowhere"; dead=1; }
    done
done < <(find "$site/book" -name '*.html' ! -name 404.html)
echo "$site/book/index.html"
exit $dead
