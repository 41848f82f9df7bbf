#!/bin/bash
# SPDX-License-Identifier: MIT
# Proves the firmware with Frama-C, `make prove`:
#     tests/prove/prove.sh [UNIT...]        names of tests/prove/UNIT.c without .c; none: all of them
# The kinds of unit:
#     wp_NAME     WP proves that each function keeps its contract, and that no step of it is undefined in C; the latter
#                 not where the unit says "defined: by UNIT", which proves that already
#     eva_NAME    Eva analyses from start, for ever, whatever the machine delivers: no step is undefined
#     tried_NAME  the program tries all values
#     sizes       SDCC and Frama-C agree on the machine
# Prints a line for each unit and for each theorem of it, that is a clause whose label its first comment explains as
# "theorem LABEL: words". Exits with 1 if anything is open.
#
# For test_prove.sh: FUNCTIONS are the only ones of the unit to prove, PROVERS the programs that may, and TIMEOUT the
# time that each has for one goal, in seconds.
set -u
cd "$(dirname "$0")/../.." || exit 2
out=build/prove
mkdir -p "$out"
why3 config list-provers 2>/dev/null | grep -q Z3 || why3 config detect >"$out/why3.log" 2>&1

# The unit's text, and that of the unit that it includes: wp_brake_far.c is wp_brake.c with another sensor.
text_of() { # UNIT
    cat "tests/prove/$1.c"
    sed -nE 's;^#include "((wp|eva|tried)_.*\.c)";tests/prove/\1;p' "tests/prove/$1.c" | xargs -r cat
}

# What a line of the unit's first comment says, such as "controller: brake".
said() { # UNIT KEY
    text_of "$1" | sed -n "s/^[/ ]\\*\\{1,2\\} $2: \\(.*\\)/\\1/p" | sed 's: *\*/$::' | head -n 1
}

