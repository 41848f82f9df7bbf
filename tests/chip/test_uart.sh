#!/bin/bash
# SPDX-License-Identifier: MIT
# What the controller says: title, header, one whole line for each control step, an answer to each
# command. It does not obey unknown commands.
. tests/lib.sh
. tests/chip/lib.sh
board=stc89c516rd
make -s "BOARD=$board" "build/$board/brake.ihx" || exit 2

S51_TYPES=1 s51_start "$board" "build/$board/brake.ihx"
s51_until 1000000
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
said=$out/said
cp "$s51_uart" "$said"
s51_clean

says() { # TEXT COUNT
    [ "$(tr -d '\r' <"$said" | grep -cxF -- "$1")" -eq "$2" ]
}
crc=$(awk '$2 == "LUT_CRC16" { print substr($3, 3, 4) }' "build/$board/brake/lut_table.h")
check "the_title_comes_first" [ "$(head -n 1 "$said" | tr -d '\r')" = "# fuzzy51 1.0 brake $board $(s51_board "$board" CLK_HZ) Hz table=0x$crc reset=power-on" ]
check "v_repeats_the_title" says "# fuzzy51 1.0 brake $board $(s51_board "$board" CLK_HZ) Hz table=0x$crc reset=power-on" 3
check "the_header_follows_each_title" says "seq,ms,dist_mm,closing_mmps,row,col,brake_pct,state,fault" 3
check "help_is_given_when_asked_for_and_for_unknown_keys" says "# ? help, v version, s status, t telemetry on/off" 3
check "telemetry_goes_off" says "# telemetry off" 1
check "telemetry_goes_on_again_line_ends_ignored" says "# telemetry on" 1
status_is_told() {
    [ "$(grep -acE '^# state=(CONTROL|FAULT) fault=[0-9]+ dropped=[0-9]+ stack_unused=[0-9]+.$' "$said")" -eq 2 ]
}
check "status_is_told_twice" status_is_told

line='[0-9]+,[0-9]+,[0-9]*,-?[0-9]+,[0-9]{1,2},[0-9]{1,2},[0-9]{1,3},(RELEASED|CONTROL|STOP|FAULT),[0-9]+'
all_lines_are_whole() {
    # The last one may still be on its way.
    ! tr -d '\r' <"$said" | sed '$d' | grep -aqvE "^(#.*|seq,.*|$line)\$"
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

# Telemetry never delays a control step. The same echoes three times, with telemetry on, off, and on with
# commands that come in as they end: each duty is set as long after its echo's end as without telemetry,
# but for what the main loop and the interrupt may be at just then: each job of a round once, as long as
# no path through it is longer. So no step waits for a line, which takes 40 ms and more to send.
image=build/$board/brake.ihx
jobs=(talk listen advance_clock brake_tick hal_stack_is_good apply show pwm_interrupt)
most_us=$(
    awk -v jobs="${jobs[*]}" '
        /at most [0-9]+ cycles/ { sub(/:/, "", $1); cycles[$1] = $(NF - 1) }
        END {
            count = split(jobs, job, " ")
            for (i = 1; i <= count; i++) {
                if (!cycles[job[i]]) exit 1
                sum += cycles[job[i]]
            }
            print sum
        }' "${image%.ihx}.bound"
)

time_steps() { # NAME KEYS-FIRST KEYS-AT-EACH-END
    local cell first k rise_us fall_us
    cell=$(s51_steps_cell "$board" brake)
    S51_TYPES=1 s51_start "$board" "$image" "$cell"
    s51_until 1000000
    first=$(s51_first_trigger)
    s51_type "$2"
    for ((k = 5; k < 45; k++)); do
        rise_us=$((first + 60000 * k + 1500))
        fall_us=$((rise_us + ((k * 677) % 4000 + 1050) * 20000 / 3432))
        s51_pin "$rise_us" echo 1
        if [ -n "$3" ]; then
            # It is there a byte's time later, and answered at once.
            s51_until $((fall_us - 1000 - k % 4 * 100))
            s51_type "${3:k % ${#3}:1}"
        fi
        s51_pin "$fall_us" echo 0
        echo "$fall_us.5" >>"$out/$1.falls"
    done
    s51_until $((first + 60000 * 45))
    s51_stop
    s51_answers "$cell" "$out/$1.falls" >"$out/$1.answers"
    answers=$(grep -ac '^#' "$s51_uart")
    s51_clean
}
same_to() { # NAME MOST_US: against the run without telemetry
    awk -v most="$2" -v name="$1" '
        FNR == NR { delay[$1] = $2 - $1; next }
        $1 in delay { n++; d = $2 - $1 - delay[$1]; if (d > worst) worst = d; if (d < -most) early = 1 }
        END { printf "%s: %d steps, at most %.0f us later than without telemetry\n", name, n, worst | "cat >&2"
              exit !(n >= 35 && worst <= most && !early) }' "$out/off.answers" "$out/$1.answers"
}
time_steps on '' ''
time_steps off t ''
check "telemetry_was_off" [ "$answers" -eq 2 ]
time_steps asked '' 'v?sx'
check "commands_were_answered" [ "$answers" -ge 20 ]
check "the_jobs_of_a_round_are_bounded" [ "${most_us:-99999}" -lt 10000 ]
check "telemetry_delays_no_step" same_to on "$most_us"
check "commands_delay_no_step" same_to asked "$most_us"
finish
