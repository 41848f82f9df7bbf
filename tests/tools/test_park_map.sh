#!/bin/bash
# SPDX-License-Identifier: MIT
# The parking map: how many of the 3,780 starts succeed; the firmware's integers against floating point;
# and a sample of starts in the simulator, which must have the same verdicts.
. tests/lib.sh

make -s build/grid/park.csv build/grid/park_late.csv
read -r starts parked parked_float differ far far_parked worst < <(awk -F, 'NR > 1 {
    n++; p += $4; f += $7; d += $4 != $7
    if ($2 >= 20) { m++; q += $4; x = $5 < 0 ? -$5 : $5; if (x > w) w = x }
} END { print n, p, f, d, m, q, w }' build/grid/park.csv)
[ "$starts" -eq 3780 ] && [ "$parked" -ge 2568 ] && [ "$parked" -le 2588 ]
say "published_blend_parks_68_percent" $? "$parked of $starts"
[ "$differ" -le 18 ]
say "integers_agree_with_floating_point" $? "$differ verdicts differ ($parked_float in floating point)"
[ "$far" -eq 1512 ] && [ "$far_parked" -eq 1512 ] && awk "BEGIN { exit !($worst <= 0.45) }"
say "every_start_from_20_m_parks" $? "$far_parked of $far, at worst $worst m beside"
late=$(awk -F, 'NR > 1 { p += $4 } END { print p }' build/grid/park_late.csv)
[ "$late" -gt "$parked" ]
say "later_blend_parks_more_often" $? "$late against $parked"

# Random starts: whoever is not told that the start is in the dead zone parks; few are told for nothing.
build/grid/park/run 20000 >"$out/random.csv"
read -r starts passed stray refused vain < <(awk -F, 'NR > 1 { n++
    if ($4) { r++; v += $5 == "parked" } else { p++; s += $5 != "parked" } } END { print n, p, s, r, v }' "$out/random.csv")
[ "$starts" -eq 20000 ] && [ "$stray" -eq 0 ]
say "every_random_start_that_passes_the_check_parks" $? "$stray of $passed do not"
[ $((vain * 15)) -lt "$refused" ] && [ "$passed" -gt 16000 ]
say "few_starts_are_refused_in_vain" $? "$vain of $refused would have parked, $passed pass"
build/grid/park/run many >"$out/log" 2>&1
[ $? = 2 ] && grep -q 'give the number of random starts' "$out/log"
say "a_bad_number_is_refused" $? "$(cat "$out/log")"

# Every 157th start, judged as the study does; those that end within 5 cm or half a degree of the limits could go either way.
image=build/stc89c516rd/park_paper.ihx
[ -e "$image" ] || make -s BOARD=stc89c516rd firmware >/dev/null
while IFS=, read -r x y heading verdict end_x end_turn _; do
    wanted=$([ "$verdict" = 1 ] && echo yes || echo no)
    build/drive run --board=stc89c516rd --scenario=tests/loop/park/t1_demo.scn --hex=$image --set park.x_m="$x" \
        --set park.y_m="$y" --set park.heading_deg="$heading" --json "$out/run.json" >"$out/log" 2>&1
    got=$(jq -r '.outcome | if .end_x_m != null and (.end_x_m | fabs) < 0.4 and (.end_turn_deg | fabs) < 2 then "yes" else "no" end' "$out/run.json")
    [ "$got" = "$wanted" ]
    say "s51_agrees_at_${x}_${y}_${heading}" $? "s51 says '$got', the map '$wanted' ($end_x m, $end_turn degrees)"
done < <(awk -F, 'NR > 1 { x = $5 < 0 ? -$5 : $5; t = $6 < 0 ? -$6 : $6; border = (x > 0.35 && x < 0.45 && t < 2.5) || (t > 1.5 && t < 2.5 && x < 0.45)
    if (NR % 157 == 40 && !border) print }' build/grid/park.csv)
finish
