#!/bin/bash
# Each C file is as `make format` leaves it.
. tests/lib.sh

while read -r file; do
    clang-format-19 --dry-run --Werror "$file" 2>/dev/null
    say "$file" $? "clang-format changes it; run: make format"
done < <(git ls-files '*.c' '*.h')
finish
