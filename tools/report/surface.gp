# SPDX-License-Identifier: MIT
# The table as a surface: gnuplot -e "out='...'; data='table.csv'" surface.gp. fistab's CSV has lines of
# distance, speed, brake after its head; each third cell is drawn.
load 'tools/report/figure.gp'
set terminal svg size 560,400 font 'sans,13'
set output out
grid = sprintf("< awk -F, 'NR > 1 { if ($1 != d) { d = $1; row++; column = 0; if (row %% 4 == 1) print \"\" } if (row %% 4 == 1 && column++ %% 4 == 0) print $1, $2, $3 }' '%s'", data)
set palette defined (0 '#2c7fb8', 0.45 '#7fcdbb', 0.75 '#fec44f', 1 '#d7301f')
set cbrange [0:100]
set zrange [0:100]
set pm3d explicit depthorder border lc rgb '#555555' lw 0.3
unset colorbox
unset key
set view 62, 128, 1.05, 1.15
set xyplane at 0
set tics scale 0.5 font ',11'
set ztics 25
set xtics 1 offset 0, -0.3
set ytics 10 offset 0.4, -0.3
unset grid
set border 31 + 64
set xlabel 'distance, m' offset 0, -0.6
set ylabel 'closing speed, m/s' offset 1, -0.6
set zlabel 'brake, %' rotate offset 2, 0 tc rgb soft
set yrange [0:35]
set xrange [1:5]
splot grid using 1:2:3 with pm3d
