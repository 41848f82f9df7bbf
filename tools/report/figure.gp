# SPDX-License-Identifier: MIT
# What all figures of the report have in common. The colours are names: figure.sh turns them into the
# page's variables, so a figure follows the light or dark setting.
ink = '#000010'; soft = '#000011'; gridline = '#000012'
level(n) = sprintf('#0000%02x', 32 + n)
series(k) = sprintf('#0000%02x', int(word(colours, k)))
set border 3 lw 1 lc rgb soft
set tics nomirror
set tics textcolor rgb soft
set xlabel tc rgb soft
set ylabel tc rgb soft
set title tc rgb ink
set grid lt 1 lw 0.7 lc rgb gridline
set key tc rgb ink
