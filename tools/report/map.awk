# SPDX-License-Identifier: MIT
# The cells of an avoidance map for map.gp, from a .values file: awk -v image=NAME -f map.awk FILE.
# Scenarios are named map_vSPEED_bDECEL. Four blocks: cells (column, row, class of impact speed, text),
# the line below which no impact is owed, the columns' and the rows' labels.
BEGIN { FS = "\t" }
NR == 1 { for (k = 1; k <= NF; k++) place[$k] = k; next }
$1 == image && $3 == "map" {
    split($2, part, "_")
    v = substr(part[2], 2) + 0; b = substr(part[3], 2) + 0
    if (!(v in row_of)) { row_of[v] = 1; speeds[++rows] = v }
    if (!(b in column_of)) { column_of[b] = 1; decels[++columns] = b }
    ok[v, b] = $4; impact[v, b] = $place["impact_mps"]; owed[v, b] = $place["owed_mps"]
}
function sort(list, count,    i, j, value) {
    for (i = 2; i <= count; i++) {
        value = list[i]
        for (j = i - 1; j >= 1 && list[j] > value; j--) list[j + 1] = list[j]
        list[j + 1] = value
    }
}
END {
    sort(speeds, rows); sort(decels, columns)
    for (c = 1; c <= columns; c++)
        for (r = 1; r <= rows; r++) {
            v = speeds[r]; b = decels[c]
            if (!((v, b) in ok)) continue
            if (!ok[v, b]) print c, r, 9, "?"
            else if (impact[v, b] > 0) print c, r, impact[v, b] <= 1 ? 1 : impact[v, b] <= 3 ? 2 : impact[v, b] <= 6 ? 3 : 4, sprintf("%.1f", impact[v, b])
            else print c, r, 0, "~"
        }
    print "\n"
    for (c = 1; c <= columns; c++) {
        for (r = 0; r < rows && owed[speeds[r + 1], decels[c]] == 0; r++) ;
        print c - 0.5, r + 0.5
        print c + 0.5, r + 0.5
    }
    print "\n"
    for (c = 1; c <= columns; c++) print c, decels[c]
    print "\n"
    for (r = 1; r <= rows; r++) print r, speeds[r]
}
