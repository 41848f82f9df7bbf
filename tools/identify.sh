#!/bin/sh
# SPDX-License-Identifier: MIT
# Finishes a linked image:
#     tools/identify.sh IMAGE.ihx AT
# The two bytes at AT become the address of the text that says who it is (firmware/mcu/identity.h), low byte
# first. The two bytes after them make the CRC of all code 0 (firmware/mcu/code.c).
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
# The CRC of the bytes before the two leads to one state, and 0 behind the last byte comes from another one: the two
# bytes lead from the one to the other. A byte at a time, by the table of the polynomial 0x1021; awk has no xor of
# its own.
bytes=$(od -An -v -w1 -t u1 "$image.bin" | awk -v at="$at" -v name_low=$((0x$identity % 256)) -v name_high=$((0x$identity / 256)) '
    function xor(a, b) { return nibbles[int(a / 16) * 16 + int(b / 16)] * 16 + nibbles[a % 16 * 16 + b % 16] }
    function feed(byte,    row) {
        row = xor(high, byte)
        high = xor(low, table_high[row])
        low = table_low[row]
    }
    function take_back(byte,    row) {
        row = row_of[low]
        low = xor(high, table_high[row])
        high = xor(row, byte)
    }
    BEGIN {
        for (a = 0; a < 16; a++)
            for (b = 0; b < 16; b++)
                for (bit = 1; bit <= 8; bit *= 2) nibbles[a * 16 + b] += int(a / bit) % 2 != int(b / bit) % 2 ? bit : 0
        for (row = 0; row < 256; row++) {
            crc = row * 256
            for (bit = 0; bit < 8; bit++) {
                top = crc >= 32768
                crc = crc * 2 % 65536
                if (top) crc = xor(int(crc / 256), 16) * 256 + xor(crc % 256, 33)
            }
            table_high[row] = int(crc / 256)
            table_low[row] = crc % 256
            row_of[crc % 256] = row
        }
    }
    { byte[NR - 1] = $1 }
    END {
        byte[at] = name_low
        byte[at + 1] = name_high
        high = low = 0
        for (i = 0; i < at + 2; i++) feed(byte[i])
        from_high = high
        from_low = low
        high = low = 0
        for (i = NR - 1; i >= at + 4; i--) take_back(byte[i])
        take_back(0)
        take_back(0)
        printf "\\%03o\\%03o\\%03o\\%03o", name_low, name_high, xor(from_high, high), xor(from_low, low)
    }')
# shellcheck disable=SC2059  # the bytes are octal numbers for printf
printf "$bytes" | dd of="$image.bin" bs=1 seek=$at conv=notrunc status=none
objcopy -I binary -O ihex "$image.bin" "$image.part"
tr -d '\r' <"$image.part" >"$image"
rm "$image.bin" "$image.part"
