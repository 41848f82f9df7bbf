# SPDX-License-Identifier: MIT
# Takes README.md and docs/*.md apart, for test_docs.sh. Prints a line for each item:
#     PAGE:LINE <tab> KIND <tab> TEXT
# KIND is `code` (between backticks), `command` (after "$ " in a console block), `output` (another line of
# such a block), `block` (a line of any other block), `link`, `holds` (a comment of the form
# <!-- NAME = VALUE, NAME = VALUE -->), or `row` (of a table).
function item(kind, text) {
    printf "%s:%d\t%s\t%s\n", FILENAME, FNR, kind, text
}

FNR == 1 || /^$/ { is_code = 0; code = "" }

/^```/ {
    block = block == "" ? (/^```console/ ? "console" : "other") : ""
    item(block == "" ? "end" : "begin", substr($0, 4))
    next
}
block == "console" && sub(/^\$ /, "") { item("command", $0); next }
block == "console" { item("output", $0); next }
block != "" { item("block", $0); next }

/^<!-- .* -->$/ {
    count = split(substr($0, 6, length($0) - 9), parts, /, */)
    for (i = 1; i <= count; i++) item("holds", parts[i])
    next
}
/^\|/ { item("row", $0) }

{
    rest = $0
    while (match(rest, /\]\([^)]*\)/)) {
        item("link", substr(rest, RSTART + 2, RLENGTH - 3))
        rest = substr(rest, RSTART + RLENGTH)
    }
    count = split($0, parts, "`")
    for (i = 1; i <= count; i++) {
        if (i > 1) {
            if (is_code) item("code", code)
            is_code = !is_code
            code = ""
        }
        code = code (code == "" ? "" : " ") parts[i]
    }
}
