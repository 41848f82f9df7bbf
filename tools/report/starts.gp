# SPDX-License-Identifier: MIT
# A map of starts: the scripts that load this set data, x, y, value, share, unit (what a label is divided
# by), every_x and every_y (which labels are shown) and the axes' labels.
load 'tools/report/figure.gp'
cells = sprintf("< awk -F, -v x=%s -v y=%s -v value=%s -v share=%d -f tools/report/starts.awk '%s'", x, y, value, share, data)
stats cells index 1 using 1 nooutput name 'C'
stats cells index 2 using 1 nooutput name 'R'
set terminal svg size 400,360 font 'sans,13'
set output out
unset grid
unset key
set tics scale 0
set xrange [0.5:C_max + 0.5]
set yrange [0.5:R_max + 0.5]
set xlabel x_label offset 0, 0.3
set ylabel y_label offset 1, 0
set lmargin at screen 0.13; set rmargin at screen 0.98; set tmargin at screen 0.98; set bmargin at screen 0.16
set style fill solid noborder
label(n, value, every) = (int(n) - 1) % every ? '' : sprintf('%g', value / unit)
plot for [n = 0:4] cells index 0 using 1:($3 == n ? $2 : NaN):($1 - 0.47):($1 + 0.47):($2 - 0.46):($2 + 0.46) with boxxyerror lc rgb level(n), \
    cells index 0 using 1:2:(strcol(4) eq '~' ? '' : strcol(4)) with labels tc rgb ink font ',10', \
    cells index 1 using 1:(-9):xticlabels(label($1, $2, every_x)) with lines lc rgb soft, \
    cells index 2 using (-9):1:yticlabels(label($1, $2, every_y)) with lines lc rgb soft
