#!/bin/bash
# SPDX-License-Identifier: MIT
# Command lines of fistab eval, check and table: what they print, their exit status, and limits kept quickly.
. tests/lib.sh
fistab=build/fistab

# --- eval
expect eval_prints_ten_digits 0 86.28104575 "" $fistab eval tables/brake.fis 3 10
expect eval_reads_stdin 0 $'86.28104575\n83.71717172\n30' "" bash -c "printf '3 10\n\n%% a comment\n  1.5,\t5 \r\n# another\n4;0' | $fistab eval tables/brake.fis"
expect eval_separates_outputs_by_a_blank 0 '-1.286148249 0.2377658731' "" $fistab eval tests/golden/asym.fis -2 10
expect eval_takes_negative_numbers 0 '-1.286148249 0.2377658731' "" $fistab eval --samples=101 tests/golden/asym.fis -2 10
expect eval_exactly 0 85.93583622 "" $fistab eval --exact tables/brake.fis 1.02 0.175
expect eval_shows_the_rules_that_fire 0 $'86.28104575\n% 1 tables/brake.fis:56: if distance_m is fairly_near and closing_mps is small then brake_pct is very_large' "" $fistab eval --rules tables/brake.fis 3 10
expect eval_shows_or_and_not 0 "% 0.0198 tests/golden/asym.fis:53: if first is not middle and second is not slow then left is down, right is not on" "" bash -c "$fistab eval --rules tests/golden/asym.fis -1 30 | tail -1"
expect eval_warns_outside_the_range 0 83.71717172 "distance_m = 0.5 is outside its range of 1 to 5" $fistab eval tables/brake.fis 0.5 10
expect eval_warns_where_no_rule_fires 0 50 "no rule fires for 'brake_pct'; the answer is the middle of its range" $fistab eval tables/brake.fis 9 10
expect eval_counts_numbers 1 "" "brake.fis: error: give 2 numbers, not 1; the system has so many inputs" $fistab eval tables/brake.fis 3
expect eval_refuses_words 1 "" "'ten' is not a number" $fistab eval tables/brake.fis 3 ten
expect eval_refuses_infinity 1 "" "'inf' is not a number" $fistab eval tables/brake.fis 3 inf
expect eval_names_the_line_of_stdin 1 86.28104575 "stdin:2: error: give 2 numbers, not 1; the system has so many inputs" bash -c "printf '3 10\n3\n' | $fistab eval tables/brake.fis"
expect eval_names_long_lines_of_stdin 1 "" "stdin:1: error: more than 2 numbers" bash -c "echo 3 10 4 | $fistab eval tables/brake.fis"
expect eval_of_a_missing_file 1 "" "no_such.fis: error: cannot read: No such file" $fistab eval no_such.fis 1
expect eval_of_a_folder 1 "" "tables: error: cannot read: Is a directory" $fistab eval tables 1
expect eval_of_an_empty_file 1 "" "there is no [System] section; is this a .fis file?" $fistab eval /dev/null 1
expect eval_to_a_full_disk 1 '*' "cannot write" bash -c "$fistab eval tables/brake.fis 3 10 >/dev/full"

