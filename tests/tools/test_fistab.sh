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
expect eval_counts_numbers 2 "" "brake.fis: error: give 2 numbers, one for each input, not 1" $fistab eval tables/brake.fis 3
expect eval_refuses_words 2 "" "'ten' is not a number" $fistab eval tables/brake.fis 3 ten
expect eval_refuses_infinity 2 "" "'inf' is not a number" $fistab eval tables/brake.fis 3 inf
expect eval_names_the_line_of_stdin 1 86.28104575 "stdin:2: error: give 2 numbers, one for each input, not 1" bash -c "printf '3 10\n3\n' | $fistab eval tables/brake.fis"
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
expect grid_no_numbers 2 "" "--grid=10by10: give a number for each input" $fistab table --grid=10by10 tables/brake.fis
expect grid_of_zero 2 "" "--grid=0x10" $fistab table --grid=0x10 tables/brake.fis
expect grid_for_other_inputs 2 "" "--grid has 3 numbers, but the system has 2 inputs" $fistab table --grid=10x10x10 tables/brake.fis
expect levels_too_many 2 "" "--levels=256: give a whole number from 1 to 255" $fistab table --levels=256 tables/brake.fis
expect name_no_identifier 2 "" "--name=3d: give a C identifier" $fistab table --name=3d tables/brake.fis
expect encoding_unknown 2 "" "--encoding=zip" $fistab table --encoding=zip tables/brake.fis
expect law_unreadable 2 "" "--monotone=up" $fistab check --monotone=up tables/brake.fis
expect law_of_other_inputs 2 "" "names input 3, but the system has 2 inputs" $fistab check --monotone=-1,+3 tables/brake.fis
expect two_files 2 "" "one FILE at a time; 'tables/gap.fis' is one too many" $fistab check tables/brake.fis tables/gap.fis

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
faultless header_of_one_input "$(header_of 1 --target=c)"
faultless header_of_two_inputs "$(header_of 2 --target=c --grid=7x3 --levels=255)"
faultless header_of_three_inputs "$(header_of 3 --grid=5x4x3)"
faultless header_of_four_inputs "$(header_of 4 --target=c --grid=2x3x4x5 --nodes)"
faultless header_of_five_inputs_is_refused "$(header_of 5 --target=c 2>&1 | grep -q '5 inputs; a table has at most 4' || echo 'not refused')"

# What firmware/lib/lut.c cannot look up is refused, with a way out.
fits_lut() { # NAME MESSAGE COMMAND...: refused as a header, but fine for --target=c and as CSV
    local name=$1 message=$2
    shift 2
    refuses "$name" 1 "$message" "$@" -o "$out/lut.h"
    faultless "${name}_leaves_nothing" "$(ls "$out/lut.h" 2>/dev/null)"
    check "${name}_for_other_programs" "$@" --target=c -o "$out/any.h"
    check "${name}_as_csv" "$@" "--csv=$out/any.csv"
}
fits_lut two_outputs "2 outputs, but the firmware's look-up takes 1 of a table with 2 inputs; make a system for each output, or give --target=c" $fistab table tests/good/two_outputs.fis
fits_lut four_inputs "4 inputs, but the firmware's look-up takes at most 3; give --target=c" $fistab table "$out/inputs4.fis" --grid=2x2x2x2
fits_lut wide_grid "257 cells along 'closing_mps', but the firmware's look-up takes at most 256" $fistab table tables/brake.fis --grid=10x257
fits_lut large_table "a table of 65536 bytes leaves no room for a program" $fistab table tables/brake.fis --grid=256x256
refuses target_unknown 2 "--target=avr: give lut or c" $fistab table --target=avr tables/brake.fis

# --- a law for each output
rises() { # COLUMN FILE.csv: does the column rise all the way within each row of the table?
    awk -F, -v c="$1" 'NR > 2 && $1 == row && $c < last { bad++ } { row = $1; last = $c } END { exit bad > 0 || NR != 10001 }' "$2"
}
$fistab table tests/golden/asym.fis --repair=1:+2 --csv="$out/one.csv" 2>"$out/one.err"
$fistab table tests/golden/asym.fis --csv="$out/none.csv"
check repair_of_one_output rises 3 "$out/one.csv"
faultless repair_leaves_the_other_output "$(diff <(cut -d, -f4 "$out/one.csv") <(cut -d, -f4 "$out/none.csv") | head -3)"
refuses repair_of_an_output_that_is_not_there 2 "--repair=3:+1 names output 3, but the system has 2 outputs" $fistab table tests/golden/asym.fis --repair=3:+1
refuses monotone_names_the_output 1 "\`fistab table --repair=2:-1\` mends the table" $fistab check tests/golden/asym.fis --monotone=2:-1

