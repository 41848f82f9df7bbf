#!/bin/bash
# SPDX-License-Identifier: MIT
# What each controller takes on each board that holds it: machine cycles of its control step, interrupt
# load, stack, flash, RAM; and of the brake all delays from an echo's end on. Goals are design's; exits
# with 1 if one is missed.
#     tests/bench/firmware.sh [BOARD...]         after `make run-bench` has built what it needs
# Images run in s51 with the modules and the memory model that ship. A step's own cycles come from an
# image that takes it thousands of times (tests/bench/step.c), all else from the images that ship: the
# brake hears echoes of a drive of chance (readings.awk), the one behind a lidar its frames (tfluna.awk)
# and the others theirs, one after another with no pause, which is the most that the line carries. s51 takes 2 cycles too few for an interrupt: they are added.
set -eu
cd "$(dirname "$0")/../.."
. tests/chip/lib.sh
work=build/bench/firmware
FRAMES=80
LIDAR_FRAMES=300
mkdir -p "$work"

# Those with a control step.
apps() { # BOARD
    local modules
    for modules in "build/$1"/*/{brake/brake,frames/frames}.rel; do
        basename "${modules%/*/*}"
    done | sort
}
has_sonar() { [ -e "build/$1/$2/mcu/echo.rel" ]; }   # BOARD APP
has_lidar() { [ -e "build/$1/$2/mcu/tfluna.rel" ]; } # BOARD APP

# --- measuring: of each controller a file of "name value" lines ------------------------------------

# Least and most cycles of the step.
step_cycles() { # BOARD APP
    local image=build/$1/bench/$2.ihx log=$work/$1-$2.log line
    tests/run_image.sh "$image" >"$log"
    line=$(grep -aE '^[0-9]+ [0-9]+ [0-9]+ end$' "$log") || {
        echo "firmware.sh: error: $image did not come to its end in s51; see $log" >&2
        exit 1
    }
    local least most missed _
    read -r least most missed _ <<<"$line"
    [ "$missed" -eq 0 ] || {
        echo "firmware.sh: error: $image refused payloads, or missed states: $missed of them" >&2
        exit 1
    }
    echo "step_least $least"
    echo "step_most $most"
}

# The most that any path takes, as tools/bound finds it in the linked image.
bounded() { # BOARD APP FUNCTION
    awk -v name="$3:" '$1 == name { print $4 }' "build/$1/$2.bound"
}

# From what s51_ask said: the load of interrupts, of which there were so many a second and so many more;
# and the stack.
load_and_stack() { # BOARD APP PER_SECOND MORE
    local stack_from
    stack_from=$(awk '/^Stack starts at/ { print $4 }' "build/$1/$2.mem")
    awk -v per_second="$3" -v more="$4" -v clk_hz="$(s51_board "$1" CLK_HZ)" -v from="$((stack_from))" '
        $1 == "clocks" { all = $2 }
        $1 == "clocks_in_interrupts" {
            interrupts = per_second * all / clk_hz + more
            printf "load_pct %.2f\n", 100 * ($2 + 24 * interrupts) / all
        }
        $1 == "ram" {
            for (i = NF; i > 1 && $i == "aa"; i--) {
            }
            printf "stack_used %d\nstack_left %d\n", i - 1 - from, NF - i
        }' "$s51_dir/state"
}

# Echo to duty: the longest times from the end of an echo to the moment at which the duty is set (the
# step's number is counted right after it), to the pin, and to the STOP pin.
run_brake() { # BOARD APP
    local seq pct first start readings=50
    case $2 in brake | tuned) readings=300 ;; esac # the others are for stack and load
    seq=$(s51_steps_cell "$1" "$2")
    pct=$(s51_cell "build/$1/$2.ihx" brake)
    s51_start "$1" "build/$1/$2.ihx" "$seq" "$pct"
    s51_until 1000000
    first=$(s51_first_trigger)
    start=$((first + (1100000 - first) / 60000 * 60000))
    awk -v "first_us=$start" -v "count=$readings" -v "falls=$s51_dir/falls" -f tests/bench/readings.awk >&"$s51_pins"
    s51_until $((start + 60000 * readings))
    s51_ask $((start + 60000 * readings + 10)) >"$s51_dir/state"
    s51_stop
    s51_answers "$seq" "$s51_dir/falls" >"$s51_dir/set"
    s51_edges "$pct" >"$s51_dir/pct"
    s51_edges port1_value.1 >"$s51_dir/stop"
    s51_edges port1_value.0 >"$s51_dir/pwm"
    # The duty that each echo led to.
    awk '
        FNR == NR { pct_at[++pcts] = $1; pct[pcts] = $2; next }
        {
            while (k < pcts && pct_at[k + 1] <= $2) k++
            print $1, pct[k]
        }' "$s51_dir/pct" "$s51_dir/set" >"$s51_dir/asked"
    awk -v "clk_hz=$(s51_board "$1" CLK_HZ)" '
        FILENAME ~ /set$/ { mc = ($2 - $1) * clk_hz / 12e6; if (mc > set) set = mc; fall[++falls] = $1; next }
        $2 != level && (level = $2) == 1 {
            while (k < falls && fall[k + 1] < $1) k++
            mc = ($1 - fall[k]) * clk_hz / 12e6
            if (k && mc < 20000 && mc > stop) stop = mc # later ones have another cause than this echo
        }
        END { printf "set_readings %d\nset_most %.0f\nstop_most %.0f\n", falls, set, stop }' "$s51_dir/set" "$s51_dir/stop"
    awk -v "clk_hz=$(s51_board "$1" CLK_HZ)" -f tests/chip/pwm_periods.awk "$s51_dir/asked" "$s51_dir/pwm" 2>/dev/null |
        sed 's/.* late_us /pin_us /'
    load_and_stack "$1" "$2" 200 0
    s51_clean
}