# The headers of the unit's controller and its table, which make has written to build/prove. A unit says
# "controller: NAME" and "table: NAME" if they are not what its own name says.
flags() { # UNIT
    local controller table
    controller=$(said "$1" controller)
    controller=${controller:-${1#*_}}
    table=$(said "$1" table)
    [[ $1 != eva_* ]] || printf "%s " "-I$out/plain"
    echo "-Itests/prove -I$out/${table:-$controller} -Ifirmware -Ifirmware/lib -Ifirmware/frames -Ifirmware/mcu" \
        "-Ifirmware/$controller -DFAULT_PCT=60 -DCLK_HZ=12000000UL"
}

# Frama-C. A function without contract and without code would be taken for one that does nothing.
run() { # UNIT OPTION...
    local unit=$1
    shift
    frama-c -load-module "$out/mcs51.cmxs" -machdep mcs51 -kernel-warn-key annot:missing-spec=abort \
        -cpp-extra-args="-D__FC_MACHDEP_X86_16 $(flags "$unit") -I$(frama-c -print-share-path)/libc" \
        "$@" >"$out/$unit.log" 2>&1
}

# The functions that have their code in the unit's files: a line "FILE LINE NAME" for each. By the host's compiler.
functions_of() { # UNIT
    mkdir -p "$out/host"
    : >"$out/host/__fc_builtin.h" # Frama-C's own functions, which the host does not need
    # shellcheck disable=SC2046  # the flags are words
    gcc -fsyntax-only -w -aux-info "$out/$1.aux" $(flags "$1") -idirafter "$out/host" "tests/prove/$1.c" &&
        sed -nE 's;^/\* ([^:]*):([0-9]*):NF \*/ [^(]*[ *]([a-z_0-9]+) \(.*;\1 \2 \3;p' "$out/$1.aux"
}

# Those that the unit proves: of the files that it says in a line "proves: FILE...", or of all that it includes;
# with the headers of the same names.
proved_by() { # UNIT
    functions_of "$1" | awk -v files="$(said "$1" proves)" '
        function stem(path) { sub(/.*\//, "", path); sub(/\.[ch]$/, "", path); return path }
        BEGIN { count = split(files, list, " "); for (i = 1; i <= count; i++) wanted[stem(list[i])] }
        files == "" && $1 ~ /\.c$/ { wanted[stem($1)] }
        { from[$3] = stem($1) }
        END { for (name in from) if (from[name] in wanted) print name }' | sort | paste -sd,
}

# The goals of a log that no prover could prove. WP says the outcome before the goal, or behind it if there is one prover.
open_goals() { # LOG
    sed -nE -e 's/^\[wp\] \[(Failed|Timeout|Unknown|Stepout)\] Goal typed_([a-zA-Z0-9_]+).*/\2/p' \
        -e 's/^\[wp\] \[[^]]+\] Goal typed_([a-zA-Z0-9_]+) : (Failed|Timeout|Unknown|Stepout).*/\1/p' "$1" | sort -u
}

# WP's simplifications `pruning` and `ground` take longer than what the provers then save, but for a unit that says
# "simplify: ..." with one of these words or both.
by_wp() { # UNIT
    local unit=$1 label words goals proved simplification status=0 log=$out/$1.log rte=() simplify=()
    [ -n "$(said "$unit" defined)" ] || rte=(-wp-rte)
    for simplification in pruning ground; do
        [[ $(said "$unit" simplify) == *$simplification* ]] || simplify+=("-wp-no-$simplification")
    done
    if ! run "$unit" "tests/prove/$unit.c" -wp-prover "${PROVERS:-z3,cvc4}" -wp-par 1 -wp-cache update -wp-cache-dir "${CACHE:-$out/cache}" \
        "${simplify[@]}" -wp -wp-fct="${FUNCTIONS:-$(proved_by "$unit")}" "${rte[@]}" -wp-prop="-@tried,-tried" -wp-timeout "${TIMEOUT:-60}" \
        -then -no-wp -report-csv "$out/$unit.csv"; then
        echo "$unit: frama-c failed; see $log"
        return 2
    fi
    read -r proved goals < <(sed -n 's/.*Proved goals: *\([0-9]*\) *\/ *\([0-9]*\).*/\1 \2/p' "$log")
    [ "${goals:-0}" -gt 0 ] && [ "$proved" -eq "$goals" ] && [ -z "$(open_goals "$log")" ] || status=1
    echo "$unit: ${proved:-0} of ${goals:-0} goals proved$(open_goals "$log" | sed 's/^/, OPEN: /' | tr -d '\n')"
    [ -z "${FUNCTIONS:-}" ] || return $status
    while IFS=: read -r label words; do
        if grep -qE "Goal typed_[a-z0-9_]*$label" "$log" && ! open_goals "$log" | grep -q "$label"; then
            echo "  theorem $label: proved:$words"
        else
            echo "  theorem $label: OPEN:$words"
            status=1
        fi
    done < <(text_of "$unit" | sed -n 's/^ *\*\{0,1\} *theorem \([A-Za-z0-9_]*\):\(.*\)/\1:\2/p')
    return $status
}

by_eva() { # UNIT
    local unit=$1 alarms open
    mkdir -p "$out/plain"
    # Without its contracts: they tie variables to each other, which Eva keeps apart, so it would take what holds for
    # impossible and look no further.
    sed 's;/\*@;/* ;' firmware/frames/frame.c >"$out/plain/$unit.c" && mv "$out/plain/$unit.c" "$out/plain/frame.c"
    if ! run "$unit" "tests/prove/$unit.c" -eva -eva-precision 2 -main main; then
        echo "$unit: frama-c failed; see $out/$unit.log"
        return 2
    fi
    alarms=$(sed -n 's/^ *\([0-9]*\|No\) alarms\{0,1\} generated.*/\1/p' "$out/$unit.log")
    open=$(grep -cE 'tests/prove/.*(assertion|check).*got status (unknown|invalid)' "$out/$unit.log")
    echo "$unit: ${alarms:-no result, not 0} alarms, $open open assertions, from start and for ever"
    [ "$open" -eq 0 ] && [ "${alarms:-none}" = 0 ]
}

# SDCC and Frama-C take sizes.c: it is an error for whoever disagrees with a line.
by_both() {
    if ! { sdcc -mmcs51 --std-c11 -Ifirmware/lib -c tests/prove/sizes.c -o "$out/sizes.rel" >"$out/sizes.log" 2>&1 &&
        run sizes tests/prove/sizes.c; }; then
        echo "sizes: SDCC and mcs51.ml do not agree; see $out/sizes.log"
        return 1
    fi
    echo "sizes: SDCC and mcs51.ml agree on each size and conversion"
}

# With "sanitized: yes" it also ends at the first index that is not in its array.
by_trying() { # UNIT
    local sanitizers=''
    [ -z "$(said "$1" sanitized)" ] || sanitizers='-fsanitize=address,undefined -fno-sanitize-recover=all'
    # shellcheck disable=SC2046,SC2086  # the flags are words
    gcc -O3 -std=c11 -Wall -Wextra -Werror $sanitizers $(flags "$1") "tests/prove/$1.c" -lm -o "$out/$1" && "$out/$1"
}

if [ $# -eq 1 ]; then
    [ -f "tests/prove/$1.c" ] || {
        echo "prove.sh: error: no unit '$1'; the units are the C files of tests/prove" >&2
        exit 2
    }
    case $1 in
    wp_*) by_wp "$1" ;;
    eva_*) by_eva "$1" ;;
    tried_*) by_trying "$1" ;;
    sizes) by_both ;;
    esac
    exit
fi

# After all units: each function of the firmware, but for mcu and main.c, has a contract that WP has proved, or stands in
# without.txt with the reason.
by_contract() {
    local unit status=0
    # Partially proven: a clause `tried` is among its reasons. tried_*.c have functions that no unit of WP has.
    for unit in tests/prove/wp_*.c tests/prove/tried_*.c; do
        unit=$(basename -s .c "$unit")
        functions_of "$unit" | awk -F '[ \t]' -v csv="$out/$unit.csv" '
            BEGIN { while ((getline line < csv) > 0) { split(line, at, "\t"); if (at[5] == "assigns clause" && at[6] ~ /^(Valid|Partially proven)$/) proved[at[4]] } }
            { print ($3 in proved ? "proved" : "open"), $1, $3 }'
    done | grep '^[a-z]* firmware/' | grep -v '/mcu/\|/main\.c' | sort -u >"$out/contracts"
    {
        for file in firmware/*/*.c; do
            grep -q " $file " "$out/contracts" || echo "open $file -"
        done | grep -v 'firmware/\(mcu\|bringup\|examples\)/\|/main\.c'
        cat "$out/contracts"
    } | awk -v reasons=tests/prove/without.txt '
        BEGIN { while ((getline line < reasons) > 0) if (line !~ /^#/) { split(line, at, " "); reason[at[1] " " at[2]] = 1 } }
        $1 == "proved" { proved[$2 " " $3] }
        $1 == "open" { open[$2 " " $3] }
        END {
            for (name in proved) if (name in reason) { print "contracts: " name ": is proved; take it out of " reasons; bad = 1 }
            for (name in open) if (!(name in proved)) {
                if (name in reason) { without++; delete reason[name] } else { print "contracts: " name ": no contract that WP has proved: give it one, or say why not in " reasons; bad = 1 }
            }
            for (name in reason) if (!(name in proved)) { print "contracts: " name ": stands in " reasons ", but there is no such function without contract"; bad = 1 }
            print "contracts: " length(proved) " functions have one that is proved, " without + 0 " stand in " reasons
            exit bad
        }' || status=1
    return $status
}

# After all units: Eva came to each function of the firmware that is in its units, in one of them at least, or it stands in
# unreached.txt with the reason. An analysis that comes to nothing finds nothing.
by_reach() {
    local unit
    for unit in tests/prove/eva_*.c; do
        unit=$(basename -s .c "$unit")
        functions_of "$unit" | awk '$1 ~ /^firmware\// { print "in", $3 }'
        sed -n 's/.*Values at end of function \([A-Za-z0-9_]*\):.*/reached \1/p' "$out/$unit.log"
    done | awk -v reasons=tests/prove/unreached.txt '
        BEGIN { while ((getline line < reasons) > 0) if (line !~ /^#/) { split(line, at, " "); reason[at[1]] = 1 } }
        $1 == "in" { all[$2] }
        $1 == "reached" { reached[$2] }
        END {
            for (name in all) {
                if (name in reached) { count++ } else if (!(name in reason)) { print "reach: Eva comes to " name " in no unit: give it a unit, or say why not in " reasons; bad = 1 }
            }
            for (name in reason) if (name in reached || !(name in all)) { print "reach: " name ": take it out of " reasons; bad = 1 }
            print "reach: Eva came to " count + 0 " functions; " length(reason) " stand in " reasons
            exit bad || !count
        }'
}

# All that are asked for, two at a time; first those that say "long: yes", so that none of them is left over at the end.
all=("$@")
[ $# -gt 0 ] || all=(tests/prove/*_*.c tests/prove/sizes.c)
for unit in "${all[@]}"; do
    unit=$(basename -s .c "$unit")
    echo "$unit $(said "$unit" long)"
done | sort -s -r -k 2 | sed 's/ .*//' >"$out/units"
# shellcheck disable=SC2016  # the inner shell expands it
xargs -P 2 -I UNIT bash -c '"$0" "$1" >"$2/$1.txt" 2>&1; status=$?; cat "$2/$1.txt"; [ $status -eq 0 ]' "$PWD/tests/prove/prove.sh" UNIT "$out" <"$out/units" || status=1
[ $# -gt 0 ] || by_contract || status=1
[ $# -gt 0 ] || by_reach || status=1
exit "${status:-0}"
