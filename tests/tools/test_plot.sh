#!/bin/bash
# SPDX-License-Identifier: MIT
# fistab plot: what is on the picture, and what is said when there can be none.
. tests/lib.sh

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

check brake_as_svg plot tables/brake.fis -o "$out/brake.svg"
check svg_is_whole says "$out/brake.svg" '<svg' '</svg>'
check axes_have_names_and_units says "$out/brake.svg" 'distance (m)' 'closing (m/s)' 'brake (%)'
check sets_have_names says "$out/brake.svg" 'very near' 'fairly near' 'medium' 'moderate' 'very large'
# 40 by 40 squares of the surface
check surface_is_drawn test "$(grep -c '<polygon' "$out/brake.svg")" -ge 1600
check same_input_same_bytes plot tables/brake.fis -o "$out/again.svg"
check same_bytes cmp "$out/brake.svg" "$out/again.svg"

check sets_alone plot tables/brake.fis --sets -o "$out/sets.svg"
check sets_alone_have_names says "$out/sets.svg" 'very near' 'very large'
check sets_alone_have_no_surface lacks "$out/sets.svg" '<polygon'

check brake_as_png plot tables/brake.fis -o "$out/brake.png"
check png_is_one test "$(head -c 8 "$out/brake.png" | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a

check one_input_is_a_curve plot tests/lut/one_input.fis -o "$out/one.svg"
check its_constants_have_names says "$out/one.svg" none most dent

check three_inputs_are_a_slice plot tables/follow.fis -o "$out/follow.svg"
check slice_says_where says "$out/follow.svg" ' at 0'
check other_axes plot tables/follow.fis --axes=1,3 -o "$out/axes.svg"

check bad_axes_are_usage status_is 2 plot tables/brake.fis --axes=1,3 -o "$out/bad.svg"
check same_axis_twice_is_usage status_is 2 plot tables/brake.fis --axes=2,2 -o "$out/bad.svg"
check other_endings_are_usage status_is 2 plot tables/brake.fis -o "$out/bad.pdf"
check no_output_is_usage status_is 2 plot tables/brake.fis
check no_file_is_bad_input status_is 1 plot "$out/none.fis" -o "$out/bad.svg"
no_gnuplot() {
    status_is 1 env PATH="$out" "$PWD/build/fistab" plot tables/brake.fis -o "$out/bad.svg" \
        2>"$out/message" && says "$out/message" 'install the package gnuplot-nox'
}
check no_gnuplot_names_the_package no_gnuplot
check nothing_is_left_behind test -z "$(compgen -G "$out/bad*")"
finish
