#!/usr/bin/env bash
# CalculiX 2.20 (Debian calculix-ccx 2.20-1): *ORIENTATION with a *DISTRIBUTION gives every SHELL element the direction of the first,
# default line. The lines of single elements are ignored, without a warning. Solid elements get their own directions.
#
# Input: two unit squares (cubes) in a row, pulled along x by 1 N per unit area. E = 100 along the first axis of the fabric, 10 across it.
# The first axis is x in element 1 and y in element 2, so the end moves by 1/100 + 1/10 = 0.11.
#
#   elements   directions by                      end moves by
#   C3D8I      *DISTRIBUTION, default line x      0.11
#   S4         two *ORIENTATION, two sections     0.11
#   S4         *DISTRIBUTION, default line x      0.02   both elements along x
#   S4         *DISTRIBUTION, default line y      0.20   both elements along y
#
# Way round it: one *ORIENTATION and one *SHELL SECTION for every direction. Ends with 1 where CalculiX answers otherwise.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# The pinned package with the libraries that it loads, unpacked here only.
command -v apt-get > /dev/null || { echo "skipped: no apt-get here"; exit 0; }
libraries=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
  calculix-ccx | grep -E '^(lib(spooles|arpack|blas|lapack|gfortran|quadmath|gomp|openmpi|hwloc|event|pmix|ucx|fabric|psm|mpi|ibverbs|nl|numa|munge|rdmacm|udev|ltdl)|gcc-).*[0-9]' | sort -u)
# shellcheck disable=SC2086
apt-get download calculix-ccx=2.20-1 $libraries > download.log 2>&1 || { cat download.log; exit 1; }
for package in ./*.deb; do dpkg -x "$package" root; done
folders=$(find root -name '*.so*' -printf '%h\n' | sort -u | sed "s|^|$work/|" | paste -sd:)
export LD_LIBRARY_PATH=$folders OMP_NUM_THREADS=1
ccx=$work/root/usr/bin/ccx
{ "$ccx" -v || true; } | grep Version

x="1., 0., 0., 0., 1., 0."
y="0., 1., 0., -1., 0., 0."

# deck NAME KIND DIRECTIONS SECTIONS: prints how far the end moves.
deck() {
  {
    echo "*NODE"
    local k=0 z nodes
    for z in 0 1; do
      for nodes in "0., 0." "1., 0." "2., 0." "0., 1." "1., 1." "2., 1."; do
        k=$((k + 1))
        if [ "$2" = C3D8I ] || [ "$z" = 0 ]; then echo "$k, $nodes, $z."; fi
      done
    done
    printf '*ELEMENT, TYPE=%s, ELSET=all\n' "$2"
    if [ "$2" = S4 ]; then
      printf '1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n*NSET, NSET=left\n1, 4\n*NSET, NSET=right\n3, 6\n'
    else
      printf '1, 1, 2, 5, 4, 7, 8, 11, 10\n2, 2, 3, 6, 5, 8, 9, 12, 11\n*NSET, NSET=left\n1, 4, 7, 10\n*NSET, NSET=right\n3, 6, 9, 12\n'
    fi
    printf '*ELSET, ELSET=one\n1\n*ELSET, ELSET=two\n2\n'
    printf '*MATERIAL, NAME=m\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n100., 10., 10., 0., 0., 0., 5., 5.\n5.\n'
    printf '%b\n%b\n' "$3" "$4"
    printf '*BOUNDARY\nleft, 1, 3\nright, 2, 3\n*STEP\n*STATIC\n*CLOAD\nright, 1, %s\n' "$([ "$2" = S4 ] && echo 0.5 || echo 0.25)"
    printf '*NODE PRINT, NSET=right\nU\n*END STEP\n'
  } > "$1.inp"
  "$ccx" "$1" > "$1.txt"
  ! grep -qiE 'error|warning' "$1.txt" || echo "$1: CalculiX warns now" >&2
  awk 'NF == 4 && $1 ~ /^[0-9]+$/ {sum += $2; n++} END {printf "%.3f", sum / n}' "$1.dat"
}

by_element() { printf '*DISTRIBUTION, NAME=d\\n, %s\\n1, %s\\n2, %s\\n*ORIENTATION, NAME=o\\nd' "$1" "$x" "$y"; }
by_section="*ORIENTATION, NAME=o1\n$x\n*ORIENTATION, NAME=o2\n$y"
shell="*SHELL SECTION, MATERIAL=m"
found="$(deck solid C3D8I "$(by_element "$x")" "*SOLID SECTION, MATERIAL=m, ELSET=all, ORIENTATION=o")"
found+=" $(deck sections S4 "$by_section" "$shell, ELSET=one, ORIENTATION=o1\n1.\n$shell, ELSET=two, ORIENTATION=o2\n1.")"
found+=" $(deck first_x S4 "$(by_element "$x")" "$shell, ELSET=all, ORIENTATION=o\n1.")"
found+=" $(deck first_y S4 "$(by_element "$y")" "$shell, ELSET=all, ORIENTATION=o\n1.")"
echo "solids, sections, distribution from x, from y: $found"
[ "$found" = "0.110 0.110 0.020 0.200" ] || { echo "CalculiX answers otherwise: this finding is out of date"; exit 1; }
