#!/bin/sh
# SPDX-License-Identifier: MIT
# Adds to a linked image the address of the text that says who it is (firmware/mcu/identity.h):
#     tools/identify.sh IMAGE.ihx AT       the two bytes at AT become the address, low byte first
# The linker cannot do that: it keeps all of the vectors' area for the vectors, unused bytes, too.
set -eu
image=$1 at=$(($2))
address=$(awk '$3 == "_identity" { print $2; exit }' "${image%.ihx}.map")
[ -n "$address" ] || {
    echo "$image: error: its map has no _identity; link mcu/identity" >&2
    exit 1
}
high=$((0x$address / 256)) low=$((0x$address % 256))
record=$(printf ':02%04X00%02X%02X%02X' $at $low $high $(((512 * 4 - 2 - at - low - high) % 256)))
# Behind the first record, which is the reset vector: so addresses keep growing.
sed "1a $record" "$image" >"$image.part"
mv "$image.part" "$image"
