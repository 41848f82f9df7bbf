# SPDX-License-Identifier: MIT
# The tables of the tab "Boards": {sheets, texts}. Input: the bench's text files by name; $memory: the
# lines of tools/memory.sh.
def number_after($word): capture($word + " +(?<n>[0-9]+)").n;
def row: . as $line | (gsub(","; " ") | split(" ") | map(select(. != ""))) as $words
    | ($line | number_after("code") | tonumber) as $code | ($line | capture("code +[0-9]+ of +(?<n>[0-9]+)").n | tonumber) as $flash
    | [$words[0], $words[1], ($code | tostring), "\(100 * $code / $flash | round) %", ($line | number_after("leaves")), ($line | number_after("at most"))];

{sheets: [{title: "Memory",
    caption: "Bytes, as linked: code with all tables, and how much of the chip's flash that is; what the RAM leaves for the stack, and the most that any path through the program needs of it.",
    head: ["board", "controller", "code", "used", "stack", "needs"],
    rows: [$memory | split("\n")[] | select(. != "") | row]}],
 texts: ([to_entries[] | {title: (.key | split("/")[-1] | rtrimstr(".txt")), caption: "As make bench measured it.",
        body: (.value | gsub("\r"; "") | gsub("\t"; "    "))}]
    | if . == [] then [{title: "Cycles", caption: "", body: "Not measured yet: make bench, then make report."}] else . end)}
