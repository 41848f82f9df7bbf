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

# Sets comment to the line in that file's comment style; to nothing for other files. $head are its first lines.
comment_for() { # FILE
    comment=
    case $1 in
    tests/bad/* | tests/good/* | tests/fuzz/corpus/*) ;;
    tests/golden/*.fis) ;;
    *.c | *.h | *.css) comment="/* $line */" ;;
    *.js) comment="// $line" ;;
    .github/*) ;;
    *.html | *.md) comment="<!-- $line -->" ;;
    *.fis | *.m) comment="% $line" ;;
    *.scn) comment="; $line" ;;
    *.sh | *.mk | *Makefile | *.awk | *.jq | *.gp | *.conf | *.tab | *.dict | .clang-format | .editorconfig | .gitignore | .shellcheckrc) comment="# $line" ;;
    *) [[ ${head[0]:-} != '#!'* ]] || comment="# $line" ;;
    esac
}

while read -r file; do
    [ -f "$file" ] || continue
    mapfile -n 3 head <"$file"
    comment_for "$file"
    if [ -z "$comment" ] || [[ "${head[*]}" == *"$line"* ]]; then
        continue
    fi
    if [ "${1:-}" = --check ]; then
        echo "$file:1: error: no '$line'; run make format" >&2
        missing=1
        continue
    fi
    # Below "#!" and "<!doctype", which must be first.
    if [[ ${head[0]:-} == '#!'* || ${head[0]:-} == '<!'[Dd][Oo][Cc]* ]]; then
        sed -i "1a\\$comment" "$file"
    else
        sed -i "1i\\$comment" "$file"
    fi
done < <(git ls-files)
exit $missing
