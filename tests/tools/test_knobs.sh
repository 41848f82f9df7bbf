#!/bin/bash
# A knob of make that names what is not there, or a table that is no brake's, is answered by what there
# is and what a brake's table must be, before any other message.
set -u
out=build/tests/knobs
rm -rf "$out"
mkdir -p "$out"
. tests/tools/say.sh

refuses() { # NAME, TEXT, ARGUMENT OF make...: fails, and TEXT is in the first line that holds an error
    local name=$1 text=$2
    shift 2
    make "$@" >"$out/stdout" 2>"$out/stderr"
    [ $? -ne 0 ] && grep -m 1 -e '\*\*\*' -e 'error' "$out/stderr" | grep -qF -- "$text"
    say "$name" $? "not '$text' but: $(head -n 3 "$out/stderr")"
}
refuses "an estimator that is not there" "no estimator 'nosuch'; use difference or smooth" ESTIMATOR=nosuch
refuses "a table that is not there" "no file 'nosuch.fis'; TABLE names the brake's fuzzy system" TABLE=nosuch.fis
refuses "a board that lacks a pin" "firmware/boards/at89s52.mk: error: a board states PIN_NOSUCH := ..., as the others do" -W Makefile DRIVE_PINS=NOSUCH build/boards.h
refuses "an app that is not there" "board at89s52 has no app 'nosuch'; its apps are: brake tuned" flash BOARD=at89s52 PORT=/dev/x APP=nosuch

law=(BOARD=generic8052 OUT="$out" "$out/brake/core/law_fuzzy.rel" "$out/brake/core/cell.rel")
refuses "a table of three inputs" "the brake needs a table of two inputs: distance in m, closing speed in m/s" TABLE=tables/follow.fis "${law[@]}"
refuses "a table of one input" "the brake needs a table of two inputs" TABLE=tables/park.fis "${law[@]}"
sed '/^\[Input2\]/,$!{s/Range=\[1 5\]/Range=[100 500]/; s/\[\([0-9]\) \([0-9]\) \([0-9]\)/[\100 \200 \300/; s/00 \([0-9]\)\]/00 \100]/}' tables/brake.fis >"$out/cm.fis"
refuses "a table in centimetres" "an axis of the table is too long: at most 65.535 m or m/s from end to end" TABLE="$out/cm.fis" "${law[@]}"
exit $failed
