#!/usr/bin/env bash
# `ibr export c` as C99 and C++ on this machine, for a Cortex-M4F in single precision and for an ATmega328P.
# tests/foreign/c.sh [IBR]
# A compiler that is absent is skipped with a word.
set -euo pipefail
. "$(dirname "$0")/common"
cd "$work"
"$ibr" --quiet export c epam --pressure 0:40kPa --out my-robot.c > /dev/null
if "$ibr" --quiet export c epam --pressure 0:40kPa --out my-robot.c 2> refusal; then echo "a file was replaced without --force"; exit 1; fi
grep -q -- --force refusal
"$ibr" --quiet --force export c epam --pressure 0:40kPa --out my-robot.c > /dev/null
height=$("$ibr" predict epam --pressure <(printf 'p_kpa\n20\n') --json | sed -n '/"tip"/,/}/s/.*"y_mm": *\([0-9]*\.[0-9]\{1,4\}\).*/\1/p')
cat > main.c << 'END'
#include "my-robot.h"
#include <stdio.h>
int main(void)
{
    my_robot_tip_t tip;
    const int outside = my_robot_tip((IBR_REAL)20e3, &tip);
    printf("%.4f\n", (double)tip.y_m * 1e3);
    return outside;
}
END
cp main.c main.cpp
strict="-O2 -Wall -Wextra -Wpedantic -Werror"
single="-DIBR_REAL=float -Wdouble-promotion -Wfloat-conversion"
has() { command -v "$1" > /dev/null || { echo "c: skipped: no $1 here"; return 1; }; }
# near NAME VALUE: within 0.05 mm of the model.
near() {
  awk -v a="$2" -v b="$height" 'BEGIN { exit !(a - b < 0.05 && b - a < 0.05) }' || { echo "$1: tip at $2 mm, model $height mm"; exit 1; }
  echo "$1: tip at $2 mm, model $height mm"
}
# shellcheck disable=SC2086
if has gcc; then
  gcc -std=c99 $strict main.c my-robot.c -o c99 -lm && near C99 "$(./c99)"
  gcc -std=c99 $strict $single -Wno-double-promotion -c main.c -o single.o
  gcc -std=c99 $strict $single -c my-robot.c -o table.o && gcc single.o table.o -o single -lm && near "C99, float" "$(./single)"
fi
# shellcheck disable=SC2086
if has g++; then
  gcc -std=c99 $strict -c my-robot.c -o table.o
  g++ -std=c++17 $strict main.cpp table.o -o linked -lm && near "C++ linked with C" "$(./linked)"
  g++ -std=c++17 $strict -x c++ main.cpp my-robot.c -o whole -lm && near C++17 "$(./whole)"
fi
# shellcheck disable=SC2086
if has arm-none-eabi-gcc; then
  arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -std=c99 ${strict/-O2/-Os} $single -c my-robot.c -o arm.o
  if arm-none-eabi-nm arm.o | grep -E '__aeabi_d|__aeabi_f2d| U sqrt$'; then echo "Cortex-M4F: double precision is called"; exit 1; fi
  bytes=$(arm-none-eabi-size arm.o | awk 'NR == 2 { print $1 + $2 + $3 }')
  [ "$bytes" -le 3072 ] || { echo "Cortex-M4F: $bytes bytes, more than 3072"; exit 1; }
  echo "Cortex-M4F: $bytes bytes, no double precision"
fi
# shellcheck disable=SC2086
if has avr-gcc; then
  avr-gcc -mmcu=atmega328p -std=c99 ${strict/-O2/-Os} -c my-robot.c -o avr.o
  ram=$(avr-size avr.o | awk 'NR == 2 { print $2 + $3 }')
  [ "$ram" = 0 ] || { echo "ATmega328P: $ram bytes of RAM for constants"; exit 1; }
  echo "ATmega328P: $(avr-size avr.o | awk 'NR == 2 { print $1 }') bytes of flash, none of RAM"
fi
