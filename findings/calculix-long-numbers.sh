#!/usr/bin/env bash
# CalculiX 2.20 (Debian calculix-ccx 2.20-1) reads the first 20 characters of a number, without a word. What a decimal exponent of two
# digits loses there is its last digit: 4.898587196589413e-18, 21 characters, becomes 0.4898587.
#
#   z of node 4 in the deck     z in the .frd
#   4.898587196589413e-18       0.489859
#   4.89858719658941e-18        4.89859e-18
#
# Way round it: at most 20 characters a number. Ends with 1 where CalculiX answers otherwise.
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

# deck NAME Z: prints the z of node 4 as the result file has it. Nothing is computed.
deck() {
  printf '*NODE, NSET=all\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., %s\n' "$2" > "$1.inp"
  {
    printf '*ELEMENT, TYPE=S4, ELSET=all\n1, 1, 2, 3, 4\n*MATERIAL, NAME=m\n*ELASTIC\n100., 0.3\n'
    printf '*SHELL SECTION, ELSET=all, MATERIAL=m\n0.1\n*BOUNDARY\nall, 1, 3\n'
    printf '*STEP\n*NO ANALYSIS\n*NODE FILE, OUTPUT=2D\nU\n*END STEP\n'
  } >> "$1.inp"
  # It ends with 201 where nothing is to be computed.
  "$ccx" "$1" > "$1.txt" || [ $? = 201 ]
  awk '/^ -1 +4 / && !found { print substr($0, 38, 12); found = 1 }' "$1.frd" | tr -d ' '
}

found="$(deck long 4.898587196589413e-18) $(deck short 4.89858719658941e-18)"
echo "z of node 4: $found"
[ "$found" = "4.89859E-01 4.89859E-18" ] || { echo "CalculiX answers otherwise: this finding is out of date"; exit 1; }
