#!/bin/bash
# SPDX-License-Identifier: MIT
# `make flash`, as far as it goes without a chip: the command line it would run, and what it says
# when something is missing.
. tests/lib.sh

says() { # NAME, TEXT, COMMAND...: whatever COMMAND's exit status is, it prints TEXT
    local name=$1 text=$2 said
    shift 2
    said=$("$@" 2>&1)
    [[ $said == *"$text"* ]]
    say "$name" $? "no '$text' in '$said'"
}

at89s52=(make flash BOARD=at89s52)
says stc_runs_stcgal 'stcgal -P stc89 -p /dev/x build/stc89c516rd/brake.hex' \
    make -n flash BOARD=stc89c516rd PORT=/dev/x
says at89_runs_avrdude 'avrdude -C +firmware/boards/at89s52.conf -c avrisp -b 19200 -P /dev/x -p AT89S52 -U flash:w:build/at89s52/brake.hex:i' \
    make -n flash BOARD=at89s52 PORT=/dev/x
says usbasp_needs_no_port 'avrdude -C +firmware/boards/at89s52.conf -c usbasp -b 19200 -P usb -p AT89S52' \
    make -n flash BOARD=at89s52 PROGRAMMER=usbasp
says stc_of_8_kb_runs_stcgal 'stcgal -P stc89 -p /dev/x build/stc89c52rc/brake.hex' \
    make -n flash BOARD=stc89c52rc PORT=/dev/x
says another_app_is_flashed 'build/at89s52/gap.hex' make -n flash BOARD=at89s52 PORT=/dev/x APP=gap
says a_missing_board_is_named "the boards are: $(basename -as .mk firmware/boards/*.mk | xargs)" make flash
says a_missing_port_is_named 'say where the chip is' "${at89s52[@]}"
says a_missing_flasher_is_named 'nosuchtool is missing' "${at89s52[@]}" PORT=/dev/x 'FLASH=nosuchtool'
says a_board_without_flasher_says_so 'no flasher of its own' make flash BOARD=generic8052 PORT=/dev/x
says avrdude_reads_our_part 'signature              = 0x1e 0x52 0x06' \
    avrdude -C +firmware/boards/at89s52.conf -p AT89S52/s
finish