# --- files: nothing is destroyed
cp tables/brake.fis "$out/my.fis"
ln -s my.fis "$out/link.fis"
ln "$out/my.fis" "$out/hard.fis"
for output in my.fis link.fis hard.fis ./../test_fistab/my.fis; do
    for command in table plot convert; do
        case $command in plot) [ "$output" = my.fis ] || continue; name=$out/plot.svg; ln -f "$out/my.fis" "$name" ;; *) name=$out/$output ;; esac
        refuses "${command}_on_its_input_$output" 1 "the output would overwrite the input" $fistab $command "$out/my.fis" -o "$name"
    done
    refuses "csv_on_its_input_$output" 1 "the output would overwrite the input" $fistab table "$out/link.fis" "--csv=$out/$output"
done
faultless the_input_is_whole "$(cmp tables/brake.fis "$out/my.fis")"
refuses two_outputs_in_one_file 1 "two outputs go to this one file" $fistab table tables/brake.fis -o "$out/x.h" "--csv=$out/x.h"
ln -s x.h "$out/x.csv"
refuses two_outputs_by_a_link 1 "two outputs go to this one file" $fistab table tables/brake.fis -o "$out/x.h" "--csv=$out/x.csv"
refuses empty_output_name 1 "the name of an output file is empty" $fistab table tables/brake.fis -o ''
$fistab table tables/brake.fis >"$out/plain.h"
ln -s plain_target.h "$out/to_nothing.h"
check a_link_to_nothing $fistab table tables/brake.fis -o "$out/to_nothing.h"
faultless a_link_stays_a_link "$([ -L "$out/to_nothing.h" ] || echo 'no link any more'; cmp "$out/plain.h" "$out/plain_target.h")"
chmod 640 "$out/plain_target.h"
check a_link_to_a_file $fistab table tables/brake.fis -o "$out/to_nothing.h"
faultless a_file_keeps_its_mode "$([ "$(stat -c %a "$out/plain_target.h")" = 640 ] || stat -c %a "$out/plain_target.h")"
(cd "$out" && "$OLDPWD/$fistab" table "$OLDPWD/tables/brake.fis" -o - >minus.h)
faultless a_minus_is_stdout "$(cmp "$out/plain.h" "$out/minus.h" 2>&1; [ ! -e "$out/-" ] || echo 'a file of that name')"
{ echo before; $fistab table tables/brake.fis -o /dev/stdout; echo after; } >"$out/stdout.h"
faultless dev_stdout_is_stdout "$({ echo before; cat "$out/plain.h"; echo after; } | cmp - "$out/stdout.h"; [ -L /dev/stdout ] || echo 'no link any more')"
check descriptor_3 bash -c "$fistab table tables/brake.fis -o /dev/fd/3 3>'$out/three.h' && cmp '$out/plain.h' '$out/three.h'"
refuses a_full_disk 1 "cannot write: No space left on device" $fistab table tables/brake.fis -o /dev/full
refuses a_full_disk_for_one_of_two 1 "cannot write: No space left on device" $fistab table tests/good/plain.fis --grid=2x2 -o /dev/full "--csv=$out/alone.csv"
faultless no_file_of_two_without_the_other "$(ls "$out"/alone.csv* 2>/dev/null)"
mkdir "$out/signals"
for signal in INT TERM HUP; do
    mkfifo "$out/pipe"
    # The header cannot be finished as nobody reads the CSV: so the signal finds the temporary file there.
    # The shell starts a background program with SIGINT ignored, and env puts that right.
    env --default-signal=$signal timeout --foreground 30 $fistab table tables/brake.fis -o "$out/signals/x.h" "--csv=$out/pipe" &
    victim=$!
    exec 8<>"$out/pipe"
    for ((i = 0; i < 500; i++)); do [ -z "$(ls "$out/signals")" ] || break; sleep 0.01; done
    faultless "the_file_is_begun_before_SIG$signal" "$([ -n "$(ls "$out/signals")" ] || echo 'no temporary file yet')"
    kill -$signal $victim
    wait $victim
    say "SIG${signal}_ends_it" "$([ $? -gt 128 ]; echo $?)"
    exec 8>&-
    faultless "SIG${signal}_leaves_nothing" "$(ls "$out/signals")"
    rm "$out/pipe"