# --- usage
expect no_command 2 "" "Usage: fistab COMMAND" $fistab
expect unknown_command 2 "" "there is no command 'evl'" $fistab evl
expect help_of_all 0 '*' "" $fistab --help
expect help_of_eval 0 '*' "" $fistab eval --help
expect help_of_check 0 '*' "" $fistab check --help
expect help_of_table 0 '*' "" $fistab table --help
expect version 0 "fuzzy51 1.0" "" $fistab --version
expect version_of_table 0 "fuzzy51 1.0" "" $fistab table --version
expect no_file 2 "" "Usage: fistab eval" $fistab eval
expect unknown_option 2 "" "unrecognized option '--sample-count" $fistab eval --sample-count=3 tables/brake.fis
expect samples_too_few 2 "" "--samples=1: give a whole number from 2 to 100001" $fistab eval --samples=1 tables/brake.fis 3 10
expect samples_no_number 2 "" "--samples=many" $fistab eval --samples=many tables/brake.fis 3 10
expect grid_no_numbers 2 "" "--grid=10by10: give one number an input" $fistab table --grid=10by10 tables/brake.fis
expect grid_of_zero 2 "" "--grid=0x10" $fistab table --grid=0x10 tables/brake.fis
expect grid_for_other_inputs 2 "" "--grid has 3 numbers, but the system has 2 inputs" $fistab table --grid=10x10x10 tables/brake.fis
expect levels_too_many 2 "" "--levels=256: give a whole number from 1 to 255" $fistab table --levels=256 tables/brake.fis
expect name_no_identifier 2 "" "--name=3d: give a C identifier" $fistab table --name=3d tables/brake.fis
expect encoding_unknown 2 "" "--encoding=zip" $fistab table --encoding=zip tables/brake.fis
expect law_unreadable 2 "" "--monotone=up" $fistab check --monotone=up tables/brake.fis
expect law_of_other_inputs 2 "" "names input 3, but the system has 2 inputs" $fistab check --monotone=-1,+3 tables/brake.fis
expect two_files 2 "" "one FILE.fis at a time; 'tables/gap.fis' is one too many" $fistab check tables/brake.fis tables/gap.fis

# --- check
expect brake_breaks_the_law 1 "" "(monotone) 'brake_pct' breaks -1,+2 between 650 pairs of neighbours; worst, it is 77 at distance_m = 4.98" $fistab check --monotone=-1,+2 tables/brake.fis
expect brake_prod_obeys_the_law 0 "" "" $fistab check --monotone=-1,+2 tables/brake_prod.fis
expect brake_prod_obeys_it_finer 0 "" "" $fistab check --monotone=-1,+2 --grid=400x400 --levels=255 tables/brake_prod.fis
expect brake_prod_obeys_it_exactly 0 "" "" $fistab check --monotone=-1,+2 --exact --levels=255 tables/brake_prod.fis
check coverage_has_a_line_for_each_rule test "$($fistab check --coverage tables/brake.fis | wc -l)" -eq 16

# --- table
$fistab table tables/brake.fis -o "$out/a.h" --csv="$out/a.csv"
(cd tables && ../$fistab table brake.fis -o ../"$out/b.h" --csv=../"$out/b.csv")
$fistab table tables/brake.fis >"$out/stdout.h"
faultless same_input_same_bytes "$(cmp "$out/a.h" "$out/b.h"; cmp "$out/a.csv" "$out/b.csv"; cmp "$out/a.h" "$out/stdout.h")"
faultless csv_has_a_line_for_each_cell "$([ "$(wc -l <"$out/a.csv")" -eq 10001 ] || echo 'not 10,001 lines')"
faultless csv_names_its_columns "$([ "$(head -1 "$out/a.csv")" = '"distance_m","closing_mps","brake_pct"' ] || head -1 "$out/a.csv")"
faultless csv_goes_row_by_row "$([ "$(sed -n '102p' "$out/a.csv")" = 1.06,0.175,86 ] || sed -n '102p' "$out/a.csv")"
faultless header_and_csv_hold_the_same "$(diff <(tail -n +2 "$out/a.csv" | cut -d, -f3) <(sed -n '/out1/,/^}/p' "$out/a.h" | tail -n +2 | grep -oE '[0-9]+') | head -3)"
expect table_only_as_csv 0 "" "" $fistab table tables/brake.fis --csv="$out/c.csv"
expect no_folder_to_write_to 1 "" "$out/no/such.h: error: cannot write" $fistab table tables/brake.fis -o "$out/no/such.h"
expect no_folder_for_the_second_file 1 "" "cannot write" $fistab table tables/brake.fis --csv="$out/new.csv" -o "$out/no/such.h"
faultless nothing_half_written "$(compgen -G "$out/*new*")$(compgen -G "$out/*such*")"
expect grid_too_large 1 "" "a grid of more than 16777216 cells is beyond fistab's limit" $fistab table --grid=5000x5000 tables/brake.fis

# Headers of one to four inputs and two outputs compile, for the host and for the chip.
header_of() { # INPUTS OPTION...
    local inputs=$1 i
    shift
    {
        echo "[System]"
        echo "Type='sugeno'"
        echo "DefuzzMethod='wtaver'"
        for ((i = 1; i <= inputs; i++)); do printf "[Input%d]\nName='in */ \"%d\" \\\\'\nRange=[0 %d.5]\n" $i $i $i; done
        for i in 1 2; do printf "[Output%d]\nName='out /* %d'\nRange=[0 100]\nMF1='p':'linear',[%s 3]\n" $i $i "$(yes 1 | head -"$inputs" | tr '\n' ' ')"; done
        echo "[Rules]"
        echo "$(yes 0 | head -"$inputs" | tr '\n' ' '), 1 1 (1) : 1"
    } >"$out/inputs$inputs.fis"
    $fistab table --name=lut "$@" -o "$out/lut_table.h" "$out/inputs$inputs.fis" 2>&1 || return
    cat >"$out/lut.c" <<'C'
