#!/bin/bash
# Each C file is as `make format` leaves it.
set -u
# shellcheck source=tests/tools/say.sh
. tests/tools/say.sh

while read -r file; do
    clang-format-19 --dry-run --Werror "$file" 2>/dev/null
    say "$file" $? "clang-format changes it; run: make format"
done < <(git ls-files '*.c' '*.h')
exit $failed
