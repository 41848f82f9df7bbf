#!/bin/sh
# SPDX-License-Identifier: MIT
# Finishes a linked image:
#     tools/identify.sh IMAGE.ihx AT
# The two bytes at AT become the address of the text that says who it is (firmware/mcu/identity.h), low byte
# first. The two bytes after them make the sum of all code, and the sum of its sums, 0 (firmware/mcu/code.c).
# What is free up to the end of the last page of code becomes 0xFF, as it is in an erased chip.
# The linker can do none of that: it keeps all of the vectors' area for the vectors, unused bytes, too.
set -eu
image=$1 at=$(($2))
identity=$(awk '$3 == "_identity" { print $2; exit }' "${image%.ihx}.map")
[ -n "$identity" ] || {
    echo "$image: error: its map has no _identity; link mcu/identity" >&2
    exit 1
}
end=$(awk '$3 == "s_XINIT" { print $2; exit }' "${image%.ihx}.map")
pages=$(((0x$end + 255) / 256))
objcopy -I ihex -O binary --gap-fill 0xff --pad-to $((pages * 256)) "$image" "$image.bin"
# With x and y as the two bytes, and n bytes from y to the end: sum + x + y and sums + (n + 1) x + n y are 0.
bytes=$(od -An -v -w1 -t u1 "$image.bin" | awk -v at="$at" -v low=$((0x$identity % 256)) -v high=$((0x$identity / 256)) '
    { byte = $1 }
    NR == at + 1 { byte = low }
    NR == at + 2 { byte = high }
    NR == at + 3 || NR == at + 4 { byte = 0 }
    { sum = (sum + byte) % 256; sums = (sums + sum) % 256 }
    END {
        n = (NR - at - 3) % 256
        x = (256 * 256 - sums + n * sum) % 256
        y = (512 - sum - x) % 256
        printf "\\%03o\\%03o\\%03o\\%03o", low, high, x, y
    }')
# shellcheck disable=SC2059  # the bytes are octal numbers for printf
printf "$bytes" | dd of="$image.bin" bs=1 seek=$at conv=notrunc status=none
objcopy -I binary -O ihex "$image.bin" "$image.part"
tr -d '\r' <"$image.part" >"$image"
rm "$image.bin" "$image.part"
