#!/bin/bash
# SPDX-License-Identifier: MIT
# Shows that the proofs can fail, `make test-prove`: seeds each fault of faults.txt into a copy of the firmware and
# proves the functions that it names. They must be proved without the fault, and not with it. Prints a line for
# each fault, then "N passed, N failed".
set -u
cd "$(dirname "$0")/../.." || exit 2
top=$PWD/build/prove/faults
# What is proved without a fault is kept; a fault changes few of these goals, and z3 takes less than a second for each
# that can still be proved.
export CACHE=$PWD/build/prove/cache

# A copy of the sources, with the tables that make has written.
copy() { # NAME
    mkdir -p "$top/$1/tests" "$top/$1/build/prove"
    cp -r firmware "$top/$1/"
    cp -r tests/prove "$top/$1/tests/"
    cp build/prove/mcs51.cmxs "$top/$1/build/prove/"
    for table in build/prove/*/lut_table.h; do
        mkdir -p "$top/$1/$(dirname "$table")"
        cp "$table" "$top/$1/$table"
    done
}

# What prove.sh says of these functions: 0 proved, 1 not proved, 2 not read.
prove() { # NAME UNIT FUNCTIONS
    FUNCTIONS=$3 "$top/$1/tests/prove/prove.sh" "$2" >"$top/$1/said" 2>&1
}

# Without a fault: all that a unit's faults name, in one go.
sound() { # UNIT
    local unit=$1 functions
    functions=$(awk -v unit="$unit" '!/^#/ && $2 == unit { print $3 }' tests/prove/faults.txt | sort -u | paste -sd,)
    copy "sound_$unit"
    prove "sound_$unit" "$unit" "$functions" && echo "without a fault: $(cat "$top/sound_$unit/said"):PASS" ||
        echo "without a fault: $(cat "$top/sound_$unit/said"):FAIL"
}

faulty() { # LINE
    local line=$1 theorem unit functions file command name changed
    read -r theorem unit functions file command < <(sed -n "${line}p" tests/prove/faults.txt)
    name=fault_$line
    copy "$name"
    sed -i -E "$command" "$top/$name/$file"
    changed=$(diff "$file" "$top/$name/$file" | grep -c '^[<>]')
    if [ "$changed" -lt 1 ] || [ "$(diff "$file" "$top/$name/$file" | grep -c '^[0-9]')" -ne 1 ]; then
        echo "tests/prove/faults.txt:$line: the command must change one line of $file, but changes $changed:FAIL"
        return
    fi
    TIMEOUT=2 PROVERS=z3 prove "$name" "$unit" "$functions"
    case $? in
    0) echo "tests/prove/faults.txt:$line: $theorem: $functions is still proved with this fault: $command:FAIL" ;;
    1) echo "$theorem falls: $(cat "$top/$name/said"):PASS" ;;
    *) echo "tests/prove/faults.txt:$line: $(cat "$top/$name/said"):FAIL" ;;
    esac
}

export -f copy prove sound faulty
export top
rm -rf "$top"
mkdir -p "$top"
{
    awk '!/^#/ { print "sound " $2 }' tests/prove/faults.txt | sort -u
    awk '!/^#/ { print "faulty " NR }' tests/prove/faults.txt
} | xargs -P 2 -I CALL bash -c CALL | tee "$top/said"
failed=$(grep -c ':FAIL$' "$top/said")
echo "$(grep -c ':PASS$' "$top/said") passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$(grep -c ':PASS$' "$top/said")" -gt 0 ]