# Has s51's UART receive what $s51_dir/frames holds, then measures load and stack. A byte in and a byte out
# are an interrupt each.
receive() { # BOARD APP INTERRUPTS_PER_SECOND
    local end_us=$((500000 + $(wc -c <"$s51_dir/frames") * 1050))
    cat "$s51_dir/frames" >&"$s51_keys"
    s51_until "$end_us"
    s51_ask $((end_us + 10)) >"$s51_dir/state"
    s51_stop
    load_and_stack "$1" "$2" "$3" $(($(wc -c <"$s51_dir/frames") + $(wc -c <"$s51_uart")))
    s51_clean
}

run_lidar() { # BOARD APP
    S51_TYPES=1 s51_start "$1" "build/$1/$2.ihx"
    s51_until 400000
    printf '%b' "$(awk -v "count=$LIDAR_FRAMES" -f tests/bench/tfluna.awk)" >"$s51_dir/frames"
    receive "$1" "$2" 200
}

run_frames() { # BOARD APP
    local family=${2%%_*} kind bytes per_second=200
    kind=$(awk -v name="FRAME_${family^^}" '$1 == name { print $3 + 0 }' firmware/frames/frame.h)
    bytes=$(awk '$2 ~ /_(PAYLOAD|TARGET)_BYTES$/ { bytes += $3 } END { print bytes }' "firmware/$family/$family.h")
    [ ! -e "build/$1/$2/mcu/servo.rel" ] || per_second=300 # with the servo's
    S51_TYPES=1 s51_start "$1" "build/$1/$2.ihx"
    s51_until 400000
    "build/bench/line_$family" "$kind" "$bytes" "$FRAMES" >"$s51_dir/frames"
    receive "$1" "$2" "$per_second"
}

measure() { # BOARD APP
    step_cycles "$1" "$2"
    if has_sonar "$1" "$2"; then
        run_brake "$1" "$2"
    elif has_lidar "$1" "$2"; then
        run_lidar "$1" "$2"
    else
        run_frames "$1" "$2"
    fi
    # memory.sh's line: code N of M bytes, RAM N of M bytes
    tools/memory.sh "$1" "build/$1" "$2" | sed -E 's/.* code +([0-9]+) .* RAM +([0-9]+) of.*/flash \1\nram \2/'
}

if [ "${1:-}" = --measure ]; then
    measure "$2" "$3" >"$work/$2-$3.part"
    mv "$work/$2-$3.part" "$work/$2-$3"
    echo "$2 $3" >>"$work/measured"
    exit
fi

