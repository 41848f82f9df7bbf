#!/bin/bash
# SPDX-License-Identifier: MIT
# What drive prints about a run before the verdict: a sentence that fits the controller, and the figures
# that its world measures.
. tests/lib.sh

says() { # NAME SCENARIO PATTERN: the lines before the judged outcomes are, in one, of that form
    build/drive run --board stc89c516rd --scenario "$out/$2.scn" 2>&1 | sed '/^  holds\|^  FAILS/,$d' | tr '\n' '|' >"$out/said"
    grep -qxE -- "$3" "$out/said" && ! grep -qE 'nan|inf|-0\.?0* ' "$out/said"
    say "$1" $? "$(cat "$out/said")"
}
# Short ones, so that the tabs and the missing lead of a hand-written file are read here, too.
printf '[scenario]\ntitle\t=\tAlone\nduration_s\t=\t0.3\n[ego]\nspeed_mps\t=\t2\n[expect]\nmax_brake_pct\t<=\t0\n' >"$out/alone.scn"
printf '[scenario]\ntitle = R\napp = follow\nduration_s = 0.3\n[ego]\nspeed_mps = 1\n[lead]\ngap_m = 9\nspeed_mps = 1\n[expect]\nimpact = none\n' >"$out/robot.scn"
sed 's/^gap_m = 9/gap_m = 0.01/; s/^speed_mps = 1$/speed_mps = 0/; 0,/^speed_mps = 0/s//speed_mps = 2/' "$out/robot.scn" >"$out/robot_hits.scn"
sed 's/^speed_mps = 1$/speed_mps = 0/' "$out/robot.scn" | sed 's/^app = follow/&\nhold_s = 9/; s/gap_m = 9/gap_m = 0.1/' >"$out/robot_stands.scn"
sed "s/^duration_s = 30/duration_s = 6/" tests/loop/follow/a_lane_free.scn >"$out/robot_changes.scn" # at 5.5 s

n='[0-9]+\.[0-9]+'
says "nobody ahead" alone "Alone: drives at 2\.00 m/s after 0\.30 s\|  peak deceleration 0\.00 m/s2, peak jerk 0\.0 m/s3, most brake 0 %\|"
says "a robot that drives" robot "R: drives at $n m/s in the end, $n m behind the robot ahead\|  least gap $n m, most brake [0-9]+ %\|"
says "a robot that stands" robot_stands "R: stands in the end, 0\.10 m behind the robot ahead\|  least gap 0\.10 m, most brake [0-9]+ %\|"
says "a robot that collides" robot_hits "R: hits the robot ahead at $n m/s\|  least gap -?$n m, most brake [0-9]+ %\|"
says "a robot that changes lanes" robot_changes ".*: changes lanes at $n s, drives at $n m/s in the end, $n m behind the robot ahead\|  least gap $n m, most brake [0-9]+ %\|"
finish
