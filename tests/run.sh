#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs test suites, twice as many at a time as there are cores, because some wait, and adds up what they
# print.
#     tests/run.sh COMMAND...         each COMMAND is one suite, a shell command line
# A suite prints one line a case, PLACE:LINE:NAME:PASS or PLACE:LINE:NAME:FAIL: why, and exits
# non-zero if any failed. A case that cannot run here prints IGNORE and the reason, which is shown. A
# suite that fails without naming a case, or prints no case, counts as one failure. Beside each suite stands
# the processor time that it took, in seconds. At the end come the failed cases once more, and "N passed, N
# failed".
set -u

run_suite() {
    local suite=$1 log status good bad skipped seconds cpu TIMEFORMAT='%U %S'
    log=$(mktemp)
    # stdin is an empty file: a suite never waits for a terminal.
    cpu=$({ time bash -c "$suite" >"$log" 2>&1 </dev/null; } 2>&1)
    status=$?
    read -r good bad skipped seconds < <(awk -v cpu="$cpu" '
        /^[^ ].*:[0-9]+:.*:PASS$/ { good++ }
        /^[^ ].*:[0-9]+:.*:FAIL/ { bad++ }
        /^[^ ].*:[0-9]+:.*:IGNORE/ { skipped++ }
        END { n = split(cpu, part, " "); printf "%d %d %d %.1f\n", good, bad, skipped, part[n - 1] + part[n] }' "$log")
    [ "$skipped" -eq 0 ] || grep -aE '^[^ ].*:[0-9]+:.*:IGNORE' "$log"
    if [ "$bad" -eq 0 ] && { [ "$status" -ne 0 ] || [ $((good + skipped)) -eq 0 ]; }; then
        bad=1
        echo "$suite:0:suite:FAIL: exit status $status after $good cases; its last lines:"
        tail -n 40 "$log"
    elif [ "$bad" -ne 0 ]; then
        grep -avE ':PASS$' "$log"
    fi
    printf '%5d passed %3d failed %6.1f s  %s\n' "$good" "$bad" "$seconds" "$suite"
    rm -f "$log"
}
export -f run_suite

all=$(mktemp)
trap 'rm -f "$all"' EXIT
parallel --will-cite --jobs 200% --keep-order --line-buffer run_suite ::: "$@" | tee "$all"
[ "$(grep -cE '^ *[0-9]+ passed +[0-9]+ failed +[0-9.]+ s  ' "$all")" -eq $# ] || {
    echo "run.sh: error: not every suite reported" >&2
    exit 1
}
grep -aE '^[^ ].*:[0-9]+:.*:FAIL' "$all"
awk '/^ *[0-9]+ passed +[0-9]+ failed  / { passed += $1; failed += $3 }
    END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 }' "$all"
