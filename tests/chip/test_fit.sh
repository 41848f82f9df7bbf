#!/bin/bash
# SPDX-License-Identifier: MIT
# A program that is larger than its chip does not link, and the message says so. The message for an
# unknown board lists the boards.
. tests/lib.sh
dir=build/outgrown
rm -rf "$dir"

outgrows() { # MESSAGE KNOB=VALUE...
    local message=$1
    shift
    ! make -s BOARD=at89s52 "OUT=$dir" "$@" "$dir/brake.ihx" >"$dir.log" 2>&1 && [ ! -e "$dir/brake.ihx" ] && grep -q "$message" "$dir.log"
}
check "a_plain_table_does_not_fit_8_kb" outgrows "bytes of code are too many for board at89s52" ENCODING=plain
check "the_brake_does_not_fit_128_bytes_of_ram" outgrows "too little RAM for the stack on board at89s52" IRAM_BYTES=128

names_the_boards() {
    ! make BOARD=nosuch firmware >"$dir.log" 2>&1 && grep -q "no board 'nosuch'; the boards are: $(basename -as .mk firmware/boards/*.mk | xargs)" "$dir.log"
}
check "an_unknown_board_names_the_boards" names_the_boards
rm -rf "$dir" "$dir.log"
finish
