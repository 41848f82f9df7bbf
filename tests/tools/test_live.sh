#!/bin/bash
# SPDX-License-Identifier: MIT
# --live: a picture in a terminal, whose cursor comes back also after an interrupt; plain lines
# elsewhere; and the same numbers as without it. Each world has its own picture.
. tests/lib.sh
run="build/drive run --hex build/stc89c516rd/brake.ihx --board stc89c516rd --scenario tests/loop/standing_car_3mps.scn"

$run --csv "$out/without.csv" >/dev/null
$run --live --csv "$out/plain.csv" >"$out/plain"
cmp -s "$out/without.csv" "$out/plain.csv"
say "live changes no number" $? "the traces differ"
! grep -q $'\033' "$out/plain" && grep -q 'gap .* m  ego .* m/s  lead .* m/s .* brake .* %  CONTROL' "$out/plain"
say "plain lines where there is no terminal" $? "$(head -n 3 "$out/plain")"

begin=$(date +%s%N)
TERM=xterm script -qec "$run --live --csv $out/terminal.csv" /dev/null >"$out/terminal" </dev/null
took_ms=$((($(date +%s%N) - begin) / 1000000))
cmp -s "$out/without.csv" "$out/terminal.csv"
say "a terminal changes no number" $? "the traces differ"
grep -q $'\033\[?25l' "$out/terminal" && grep -q 'brake' "$out/terminal" &&
    [ "$(grep -ao $'\033\[?25[lh]' "$out/terminal" | tail -n 1)" = $'\033[?25h' ]
say "the cursor goes and comes back" $? "$(grep -ao $'\033\[?25[lh]' "$out/terminal" | od -c | head -n 3)"
end_ms=$(awk -F, 'END { print $1 * 1000 - 50 }' "$out/without.csv")
awk -v took="$took_ms" -v simulated="$end_ms" 'BEGIN { exit took < simulated }'
say "not faster than real time" $? "$took_ms ms for $end_ms ms"

# Interrupted once the picture is there, however long a busy machine takes to it.
for engine in s51 fast; do
    cat >"$out/break.sh" <<END
$run --live --engine=$engine &
for _ in \$(seq 300); do
    grep -q 'brake' $out/broken && break
    sleep 0.1
done
kill -INT \$!
wait \$!
END
    rm -f "$out/broken"
    TERM=xterm timeout 60 script -qfec "bash $out/break.sh" "$out/broken" >/dev/null 2>&1 </dev/null
    [ "$(grep -ao $'\033\[?25[lh]' "$out/broken" | tail -n 1)" = $'\033[?25h' ] && grep -q "interrupted" "$out/broken"
    say "an interrupt gives the cursor back, with $engine" $? "$(tail -n 1 "$out/broken")"
done

picture() { # SCENARIO LINES [option...]: its last picture in a terminal, of that many lines, to $out/picture
    scenario=$1 lines=$2
    shift 2
    TERM=xterm script -qec "build/drive run --board stc89c516rd --scenario tests/loop/$scenario.scn --live $*" /dev/null \
        2>&1 </dev/null | tr -d '\r' | sed $'s/\033\\[K//' >"$out/frames"
    awk -v RS=$'\033\\['"$lines"A 'END { print $0 }' "$out/frames" | head -n "$lines" >"$out/picture"
}

# A yard: the car stands in its place, and the way to there is marked.
picture park/t2_right 21
[ "$(grep -c '\[.\]' "$out/picture")" -ge 2 ] && grep -q '\[|\]' "$out/picture" && grep -q '\[o\]' "$out/picture" &&
    [ "$(tr -cd . <"$out/picture" | wc -c)" -ge 20 ] && sed -n 20p "$out/picture" | grep -q 'y   0.00 m' &&
    sed -n 21p "$out/picture" | grep -q ARRIVED
say "a yard to park in" $? "$(cat "$out/picture")"
# Two lanes: the robot drives in the lower one, and after the change in the upper one.
picture follow/a_lane_free 11 --set scenario.duration_s=4
sed -n 5p "$out/picture" | grep -q '\[##>.*\[##\]' && ! sed -n 3p "$out/picture" | grep -q '\['
say "a robot in its own lane" $? "$(cat "$out/picture")"
picture follow/a_lane_free 11 --set scenario.duration_s=6
sed -n 3p "$out/picture" | grep -q '\[##>' && ! sed -n 5p "$out/picture" | grep -q '\['
say "a robot in the other lane" $? "$(cat "$out/picture")"
# A bend to the left: the far side of the lane is to the left of the near one, with the radar's echo in it.
picture radar/bend_own_lane 23 --set scenario.duration_s=2
awk 'NR == 8 { far = index($0, "|") } NR == 18 { near = index($0, "|"); exit !(far > 0 && near > far + 10) }' "$out/picture" &&
    grep -q '|.*o.*|' "$out/picture"
say "a bend" $? "$(cat "$out/picture")"
# The safe distance: a mark on the road, ahead of the car or behind the one ahead, and a bar.
picture gap/cut_in 10 --set scenario.duration_s=3
sed -n 3p "$out/picture" | grep -q '^\[##>.*|' && grep -q '^ safe |' "$out/picture"
say "a safe distance" $? "$(cat "$out/picture")"

yard="build/drive run --board stc89c516rd --scenario tests/loop/park/t2_right.scn --live"
$yard | grep -q 'x .* m  y .* m  heading .*  steer .*  DRIVING'
say "plain lines of a yard" $? "none"
finish
