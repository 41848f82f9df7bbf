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
# bytes lead from the one to the other. crc_before undoes a step of the CRC.
bytes=$(od -An -v -w1 -t u1 "$image.bin" | awk -v at="$at" -v low=$((0x$identity % 256)) -v high=$((0x$identity / 256)) '
    function turned(crc, bit) { return int(crc / bit) % 2 ? crc - bit : crc + bit }
    function fed_back(crc) { return turned(turned(turned(crc, 4096), 32), 1) }
    function crc_after(crc, bit) { return int(crc / 32768) == bit ? crc * 2 % 65536 : fed_back(crc * 2 % 65536) }
    function crc_before(crc, bit) { return crc % 2 ? (fed_back(crc) + (1 - bit) * 65536) / 2 : (crc + bit * 65536) / 2 }
    { byte[NR - 1] = $1 }
    END {
        byte[at] = low
        byte[at + 1] = high
        for (i = 0; i < at + 2; i++)
            for (bit = 128; bit >= 1; bit /= 2) from = crc_after(from + 0, int(byte[i] / bit) % 2)
        for (i = NR - 1; i >= at + 4; i--)
            for (bit = 1; bit <= 128; bit *= 2) to = crc_before(to + 0, int(byte[i] / bit) % 2)
        for (i = 0; i < 16; i++) to = crc_before(to + 0, 0)
        for (bit = 1; bit <= 32768; bit *= 2) both += int(from / bit) % 2 != int(to / bit) % 2 ? bit : 0
        printf "\\%03o\\%03o\\%03o\\%03o", low, high, int(both / 256), both % 256
    }')
# shellcheck disable=SC2059  # the bytes are octal numbers for printf
printf "$bytes" | dd of="$image.bin" bs=1 seek=$at conv=notrunc status=none
objcopy -I binary -O ihex "$image.bin" "$image.part"
tr -d '\r' <"$image.part" >"$image"
rm "$image.bin" "$image.part"
