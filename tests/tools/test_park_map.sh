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

# Every 157th start; those that end within 5 cm or half a degree of the limits could go either way.
image=build/stc89c516rd/park.ihx
[ -e "$image" ] || make -s BOARD=stc89c516rd firmware >/dev/null
while IFS=, read -r x y heading verdict end_x end_turn _; do
    wanted=$([ "$verdict" = 1 ] && echo yes || echo no)
    build/drive run --board=stc89c516rd --scenario=tests/loop/park/t1_demo.scn --set park.x_m="$x" \
        --set park.y_m="$y" --set park.heading_deg="$heading" >build/tests/park_map.txt 2>&1
    got=$(sed -n 's/.*holds  parked = yes.*/yes/p; s/.*FAILS  parked = yes.*/no/p' build/tests/park_map.txt)
    [ "$got" = "$wanted" ]
    say "s51_agrees_at_${x}_${y}_${heading}" $? "s51 says '$got', the map '$wanted' ($end_x m, $end_turn degrees)"
done < <(awk -F, 'NR > 1 { x = $5 < 0 ? -$5 : $5; t = $6 < 0 ? -$6 : $6; border = (x > 0.35 && x < 0.45 && t < 2.5) || (t > 1.5 && t < 2.5 && x < 0.45)
    if (NR % 157 == 40 && !border) print }' build/grid/park.csv)
finish
