#!/bin/bash
# SPDX-License-Identifier: MIT
# Each C file is as `make format` leaves it, and each source file has its SPDX line.
. tests/lib.sh

mapfile -t files < <(git ls-files '*.c' '*.h')
clang-format-19 --dry-run "${files[@]}" 2>"$out/changes"
changed=$(sed -nE 's/^([^ :]+):[0-9]+:[0-9]+: (warning|error): .*/\1/p' "$out/changes" | sort -u)
for file in "${files[@]}"; do
    [[ $'\n'$changed$'\n' != *$'\n'$file$'\n'* ]]
    say "$file" $? "clang-format changes it; run: make format"
done
check "each source file names its licence" tools/spdx.sh --check
long_lines=$(git ls-files '*.c' '*.h' ':!tests/bad' ':!tests/prove' | xargs awk 'length > 100 && /^ *(\/?\*)/ { printf "%s:%d ", FILENAME, FNR }')
[ -z "$long_lines" ]
say "no line of a comment is longer than 100 characters" $? "$long_lines; the formatter leaves comments as they are"
finish
