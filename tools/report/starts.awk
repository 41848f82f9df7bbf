# SPDX-License-Identifier: MIT
# The cells of a map of starts for starts.gp, from a CSV with a head: awk -F, -v x=gap_mm -v y=own_mmps
# -v value=collided -v share=0 -f starts.awk FILE. Starts that differ in nothing but other columns share
# a cell: their values are added up, or, with share=1, averaged. Three blocks: cells (column, row,
# class, text), the columns' and the rows' labels.
NR == 1 { for (k = 1; k <= NF; k++) place[$k] = k; next }
{
    a = $place[x]; b = $place[y]
    if (!(a in column_of)) column_of[a] = ++columns
    if (!(b in row_of)) row_of[b] = ++rows
    sum[a, b] += $place[value]; count[a, b]++
}
function rank(list, which_of,    key, other, n) {
    for (key in list) {
        n = 1
        for (other in list) if (other + 0 < key + 0) n++
        which_of[key] = n
    }
}
END {
    rank(column_of, column); rank(row_of, row)
    for (a in column)
        for (b in row) {
            if (!((a, b) in sum)) continue
            mean = sum[a, b] / count[a, b]
            if (share) level = mean >= 1 ? 0 : mean >= 0.75 ? 1 : mean >= 0.5 ? 2 : mean >= 0.25 ? 3 : 4
            else level = sum[a, b] < 4 ? sum[a, b] : 4
            print column[a], row[b], level, (share || !sum[a, b] ? "~" : sum[a, b])
        }
    print "\n"
    for (a in column) print column[a], a
    print "\n"
    for (b in row) print row[b], b
}
