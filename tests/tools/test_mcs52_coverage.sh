#!/bin/bash
# SPDX-License-Identifier: MIT
# The hand-worked tests of tools/drive/sim/mcs52 go through each line of it, and each branch both ways.
# (test_mcs52_s51 does not count: it compares with s51.)
. tests/lib.sh
includes="-std=c11 -D_GNU_SOURCE -Itools/drive/sim -Itools/common -Ibuild/deps/unity/src"
tests=$(basename -as .c tests/tools/test_mcs52*.c | grep -vx test_mcs52_s51)

build() {
    local file
    for file in tools/drive/sim/mcs52*.c; do
        # shellcheck disable=SC2086  # a list of options
        cc -O0 --coverage $includes -c "$PWD/$file" -o "$out/$(basename "$file" .c).o" || return
    done
    cc -O1 -c build/deps/unity/src/unity.c -o "$out/unity.o" || return
    for file in $tests; do
        # shellcheck disable=SC2086
        cc -O0 $includes "tests/tools/$file.c" "$out"/unity.o "$out"/mcs52*.o --coverage -lm -o "$out/$file" || return
    done
}
check "the library builds for gcov" build
for test in $tests; do
    "$out/$test" >"$out/$test.log" 2>&1
    say "$test passes without sanitizers" $? "$(grep -m 1 FAIL "$out/$test.log")"
done

(cd "$out" && for file in mcs52*.gcda; do gcov -b "$file"; done) >"$out/gcov.txt" 2>&1
files=0
while read -r file lines branches; do
    files=$((files + 1))
    [ "$lines" = 100.00 ] && [ "$branches" = 100.00 ]
    say "$file is tested in each line and branch" $? "$lines % of the lines, $branches % of the branches: see $out/$file.gcov"
done < <(awk -F "[':%]" '
    /^File .*mcs52/ { file = $2; sub(/.*\//, "", file); lines = branches = "100.00"; next }
    /^File/ { file = "" }
    file != "" && /^Lines executed/ { lines = $2 }
    file != "" && /^Taken at least once/ { branches = $2 }
    file != "" && /^(Creating|$)/ { print file, lines, branches; file = "" }' "$out/gcov.txt" | sort -u)
[ "$files" -ge "$(git ls-files 'tools/drive/sim/mcs52*.c' | wc -l)" ]
say "gcov saw each file" $? "$files files; $(tail -n 2 "$out/gcov.txt")"
finish
