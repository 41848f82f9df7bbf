#!/bin/bash
# SPDX-License-Identifier: MIT
# Makes the first inputs of fuzz_readers from files of the tree and from what SDCC makes here:
#     tests/fuzz/readers.sh FOLDER
set -eu
cd "$(dirname "$0")/../.."
mkdir -p "$1" build/fuzz
sdcc -mmcs51 tests/bound/ratio.c -o build/fuzz/ratio.ihx
{ printf H; cat build/fuzz/ratio.ihx; } >"$1/image"
for listing in map rst; do
    { printf L; cat build/fuzz/ratio.ihx; printf '\001'; cat "build/fuzz/ratio.$listing"; } >"$1/$listing"
done
for scenario in tests/loop/*.scn tests/loop/{follow,park,radar,gap}/*.scn tests/bad/*.scn; do
    { printf S; cat "$scenario"; } >"$1/$(tr / _ <<<"$scenario")"
done
# shellcheck disable=SC2016  # the dump's own words
{
    printf 'V '
    printf '%s\n' '$timescale 1ns $end' '$scope module s51 $end' '$var wire 8 a P1 $end' '$var wire 1 b P3_2 $end' \
        '$upscope $end' '$enddefinitions $end' '$dumpvars' 'b11111111 a' '1b' '$end' '#1000' 'b101 a' '#2000' '0b' 'xb'
} >"$1/dump"
{
    printf 'U '
    printf '%s\r\n' '# fuzzy51 board=stc89c516rd app=brake table=1A2B reset=power' 'seq,ms,dist_mm,closing_mmps,state,fault' \
        '1,60,4999,-12,CONTROL,-' '2,120,,,FAULT,no_echo'
} >"$1/lines"
