#!/bin/bash
# SPDX-License-Identifier: MIT
# The systems of gap and follow, as fistab evaluates them, against Octave's answers in tests/golden.
. tests/lib.sh

# SYSTEM INPUTS: lines of "inputs,outputs" on stdin; the answers may differ by rounding.
compare() { # NAME SYSTEM INPUTS
    local lines wrong
    lines=$(cat)
    wrong=$(paste -d ' ' <(echo "$lines" | tr , ' ') \
        <(echo "$lines" | cut -d, -f"1-$3" | tr , ' ' | build/fistab eval "tables/$2.fis" 2>/dev/null) |
        awk -v inputs="$3" -v delta=1e-9 '{
            outputs = (NF - inputs) / 2
            for (o = 1; o <= outputs; o++) {
                off = $(inputs + o) - $(inputs + outputs + o)
                if (outputs != int(outputs) || off > delta || off < -delta) { print; break }
            }
        }' | head -n 3)
    [ "$(echo "$lines" | wc -l)" -gt 200 ] || wrong="only these lines: $lines"
    faultless "$1" "${wrong:+inputs, Octave, fistab: $wrong}"
}

compare "gap equals Octave's" gap 2 < <(grep -v '^#' tests/golden/gap_octave.csv)
for system in follow follow_paper; do
    compare "$system equals Octave's" $system 3 \
        < <(grep "^$system," tests/golden/follow_octave.csv | cut -d, -f2-)
done
finish
