#!/bin/bash
# SPDX-License-Identifier: MIT
# Every .fis, .fll and .fcl in tests/bad says what it is there for: `% expect: LINE: error: text` in its first
# line (# in place of % in an .fll or .fcl). check must say that, exit 1 and print nothing on stdout; table, for
# errors, must too and write no file.
. tests/lib.sh

for fis in tests/bad/*.fis tests/bad/*.fll tests/bad/*.fcl; do
    expect=$(sed -n '1s/^[%#] expect: //p' "$fis" | tr -d '\r')
    arguments=$(sed -n '2s/^[%#] args: //p' "$fis")
    wrong=
    # shellcheck disable=SC2086  # a list of words
    stdout=$(build/fistab check $arguments "$fis" 2>"$out/stderr")
    status=$?
    [ -n "$expect" ] || wrong="no '% expect:' in its first line"
    [ $status -eq 1 ] || wrong="check exits with $status"
    [ -z "$stdout" ] || wrong="check prints on stdout: $stdout"
    sed "s|^$fis: *||" "$out/stderr" | grep -qxF -- "$expect" || wrong="expected '$expect', got '$(cat "$out/stderr")'"
    if [ -z "$arguments" ] && [[ $expect == *error:* ]]; then
        rm -f "$out"/*.h "$out"/*.csv
        build/fistab table "$fis" -o "$out/table.h" --csv="$out/table.csv" >"$out/stdout" 2>"$out/stderr"
        [ $? -eq 1 ] || wrong="table does not exit with 1"
        sed "s|^$fis: *||" "$out/stderr" | grep -qxF -- "$expect" || wrong="table does not say '$expect'"
        [ ! -e "$out/table.h" ] && [ ! -e "$out/table.csv" ] || wrong="table leaves $(ls "$out")"
        [ ! -s "$out/stdout" ] || wrong="table prints on stdout"
    fi
    faultless "$fis" "$wrong"
done

# The other way round: every message of the checks has a fixture.
while read -r name; do
    check "fixture_of_check_$name" grep -q "^% expect: .*($name)" tests/bad/check_*.fis
done < <(sed -n 's/^ \*   \([a-z_]\+\)  .*/\1/p' tools/fistab/check.h)
finish
