# SPDX-License-Identifier: MIT
# What is left of the speed at which a standing car is met: gnuplot -e "out='...'; values='...';
# image='brake first'; names='fuzzy "at once"'; colours='1 4'" limit.gp
load 'tools/report/figure.gp'
rows(name) = sprintf("< awk -F '\\t' 'NR == 1 { for (k = 1; k <= NF; k++) place[$k] = k } $1 == \"%s\" && $3 == \"limit\" && $4 { split($2, part, \"_\"); print part[2], $place[\"impact_mps\"] + 0, $place[\"owed_mps\"] }' '%s'", name, values)
set terminal svg size 520,330 font 'sans,13'
set output out
set xlabel 'closing speed at 5 m, m/s' offset 0, 0.3
set ylabel 'impact speed, m/s' offset 1.2, 0
set tics scale 0.4
set yrange [0:8]
set key top left samplen 2 spacing 1.1
set lmargin at screen 0.09; set rmargin at screen 0.98; set tmargin at screen 0.97; set bmargin at screen 0.17
plot for [k = 1:words(image)] rows(word(image, k)) using 1:2 with lines lw 2.2 lc rgb series(k) title word(names, k) noenhanced, \
    rows(word(image, 1)) using 1:3 with lines lw 1.5 dt (6, 4) lc rgb ink title 'owed'