if [ $# -eq 0 ]; then
    mapfile -t boards < <(basename -as .mk firmware/boards/*.mk)
    set -- "${boards[@]}"
fi
rm -f "$work"/*
: >"$work/measured"
for board; do
    for app in $(apps "$board"); do echo "build/$board/bench/$app.ihx"; done | xargs make -s "BOARD=$board" >&2
    for app in $(apps "$board"); do echo "$board $app"; done
done >"$work/jobs"
xargs -P "${JOBS:-$(nproc)}" -L 1 "$0" --measure <"$work/jobs" &
while kill -0 $! 2>/dev/null; do
    sleep 1
    if [ -t 2 ]; then printf '\r%d of %d images measured ' "$(wc -l <"$work/measured")" "$(wc -l <"$work/jobs")" >&2; fi
done
if [ -t 2 ]; then echo >&2; fi
wait $! || {
    echo "firmware.sh: error: not all images were measured; see above" >&2
    exit 1
}

# --- tables ----------------------------------------------------------------------------------------
value() { awk -v name="$3" '$1 == name { print $2 }' "$work/$1-$2"; } # BOARD APP NAME
missed=0
goal() { # VALUE LIMIT
    if awk -v value="$1" -v limit="$2" 'BEGIN { exit !(value <= limit) }'; then
        echo met
    else
        echo 'NOT MET'
        missed=1
    fi
}

printf '%-12s %-13s %11s %11s %6s %7s %5s %15s\n' board controller 'step, least' 'most cycles' 'load %' flash RAM 'stack used left'
while read -r board app; do
    printf '%-12s %-13s %11s %11s %6s %7s %5s %10s %4s\n' "$board" "$app" "$(value "$board" "$app" step_least)" \
        "$(value "$board" "$app" step_most)" "$(value "$board" "$app" load_pct)" "$(value "$board" "$app" flash)" \
        "$(value "$board" "$app" ram)" "$(value "$board" "$app" stack_used)" "$(value "$board" "$app" stack_left)"
    [ "$(value "$board" "$app" stack_left)" -gt 0 ] || missed=1
done <"$work/jobs"

row() { # WHAT VALUE LIMIT UNIT
    local verdict
    verdict=$(goal "$2" "$3")
    [ "$verdict" = met ] || missed=1
    printf '    %-46s %8s   goal: at most %-9s %s\n' "$1" "$2" "$3 $4" "$verdict"
}

# Bytes of code and constants that each module's object has; what is over is SDCC's library.
modules() { # BOARD APP
    local folder=build/$1/$2 object name
    for object in "$folder"/*/*.rel; do
        name=${object#"$folder/"}
        awk -v name="${name%.rel}" '
            function hex(text,    i, n) { for (i = 1; i <= length(text); i++) n = 16 * n + index("0123456789ABCDEF", substr(text, i, 1)) - 1; return n }
            $1 == "A" && $2 ~ /^(HOME|GSINIT|GSFINAL|CSEG|CONST|XINIT)/ { sum += hex($4) }
            END { print sum, name }' "$object"
    done | sort -rn | awk -v all="$(value "$1" "$2" flash)" '
        { sum += $1; line = line " " $2 " " $1 }
        END { print line " library " all - sum }' | xargs -n 12 | sed 's/^/        /'
}

set_goal_mc=1600
for board; do
    clk_hz=$(s51_board "$board" CLK_HZ)
    for app in brake tuned; do
        encoding=$(s51_board "$board" ENCODING)
        case $app-$encoding in
        brake-*) table=$encoding ;;
        tuned-packed) table=packed-tuned ;;
        *) table= ;;
        esac
        echo "$board, $app, at $((clk_hz / 1000)) kHz:"
        # A part of the main loop's round, then the step: its 1,500, and what these readings find the
        # loop at. Not a bound: that is `talk` and `control_step` of build/BOARD/APP.bound.
        row 'echo end to duty set, worst, mc' "$(value "$board" $app set_most)" $set_goal_mc mc
        row 'the step alone, mc' "$(value "$board" $app step_most)" 1500 mc
        row 'no path of the step takes more, mc' "$(bounded "$board" $app control_step)" 1500 mc
        # Without the loop's part, from the poll on, tests/bench/brake.c holds it to 300.
        row 'echo end to STOP pin, worst, mc' "$(value "$board" $app stop_most)" 1000 mc
        # A period of the PWM, its notice of 128 cycles, and the time until the duty is set.
        row 'echo end to duty on the pin, worst, us' "$(value "$board" $app pin_us)" \
            $((10000 + (128 + set_goal_mc) * 12000 / (clk_hz / 1000))) us
        if [ -n "$table" ]; then
            read -r _ _ _ _ _ most _ < <(tests/lut/run.sh "build/lut/$table")
            row "table fetch, $table, mc" "$most" "$([ "$encoding" = plain ] && echo 24 || echo 120)" mc
        fi
        row 'interrupts (all PWM), % of all cycles' "$(value "$board" $app load_pct)" 3 %
        echo "    $(value "$board" $app set_readings) readings; bytes of code:"
        modules "$board" $app
    done
    # From the poll that takes a frame to the STOP pin, tests/bench/brake.c holds it to 300.
    for app in $(apps "$board"); do
        has_lidar "$board" "$app" || continue
        echo "$board, $app, at $((clk_hz / 1000)) kHz:"
        row 'the step alone, mc' "$(value "$board" "$app" step_most)" 1500 mc
        row 'no path of the step takes more, mc' "$(bounded "$board" "$app" control_step)" 1500 mc
        echo "    bytes of code:"
        modules "$board" "$app"
    done
done
exit $missed
