#!/bin/sh
# SPDX-License-Identifier: MIT
# The main job in one command: the real firmware, in the simulator, stops a car behind a standing one.
# Needs what `make all` builds; writes trace and figure to build/demo.
set -eu
board=${1:-stc89c516rd}
scenario=tests/loop/standing_car_3mps.scn
out=build/demo
mkdir -p "$out"
live=
[ -t 1 ] && live=--live

echo "fuzzy51: $scenario with build/$board/brake.ihx, run by s51"
build/drive run --hex "build/$board/brake.ihx" --board "$board" --scenario "$scenario" \
    --csv "$out/standing_car_3mps.csv" --vcd "$out/standing_car_3mps.vcd" $live
gnuplot -e "csv='$out/standing_car_3mps.csv'; out='$out/standing_car_3mps.svg'; title='A standing car met at 3 m/s'" \
    tools/report/run.gp
echo "trace:  $out/standing_car_3mps.csv (numbers), $out/standing_car_3mps.vcd (pins, for GTKWave)"
echo "figure: $out/standing_car_3mps.svg"