done

# --- messages
system_with() { # SED-SCRIPT: brake.fis, changed
    sed "$1" tables/brake.fis >"$out/changed.fis"
    echo "$out/changed.fis"
}
refuses only_input_2 1 "[Input1] is missing; number the sections from 1 on" $fistab check "$(system_with '/\[Input1\]/,/^$/d;s/NumInputs=2/NumInputs=1/')"
refuses wrong_defuzz_method 1 "changed.fis:$(grep -n DefuzzMethod tables/brake.fis | cut -d: -f1): error: DefuzzMethod 'wtaver' is not for Type 'mamdani'" $fistab check "$(system_with "s/^DefuzzMethod=.*/DefuzzMethod='wtaver'/")"
expect rules_behind_negative_numbers 0 '*' "" $fistab eval tests/golden/asym.fis -2 10 --rules
refuses quote_too_many 1 "two quotes '' are one quote inside a name" $fistab check "$(system_with "s/^MF1='very_near'/MF1='very_near''/")"
refuses an_expression 1 "expected a number such as 12.5, found '2*5'" $fistab check "$(system_with 's/^Range=\[1 5\]/Range=[1 2*5]/')"
printf 'MATLAB 5.0 MAT-file, Platform: GLNXA64\0\1\2' >"$out/fis.mat"
refuses a_workspace 1 "is a workspace of MATLAB's (.mat), not a .fis; in MATLAB write the system by writefis(fis, 'name')" $fistab check "$out/fis.mat"
refuses a_grid_beyond_numbers 2 "a grid has at most 16777216 cells" $fistab table --grid=99999999999x1 tables/brake.fis
refuses plot_without_rules 1 "no rule gives an output here, so there is no surface; add rules, or draw the sets alone by --sets" $fistab plot "$(system_with '/^\[Rules\]/,$d;s/^NumRules=.*/NumRules=0/')" -o "$out/empty.svg"
expect sugeno_range_of_nothing_is_fine 0 "" "" $fistab check tests/good/sugeno_range_0_0.fis
refuses sugeno_range_of_nothing_is_no_table 1 "is [0 0]; a table needs a range that its values fill" $fistab table tests/good/sugeno_range_0_0.fis

# --- help, manual page and completion name every option
for command in eval check table plot convert; do
    $fistab $command --help | grep -oE -- '--[a-z-]+' | sort -u >"$out/in_help"
    $fistab --man | sed 's/\\-/-/g' | sed -n "/^.SH ${command^^}/,/^.SH [^${command:0:1}]/p" | grep -oE '^.B .*--[a-z-]+' | grep -oE -- '--[a-z-]+' |
        sort -u >"$out/in_manual"
    words=$(bash -c "source <($fistab --completion); COMP_WORDS=(fistab $command --); COMP_CWORD=2; _fistab; printf '%s\n' \"\${COMPREPLY[@]}\"")
    faultless "manual_of_$command" "$(grep -vE -- '^--(help|usage|version)$' "$out/in_help" | diff - "$out/in_manual")"
    faultless "completion_of_$command" "$(grep -v -- --usage "$out/in_help" | diff - <(tr -d = <<<"$words" | sort -u))"
done
expect completion_of_commands 0 convert "" bash -c "source <($fistab --completion); COMP_WORDS=(fistab co); COMP_CWORD=1; _fistab; echo \"\${COMPREPLY[@]}\""
check install_puts_the_tools_in_place make --no-print-directory install "DESTDIR=$PWD/$out/staged" PREFIX=/usr
for tool in fistab drive bound; do
    check "installed_$tool" "$out/staged/usr/bin/$tool" --version
    check "manual_page_of_$tool" grep -q "^.TH ${tool^^} 1" "$out/staged/usr/share/man/man1/$tool.1"
    check "completion_file_of_$tool" grep -q "^complete .* $tool\$" "$out/staged/usr/share/bash-completion/completions/$tool"
done
check help_shows_an_example bash -c "$fistab --help | grep -q 'fistab table heater.fis --grid=32x32 -o heater.h'"

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
quick inputs_64_check 1 1 "" $fistab check "$out/inputs64.fis"
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