#include <stdint.h>
#ifndef __SDCC
#define __code
#endif
#define LUT_DATA
#include "lut_table.h"
#if !defined LUT_INPUTS || LUT_OUTPUTS != 2 || LUT_PACKED != 0 || LUT_IN1_CELLS < 1
#error "a macro is missing"
#endif
uint8_t first(void);
uint8_t first(void)
{
    const __code uint8_t *a = (const __code uint8_t *)lut_out1, *b = (const __code uint8_t *)lut_out2;
    return (uint8_t)(a[sizeof lut_out1 - 1] + b[0] + (sizeof lut_out1 + sizeof lut_out2 == LUT_BYTES ? 0 : 1));
}
C
    gcc -std=c11 -Wall -Wextra -Wconversion -Werror -c "$out/lut.c" -o "$out/lut.o" 2>&1
    sdcc -mmcs51 --std-c11 --model-small --Werror -c "$out/lut.c" -o "$out/lut.rel" 2>&1
}
faultless header_of_one_input "$(header_of 1)"
faultless header_of_two_inputs "$(header_of 2 --grid=7x3 --levels=255)"
faultless header_of_three_inputs "$(header_of 3 --grid=5x4x3)"
faultless header_of_four_inputs "$(header_of 4 --grid=2x3x4x5 --nodes)"
faultless header_of_five_inputs_is_refused "$(header_of 5 2>&1 | grep -q '5 inputs; a table has at most 4' || echo 'not refused')"

# --- limits: an answer or a message, within seconds of processor time
# quick NAME SECONDS STATUS STDERR COMMAND...
quick() {
    local name=$1 seconds=$2 status=$3 stderr=$4 wrong='' code
    shift 4
    (ulimit -t "$seconds" && "$@" >"$out/stdout" 2>"$out/stderr")
    code=$?
    [ $code -eq "$status" ] || wrong="exit status $code, not $status: $(head -c 300 "$out/stderr")"
    [ -z "$stderr" ] || grep -qF -- "$stderr" "$out/stderr" || wrong="did not say '$stderr' but: $(head -c 300 "$out/stderr")"
    faultless "$name" "$wrong"
}

