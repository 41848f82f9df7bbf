#!/bin/bash
# SPDX-License-Identifier: MIT
# Makes tests/golden/*_fuzzylite.csv anew; takes a minute. `tools/deps.sh golden` installs what it needs.
# fuzzylite takes a centroid as a sum over the midpoints of RESOLUTION stripes, so its answers are compared
# with --exact: the finer, the nearer. The rule of Sugeno systems is MATLAB's own.
set -eu
cd "$(dirname "$0")/../.."
tools/deps.sh golden
golden=tests/golden
build=build/golden
mkdir -p $build
RESOLUTION=100000
how="# made by tests/golden/make_fuzzylite.sh with fuzzylite $(dpkg-query -W -f '${Version}' fuzzylite)"

# FLL POINTS: inputs and outputs, one line a point, separated by commas
evaluate() {
    fuzzylite -i "$1" -if fll -o $build/out.fld -of fld -d "$2" -dheader false -dinputs true -decimals 12
    tr ' ' ',' <$build/out.fld
}

grid() { # FROM STEP TO for either input
    for a in $(seq "$1" "$2" "$3"); do for b in $(seq "$4" "$5" "$6"); do echo "$a $b"; done; done
}

# The system as fuzzylite reads it, with enough decimals, and with the operators KEY=WORD given.
convert() {
    fuzzylite -i "$1" -if fis -o $build/system.fll -of fll -decimals 12
    shift
    sed -i "s/Centroid 100/Centroid $RESOLUTION/" $build/system.fll
    for change in "$@"; do sed -i "s/${change%=*}: .*/${change%=*}: ${change#*=}/" $build/system.fll; done
}

{
    echo "$how, resolution $RESOLUTION"
    echo "# x1,x2,brake of tables/brake.fis"
    grid 1 0.25 5 0 2.5 35 >$build/points.fld
    convert tables/brake.fis
    evaluate $build/system.fll $build/points.fld
} >$golden/brake_fuzzylite.csv

{
    echo "$how, resolution $RESOLUTION"
    echo "# x1,x2,left,right of tests/golden/asym.fis without 'not' in its outcomes, where fuzzylite negates the"
    echo "# strength of the rule, MATLAB the set"
    grid -2 1.4 5 10 20 90 >$build/points.fld
    sed -E '/Rules/,$s/, *-?([0-9]+) -?([0-9]+)/, \1 \2/' $golden/asym.fis >$build/asym.fis
    convert $build/asym.fis
    evaluate $build/system.fll $build/points.fld
} >$golden/surface_fuzzylite.csv

{
    echo "$how"
    echo "# and,or,defuzz,x1,x2,y1,y2 of tests/golden/sugeno.fis"
    grid -2 1 5 10 13.34 90 >$build/points.fld
    for methods in min,max,wtaver,Minimum,Maximum,WeightedAverage prod,probor,wtsum,AlgebraicProduct,AlgebraicSum,WeightedSum; do
        IFS=, read -r and or defuzz conjunction disjunction defuzzifier <<<"$methods"
        convert $golden/sugeno.fis conjunction="$conjunction" disjunction="$disjunction" "defuzzifier=$defuzzifier TakagiSugeno"
        evaluate $build/system.fll $build/points.fld | sed "s/^/$and,$or,$defuzz,/"
    done
} >$golden/sugeno_fuzzylite.csv

# Membership functions that Octave lacks: one rule gives 1, another 0 with strength 1, so the answer is m / (m + 1).
{
    echo "$how"
    echo "# kind,parameters,x,degree/(degree+1); fuzzylite has them as Ramp and Discrete"
    seq -1.3 0.37 11 >$build/points.fld
    while IFS=, read -r kind parameters term; do
        cat >$build/system.fll <<FLL
Engine: mf
InputVariable: x
  range: -2.000 12.000
  term: it $term
  term: all Rectangle -100.000 100.000
OutputVariable: y
  range: 0.000 1.000
  defuzzifier: WeightedAverage TakagiSugeno
  term: one Constant 1.000
  term: none Constant 0.000
RuleBlock: rules
  conjunction: Minimum
  implication: AlgebraicProduct
  activation: General
  rule: if x is it then y is one
  rule: if x is all then y is none
FLL
        evaluate $build/system.fll $build/points.fld | sed "s/^/$kind,$parameters,/"
    done <<MF
linsmf,4 6,Ramp 4 6
linsmf,-1 9.5,Ramp -1 9.5
linzmf,3 8,Ramp 8 3
linzmf,-2 2.2,Ramp 2.2 -2
pwlmf,1 0.2 3 0.9 4 0.9 8 0.1,Discrete 1 0.2 3 0.9 4 0.9 8 0.1
pwlmf,0 1 5 0.5 6 0 9 0.75,Discrete 0 1 5 0.5 6 0 9 0.75
MF
} >$golden/mf_fuzzylite.csv
