#!/usr/bin/env bash
# Says whether two builds print the same JSON, byte for byte: every command that reads or judges data, on what comes with the program.
# For changes that only move code. Usage: tests/same.sh OLD_IBR NEW_IBR [WORDS of the commands to run]
set -uo pipefail
old="$(realpath "${1:?write tests/same.sh OLD_IBR NEW_IBR}")"
new="$(realpath "${2:?write tests/same.sh OLD_IBR NEW_IBR}")"
only="${3:-.}"
cd "$(dirname "$0")/.."
top="$PWD"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
commands="$(cat <<'LIST'
predict epam
predict cpam --pressure 5kPa,10kPa,30kPa
predict spam --inverse tip=60mm
predict fpam --body-pressure 4kPa --pressure 0:30:10kPa
predict studies/epam-two-strips.toml --pressure 10kPa
compare epam synthetic-epam
compare cpam synthetic-cpam --calibrate
compare spam synthetic-spam
compare fpam synthetic-fpam
compare epam synthetic-epam-two-bodies
compare epam fem-epam --calibrate
compare cpam fem-cpam
compare spam fem-spam
compare fpam fem-fpam
compare --engines --stored
compare --paper
diagnose epam synthetic-epam
diagnose cpam synthetic-cpam
diagnose spam synthetic-spam
diagnose fpam synthetic-fpam
diagnose epam synthetic-epam-two-bodies
diagnose epam fem-epam
diagnose cpam fem-cpam
diagnose spam fem-spam
diagnose fpam fem-fpam
diagnose breukels-2011-beams
compare breukels-2011-beams
diagnose mckibben-free
compare fpam jitosho-2023-arm
ladder epam synthetic-epam
ladder cpam synthetic-cpam
add epam best synthetic-epam --out NEW.toml
validate fpam synthetic-fpam --without arm_growth
breakdown epam cpam --stored
characterize sets/nylon-offaxis/coupon_00.csv sets/nylon-offaxis/coupon_45.csv sets/nylon-offaxis/coupon_90.csv
data check synthetic-epam
data check fem-cpam
data list
list
list effects
design studies/epam-wish.toml --no-check
pattern epam
LIST
)"
count=0
failed=0
while read -r line; do
    [[ "$line" =~ $only ]] || continue
    count=$((count + 1))
    for build in old new; do
        mkdir -p "$folder/$build"
        # shellcheck disable=SC2086
        (cd "$folder/$build" && ln -sfn "$top/studies" "$top/data/sets" . && "${!build}" $line --json > out.json 2> err.txt; echo "exit $?" >> out.json)
        # Names of the folder differ.
        sed -i "s,$folder/$build,FOLDER,g" "$folder/$build/out.json" "$folder/$build/err.txt"
    done
    if cmp -s "$folder/old/out.json" "$folder/new/out.json" && cmp -s "$folder/old/err.txt" "$folder/new/err.txt"; then
        [ -n "${SHOW:-}" ] && printf 'same       %s: %s\n' "$line" "$(tail -1 "$folder/old/out.json")"
    else
        failed=$((failed + 1))
        printf 'different  ibr %s\n' "$line"
        diff "$folder/old/out.json" "$folder/new/out.json" | cut -c1-300 | head -4
        diff "$folder/old/err.txt" "$folder/new/err.txt" | cut -c1-300 | head -4
    fi
done <<< "$commands"
printf '%s of %s commands the same\n' $((count - failed)) "$count"
[ "$failed" = 0 ]
