#!/bin/bash
# SPDX-License-Identifier: MIT
# Writes compile_commands.json, for editors: how the host's compiler sees each file of the tools and of the
# firmware's portable part.
#     tools/compdb.sh
set -euo pipefail
# What make would do, without doing it.
make -Bnk V=1 tools run-unit 2>/dev/null | awk -v folder="$PWD" '
    / -c [^ ]+\.c -o / {
        match($0, / -c [^ ]+\.c /)
        file = substr($0, RSTART + 4, RLENGTH - 5)
        if (seen[file]++) next
        gsub(/\\/, "\\\\"); gsub(/"/, "\\\"")
        printf "%s{\"directory\":\"%s\",\"file\":\"%s\",\"command\":\"%s\"}", count++ ? ",\n" : "[\n", folder, file, $0
    }
    END { print count ? "\n]" : "[]" }' >compile_commands.json
echo "compile_commands.json: $(grep -c '"file"' compile_commands.json) files"
