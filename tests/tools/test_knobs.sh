#!/bin/bash
# SPDX-License-Identifier: MIT
# A knob of make that names what is not there, or a table that is no brake's, is answered by what there
# is and what a brake's table must be, before any other message.
. tests/lib.sh

refuses "an estimator that is not there" 2 "no estimator 'nosuch'; use difference or smooth" make ESTIMATOR=nosuch
refuses "a sensor that is not there" 2 "no sensor 'nosuch'; the sensors are: hcsr04 tfluna" make SENSOR=nosuch
refuses "a sensor that the board does not hold" 2 "at89s52 does not hold the brake with SENSOR=tfluna; the boards that do: generic8052 stc89c516rd" make SENSOR=tfluna BOARD=at89s52
refuses "an app that the board does not hold" 2 "at89s52 does not hold brake_far; it holds: brake tuned" make flash BOARD=at89s52 PORT=/dev/x APP=brake_far
refuses "a step of a sensor that has its own" 2 "STEP_MS is for SENSOR=hcsr04" make BOARD=generic8052 SENSOR=tfluna STEP_MS=50 OUT="$out" "$out/first/brake/latch.rel"
refuses "a table that is not there" 2 "no file 'nosuch.fis'; TABLE names the brake's fuzzy system" make TABLE=nosuch.fis
refuses "a board that lacks a pin" 2 "firmware/boards/at89s52.mk: error: a board states PIN_NOSUCH := ..., as the others do" make -W tools/drive/rules.mk PINS=NOSUCH build/boards.h
refuses "an app that is not there" 2 "no app 'nosuch'; the apps are: brake tuned" make flash BOARD=at89s52 PORT=/dev/x APP=nosuch

law=(make BOARD=generic8052 OUT="$out" "$out/brake/brake/law_fuzzy.rel" "$out/brake/brake/cell.rel")
refuses "a table of three inputs" 2 "the brake needs a table of two inputs: distance in m, closing speed in m/s" "${law[@]}" TABLE=tables/follow.fis
refuses "a table of one input" 2 "the brake needs a table of two inputs" "${law[@]}" TABLE=tables/park.fis
sed '/^\[Input2\]/,$!{s/Range=\[1 5\]/Range=[100 500]/; s/\[\([0-9]\) \([0-9]\) \([0-9]\)/[\100 \200 \300/; s/00 \([0-9]\)\]/00 \100]/}' tables/brake.fis >"$out/cm.fis"
refuses "a table in centimetres" 2 "an axis is too long: at most 65.535 m or m/s from end to end" "${law[@]}" TABLE="$out/cm.fis"

latch=(make BOARD=generic8052 OUT="$out" "$out/brake/brake/latch.rel")
refuses "a step that the sensor cannot keep" 2 "STEP_MS must be 50 to 310, in steps of 10" "${latch[@]}" STEP_MS=40
refuses "a release within STOP" 2 "RELEASE_MM must be STOP_MM to 6000" "${latch[@]}" STOP_MM=1500
make -s BOARD=generic8052 OUT="$out" STOP_MM=1400 RELEASE_MM=1800 STEP_MS=80 FAULT_PCT=30 "$out/brake.ihx" || exit 2
build/drive run --board generic8052 --hex "$out/brake.ihx" --scenario tests/loop/start_inside_1m.scn --uart "$out/said" \
    --set ego.speed_mps=0 --set lead.gap_m=1.35 >/dev/null
check "STOP_MM, STEP_MS: at 1.35 m it stands in STOP, a reading each 80 ms" \
    awk -F, '/^[0-9]+,.*,STOP,0/ { if (!n++) first = $2; last = $2 } END { mean = n > 1 ? (last - first) / (n - 1) : 0; exit !(n > 5 && mean > 78 && mean < 82) }' "$out/said"

# The brake's other laws behind the other sensor, in a folder of its own.
make -s BOARD=generic8052 SENSOR=tfluna build/generic8052/tfluna/first.ihx || exit 2
check "SENSOR=tfluna: the image says so, and drives" \
    bash -c 'build/drive run --board generic8052 --hex build/generic8052/tfluna/first.ihx --scenario tests/loop/standing_car_3mps.scn | grep "Hz tfluna table"'

# A change of a flag in a NAME.mk or of the version builds anew; one that fails leaves no image.
image=(make -s BOARD=generic8052 OUT="$out/stale" "$out/stale/follow.hex")
"${image[@]}" >/dev/null || exit 2
cp "$out/stale/follow.ihx" "$out/before.ihx"
check "nothing is built twice" [ -z "$("${image[@]}")" ]
"${image[@]}" 'follow_FLAGS=-DSERVO -DFOLLOW_AS_PUBLISHED' >/dev/null
say "other flags build" $? "they do not"
! cmp -s "$out/before.ihx" "$out/stale/follow.ihx"
say "other flags make another image" $? "it is the old one"
refuses "flags that SDCC does not know" 2 "error" "${image[@]}" follow_FLAGS=-DCLK_HZ=0
[ ! -e "$out/stale/follow.ihx" ] && [ ! -e "$out/stale/follow.hex" ]
say "and leave no image" $? "there is one"
"${image[@]}" VERSION=9.9 >/dev/null
objcopy -I ihex -O binary "$out/stale/follow.ihx" "$out/follow.bin"
check "another version is in the image" grep -aq "fuzzy51 9.9 follow generic8052 " "$out/follow.bin"

report=(tools/report/report.sh stc89c516rd)
export REPORT_OUT=$out/report
refuses "an image that is not there" 2 "no image 'nosuch'; the images are: brake tuned brake_far classic" env IMAGES='gap nosuch' "${report[@]}"
refuses "a map of no fineness" 2 "MAP=finest: use coarse, normal or fine" env MAP=finest "${report[@]}"
refuses "no jobs at all" 2 "JOBS=0: give a whole number, 1 or more" env JOBS=0 "${report[@]}"
refuses "a word for jobs" 2 "JOBS=all: give a whole number, 1 or more" env JOBS=all "${report[@]}"
[ ! -e "$REPORT_OUT/index.html" ]
say "no page of a refused report" $? "there is one"
finish
