#!/bin/bash
# SPDX-License-Identifier: MIT
# Proves the firmware with Frama-C, `make prove`:
#     tests/prove/prove.sh [UNIT...]        names of tests/prove/UNIT.c without .c; none: all of them
# A unit wp_NAME.c is proved by WP: each function keeps its contract, and no step of it is undefined in C. A unit
# eva_NAME.c is analysed by Eva: from start, for ever, whatever the machine delivers, no step is undefined. tried.c
# tries all values. Prints a line for each unit and for each theorem of it, that is a clause whose label its
# first comment explains as "theorem LABEL: words". Exits with 1 if anything is open.
# int has 16 bits, as with SDCC for the 8051.
set -u
cd "$(dirname "$0")/../.." || exit 2
out=build/prove
failed=0
mkdir -p "$out"
why3 config list-provers 2>/dev/null | grep -q Z3 || why3 config detect >"$out/why3.log" 2>&1

# say NAME STATUS WORDS
say() {
    echo "$1: $3"
    [ "$2" -eq 0 ] || failed=1
}

# Frama-C with the headers of the unit's controller, the table of which make has written to build/prove.
run() { # UNIT OPTION...
    local unit=$1 name=${1#*_} folder
    shift
    folder=$(sed -n 's/.*controller: \([a-z]*\).*/\1/p' "tests/prove/$unit.c")
    frama-c -machdep x86_16 -kernel-warn-key annot:missing-spec=abort -cpp-extra-args="-Itests/prove -I$out/${folder:-$name} -Ifirmware -Ifirmware/lib -Ifirmware/frames -Ifirmware/mcu \
        -Ifirmware/${folder:-$name} -DFAULT_PCT=60 -DCLK_HZ=12000000UL -I$(frama-c -print-share-path)/libc" "$@" "tests/prove/$unit.c" >"$out/$unit.log" 2>&1
}

by_wp() { # UNIT
    local unit=$1 label words goals proved functions
    # A unit that says "functions: NAMES" is proved for these functions only.
    functions=$(sed -n 's/.*functions: \([a-z0-9_,]*\).*/\1/p' "tests/prove/$unit.c")
    if ! run "$unit" -wp ${functions:+"-wp-fct=$functions"} -wp-rte -wp-prop=-@tried,-tried -wp-prover z3,cvc4 -wp-timeout "${TIMEOUT:-60}" -wp-par 2; then
        say "$unit" 1 "frama-c failed; see $out/$unit.log"
        return
    fi
    read -r proved goals < <(sed -n 's/.*Proved goals: *\([0-9]*\) *\/ *\([0-9]*\).*/\1 \2/p' "$out/$unit.log" | tail -n 1)
    [ "${goals:-0}" -gt 0 ] && [ "$proved" -eq "$goals" ]
    say "$unit" $? "${proved:-0} of ${goals:-0} goals proved$([ "${proved:-0}" = "${goals:-0}" ] || grep -oE 'Goal [a-zA-Z0-9_]+' <(grep -E '\[(Failed|Timeout|Unknown|Stepout)\]' "$out/$unit.log") | sed 's/Goal typed_/ OPEN: /' | tr '\n' ',')"
    while IFS=: read -r label words; do
        if grep -qE "Goal typed_[a-z0-9_]*$label" "$out/$unit.log" &&
            ! grep -E "\[(Failed|Timeout|Unknown|Stepout)\] Goal typed_[a-z0-9_]*$label" "$out/$unit.log" >/dev/null; then
            say "  theorem $label" 0 "proved:$words"
        else
            say "  theorem $label" 1 "OPEN:$words"
        fi
    done < <(sed -n 's/^ *\*\{0,1\} *theorem \([A-Za-z0-9_]*\):\(.*\)/\1:\2/p' "tests/prove/$unit.c")
}

by_eva() { # UNIT
    local unit=$1 alarms open
    if ! run "$unit" -eva -eva-precision 2 -main main; then
        say "$unit" 1 "frama-c failed; see $out/$unit.log"
        return
    fi
    alarms=$(sed -n 's/^ *\([0-9]*\|No\) alarms\{0,1\} generated.*/\1/p' "$out/$unit.log")
    open=$(grep -cE 'tests/prove/.*(assertion|check).*got status (unknown|invalid)' "$out/$unit.log")
    [ "$open" -eq 0 ] && [ "${alarms:-none}" = 0 ]
    say "$unit" $? "${alarms:-no result, not 0} alarms, $open open assertions, from start and for ever"
}

units=(tests/prove/tried.c tests/prove/wp_*.c tests/prove/eva_*.c)
[ $# -gt 0 ] || set -- "${units[@]}"
for unit in "$@"; do
    unit=$(basename -s .c "$unit")
    case $unit in
    wp_*) by_wp "$unit" ;;
    eva_*) by_eva "$unit" ;;
    tried)
        "$out/tried" || failed=1
        ;;
    *)
        echo "prove.sh: error: no unit '$unit'; the units are the C files of tests/prove" >&2
        exit 2
        ;;
    esac
done
exit $failed
