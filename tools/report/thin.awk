# SPDX-License-Identifier: MIT
# Makes the paths of an SVG short: awk -v RS="'" -f thin.awk IN.svg >OUT.svg. A point that lies within
# 0.1 pixel of the line drawn without it goes; what stays is written as steps of tenths.

# Does a line from point a to point b pass all between within 0.1?
function straight(a, b,    k, dx, dy, length_px) {
    dx = x[b] - x[a]; dy = y[b] - y[a]
    length_px = sqrt(dx * dx + dy * dy)
    for (k = a + 1; k < b; k++) {
        if (length_px < 0.05) { if ((x[k] - x[a]) ^ 2 + (y[k] - y[a]) ^ 2 > 0.01) return 0 }
        else if ((dx * (y[k] - y[a]) - dy * (x[k] - x[a])) / length_px > 0.1 || (dx * (y[k] - y[a]) - dy * (x[k] - x[a])) / length_px < -0.1) return 0
        else if (dx * (x[k] - x[a]) + dy * (y[k] - y[a]) < 0 || dx * (x[k] - x[b]) + dy * (y[k] - y[b]) > 0) return 0
    }
    return 1
}
function tenths(value) { return int(value * 10 + (value < 0 ? -0.5 : 0.5)) }
function polyline(count,    from, to, text, at_x, at_y) {
    at_x = tenths(x[1]); at_y = tenths(y[1])
    text = "M" at_x / 10 "," at_y / 10
    for (from = 1; from < count; from = to) {
        for (to = from + 1; to < count && straight(from, to + 1); to++) ;
        text = text (from == 1 ? "l" : " ") (tenths(x[to]) - at_x) / 10 "," (tenths(y[to]) - at_y) / 10
        at_x = tenths(x[to]); at_y = tenths(y[to])
    }
    return text
}
BEGIN { CONVFMT = OFMT = "%.6g" }
NR > 1 { printf "'" }
!/^[ \n]*M[0-9. ,LM\n-]+$/ { printf "%s", $0; next }
{
    count = 0; text = ""
    words = split($0, word, /[ \n]+/)
    for (k = 1; k <= words; k++) {
        if (word[k] !~ /^[ML]/) continue
        if (word[k] ~ /^M/ && count) { text = text polyline(count); count = 0 }
        split(substr(word[k], 2), pair, ",")
        x[++count] = pair[1] + 0; y[count] = pair[2] + 0
    }
    if (count) text = text polyline(count)
    printf "%s", text
}
