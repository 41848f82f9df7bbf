#!/bin/bash
# SPDX-License-Identifier: MIT
# Each broken scenario of tests/bad gives the message of its first line, with its place, exit status 1,
# and leaves nothing behind. The good ones of tests/loop give none.
. tests/lib.sh

for file in tests/bad/*.scn; do
    expected=$(sed -n '1s/^; expect: //p' "$file")
    rm -f "$out"/*
    build/drive run --hex build/canary.ihx --board stc89c516rd --scenario "$file" --csv "$out/x.csv" \
        >"$out/stdout" 2>"$out/stderr"
    status=$?
    if [ -z "$expected" ]; then
        say "$file" 1 "its first line is not '; expect: message'"
    elif [ $status -ne 1 ]; then
        say "$file" 1 "exit status $status in place of 1"
    elif ! grep -qF -- "$file$expected" "$out/stderr"; then
        say "$file" 1 "not '$file$expected' but: $(head -n 1 "$out/stderr")"
    elif [ "$(wc -l <"$out/stderr")" -ne 1 ]; then
        say "$file" 1 "more than one message: $(head -n 2 "$out/stderr" | tail -n 1)"
    elif [ -s "$out/stdout" ] || [ -e "$out/x.csv" ]; then
        say "$file" 1 "something was written"
    else
        say "$file" 0
    fi
done

for folder in $(find tests/loop -name '*.scn' -printf '%h\n' | sort -u); do
    build/drive list "$folder" >"$out/stdout" 2>"$out/stderr"
    say "$folder is good" $? "$(head -n 1 "$out/stderr")"
    [ "$(wc -l <"$out/stdout")" -eq "$(find "$folder" -maxdepth 1 -name '*.scn' | wc -l)" ]
    say "$folder is listed, a line each" $? "$(wc -l <"$out/stdout") lines"
done
finish
