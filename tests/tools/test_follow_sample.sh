#!/bin/bash
# SPDX-License-Identifier: MIT
# 52 starts of the follower's grid, 26 for each set of rules, six seconds each. The real image in the
# simulator must give the same result as the same decision on the host: contact and its time, the smallest
# gap and the last gap, to the millimetre.
. tests/lib.sh
board=stc89c516rd
seconds=6
every=43
folder=$out
make grid >/dev/null && make BOARD=$board build/$board/follow.ihx build/$board/follow_paper.ihx >/dev/null || exit 1

run_one() { # APP GAP_MM OWN_MMPS LEAD_MMPS
    build/drive run --board "$board" --hex "build/$board/$1.ihx" --scenario tests/grid/start.scn \
        --set "lead.gap_m=$(($2 / 1000)).$(printf %03d $(($2 % 1000)))" \
        --set "ego.speed_mps=$(($3 / 1000)).$(printf %03d $(($3 % 1000)))" \
        --set "lead.speed_mps=$(($4 / 1000)).$(printf %03d $(($4 % 1000)))" \
        --json "$folder/$1,$2,$3,$4.json" >/dev/null 2>"$folder/$1,$2,$3,$4.log"
}

for app in follow follow_paper; do
    "build/grid/$app/run" --duration-s="$seconds" --every="$every" | awk -F, -v app="$app" 'NR > 1 { print app, $0 }'
done | tr ', ' '  ' >"$folder/host.txt"
while read -r app gap own lead _; do run_one "$app" "$gap" "$own" "$lead" </dev/null; done <"$folder/host.txt"

while read -r app gap own lead collided at least last _; do
    json="$folder/$app,$gap,$own,$lead.json"
    wanted="$collided $least $last"
    if [ -r "$json" ]; then
        is=$(awk -v at="$at" '
            { gsub(/[",]/, "") }
            $1 == "impact:" { collided = $2 == "any" }
            $1 == "min_gap_m:" { least = $2 }
            $1 == "final_gap_m:" { last = $2 }
            $1 == "duration_s:" { duration = $2 }
            END {
                if (collided && (duration < at - 0.05 || duration > at + 0.05)) print "contact at " duration " s, not " at
                else printf "%d %.3f %.3f\n", collided, least, last
            }' "$json")
    else
        is="no outcome: $(head -n 1 "${json%.json}.log")"
    fi
    [ "$is" = "$wanted" ]
    say "$app from $gap mm, $own and $lead mm/s" $? "contact, least and last gap are '$is', on the host '$wanted'"
done <"$folder/host.txt"
check "at least 50 starts" [ "$(wc -l <"$folder/host.txt")" -ge 50 ]
finish
