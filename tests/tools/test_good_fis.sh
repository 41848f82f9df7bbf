#!/bin/bash
# SPDX-License-Identifier: MIT
# Every system in tests/good (.fis, .fll, .fcl) passes `fistab check` (with the options of `% args:`) without a
# word; one that says `% equals: FILE` has the same outputs as FILE (both with the options of `% eval:`), and
# has them as the .fis that `fistab convert` makes of it. So have the tables that we ship. In an .fll or .fcl
# the line begins with #.
. tests/lib.sh

head_of() { # KEY FILE: the value after `% KEY:` in the first lines, whatever ends them
    tr '\r' '\n' <"$2" | sed -n "1,4s/^[%#] $1: //p"
}

for fis in tests/good/*.fis tests/good/*.fll tests/good/*.fcl tables/*.fis; do
    # shellcheck disable=SC2046  # a list of words
    said=$(build/fistab check $(head_of args "$fis") "$fis" 2>&1)
    status=$?
    wrong=
    [ -z "$said" ] || wrong="check says: $said"
    [ $status -eq 0 ] || wrong="check exits with $status: $said"
    faultless "$fis: check is silent" "$wrong"

    equal=$(head_of equals "$fis")
    [ -n "$equal" ] || continue
    for gap in 0 0.7 3 5 9.99 10; do for speed in 0 0.5 2 3.3 4; do echo "$gap $speed"; done; done >"$out/points"
    option=$(head_of eval "$fis")
    # shellcheck disable=SC2086  # no option, or one
    build/fistab eval $option "$equal" <"$out/points" >"$out/expected"
    # shellcheck disable=SC2086
    build/fistab eval $option "$fis" <"$out/points" >"$out/got" 2>&1
    wrong=
    [ "$(wc -l <"$out/expected")" -eq 30 ] || wrong="no 30 points of $equal"
    cmp -s "$out/expected" "$out/got" || wrong="differs from $equal: $(diff "$out/expected" "$out/got" | head -3)"
    faultless "$fis: same outputs as $equal" "$wrong"
    build/fistab convert "$fis" -o "$out/converted.fis" 2>"$out/stderr"
    # shellcheck disable=SC2086
    build/fistab eval $option "$out/converted.fis" <"$out/points" >"$out/got" 2>&1
    faultless "$fis: the same when converted" "$(diff "$out/expected" "$out/got" | head -3; grep -v warning "$out/stderr")"
done
finish
