# SPDX-License-Identifier: MIT
# The avoidance map of one controller: gnuplot -e "out='...'; values='...'; image='brake'" map.gp
load 'tools/report/figure.gp'
cells = sprintf("< awk -v image='%s' -f tools/report/map.awk '%s'", image, values)
stats cells index 2 using 1 nooutput name 'C'
stats cells index 3 using 1 nooutput name 'R'
set terminal svg size 400,400 font 'sans,13'
set output out
unset grid
unset key
set tics scale 0
set xrange [0.5:C_max + 0.5]
set yrange [0.5:R_max + 0.5]
set xlabel 'the car ahead brakes, m/s²' offset 0, 0.3
set ylabel 'both at, m/s' offset 1, 0
set lmargin at screen 0.13; set rmargin at screen 0.98; set tmargin at screen 0.98; set bmargin at screen 0.15
set style fill solid noborder
plot for [n = 0:4] cells index 0 using 1:($3 == n ? $2 : NaN):($1 - 0.48):($1 + 0.48):($2 - 0.47):($2 + 0.47) with boxxyerror lc rgb level(n), \
    cells index 0 using 1:2:(strcol(4) eq '~' ? '' : strcol(4)) with labels tc rgb ink font ',11', \
    cells index 1 using 1:2 with lines lw 2.2 dt (6, 4) lc rgb ink, \
    cells index 2 using 1:(-9):xtic(2) with lines lc rgb soft, \
    cells index 3 using (-9):1:ytic(2) with lines lc rgb soft
