#!/bin/bash
# SPDX-License-Identifier: MIT
# Writes tests/golden/debian_examples.txt: what fuzzylite makes of the examples that its Debian package ships, in its
# three formats, at some points; or the feature for which fistab refuses the file. `tools/deps.sh golden` installs
# fuzzylite. tests/tools/test_debian_examples.sh holds fistab to it.
set -eu
cd "$(dirname "$0")/../.."
tools/deps.sh golden
build=$PWD/build/golden
mkdir -p "$build"
examples=/usr/share/doc/fuzzylite/examples

# The ranges of the inputs or of the outputs, one line each: "low high".
ranges() { # inputs|outputs FILE
    awk -v wanted="$1" '
        /^ *\[Input|^InputVariable|^FUZZIFY/ { side = "inputs" }
        /^ *\[Output|^OutputVariable|^DEFUZZIFY/ { side = "outputs" }
        /^ *\[Rules|^RuleBlock|^RULEBLOCK/ { side = "" }
        /^ *(Range *=|range:|RANGE)/ && side == wanted {
            gsub(/Range *=|range:|RANGE|:=|\.\./, " "); gsub(/\[|\]|[();,\r]/, " "); print $1, $2
        }' "$2"
}

# 12 points spread over the inputs, off the feet of most sets
points() {
    awk '{ low[NR] = $1; high[NR] = $2 } END {
        for (k = 0; k < 12; k++) {
            for (i = 1; i <= NR; i++) {
                share = (k + 0.37) * (i == 1 ? 1 / 12 : 0.6180339887 + 0.07 * i); share -= int(share)
                printf "%s%.9f", (i > 1 ? " " : ""), low[i] + (high[i] - low[i]) * share
            }
            print ""
        } }'
}

# fuzzylite at the points. A .fis has MATLAB's sampling, so fuzzylite samples it finely, and fistab integrates.
evaluate() { # FILE
    local file=$1 format=${1##*.}
    if [ "$format" = fis ]; then
        fuzzylite -i "$file" -if fis -o "$build/system.fll" -of fll -decimals 12 >/dev/null 2>&1
        sed -i -E 's/(Centroid|OfMaximum) [0-9]+/\1 100000/' "$build/system.fll"
        file=$build/system.fll format=fll
    fi
    fuzzylite -i "$file" -if "$format" -o "$build/out.fld" -of fld -d "$build/points.fld" -dheader false \
        -dinputs false -decimals 12 >/dev/null 2>&1
}

{
    echo "# made by tests/golden/make_debian_examples.sh with fuzzylite $(dpkg-query -W -f '${Version}' fuzzylite)"
    echo "# system FILE, then for each point: inputs | outputs of fuzzylite; range: of each output; refused FILE: why"
    (cd "$examples" && find . -name '*.fis' -o -name '*.fll' -o -name '*.fcl') | sed 's|^\./||' | LC_ALL=C sort | while read -r file; do
        said=$(build/fistab eval "$examples/$file" </dev/null 2>&1) || {
            echo "refused $file: ${said#"$examples/$file:"}"
            continue
        }
        echo "system $file"
        ranges outputs "$examples/$file" | awk '{ printf "%s%.9g", (NR > 1 ? " " : "range "), $2 - $1 } END { print "" }'
        ranges inputs "$examples/$file" | points >"$build/points.fld"
        evaluate "$examples/$file"
        paste -d'|' "$build/points.fld" "$build/out.fld" | sed 's/|/ | /; s/ *$//'
    done
} >tests/golden/debian_examples.txt
