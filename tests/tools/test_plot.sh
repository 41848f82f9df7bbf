#!/bin/bash
# fistab plot: what is on the picture, and what is said when there can be none.
set -u
work=$(mktemp -d build/test_plot.XXXXXX)
trap 'rm -rf "$work"' EXIT
failed=0

check() { # NAME COMMAND...
    local name=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        echo "tests/tools/test_plot.sh:${BASH_LINENO[0]}:$name:PASS"
    else
        echo "tests/tools/test_plot.sh:${BASH_LINENO[0]}:$name:FAIL: $(tr '\n' ' ' <"$work/said" | cut -c1-300)"
        failed=1
    fi
}

plot() { build/fistab plot "$@"; }
says() { # FILE TEXT...: every text stands in the SVG
    local file=$1
    shift
    for text in "$@"; do
        grep -qF -- "$text" "$file" || { echo "no '$text' in $file"; return 1; }
    done
}
lacks() { ! says "$@"; }
status_is() { # STATUS COMMAND...
    local wanted=$1 got=0
    shift
    "$@" || got=$?
    [ "$got" -eq "$wanted" ] || { echo "exit status $got"; return 1; }
}

check brake_as_svg plot tables/brake.fis -o "$work/brake.svg"
check svg_is_whole says "$work/brake.svg" '<svg' '</svg>'
check axes_have_names_and_units says "$work/brake.svg" 'distance (m)' 'closing (m/s)' 'brake (%)'
check sets_have_names says "$work/brake.svg" 'very near' 'fairly near' 'medium' 'moderate' 'very large'
# 40 by 40 squares of the surface
check surface_is_drawn test "$(grep -c '<polygon' "$work/brake.svg")" -ge 1600
check same_input_same_bytes plot tables/brake.fis -o "$work/again.svg"
check same_bytes cmp "$work/brake.svg" "$work/again.svg"

check sets_alone plot tables/brake.fis --sets -o "$work/sets.svg"
check sets_alone_have_names says "$work/sets.svg" 'very near' 'very large'
check sets_alone_have_no_surface lacks "$work/sets.svg" '<polygon'

check brake_as_png plot tables/brake.fis -o "$work/brake.png"
check png_is_one test "$(head -c 8 "$work/brake.png" | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a

check one_input_is_a_curve plot tests/lut/one_input.fis -o "$work/one.svg"
check its_constants_have_names says "$work/one.svg" none most dent

check three_inputs_are_a_slice plot tables/follow.fis -o "$work/follow.svg"
check slice_says_where says "$work/follow.svg" ' at 0'
check other_axes plot tables/follow.fis --axes=1,3 -o "$work/axes.svg"

check bad_axes_are_usage status_is 2 plot tables/brake.fis --axes=1,3 -o "$work/bad.svg"
check same_axis_twice_is_usage status_is 2 plot tables/brake.fis --axes=2,2 -o "$work/bad.svg"
check other_endings_are_usage status_is 2 plot tables/brake.fis -o "$work/bad.pdf"
check no_output_is_usage status_is 2 plot tables/brake.fis
check no_file_is_bad_input status_is 1 plot "$work/none.fis" -o "$work/bad.svg"
no_gnuplot() {
    status_is 1 env PATH="$work" "$PWD/build/fistab" plot tables/brake.fis -o "$work/bad.svg" \
        2>"$work/message" && says "$work/message" 'install the package gnuplot-nox'
}
check no_gnuplot_names_the_package no_gnuplot
check nothing_is_left_behind test -z "$(ls "$work" | grep bad)"
exit "$failed"
