#!/bin/sh
# SPDX-License-Identifier: MIT
# What the controllers take of each board, as members of the page's data: "sheets" are tables (code and
# RAM as the linker counts them), "texts" what make bench has left in build/bench.
set -eu

escape() {
    sed -e 's/\\/\\\\/g; s/"/\\"/g; s/</\\u003c/g; s/\t/    /g; s/\r//g' -e 's/[\x01-\x1f]//g'
}

echo '"sheets":[{"title":"Memory","caption":"Bytes, as linked: code with all tables, and how much of the chip'"'"'s that is; what the 256 of RAM leave for the stack, and the most of that which any path through the program needs.","head":["board","controller","code","used","stack","needs"],"rows":['
for mem in build/*/*.mem; do
    board=$(basename "$(dirname "$mem")")
    if [ -f "firmware/boards/$board.mk" ]; then tools/memory.sh "$board" "$(basename "$mem" .mem)"; fi
done | awk '{ gsub(/,/, " ") }
{ printf "%s[\"%s\",\"%s\",\"%s\",\"%.0f %%\",\"%s\",\"%s\"]\n", (NR > 1 ? "," : ""), $1, $2, $4, 100 * $4 / $6, $15, $23 }'
echo ']}],"texts":['
first=1
for text in build/bench/*.txt; do
    [ -f "$text" ] || continue
    [ -n "$first" ] || echo ,
    first=
    printf '{"title":"%s","caption":"As make bench measured it.","body":"' "$(basename "$text" .txt | escape)"
    escape <"$text" | awk '{ printf "%s%s", (NR > 1 ? "\\n" : ""), $0 }'
    printf '"}'
done
if [ -n "$first" ]; then
    printf '{"title":"Cycles","caption":"","body":"Not measured yet: make bench, then make report."}'
fi
echo ']'
