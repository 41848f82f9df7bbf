#!/bin/bash
# SPDX-License-Identifier: MIT
# Each theorem that `make prove` prints is explained in docs/proof.md, and each has a seeded fault with which it falls.
. tests/lib.sh

sed -nE 's/^ *\*{0,1} *theorem ([A-Za-z0-9_]+):.*/\1/p' tests/prove/*.c | sort -u >"$out/proved"
sed -n '/^## The theorems/,/^## What/p' docs/proof.md | grep '^|' | cut -d '|' -f 2 | grep -oE '`[a-z0-9_]+`' | tr -d '`' | sort -u >"$out/explained"
awk '!/^(#|- )/ { print $1 }' tests/prove/faults.txt | sort -u >"$out/seeded"
faultless "docs/proof.md explains each theorem" "$(comm -23 "$out/proved" "$out/explained" | xargs)"
faultless "docs/proof.md names no other theorem" "$(comm -13 "$out/proved" "$out/explained" | xargs)"
faultless "each theorem has a seeded fault" "$(comm -23 "$out/proved" "$out/seeded" | xargs)"
sed -n 's|^tests/prove/\(wp_.*\)\.c$|\1|p' < <(ls tests/prove/*.c) | sort >"$out/units"
awk '!/^#/ { print $2 }' tests/prove/faults.txt | sort -u >"$out/faulty"
faultless "each unit of WP has a seeded fault" "$(comm -23 "$out/units" "$out/faulty" | xargs)"
faultless "each seeded fault is of a theorem" "$(comm -13 "$out/proved" "$out/seeded" | grep -vx -- - | xargs)"

# How many readings a time is with each sensor, in the page and in the sources.
readings() { # NAME SENSOR
    echo $(($(printf '#include "latch.h"\n#include "fault.h"\n%s\n' "$1" |
        gcc -E -P -Ifirmware/brake -Ifirmware/lib "-DSENSOR_$2" - | tail -n 1 | tr -d U)))
}
sed -nE 's/^\| ([A-Z_]+_READINGS) \|.*\| ([0-9]+) \| ([0-9]+) \|$/\1 \2 \3/p' docs/proof.md >"$out/readings"
check "docs/proof.md says how many readings a time is" [ -s "$out/readings" ]
faultless "docs/proof.md has the numbers of the sources" "$(while read -r name ultrasonic lidar; do
    [ "$(readings "$name" hcsr04) $(readings "$name" tfluna)" = "$ultrasonic $lidar" ] || echo "$name: $(readings "$name" hcsr04) and $(readings "$name" tfluna)"
done <"$out/readings")"
finish
