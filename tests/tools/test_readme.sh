#!/bin/bash
# What README.md shows of the tools' output is what they print, and the scenario that it shows holds.
. tests/lib.sh
cat README.md docs/brake.md docs/bound.md docs/drive.md >"$out/pages"
board=stc89c516rd
drive=(build/drive run --board "$board" --scenario)

shows() { # NAME PATTERN FILE: README.md has lines of that form, and each is a line of FILE
    grep -E -- "$2" "$out/pages" >"$out/shown"
    [ -s "$out/shown" ] && ! grep -vxF -f "$3" "$out/shown" >"$out/untrue"
    say "$1" $? "not so: $(head -n 1 "$out/untrue")"
}
"${drive[@]}" tests/loop/standing_car_3mps.scn --uart "$out/log" >"$out/said"
for character in '?' s; do
    "${drive[@]}" tests/loop/standing_car_3mps.scn --set uart.at_s=0.5 --set "uart.send=$character" --uart "$out/answer" >/dev/null
    cat "$out/answer" >>"$out/log"
done
tr -d '\r' <"$out/log" >"$out/uart"
shows "the demo's sentence" '^Standing car ahead' "$out/said"
shows "what the UART says" '^(# (\?|state|fuzzy51 [0-9])|seq,|[0-9]+,)' "$out/uart"
sed 's/; deepest.*//' "build/$board/brake.bound" >"$out/bound"
sed -n 's/^\(stack: .*\); deepest.*/\1/p' "$out/pages" >"$out/stack"
shows "the bounds" '^(pwm_interrupt|control_step): ' "$out/bound"
grep -qxF -f "$out/stack" "$out/bound" && [ -s "$out/stack" ]
say "the stack's bound" $? "$(cat "$out/stack")"
sed -n '/^\[scenario\]$/,/^```$/{/^```$/d;p}' "$out/pages" >"$out/shown.scn"
"${drive[@]}" "$out/shown.scn" >"$out/said" 2>&1
say "the scenario shown" $? "$(head -n 1 "$out/said")"
finish
