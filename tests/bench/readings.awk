# SPDX-License-Identifier: MIT
# Echoes of a drive of chance, as pin events for s51_pins of tests/chip/lib.sh, one answer to each of COUNT
# triggers, which come every 60 ms:
#     awk -v first_us=... -v count=... -v falls=FILE -f readings.awk
# Targets of 0..35 m/s either way, jumps, clear roads, echoes that stay away, never end, repeat or come
# from too near. FILE gets the times of the falls that end a measurement.
function chance(below) {
    seed = (seed * 16807) % 2147483647
    return seed % below
}
function pulse(from_us, width_us) {
    printf "#%d500\n1!\n#%d500\n0!\n", from_us, from_us + width_us
}
BEGIN {
    OFMT = CONVFMT = "%.3f"
    seed = 51
    place_mm = 4900
    nearer_mm = 60
    for (k = 0; k < count; k++) {
        start_us = first_us + 60000 * k + 4500
        what = chance(100)
        if (k < skip) continue
        if (what < 10) {
            place_mm = 100 + chance(6000)
            nearer_mm = what < 5 ? chance(2100) - 1050 : chance(120)
        } else if (what < 14) {
            nearer_mm = int(nearer_mm / 4)
        }
        if (what >= 20) place_mm -= nearer_mm # else the reading repeats
        if (place_mm < 20 || place_mm > 6200) {
            nearer_mm = -nearer_mm
            place_mm = place_mm < 20 ? 300 : 5800
        }
        width_us = int(place_mm * 20000 / 3432)
        if (what >= 97) continue # it never rises
        if (what == 96) { # it ends during the next measurement, which it spoils, too
            pulse(start_us, 75000)
            skip = k + 2
            continue
        }
        if (what >= 94) width_us = 60
        else if (what >= 90) width_us = 38000
        pulse(start_us, width_us)
        print start_us + width_us + 0.5 >falls
    }
}
