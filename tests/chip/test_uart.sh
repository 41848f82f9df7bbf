#!/bin/bash
# The controller's words: title, header, one whole line a control step, an answer to each command, and
# no command obeyed that is none.
set -u
. tests/chip/lib.sh
. tests/chip/check.sh
board=stc89c516rd
dir=$(mktemp -d)
make -s "BOARD=$board" "build/$board/brake.ihx" || exit 2

S51_TYPES=1 s51_start "$board" "build/$board/brake.ihx"
s51_until 640000
first=$(s51_first_trigger)
k=1
for keys in '?' 'v' 's' 'x' 't' 'h' $'t\r\n' 'vs'; do
    s51_echoes "$first" "$k" $((k + 10)) 3000
    k=$((k + 10))
    s51_until $((first + 60000 * k))
    s51_type "$keys"
done
s51_echoes "$first" "$k" $((k + 10)) 3000
s51_until $((first + 60000 * (k + 10)))
s51_stop
said=$dir/said
cp "$s51_uart" "$said"
s51_clean

says() { # TEXT COUNT
    [ "$(tr -d '\r' <"$said" | grep -cxF -- "$1")" -eq "$2" ]
}
crc=$(awk '$2 == "LUT_CRC16" { print substr($3, 3, 4) }' "build/$board/brake/lut_table.h")
check "the_title_comes_first" [ "$(head -n 1 "$said" | tr -d '\r')" = "# fuzzy51 1.0 brake $board table=$crc reset=power-on" ]
check "v_repeats_the_title" says "# fuzzy51 1.0 brake $board table=$crc reset=power-on" 3
check "the_header_follows_each_title" says "seq,ms,dist_mm,closing_mmps,row,col,brake_pct,state,fault" 3
check "help_is_given" says "# ? help, v version, s status, t telemetry on/off" 1
check "unknown_keys_are_answered" says "# unknown command; ? for help" 2
check "telemetry_goes_off" says "# telemetry off" 1
check "telemetry_goes_on_again_line_ends_ignored" says "# telemetry on" 1
status_is_told() {
    [ "$(grep -acE '^# state=(CONTROL|FAULT) fault=[0-9]+ dropped=[0-9]+ stack_unused=[0-9]+.$' "$said")" -eq 2 ]
}
check "status_is_told_twice" status_is_told

line='[0-9]+,[0-9]+,[0-9]*,-?[0-9]+,[0-9]{1,2},[0-9]{1,2},[0-9]{1,3},(RELEASED|CONTROL|STOP|FAULT),[0-9]+'
all_lines_are_whole() {
    # The last one may still be on its way.
    [ "$(tr -d '\r' <"$said" | sed '$d' | grep -avE "^(#.*|seq,.*|$line)\$" | wc -l)" -eq 0 ]
}
check "all_lines_are_whole" all_lines_are_whole
check "every_line_ends_in_cr_lf" [ "$(sed '$d' "$said" | grep -acv $'\r$')" -eq 0 ]

# Where lines are missing, telemetry was off or an answer took their place: the second is counted.
counts_dropped_lines() {
    tr -d '\r' <"$said" | awk -F'[ =,]' '
        /^# telemetry off/ { off = 1 }
        /^[0-9]+,/ {
            if (before && !off) missing += $1 - before - 1
            off = 0
            before = $1
        }
        /^# state/ { told = $7 }
        END { exit !(missing > 0 && told >= missing - 2 && told <= missing) }'
}
check "dropped_lines_are_counted" counts_dropped_lines
rm -rf "$dir"
check_end
