#!/bin/bash
# SPDX-License-Identifier: MIT
# The comparison of chip and host finds what it should: one wrong bit in the code of a chip.
. tests/lib.sh
. tests/listing.sh
board=${BOARD:-stc89c516rd}
images=build/compiler/$board

# differs NAME IMAGE MODULE SYMBOL OFFSET: the bit is the lowest one of the byte at SYMBOL + OFFSET.
differs() {
    local said
    awk -v "address=$(($(address_of "$4" "$images/$2/shipped/$3.rst") + $5))" -f tests/chip/flip_byte.awk "$images/$2/steps.ihx" >"$out/$1.ihx"
    check "$1_is_one_bit" [ "$(cmp -l "$images/$2/steps.ihx" "$out/$1.ihx" | wc -l)" -ge 2 ]
    said=$("$images/$2/steps" "$out/$1.ihx" 50000 2>&1)
    [ $? -eq 1 ] && [[ $said == "step "[0-9]*" differs: "*input*host*chip* ]]
    say "$1_is_found" $? "$said"
}

differs a_wrong_cell_of_the_table brake lib/lut _lut_out1 1000
differs a_wrong_digit park lib/telemetry _POWERS 2
differs a_wrong_arrow_of_the_latch brake brake/latch _NEXT 12
differs a_wrong_sine radar radar/lane _sine_q16 20
refuses "no_steps_is_refused" 2 "usage: steps" "$images/brake/steps" "$images/brake/steps.ihx"
finish