# big INPUTS SETS RULES: a system of that size; rules differ, as numbers to the base SETS do.
big() {
    awk -v inputs="$1" -v sets="$2" -v rules="$3" 'BEGIN {
        printf "[System]\nName=\"big\"\nNumInputs=%d\nNumOutputs=1\nNumRules=%d\n", inputs, rules
        for (i = 1; i <= inputs; i++) {
            printf "[Input%d]\nName=\"x%d\"\nRange=[0 %d]\nNumMFs=%d\n", i, i, sets, sets
            for (k = 1; k <= sets; k++) printf "MF%d=\"s%d\":\"trimf\",[%d %g %d]\n", k, k, k - 2, k - 0.5, k + 1
        }
        printf "[Output1]\nName=\"y\"\nRange=[0 1]\nNumMFs=2\nMF1=\"a\":\"trimf\",[0 0 1]\nMF2=\"b\":\"gaussmf\",[0.2 1]\n[Rules]\n"
        for (r = 0; r < rules; r++) {
            n = r
            for (i = 1; i <= inputs; i++) { printf "%d ", n % sets + 1; n = int(n / sets) }
            printf ", %d (1) : 1\n", r % 2 + 1
        }
    }'
}
big 64 2 20 >"$out/inputs64.fis"
big 65 2 20 >"$out/inputs65.fis"
big 3 10 1000 >"$out/rules1000.fis"
big 2 100 20000 >"$out/rules20000.fis"
big 2 150 20001 >"$out/rules20001.fis"
big 2 1000 1000 >"$out/sets1000.fis"
big 2 1001 10 >"$out/sets1001.fis"
mapfile -t ones < <(yes 1 | head -64)
quick inputs_64 5 0 "" $fistab eval "$out/inputs64.fis" "${ones[@]}"
quick inputs_64_check 20 1 "" $fistab check "$out/inputs64.fis"
quick inputs_65 5 1 "NumInputs=65 is more than fistab's limit of 64" $fistab check "$out/inputs65.fis"
quick rules_1000 5 0 "" $fistab eval "$out/rules1000.fis" 1 2 3
quick rules_1000_check 20 0 "" $fistab check "$out/rules1000.fis"
quick rules_1000_table 20 0 "" $fistab table "$out/rules1000.fis" -o "$out/rules1000.h"
quick rules_20000 5 0 "" $fistab eval "$out/rules20000.fis" 1 2
quick rules_20001 5 1 "NumRules=20001 is more than fistab's limit of 20000" $fistab eval "$out/rules20001.fis" 1 2
sed -i '/NumRules/d' "$out/rules20001.fis"
quick rules_20001_uncounted 5 1 "more than 20000 rules, fistab's limit" $fistab eval "$out/rules20001.fis" 1 2
quick sets_1000 5 0 "" $fistab eval "$out/sets1000.fis" 1 2
quick sets_1000_check 20 1 "" $fistab check "$out/sets1000.fis"
quick sets_1001 5 1 "NumMFs=1001 is more than fistab's limit of 1000" $fistab check "$out/sets1001.fis"
{ cat tables/brake.fis; yes '% padding, padding, padding' | head -c 10000000; } >"$out/10mb.fis"
quick file_of_10_mb 5 0 "" $fistab check "$out/10mb.fis"
{ cat tables/brake.fis; yes '% padding, padding, padding' | head -c 17000000; } >"$out/17mb.fis"
quick file_of_17_mb 5 1 "larger than 16777216 bytes, the limit" $fistab check "$out/17mb.fis"
head -c 10000000 /dev/zero | tr '\0' 'x' >"$out/line.fis"
quick line_of_10_mb 5 1 "expected Key=value" $fistab check "$out/line.fis"
{ sed '/MF1=.very_near/,$d' tables/brake.fis; printf "MF1='a':'pwlmf',["; yes '0 0' | head -c 10000000 | tr '\n' ' '; echo ']'; } >"$out/numbers.fis"
quick list_of_10_mb 5 1 "more than 2000 numbers in one set, fistab's limit" $fistab check "$out/numbers.fis"
yes "[Rules" | head -c 10000000 >"$out/sections.fis"
quick sections_of_10_mb 5 1 "a section is written" $fistab check "$out/sections.fis"
head -c 1000000 /dev/zero >"$out/zero.fis"
quick zero_bytes 5 1 "holds a zero byte; save it as plain text, not as UTF-16" $fistab check "$out/zero.fis"
printf '%s' "$(cat tables/brake.fis)" | iconv -f UTF-8 -t UTF-16 >"$out/utf16.fis"
quick utf16 5 1 "holds a zero byte; save it as plain text, not as UTF-16" $fistab check "$out/utf16.fis"
# --- what make fuzz found
quick exact_negation 2 0 "" $fistab eval --exact tests/fuzz/slow_negation.fis 5 12
quick exact_bisector 2 0 "" $fistab eval --exact tests/fuzz/slow_bisector.fis 9 -1.5
quick exact_needle 2 0 "" $fistab eval --exact tests/fuzz/slow_needle.fis -1.15625 0.65625
finish
