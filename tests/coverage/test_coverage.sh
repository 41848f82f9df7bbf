#!/bin/bash
# SPDX-License-Identifier: MIT
# Each line and each branch of the firmware's logic is reached by its unit tests, on the host:
#     tests/coverage/test_coverage.sh TEST...      TEST: a unit test that was built for gcov (rules.mk)
# Not asked for: firmware/mcu, the main loops (each main.c, and frames.c), which run in the simulator. A line
# that no test can reach says so beside it or just above it, after "unreached:", with the reason.
# Leaves build/coverage/host.json, of which the report makes a page.
. tests/lib.sh
coverage=build/coverage

find "$coverage" -name '*.gcda' -delete
failed=0
for test; do "$test" >"$out/${test##*/}.log" 2>&1 || failed=1; done
say each_test_passes $failed "see $out/*.log"
find "$coverage" -name '*.gcda' -exec gcov --branch-probabilities --json-format --stdout {} + >"$out/gcov.json" 2>"$out/gcov.log"
jq -s -f tests/coverage/holes.jq "$out/gcov.json" >"$coverage/host.json"

jq -r '.files[].file' "$coverage/host.json" >"$out/files"
jq -r '.files[] | .file as $file | .holes[]
    | "\($file)\t\(.line)\t\(if .reached then "a branch of this line" else "this line" end) is reached by no test"' \
    "$coverage/host.json" >"$out/holes"

# whole FILE: its holes are all explained.
whole() {
    local file line what where fault=''
    while IFS=$'\t' read -r file line what; do
        [ "$file" = "$1" ] || continue
        # Beside it, or at most two lines above: the condition of a block explains the block.
        where=$(sed -n "$((line > 2 ? line - 2 : 1)),${line}p" "$1")
        [[ $where == *"unreached: "* ]] || fault+="$1:$line: $what; "
    done <"$out/holes"
    faultless "$1" "$fault"
}

while read -r file; do
    whole "$file"
done <"$out/files"
# A file of which no line was compiled is none that is whole.
for file in $(git ls-files 'firmware/*.c' ':!firmware/mcu' ':!firmware/examples' ':!firmware/*/main.c' ':!firmware/frames/frames.c'); do
    grep -qxF "$file" "$out/files"
    say "${file}_is_tested" $? "no unit test has a line of it"
done
finish
