#!/bin/bash
# SPDX-License-Identifier: MIT
# Writes tests/golden/debian_examples.txt: what fistab makes of every .fis file that Debian's packages fuzzylite and
# octave-fuzzy-logic-toolkit ship, against these programs themselves. `tools/deps.sh golden` installs them.
set -eu
cd "$(dirname "$0")/../.."
tools/deps.sh golden
build=$PWD/build/golden
mkdir -p "$build"
fistab=build/fistab

# Largest difference of two files of numbers, in shares of the ranges in $build/ranges.
difference() {
    paste -d' ' "$1" "$2" | awk -v ranges="$(cat "$build/ranges")" '
        BEGIN { n = split(ranges, range, " ") }
        { for (i = 1; i <= n; i++) { d = $i - $(i + n); if (d < 0) d = -d; if (d == d && d / range[i] > most) most = d / range[i] } }
        END { printf "%.1e", most }'
}

compare() { # FILE
    local inputs
    inputs=$(grep -c '^ *\[Input' "$1")
    grep -A4 '^ *\[Input[0-9]*\]' "$1" | tr -d '\r' | sed -n 's/.*Range *= *\[ *\([^ ,]*\)[ ,]*\([^] ]*\).*/\1 \2/p' >"$build/inputs"
    awk '/\[Output/ { on = 1 } /\[Rules/ { on = 0 } on && /Range/' "$1" | tr -d '\r' |
        sed -n 's/.*Range *= *\[ *\([^ ,]*\)[ ,]*\([^] ]*\).*/\1 \2/p' | awk '{ printf "%s ", $2 - $1 }' >"$build/ranges"
    # 12 points a side, inside the range, off the feet of most sets
    awk -v n="$inputs" '{ low[NR] = $1; high[NR] = $2 } END {
        for (i = 0; i < (n == 1 ? 144 : 12); i++) for (j = 0; j < (n == 1 ? 1 : 12); j++) {
            a = low[1] + (high[1] - low[1]) * (i + 0.37) / (n == 1 ? 144 : 12); b = low[2] + (high[2] - low[2]) * (j + 0.37) / 12
            if (n == 1) printf "%.9f\n", a; else printf "%.9f %.9f\n", a, b } }' "$build/inputs" >"$build/points.fld"

    "$fistab" eval "$1" <"$build/points.fld" >"$build/sampled" 2>/dev/null
    "$fistab" eval --exact "$1" <"$build/points.fld" >"$build/exact" 2>/dev/null

    fuzzylite -i "$1" -if fis -o "$build/system.fll" -of fll -decimals 12 2>/dev/null
    sed -i 's/Centroid 100/Centroid 100000/' "$build/system.fll"
    fuzzylite -i "$build/system.fll" -if fll -o "$build/out.fld" -of fld -d "$build/points.fld" -dheader false -dinputs false -decimals 12
    printf '    fuzzylite, 100,000 midpoints: %s of the range from --exact' "$(difference "$build/exact" "$build/out.fld")"
    grep -q nan "$build/out.fld" && printf ' (it says nan at %d of 144 points)' "$(grep -c nan "$build/out.fld")"
    echo

    rm -f "$build/octave"
    FIS=$1 BUILD=$build octave-cli --no-gui --quiet --eval '
        warning ("off", "all"); pkg load fuzzy-logic-toolkit;
        fis = readfis (getenv ("FIS")); points = load (fullfile (getenv ("BUILD"), "points.fld"));
        out = fopen (fullfile (getenv ("BUILD"), "octave"), "w");
        for p = points'"'"'
          [y, ~, ~, mu] = evalfis (p'"'"', fis, 101);
          if (strcmp (fis.type, "mamdani") && strcmp (fis.defuzzMethod, "centroid"))
            for o = 1 : columns (mu)
              x = linspace (fis.output(o).range(1), fis.output(o).range(2), 101)'"'"';
              y(o) = sum (x .* mu(:, o)) / sum (mu(:, o));
            endfor
          endif
          fprintf (out, "%.12g ", y); fprintf (out, "\n");
        endfor' >"$build/octave.log" 2>&1 || true
    if [ ! -f "$build/octave" ] || [ "$(wc -l <"$build/octave")" -ne 144 ]; then
        echo "    Octave refuses it: $(grep -m1 '^error' "$build/octave.log")"
    else
        echo "    Octave, MATLAB's centroid of its sets: $(difference "$build/sampled" "$build/octave") of the range"
    fi
}

{
    echo "# made by tests/golden/make_debian_examples.sh with fuzzylite $(dpkg-query -W -f '${Version}' fuzzylite), octave-fuzzy-logic-toolkit $(dpkg-query -W -f '${Version}' octave-fuzzy-logic-toolkit)"
    cat <<'NOTES'
# 144 points a system. "Refused" are the files that are not plain MATLAB: types, operators and functions of the other
# programs, or fuzzylite's memory of the last output (LockPrevious=1). Differences below 5e-9 of the range are the ten
# digits that eval prints. Those that are larger, one by one:
# - heart_disease_risk and linear_tip_calculator with AggMethod 'max', 3e-2: for a Sugeno system Octave merges rules of
#   one outcome by AggMethod; MATLAB, fuzzylite and fistab add their strengths whatever AggMethod says. The originals,
#   with 'sum', agree.
# Octave refuses: 'probor', which it has under another name; files with fuzzylite's keys.
NOTES
    for fis in $(find /usr/share/octave/packages/fuzzy-logic-toolkit-* /usr/share/doc/fuzzylite/examples -name '*.fis' | sort); do
        echo "${fis#/usr/share/}"
        points=$(grep -c '^ *\[Input' "$fis")
        if yes 0 | head -"$points" | tr '\n' ' ' | "$fistab" eval "$fis" >/dev/null 2>"$build/stderr" || ! grep -q 'error:' "$build/stderr"; then
            compare "$fis"
        else
            echo "    refused: $(sed 's/.*\.fis:/line /' "$build/stderr" | head -1)"
        fi
    done
} >tests/golden/debian_examples.txt
