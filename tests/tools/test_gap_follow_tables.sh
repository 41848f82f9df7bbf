#!/bin/bash
# The systems of gap and follow, as fistab evaluates them, against Octave's answers in tests/golden.
cd "$(dirname "$0")/../.." || exit 2
failed=0

# SYSTEM INPUTS: lines of "inputs,outputs" on stdin; the answers may differ by rounding.
compare() { # LINE NAME SYSTEM INPUTS
    local lines wrong
    lines=$(cat)
    wrong=$(paste -d ' ' <(echo "$lines" | tr , ' ') \
        <(echo "$lines" | cut -d, -f"1-$4" | tr , ' ' | build/fistab eval "tables/$3.fis" 2>/dev/null) |
        awk -v inputs="$4" -v delta=1e-9 '{
            outputs = (NF - inputs) / 2
            for (o = 1; o <= outputs; o++) {
                off = $(inputs + o) - $(inputs + outputs + o)
                if (outputs != int(outputs) || off > delta || off < -delta) { print; break }
            }
        }' | head -n 3)
    if [ -z "$wrong" ] && [ "$(echo "$lines" | wc -l)" -gt 200 ]; then
        echo "$0:$1:$2:PASS"
    else
        echo "$0:$1:$2:FAIL: inputs, Octave, fistab: $(echo "$wrong" | tr '\n' ';')"
        failed=1
    fi
}

compare $LINENO "gap equals Octave's" gap 2 < <(grep -v '^#' tests/golden/gap_octave.csv)
for system in follow follow_paper; do
    compare $LINENO "$system equals Octave's" $system 3 \
        < <(grep "^$system," tests/golden/follow_octave.csv | cut -d, -f2-)
done
exit $failed
