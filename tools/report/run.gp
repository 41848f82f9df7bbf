# SPDX-License-Identifier: MIT
# One run of the brake as a figure: gnuplot -e "csv='run.csv'; title='...'; out='run.svg'" run.gp
# Three panels over one time axis: where the cars are, how fast they go, what the brake does.
set datafile separator comma
if (out[strlen(out)-2:*] eq 'png') set terminal pngcairo size 1000,900 font 'sans,12'; else set terminal svg size 1000,900 font 'sans,14' background 'white'
set output out
set multiplot layout 3,1 title title noenhanced margins 0.09,0.91,0.07,0.94 spacing 0.03
set grid lc rgb '#dddddd'
set key top right
set xtics format ''
stats csv using 't_s' nooutput name 'T'
set xrange [T_min:T_max]

set ylabel 'gap, m'
set yrange [0:*]
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#aa0000'
set label 1 'stop at 1 m' at graph 0.01, first 1.0 offset 0,0.6 tc rgb '#aa0000'
plot csv using 't_s':'gap_m' with lines lw 2 lc rgb '#1f4e79' title 'gap', \
     csv using 't_s':(column('dist_mm')/1000.0) with points pt 7 ps 0.3 lc rgb '#c55a11' title 'measured'
unset arrow 1; unset label 1

set ylabel 'speed, m/s'
set y2label 'acceleration, m/s^2'
set y2tics
set ytics nomirror
plot csv using 't_s':'ego_mps' with lines lw 2 lc rgb '#1f4e79' title 'own speed', \
     csv using 't_s':'lead_mps' with lines lw 2 lc rgb '#7f7f7f' title 'car ahead', \
     csv using 't_s':'accel_mps2' axes x1y2 with lines lw 1 lc rgb '#548235' title 'acceleration'
unset y2label; unset y2tics; set ytics mirror

set xtics format '%g'
set xlabel 'time, s'
set ylabel 'brake, %'
set yrange [0:110]
plot csv using 't_s':'brake_pct' with steps lw 2 lc rgb '#c00000' title 'brake', \
     csv using 't_s':(column('stop')*104) with steps dt 2 lc rgb '#000000' title 'stop line'
unset multiplot
