#!/bin/bash
# SPDX-License-Identifier: MIT
# The laboratory against the simulator: the same scenarios under each law, on the host and with the real
# image. Both give the same outcome, within what an echo just before or just after a tick can change.
. tests/lib.sh
board=stc89c516rd

# LAW SCENARIO SETTING...: gaps within 3 cm (or $gap_m), contact within 0.05 m/s, jerk within 3 % (or $jerk_part),
# deceleration and its rms within 3 % (or $part).
agrees() {
    local law=$1 scenario=$2 sets=() one
    shift 2
    for one; do sets+=("--set=$one"); done
    build/drive run --brief --hex build/$board/"$law".ihx --board $board --scenario "$scenario" "${sets[@]}" \
        --json "$out/out.json" >"$out/log" 2>&1
    build/lab run build/lab-images/"$law".so --scenario "$scenario" "${sets[@]}" >"$out/host" 2>>"$out/log"
    awk -v gap_m="${gap_m:-0.03}" -v part="${part:-0.03}" -v jerk_part="${jerk_part:-0.03}" '
    FNR == NR { host[$1] = $2; n++; next }
    /"outcome"/ { inside = 1 }
    /"expect"/ { inside = 0 }
    inside && NF >= 2 { name = $1; gsub(/[":]/, "", name); value = $2; sub(/,$/, "", value); chip[name] = value }
    function differs(name, absolute, relative,    a, b, d) {
        if (!(name in host) || !(name in chip)) { print name " is missing"; return }
        a = host[name]; b = chip[name]
        if (b == "null" || a == "inf") { if (b != "null" || a != "inf") print name ": " a " on the host, " b " in s51"; return }
        d = a > b ? a - b : b - a
        if (d > absolute + relative * b) print name ": " a " on the host, " b " in s51"
    }
    END {
        differs("impact_mps", 0.05, 0); differs("min_gap_m", gap_m, 0); differs("stop_gap_m", gap_m, 0)
        differs("peak_decel_mps2", 0.02, part); differs("peak_jerk_mps3", 0.2, jerk_part)
        differs("rms_accel_mps2", 0.01, part)
    }' "$out/host" "$out/out.json" | tr '\n' ';'
}

for law in brake tuned classic first none; do
    faultless "${law}_standing_3.0" "$(agrees $law tests/loop/standing_car_3mps.scn)"
    # One reading's duty makes it into a period of the PWM, or with another version of SDCC just not: then the
    # gap changes by the way of 10 ms at 6.4 m/s, beside those 3 cm.
    faultless "${law}_standing_6.4" "$(gap_m=0.094 agrees $law tests/loop/tuned/standing_car_64.scn)"
done
# The pulse of a clear road, 38 ms, ends when the PWM takes its last new duty for the next period, and when the
# chip triggers varies by 0.8 ms: so it ends 2.5 ms earlier here, well within a period.
# One that comes a period later by that costs 3 cm: the way of 10 ms at 3.1 m/s, beside the 3 cm.
for law in brake tuned classic; do
    # With noise each reading asks for another duty: one that comes a period later meets the step of the next, which
    # makes up to a tenth of the jerk.
    faultless "${law}_noisy_4.0" "$(jerk_part=0.1 agrees $law tests/loop/tuned/standing_car_40.scn scenario.seed=7)"
    faultless "${law}_lead_brakes" "$(gap_m=0.061 agrees $law tests/loop/tuned/lead_brakes_5mps2.scn sensor.no_echo_us=35500)"
done
# Behind the lidar a scenario begins with the end of the self-test, so the PWM's phase in it changes with the
# chip's program: the gap may change by the way of one period, 10 ms at 8.5 m/s.
for scenario in standing_car_85 sun black_car rain; do
    faultless "brake_far_$scenario" "$(gap_m=0.085 agrees brake_far tests/loop/brake_far/$scenario.scn)"
done
faultless tuned_holds "$(agrees tuned tests/loop/tuned/holds.scn)"
# It brakes for two readings, 120 ms: a period of the PWM more or less is 8 % of that.
faultless tuned_at_the_edge "$(part=0.083 agrees tuned tests/loop/tuned/passing_at_the_edge.scn sensor.no_echo_us=35500)"

# The command that found a table, as that says it, in three rounds (`make tune` does all): same seed, same
# system; another seed, another one; and it is one that fistab takes.
read -ra tune <<<"$(sed -n 's/^% *\(build\/lab tune .*\) -o FILE$/\1/p' tables/brake_far.fis)"
"${tune[@]}" --rounds 1 -o "$out/far.fis" >"$out/wrong" 2>"$out/log" || echo "fails: $(cat "$out/log")" >>"$out/wrong"
build/fistab check "$out/far.fis" >>"$out/wrong" 2>&1
faultless the_lidars_table_can_be_looked_for "$(head -c 300 "$out/wrong")"
read -ra tune <<<"$(sed -n 's/^% *\(build\/lab tune .*\) -o FILE$/\1/p' tables/brake_tuned.fis)"
"${tune[@]}" --rounds 3 -o "$out/a.fis" >"$out/wrong" 2>"$out/log" || echo "fails: $(cat "$out/log")" >>"$out/wrong"
"${tune[@]}" --rounds 3 -o "$out/b.fis" 2>>"$out/log"
"${tune[@]}" --rounds 3 --seed 5 -o "$out/c.fis" 2>>"$out/log"
cmp "$out/a.fis" "$out/b.fis" >>"$out/wrong" 2>&1
cmp -s "$out/a.fis" "$out/c.fis" && echo "the seed changes nothing" >>"$out/wrong"
build/fistab check "$out/a.fis" >>"$out/wrong" 2>&1
faultless tune_repeats_itself "$(head -c 300 "$out/wrong")"

# What the tables claim of themselves, in all the runs that lab makes of each situation: no impact up to LIMIT
# m/s, at most 25 m/s3 at speeds up to SMOOTH m/s, no impact where the car ahead brakes at 5 m/s2, and
# stop-and-go behind a driver of 1 m/s2 with no more than RMS m/s2.
claims() { # IMAGE LIMIT SMOOTH RMS
    build/lab figures "build/lab-images/$1.so" >"$out/figures" 2>&1
    awk -v least="$2" -v smooth="$3" -v rms="$4" '
    /no impact in 60 runs up to/ { limits++; if (!($10 >= least)) print "no impact up to " $10 " m/s, not " least }
    /standing car, [0-9]+ m\/s: jerk/ && $3 + 0 <= smooth { jerks++; sub(/\)/, "", $8); if (!($8 + 0 <= 25)) print "jerk " $8 " m/s3 at " $3 " m/s" }
    /the car ahead brakes at 5 m\/s2:/ { leads++; if ($12 != 0 || $15 != 60) print $12 " impacts in " $15 " runs where the car ahead brakes at 5 m/s2" }
    /stop-and-go, driver of 1 m\/s2:/ { drivers++; if (!($6 <= rms)) print "stop-and-go with " $6 " m/s2" }
    END { if (limits != 1 || jerks != smooth || leads != 1 || drivers != 1) print "figures are missing" }' "$out/figures"
}
faultless the_tuned_table_is_what_it_claims "$(claims tuned 6.4 4 0.449)"
with_sonar=$(awk '/stop-and-go, driver of 1 m\/s2:/ { print $6 }' "$out/figures")
faultless the_lidars_table_is_what_it_claims "$(claims brake_far 8.5 8 "$with_sonar")"

# The goal for the lidar: 60 of 60 drives at 8.5 m/s without an impact, at 25 m/s3 or less.
for ((seed = 1; seed <= 60; seed++)); do
    build/lab run build/lab-images/brake_far.so --scenario tests/loop/brake_far/standing_car_85.scn --seed $seed
done | awk '
    /^impact_mps/ { drives++; if ($2 > 0) print "an impact with " $2 " m/s in drive " drives }
    /^peak_jerk_mps3/ && $2 > 25 { print "jerk " $2 " in drive " drives }
    END { if (drives != 60) print drives + 0 " drives" }' >"$out/wrong"
faultless the_lidar_stops_at_8_5_in_60_drives "$(cat "$out/wrong")"

# The random search with real images: the same seed, the same drives. follow_paper hits in many of them, and a
# perfect head does not help: that is a limit of its law.
: >"$out/wrong"
build/lab attack --runs 30 build/$board/follow.ihx build/$board/follow_paper.ihx >"$out/a" 2>"$out/log" || echo "fails: $(cat "$out/log" "$out/a")" >"$out/wrong"
build/lab attack --runs 30 build/$board/follow.ihx >"$out/b" 2>&1
sed '/follow_paper/,$d' "$out/a" | cmp - "$out/b" >>"$out/wrong" 2>&1
awk '/ drives flagged/ { if ($1 != 0) print "flagged: " $0 } / impacts at the limit/ { limits[++n] = $2 }
    END { if (n != 2 || limits[1] > 1 || limits[2] < 3) print "at the limit: " limits[1] " of follow, " limits[2] " of follow_paper" }' "$out/a" >>"$out/wrong"
faultless attack_finds_what_the_published_follower_does "$(head -c 300 "$out/wrong")"
build/lab attack "$out/follow.ihx" >"$out/log" 2>&1
status=$?
wrong=
[ $status = 1 ] && grep -q 'error: name an image as build/BOARD/IMAGE.ihx; the boards are: ' "$out/log" || wrong="status $status: $(cat "$out/log")"
faultless an_image_without_a_board_is_refused "$wrong"

# What it refuses.
build/lab figures build/no-such.so >"$out/log" 2>&1
status=$?
wrong=
[ $status = 1 ] && grep -q 'build/no-such.so: error: cannot load this controller' "$out/log" || wrong="status $status: $(cat "$out/log")"
faultless a_missing_controller_is_named "$wrong"
build/lab tune build/lab-images/tuned.so >"$out/log" 2>&1
status=$?
wrong=
[ $status = 2 ] && grep -q 'error: say what to do' "$out/log" || wrong="status $status: $(cat "$out/log")"
faultless a_bad_command_is_refused "$wrong"
build/lab run build/lab-images/brake.so --scenario tests/loop/radar/case_100.scn >"$out/log" 2>&1
status=$?
wrong=
[ $status = 1 ] && grep -q "case_100.scn: error: app = radar; the laboratory has the brake's world alone" "$out/log" || wrong="status $status: $(cat "$out/log")"
faultless another_apps_scenario_is_refused "$wrong"
finish
