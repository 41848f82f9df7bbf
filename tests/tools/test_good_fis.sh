#!/bin/bash
# SPDX-License-Identifier: MIT
# Every tests/good/*.fis passes `fistab check` (with the options of `% args:`) without a word; one that says
# `% equals: FILE` has the same outputs as FILE. So have the tables that we ship.
. tests/lib.sh

head_of() { # KEY FILE: the value after `% KEY:` in the first lines, whatever ends them
    tr '\r' '\n' <"$2" | sed -n "1,4s/^% $1: //p"
}

for fis in tests/good/*.fis tables/*.fis; do
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
    build/fistab eval "$equal" <"$out/points" >"$out/expected"
    build/fistab eval "$fis" <"$out/points" >"$out/got" 2>&1
    wrong=
    [ "$(wc -l <"$out/expected")" -eq 30 ] || wrong="no 30 points of $equal"
    cmp -s "$out/expected" "$out/got" || wrong="differs from $equal: $(diff "$out/expected" "$out/got" | head -3)"
    faultless "$fis: same outputs as $equal" "$wrong"
done
finish
