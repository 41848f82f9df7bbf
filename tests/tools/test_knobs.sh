#!/bin/bash
# SPDX-License-Identifier: MIT
# A knob of make that names what is not there, or a table that is no brake's, is answered by what there
# is and what a brake's table must be, before any other message.
. tests/lib.sh

refuses "an estimator that is not there" 2 "no estimator 'nosuch'; use difference or smooth" make ESTIMATOR=nosuch
refuses "a table that is not there" 2 "no file 'nosuch.fis'; TABLE names the brake's fuzzy system" make TABLE=nosuch.fis
refuses "a board that lacks a pin" 2 "firmware/boards/at89s52.mk: error: a board states PIN_NOSUCH := ..., as the others do" make -W tools/drive/rules.mk PINS=NOSUCH build/boards.h
refuses "an app that is not there" 2 "no app 'nosuch'; the apps are: brake tuned" make flash BOARD=at89s52 PORT=/dev/x APP=nosuch

law=(make BOARD=generic8052 OUT="$out" "$out/brake/brake/law_fuzzy.rel" "$out/brake/brake/cell.rel")
refuses "a table of three inputs" 2 "the brake needs a table of two inputs: distance in m, closing speed in m/s" "${law[@]}" TABLE=tables/follow.fis
refuses "a table of one input" 2 "the brake needs a table of two inputs" "${law[@]}" TABLE=tables/park.fis
sed '/^\[Input2\]/,$!{s/Range=\[1 5\]/Range=[100 500]/; s/\[\([0-9]\) \([0-9]\) \([0-9]\)/[\100 \200 \300/; s/00 \([0-9]\)\]/00 \100]/}' tables/brake.fis >"$out/cm.fis"
refuses "a table in centimetres" 2 "an axis is too long: at most 65.535 m or m/s from end to end" "${law[@]}" TABLE="$out/cm.fis"

report=(tools/report/report.sh stc89c516rd)
export REPORT_OUT=$out/report
refuses "an image that is not there" 2 "no image 'nosuch'; the images are: brake tuned classic" env IMAGES='gap nosuch' "${report[@]}"
refuses "a map of no fineness" 2 "MAP=finest: use coarse, normal or fine" env MAP=finest "${report[@]}"
refuses "no jobs at all" 2 "JOBS=0: give a whole number, 1 or more" env JOBS=0 "${report[@]}"
refuses "a word for jobs" 2 "JOBS=all: give a whole number, 1 or more" env JOBS=all "${report[@]}"
[ ! -e "$REPORT_OUT/index.html" ]
say "no page of a refused report" $? "there is one"
finish
