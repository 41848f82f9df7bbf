# SPDX-License-Identifier: MIT
# Turns what `drive run --live` writes to a terminal into an animated SVG: awk -f live.awk TERMINAL.txt
# Reads the output of a terminal of 80 columns without UTF-8. Each picture of the road becomes a frame,
# shown for as long as the simulated time between two pictures; the last one stays for two seconds and
# has the first line of the outcome below it.
BEGIN {
    RS = "\033\\[[0-9]+A"
    COLUMN_PX = 8; LINE_PX = 18; MARGIN_PX = 12; COLUMNS = 80; HOLD_S = 2
}

{
    gsub(/\r/, "")
    gsub(/\033\[[?0-9]*[a-zA-Z]/, "")
    frames[++count] = $0
}

function escaped(text) {
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    return text
}

function x_px(column) { return MARGIN_PX + column * COLUMN_PX }
function y_px(row) { return MARGIN_PX + row * LINE_PX }

function say(row, column, text, class) {
    printf "<text class=\"%s\" x=\"%d\" y=\"%d\" textLength=\"%d\">%s</text>\n", class, x_px(column), y_px(row) + 13, \
        length(text) * COLUMN_PX, escaped(text)
}

function block(row, column, width, class) {
    if (width > 0)
        printf "<rect class=\"%s\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"11\"/>\n", class, x_px(column), y_px(row) + 3, width * COLUMN_PX
}

# A line of the terminal: a rail of the road, or words, with a bar at the end.
function draw(row, line,    at, full) {
    sub(/ +$/, "", line)
    if (line == "")
        return
    if (line ~ /^-+$/) {
        printf "<rect class=\"rail\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"2\"/>\n", x_px(0), y_px(row) + 8, length(line) * COLUMN_PX
        return
    }
    at = match(line, /[#.]+$/)
    if (at && RLENGTH >= 20) {
        full = substr(line, at)
        gsub(/\./, "", full)
        block(row, at - 1, RLENGTH, "rest")
        block(row, at - 1, length(full), "bar")
        line = substr(line, 1, at - 1)
        sub(/ +$/, "", line)
    }
    if (line ~ /^\[/) # the road: its marks say nothing here
        gsub(/\./, " ", line)
    # Words stand where they stood, however wide the viewer's letters are.
    at = 0
    while (match(line, /[^ ]+( [^ ]+)*/)) {
        say(row, at + RSTART - 1, substr(line, RSTART, RLENGTH), "words")
        at += RSTART + RLENGTH - 1
        line = substr(line, RSTART + RLENGTH)
    }
}

# The time stands at the end of a picture's first line: "... 1.20 s".
function time_s(frame,    lines, words, n) {
    split(frame, lines, "\n")
    n = split(lines[1], words, " ")
    return words[n - 1]
}

END {
    rows = split(frames[1], unused, "\n") - 1
    begin_s = time_s(frames[1])
    total_s = time_s(frames[count]) - begin_s + HOLD_S
    width = COLUMNS * COLUMN_PX + 2 * MARGIN_PX
    height = (rows + 1) * LINE_PX + 2 * MARGIN_PX
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\">\n", width, height, width, height
    print "<style>"
    print "text { font: 13px monospace; white-space: pre } .words { fill: #d8dee9 } .rail { fill: #7b8494 }"
    print ".bar { fill: #4fb6c2 } .rest { fill: #333c4a }"
    print "</style>"
    printf "<rect width=\"%d\" height=\"%d\" rx=\"8\" fill=\"#1d232e\"/>\n", width, height
    for (k = 1; k <= count; k++) {
        from = (time_s(frames[k]) - begin_s) / total_s
        to = k < count ? (time_s(frames[k + 1]) - begin_s) / total_s : 1
        if (k < count && to <= from)
            continue
        printf "<g%s>", k < count ? " visibility=\"hidden\"" : ""
        values = k == 1 ? "visible;hidden" : k < count ? "hidden;visible;hidden" : "hidden;visible"
        times = k == 1 ? sprintf("0;%.4f", to) : k < count ? sprintf("0;%.4f;%.4f", from, to) : sprintf("0;%.4f", from)
        printf "<animate attributeName=\"visibility\" calcMode=\"discrete\" dur=\"%.2fs\" repeatCount=\"indefinite\" values=\"%s\" keyTimes=\"%s\"/>\n", \
            total_s, values, times
        n = split(frames[k], lines, "\n")
        for (row = 1; row <= rows; row++)
            draw(row - 1, lines[row])
        if (k == count)
            say(rows, 0, lines[rows + 1], "words")
        print "</g>"
    }
    print "</svg>"
}
