#!/bin/sh
# SPDX-License-Identifier: MIT
# Takes out of a compiled file what SDCC 4.5 adds for C11's atomic flags, which this firmware does not use:
#     tools/no_atomics.sh FILE.rel        FILE.asm is beside it
# That is 109 bytes of routines, and at the end of each interrupt a jump to one of them, 16 cycles longer than
# a plain return. Files without any of this, and those of older versions, stay as they are.
set -eu
asm=${1%.rel}.asm
grep -q sdcc_atomic "$asm" || exit 0
sed -i '/globl.*sdcc_atomic/d
    /^; restartable atomic support routines/,/^;---/{/^;---/!d}
    s/ljmp\([[:blank:]]*\)sdcc_atomic_maybe_rollback/reti/' "$asm"
sdas8051 -plosgffw "$1" "$asm"
