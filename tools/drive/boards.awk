# SPDX-License-Identifier: MIT
# A board's fragment, after firmware/pins.mk, as one line of build/boards.h.
#     awk -v pins="PWM STOP ..." -f boards.awk firmware/pins.mk firmware/boards/NAME.mk
$2 == ":=" { value[$1] = $3 }
function of(key) {
    if (key in value) {
        return value[key]
    }
    print FILENAME ": error: a board states " key " := ..., as the others do" >"/dev/stderr"
    exit 1
}
END {
    name = FILENAME
    gsub(/.*\/|\.mk$/, "", name)
    printf "BOARD(%s, %s, \"%s\", \"%s\"", name, of("CLK_HZ"), of("S51_TYPE"), of("WATCHDOG")
    count = split(pins, pin, " ")
    for (i = 1; i <= count; i++) {
        printf ", %s", of("PIN_" pin[i])
    }
    print ")"
}
