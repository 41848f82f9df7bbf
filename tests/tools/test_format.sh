#!/bin/bash
# SPDX-License-Identifier: MIT
# Each C file is as `make format` leaves it, and each source file has its SPDX line.
. tests/lib.sh

while read -r file; do
    clang-format-19 --dry-run --Werror "$file" 2>/dev/null
    say "$file" $? "clang-format changes it; run: make format"
done < <(git ls-files '*.c' '*.h')
check "each source file names its licence" tools/spdx.sh --check
long_lines=$(git ls-files '*.c' '*.h' ':!tests/bad' ':!tests/prove' | xargs awk 'length > 100 && /^ *(\/?\*)/ { print FILENAME ":" FNR; exit }')
[ -z "$long_lines" ]
say "no line of a comment is longer than 100 characters" $? "$long_lines; the formatter leaves comments as they are"
finish
