# SPDX-License-Identifier: MIT
# Where the follower collides: gnuplot -e "out='...'; data='build/grid/follow.csv'" follow_map.gp
x = 'gap_mm'; y = 'own_mmps'; value = 'collided'; share = 0; unit = 1000.0; every_x = 5; every_y = 2
x_label = 'gap at the start, m'
y_label = 'own speed, m/s'
load 'tools/report/starts.gp'
