#!/bin/bash
# SPDX-License-Identifier: MIT
# Proves the firmware with Frama-C, `make prove`:
#     tests/prove/prove.sh [UNIT...]        names of tests/prove/UNIT.c without .c; none: all of them
# A unit wp_NAME.c is proved by WP: each function keeps its contract, and no step of it is undefined in C. A unit
# eva_NAME.c is analysed by Eva: from start, for ever, whatever the machine delivers, no step is undefined. tried.c
# tries all values. Prints a line for each unit and for each theorem of it, that is a clause whose label its
# first comment explains as "theorem LABEL: words". Exits with 1 if anything is open.
# int has 16 bits, as with SDCC for the 8051.
#
# For test_prove.sh: FUNCTIONS are the only ones of the unit to prove. TIMEOUT is the time that a prover has for one
# goal, in seconds.
set -u
cd "$(dirname "$0")/../.." || exit 2
out=build/prove
mkdir -p "$out"
why3 config list-provers 2>/dev/null | grep -q Z3 || why3 config detect >"$out/why3.log" 2>&1

# Frama-C with the headers of the unit's controller and its table, which make has written to build/prove. A unit
# says "controller: NAME" and "table: NAME" if they are not what its own name says.
run() { # UNIT OPTION...
    local unit=$1 folder table
    shift
    folder=$(sed -n 's/^[/ ]\*\{1,2\} controller: \([a-z]*\).*/\1/p' "tests/prove/$unit.c")
    folder=${folder:-${unit#*_}}
    table=$(sed -n 's/^[/ ]\*\{1,2\} table: \([a-z]*\).*/\1/p' "tests/prove/$unit.c")
    # A function without contract and without code would be taken for one that does nothing.
    frama-c -machdep x86_16 -kernel-warn-key annot:missing-spec=abort -cpp-extra-args="-Itests/prove -I$out/${table:-$folder} -Ifirmware -Ifirmware/lib \
        -Ifirmware/frames -Ifirmware/mcu -Ifirmware/$folder -DFAULT_PCT=60 -DCLK_HZ=12000000UL -I$(frama-c -print-share-path)/libc" \
        "$@" "tests/prove/$unit.c" >"$out/$unit.log" 2>&1
}

# The goals of a log that no prover could prove.
open_goals() { # LOG
    sed -nE 's/^\[wp\] \[(Failed|Timeout|Unknown|Stepout)\] Goal typed_([a-zA-Z0-9_]+).*/\2/p' "$1"
}

by_wp() { # UNIT
    local unit=$1 label words goals proved functions status=0
    # A unit that says "functions: NAMES" is proved for these functions only.
    functions=${FUNCTIONS:-$(sed -n 's/^[/ ]\*\{1,2\} functions: \([a-z0-9_,]*\).*/\1/p' "tests/prove/$unit.c")}
    if ! run "$unit" -wp ${functions:+"-wp-fct=$functions"} -wp-rte -wp-prop=-@tried,-tried -wp-prover z3,cvc4 -wp-timeout "${TIMEOUT:-60}" -wp-par 1; then
        echo "$unit: frama-c failed; see $out/$unit.log"
        return 2
    fi
    read -r proved goals < <(sed -n 's/.*Proved goals: *\([0-9]*\) *\/ *\([0-9]*\).*/\1 \2/p' "$out/$unit.log" | tail -n 1)
    [ "${goals:-0}" -gt 0 ] && [ "$proved" -eq "$goals" ] || status=1
    echo "$unit: ${proved:-0} of ${goals:-0} goals proved$(open_goals "$out/$unit.log" | sed 's/^/, OPEN: /' | tr -d '\n')"
    [ -z "${FUNCTIONS:-}" ] || return $status
    while IFS=: read -r label words; do
        if grep -qE "Goal typed_[a-z0-9_]*$label" "$out/$unit.log" && ! open_goals "$out/$unit.log" | grep -q "$label"; then
            echo "  theorem $label: proved:$words"
        else
            echo "  theorem $label: OPEN:$words"
            status=1
        fi
    done < <(sed -n 's/^ *\*\{0,1\} *theorem \([A-Za-z0-9_]*\):\(.*\)/\1:\2/p' "tests/prove/$unit.c")
    return $status
}

by_eva() { # UNIT
    local unit=$1 alarms open
    if ! run "$unit" -eva -eva-precision 2 -main main; then
        echo "$unit: frama-c failed; see $out/$unit.log"
        return 2
    fi
    alarms=$(sed -n 's/^ *\([0-9]*\|No\) alarms\{0,1\} generated.*/\1/p' "$out/$unit.log")
    open=$(grep -cE 'tests/prove/.*(assertion|check).*got status (unknown|invalid)' "$out/$unit.log")
    echo "$unit: ${alarms:-no result, not 0} alarms, $open open assertions, from start and for ever"
    [ "$open" -eq 0 ] && [ "${alarms:-none}" = 0 ]
}

if [ $# -eq 1 ]; then
    case $1 in
    wp_*) by_wp "$1" ;;
    eva_*) by_eva "$1" ;;
    tried) "$out/tried" ;;
    esac
    exit
fi

# All that are asked for, two at a time.
[ $# -gt 0 ] || mapfile -t all < <(find tests/prove -name 'wp_*.c' -o -name 'eva_*.c' -o -name 'tried.c' | sort -r)
for unit in "${@:-${all[@]}}"; do
    unit=$(basename -s .c "$unit")
    [ -f "tests/prove/$unit.c" ] || {
        echo "prove.sh: error: no unit '$unit'; the units are the C files of tests/prove" >&2
        exit 2
    }
    echo "$unit"
done >"$out/units"
# shellcheck disable=SC2016  # the inner shell expands it
xargs -P 2 -I UNIT bash -c '"$0" "$1" >"$2/$1.txt" 2>&1; status=$?; cat "$2/$1.txt"; [ $status -eq 0 ]' "$PWD/tests/prove/prove.sh" UNIT "$out" <"$out/units" || exit 1
