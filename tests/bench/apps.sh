#!/bin/bash
# What each controller takes on each board that holds it: machine cycles of a control step, flash, RAM.
#     tests/bench/apps.sh            after `make`; builds the images that time the steps
# The images run in s51 with the modules and the memory model that ship; a controller without a
# tests/bench/APP.c is listed without cycles. Cycles are those of the step itself, from the payload to
# the decision; the brake's own bench says more of it.
set -eu
cd "$(dirname "$0")/../.."

# Least and most cycles of APP's step on BOARD; "- -" where nothing times it.
cycles() { # BOARD APP
    local image=build/$1/bench/$2.ihx log=build/$1/bench/$2.log line
    [ -e "tests/bench/$2.c" ] || {
        echo "- -"
        return
    }
    make BOARD="$1" "$image" >&2
    # s51 leaves early when its input is closed, and always with 0: only the image's own "end" counts.
    coproc open_pipe { exec sleep 65; }
    timeout -k 1 60 s51 -t C52 -q -b -R 1 -G -I "if=xram[0xffff]" "$image" <&"${open_pipe[0]}" >"$log" 2>&1 || true
    kill "$open_pipe_PID" 2>/dev/null
    wait "$open_pipe_PID" 2>/dev/null || true
    line=$(grep -aE '^[0-9]+ [0-9]+ [0-9]+ end$' "$log") || {
        echo "apps.sh: error: $image did not come to its end in s51; see $log" >&2
        exit 1
    }
    set -- $line
    [ "$3" -eq 0 ] || {
        echo "apps.sh: error: $image refused $3 of its own payloads" >&2
        exit 1
    }
    echo "$1 $2"
}

printf '%-12s %-13s %11s %11s %7s %5s %6s\n' board controller 'step, least' 'most cycles' flash RAM stack
for fragment in firmware/boards/*.mk; do
    board=$(basename "$fragment" .mk)
    for app in $(awk '$1 == "APPS" { for (i = 3; i <= NF; i++) print $i }' "$fragment"); do
        # memory.sh's line: code N of M bytes, RAM N of M bytes, which leaves N for the stack
        read -r flash ram stack < <(tools/memory.sh "$board" "$app" | sed -E \
            's/.* code +([0-9]+) .* RAM +([0-9]+) .* leaves +([0-9]+) .*/\1 \2 \3/')
        read -r least most < <(cycles "$board" "$app")
        printf '%-12s %-13s %11s %11s %7s %5s %6s\n' "$board" "$app" "$least" "$most" "$flash" "$ram" "$stack"
    done
done
