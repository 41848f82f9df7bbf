# SPDX-License-Identifier: MIT
# From where the car parks: gnuplot -e "out='...'; data='build/grid/park.csv'" park_map.gp
x = 'x_m'; y = 'y_m'; value = 'parked'; share = 1; unit = 1.0; every_x = 5; every_y = 2
x_label = 'beside the place, m'
y_label = 'before the place, m'
load 'tools/report/starts.gp'
