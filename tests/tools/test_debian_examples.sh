#!/bin/bash
# SPDX-License-Identifier: MIT
# The examples of Debian's package fuzzylite, in its three formats: fistab gives what fuzzylite gave
# (tests/golden/debian_examples.txt) within 1e-6 of the range, or refuses the file with the reason recorded there.
. tests/lib.sh
examples=/usr/share/doc/fuzzylite/examples
recorded=tests/golden/debian_examples.txt

if [ ! -d "$examples" ]; then
    say examples_are_there 1 "no $examples; install them by: tools/deps.sh test"
    finish
fi

# The largest difference of outputs GOT to EXPECTED in shares of the ranges; fuzzylite says nan where no rule fires.
difference() { # RANGES EXPECTED GOT
    paste -d' ' "$2" "$3" | awk -v ranges="$1" '
        BEGIN { n = split(ranges, range, " ") }
        NF != 2 * n { print "line " NR " has " NF " numbers, not " 2 * n; bad = 1; exit }
        { for (i = 1; i <= n; i++) if ($i != "nan") { d = ($i - $(i + n)) / range[i]; if (d < 0) d = -d; if (!(d <= most)) most = d; count++ } }
        END { if (!bad && (count == 0 || !(most < 1e-6))) print most " of the range at " count " values" }'
}

compare() { # FILE RANGES, the points in $out/points
    local option=
    [ "${1##*.}" != fis ] || option=--exact
    cut -d'|' -f1 "$out/points" >"$out/inputs"
    cut -d'|' -f2 "$out/points" >"$out/expected"
    # shellcheck disable=SC2086  # no option, or one
    build/fistab eval $option "$examples/$1" <"$out/inputs" >"$out/got" 2>/dev/null
    faultless "$1" "$(difference "$2" "$out/expected" "$out/got")"
}

file=
: >"$out/points"
while read -r word rest; do
    case $word in
    \#*) continue ;;
    range) ranges=$rest && continue ;;
    system | refused)
        [ -z "$file" ] || compare "$file" "$ranges"
        file= && : >"$out/points"
        if [ "$word" = system ]; then
            file=$rest
        else
            said=$(build/fistab eval "$examples/${rest%%: *}" </dev/null 2>&1)
            faultless "${rest%%: *}" "$([[ "$said" == *"${rest#*: }" ]] || echo "said $said")"
        fi
        ;;
    *) echo "$word $rest" >>"$out/points" ;;
    esac
done <"$recorded"
[ -z "$file" ] || compare "$file" "$ranges"
faultless every_example_is_recorded "$(find "$examples" -name '*.f[ci]s' -o -name '*.f[cl]l' | wc -l | grep -vx "$(grep -cE '^(system|refused) ' $recorded)")"
finish
