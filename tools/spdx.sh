#!/bin/bash
# SPDX-License-Identifier: MIT
# Each source file names the licence in its first lines, by the LICENSE file's SPDX identifier.
#     tools/spdx.sh            adds the line where it is missing (`make format` calls this)
#     tools/spdx.sh --check    names the files that lack it; exit status 1 if there are any
# Left as they are: inputs of tests, whose bytes or line numbers matter, GitHub's templates, whose text is
# filled in, and formats without comments.
set -euo pipefail
cd "$(dirname "$0")/.."
read -r name _ <LICENSE
line="SPDX-License-Identifier: $name"
missing=0

comment_for() { # FILE: the line in that file's comment style; nothing for other files
    case $1 in
    tests/bad/* | tests/good/* | tests/fuzz/corpus/*) ;;
    tests/golden/*.fis) ;;
    *.c | *.h | *.css) echo "/* $line */" ;;
    *.js) echo "// $line" ;;
    .github/*) ;;
    *.html | *.md) echo "<!-- $line -->" ;;
    *.fis | *.m) echo "% $line" ;;
    *.scn) echo "; $line" ;;
    *.sh | *.mk | *Makefile | *.awk | *.jq | *.gp | *.conf | *.tab | *.dict | .clang-format | .editorconfig | .gitignore | .shellcheckrc) echo "# $line" ;;
    *) ! head -n 1 "$1" | grep -aq '^#!' || echo "# $line" ;;
    esac
}

while read -r file; do
    comment=$([ ! -f "$file" ] || comment_for "$file")
    if [ -z "$comment" ] || head -n 3 "$file" | grep -qF "$line"; then
        continue
    fi
    if [ "${1:-}" = --check ]; then
        echo "$file:1: error: no '$line'; run make format" >&2
        missing=1
        continue
    fi
    # Below "#!" and "<!doctype", which must be first.
    if head -n 1 "$file" | grep -aqiE '^(#!|<!doctype)'; then
        sed -i "1a\\$comment" "$file"
    else
        sed -i "1i\\$comment" "$file"
    fi
done < <(git ls-files)
exit $missing
