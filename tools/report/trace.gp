# SPDX-License-Identifier: MIT
# One scenario over time, a curve a controller: gnuplot -e "out='...'; files='a.csv b.csv'; colours='1 2';
# columns='gap_m ego_mps'; labels='\"gap, m\" \"speed, m/s\"'; references='\"\" lead_mps'; lows='0 0'; highs='* *'; steps='1 2'" trace.gp
# Margins are fixed: the player lays its cursor over them.
load 'tools/report/figure.gp'
set datafile separator comma
panels = words(columns)
height = 122 * panels + 40
set terminal svg size 480,height font 'sans,14'
set output out
set multiplot
set lmargin at screen 0.11; set rmargin at screen 0.97
end_s = 0
do for [k = 1:words(files)] {
    stats word(files, k) using 't_s' nooutput name 'T'
    if (T_max > end_s) { end_s = T_max }
}
set xrange [0:end_s]
set xtics format ''
set tics font ',12' scale 0.4
do for [p = 1:panels] {
    if (p == panels) { set xtics format '%g'; set label 2 'time, s' at screen 0.54, screen 9.0 / height center font ',12' tc rgb soft }
    set tmargin at screen 1 - (122.0 * (p - 1) + 20) / height
    set bmargin at screen 1 - (122.0 * p - 4) / height
    set label 1 word(labels, p) at graph 0, 1 offset 0, 0.55 left tc rgb ink
    eval sprintf('set yrange [%s:%s]', word(lows, p), word(highs, p))
    set ytics word(steps, p) + 0
    reference = word(references, p)
    plot for [f in reference eq '-' ? '' : word(files, 1)] f using 't_s':(column(reference)) with lines lw 1.5 dt 2 lc rgb soft notitle, \
         for [k = 1:words(files)] word(files, k) using 't_s':(column(word(columns, p))) with lines lw 1.8 lc rgb series(k) notitle
}
unset multiplot
