#!/bin/sh
# SPDX-License-Identifier: MIT
# One drive to look at: the real firmware of an app in the simulator, on the scenario of tests/loop that
# says `demo = yes` for that app. Needs what `make all` builds; writes trace and figure to build/demo.
#     tools/demo.sh [BOARD [APP]]
set -eu
board=${1:-stc89c516rd}
app=${2:-brake}
out=build/demo
scenario=
# shellcheck disable=SC2013  # names of scenarios have no blanks
for file in $(grep -lr '^demo = yes' tests/loop); do
    of=$(sed -n 's/^app = //p' "$file")
    [ "${of:-brake}" != "$app" ] || scenario=$file
    # a variant, or another of the brake's laws, drives where its controller does
    [ -n "$scenario" ] || [ "${of:-brake}" != "${app%%_*}" ] || scenario=$file
done
if [ ! -f "build/$board/$app.ihx" ]; then
    echo "demo.sh: error: no image build/$board/$app.ihx; APP is one of: $(cd "build/$board" && echo *.ihx | sed 's/\.ihx//g')" >&2
    exit 1
fi
scenario=${scenario:-tests/loop/standing_car_3mps.scn}
name=$(basename "$scenario" .scn)
mkdir -p "$out"
live=
[ -t 1 ] && live=--live

echo "fuzzy51: $scenario with build/$board/$app.ihx, run by s51"
build/drive run --hex "build/$board/$app.ihx" --board "$board" --scenario "$scenario" \
    --csv "$out/$name.csv" --vcd "$out/$name.vcd" $live
build/drive plot "$out/$name.csv" -o "$out/$name.svg"
echo "trace:  $out/$name.csv (numbers), $out/$name.vcd (pins, for GTKWave)"
echo "figure: $out/$name.svg"
