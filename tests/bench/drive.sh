#!/bin/bash
# SPDX-License-Identifier: MIT
# How fast drive is: against s51 that runs free with the same image, and two runs on two processors
# against one after the other.
#     tests/bench/drive.sh [BOARD]         after `make`; BOARD: stc89c516rd
# The sensor is off in both, because a free s51 has none: the controller does the same work, in FAULT.
# Speeds are simulated seconds a second of processor time, so that other work on the machine counts
# little; the best of four, by turns. The second figure is wall time and needs two idle processors.
set -eu
cd "$(dirname "$0")/../.."
board=${1:-stc89c516rd}
image=build/$board/brake.ihx
out=build/bench/drive
mkdir -p "$out"
read -r clk_hz type < <(sed -n "s/^BOARD($board, \([0-9]*\), \"\([^\"]*\)\".*/\1 \2/p" build/boards.h)

cat >"$out/off.scn" <<'END'
[scenario]
title = The sensor is off
duration_s = 12
[ego]
speed_mps = 0
[fault]
kind = off
from_s = 0
[expect]
impact = none
END

TIMEFORMAT='%R %U %S'

# Seconds simulated by a free s51, and processor seconds.
free_run() {
    rm -f "$out/console"
    mkfifo "$out/console"
    exec 3<>"$out/console" # s51 leaves early when its input is closed
    printf 'step 8000000\nquit\n' >&3
    { time tools/s51 -t "$type" -X "$clk_hz" -R 1 -S "uart=0,out=$out/uart" -e 'set bit pin3.2 0' "$image" \
        <"$out/console" >"$out/free.log" 2>/dev/null; } 2>"$out/time"
    exec 3>&-
    awk -v hz="$clk_hz" 'NR == FNR { cpu = $2 + $3; next } { print $2 / hz, cpu }' \
        "$out/time" <(grep -ao 'Simulated [0-9]* ticks' "$out/free.log")
}

drive_run() {
    { time build/drive run --hex "$image" --board "$board" --scenario "$out/off.scn" --stats \
        >"$out/drive.log"; } 2>"$out/time"
    awk 'NR == FNR { cpu = $2 + $3; next } / s simulated in / { print $1, cpu }' "$out/time" "$out/drive.log"
}

best() { # the larger of the speeds $1 and simulated $2 in $3 seconds
    awk -v best="$1" -v s="$2" -v cpu="$3" 'BEGIN { v = s / cpu; print (v > best ? v : best) }'
}

free=0 drive=0
for _ in 1 2 3 4; do
    read -r simulated cpu < <(free_run)
    free=$(best "$free" "$simulated" "$cpu")
    read -r simulated cpu < <(drive_run)
    drive=$(best "$drive" "$simulated" "$cpu")
done
awk -v free="$free" -v drive="$drive" 'BEGIN {
    printf "s51 free %.2f, under drive %.2f simulated seconds a second: %.0f %% (goal: 90)\n", free, drive, 100 * drive / free }'

now() {
    date +%s.%N
}
gain=0
for _ in 1 2 3; do
    t0=$(now)
    drive_run >/dev/null
    drive_run >/dev/null
    t1=$(now)
    build/drive run --hex "$image" --board "$board" --scenario "$out/off.scn" >/dev/null &
    build/drive run --hex "$image" --board "$board" --scenario "$out/off.scn" >/dev/null
    wait $!
    t2=$(now)
    gain=$(awk -v a="$t0" -v b="$t1" -v c="$t2" -v g="$gain" 'BEGIN { v = (b - a) / (c - b); print (v > g ? v : g) }')
done
printf 'two runs at a time: %.2f times as fast as one after the other (goal: 1.9 on two idle processors; %s here, load %s)\n' \
    "$gain" "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)"
