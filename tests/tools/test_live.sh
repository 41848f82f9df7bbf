#!/bin/bash
# SPDX-License-Identifier: MIT
# --live: a picture in a terminal, whose cursor comes back also after an interrupt; plain lines
# elsewhere; and the same numbers as without it. A car that parks has a yard in place of a road.
. tests/lib.sh
run="build/drive run --hex build/stc89c516rd/brake.ihx --board stc89c516rd --scenario tests/loop/standing_car_3mps.scn"

$run --csv "$out/without.csv" >/dev/null
$run --live --csv "$out/plain.csv" >"$out/plain"
cmp -s "$out/without.csv" "$out/plain.csv"
say "live changes no number" $? "the traces differ"
! grep -q $'\033' "$out/plain" && grep -q 'gap .* m  speed .* m/s  brake .* %  CONTROL' "$out/plain"
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
cat >"$out/break.sh" <<END
$run --live &
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
say "an interrupt gives the cursor back" $? "$(tail -n 1 "$out/broken")"

# The yard's last picture: 18 rows, in which the car stands in its place, and the way to there.
yard="build/drive run --board stc89c516rd --scenario tests/loop/park/t2_right.scn --live"
TERM=xterm script -qec "$yard" /dev/null 2>&1 </dev/null | tr -d '\r' | sed $'s/\033\\[K//' >"$out/yard"
awk -v RS=$'\033\\[20A' 'END { print $0 }' "$out/yard" | head -n 20 >"$out/yard_last"
[ "$(grep -c '\[.\]' "$out/yard_last")" -ge 2 ] && grep -q '\[|\]' "$out/yard_last" && grep -q '\[o\]' "$out/yard_last" &&
    [ "$(tr -cd . <"$out/yard_last" | wc -c)" -ge 10 ] && sed -n 20p "$out/yard_last" | grep -q 'y   0.00 m .*ARRIVED'
say "a yard to park in" $? "$(cat "$out/yard_last")"
$yard | grep -q 'x .* m  y .* m  heading .*  steering .*  DRIVING'
say "plain lines of a yard" $? "none"
finish
