#!/bin/bash
# SPDX-License-Identifier: MIT
# The two estimators of firmware/brake/closing.h in the loop, with the HC-SR04 and with the TF-Luna: what
# noise and missing readings make of the closing speed and of the brake, beside the figures of a
# floating-point study of this loop with the HC-SR04.
#     tests/bench/estimator.sh [BOARD]     after `make`; BOARD: stc89c516rd
# Builds the images (ESTIMATOR=difference, smooth) under build/bench/estimator and runs them under drive,
# at 0, 1 and 2 cm of noise and 0, 2 and 10 % of readings missing, rounded to 1 cm as in the study:
#
#   hold   own car and target stand 3, 4 and 4.9 m apart, one after the other; each gap counts from 0.6 s after
#          the target got there. The table is level nearer than 2 m and steepest at 4.9 m.
#   wild   the first seconds of hold again, with three single readings that are too short.
#   ramp   the target brakes at 2 m/s2 ahead of a car whose own brake hardly bites (0.5 m/s2), twice.
#
#   rate noise   standard deviation of the closing speed from the true one, over all gaps of hold
#   lag          how late the speed in force follows a ramp: mean error over the ramp's slope, from 0.7 s on
#   brake noise  of the brake at the pins, when the sensor is triggered. hold: standard deviation at the worst
#                gap; ramp: root mean square of the difference from the same ramp without noise or missing
#                readings, from 4.9 m on: whether one reading earlier is within the table's 5 m is another matter
#   changes      of the brake by more than 2 or 3 points from the last one counted, at the worst gap
#   wild         most that the brake rises and falls in 0.8 s, against the same run without that reading
#
# Where the study's figures differ: it has no slack in rows and columns (firmware/brake/brake.h), which takes the
# noise from a brake that holds, and its brake is not rounded to 1 %; its five cases are not told. What is left
# of changes comes from missing readings: beyond 4 m two in a row are a target that left (brake.h).
#
# Exits with 1 if a drive fails, or if at a constant gap the brake changes by more than 2 points more than
# once a second.
set -eu
cd "$(dirname "$0")/../.."
board=${1:-stc89c516rd}
out=build/bench/estimator
mkdir -p "$out"
rm -f "$out"/*.scn "$out"/*.csv "$out"/*.uart "$out"/*.log

for estimator in difference smooth; do
    for sensor in hcsr04 tfluna; do
        image=$out/$sensor-$estimator
        make BOARD="$board" SENSOR="$sensor" ESTIMATOR="$estimator" OUT="$image" "$image/brake.ihx"
    done
done

# --- the drives --------------------------------------------------------------------------------------

scenario() { # FILE TITLE SECONDS SEED EGO-MPS GAP-M PROFILE: all but the sensor
    cat >"$1" <<END
[scenario]
title = $2
duration_s = $3
seed = $4
[ego]
speed_mps = $5
brake_max_mps2 = 0.5
driver = coasts
[lead]
gap_m = $6
profile = $7
END
}

sensor() { # FILE NOISE-CM MISSING-PCT: and what must come of it
    printf '[sensor]\nstep_m = 0.01\nmax_m = 6\nnoise_m = %s\ndropout = %s\n' "${2}e-2" "${3}e-2" >>"$1"
    printf '[expect]\nimpact = none\n' >>"$1"
    [ "$3" -gt 0 ] || echo 'never = FAULT' >>"$1"
}

glitches() { # FILE AT-S:DIST-M...
    local file=$1 n='' glitch
    shift
    for glitch; do
        printf '[fault%s]\nkind = glitch\nfrom_s = %s\ndist_m = %s\n' "$n" "${glitch%:*}" "${glitch#*:}" >>"$file"
        n=$((${n:-1} + 1))
    done
}

conditions=()
for noise_cm in 0 1 2; do
    for missing_pct in 0 2 10; do
        conditions+=("$noise_cm-$missing_pct")
        name=$out/$noise_cm-$missing_pct
        # Changes are rare and come in bursts: hours on the host give 0.64 a second at most, and 60 s give
        # that within 0.15.
        case $noise_cm-$missing_pct in
        2-10) seconds=70 ;;
        *-10) seconds=22 ;;
        *) seconds=13 ;;
        esac
        seed=$((1 + 10 * noise_cm + missing_pct))
        # 3 m until 3.2 s, 4 m from 4.8 to 7.8 s, 4.9 m from 9.4 s on; it stops gently, or
        # readings that suddenly stay the same would be taken for a stuck sensor
        scenario "$name-hold.scn" 'Constant gaps' "$seconds" "$seed" 0 3 \
            '0:0, 3.2:0, 4:1.25, 4.8:0, 7.8:0, 8.6:1.125, 9.4:0'
        scenario "$name-wild.scn" 'Three wild readings' 3.2 "$seed" 0 3 0:0
        glitches "$name-wild.scn" 0.8:2 1.6:2.5 2.4:2.8
        for ramp in 1 2; do
            scenario "$name-ramp$ramp.scn" 'A ramp' 2.6 $((seed + 100 * ramp)) 5 5.4 '0:5, 0.2:5, 2.7:0'
        done
        for drive in hold wild ramp1 ramp2; do
            sensor "$name-$drive.scn" "$noise_cm" "$missing_pct"
        done
    done
done

# Prints the drive's name, and what was wrong with it.
run_one() { # SENSOR-ESTIMATOR SCENARIO
    local name trouble=
    name=$1-$(basename "$2" .scn)
    build/drive run ${ENGINE:+"--engine=$ENGINE"} --hex "$out/$1/brake.ihx" --board "$board" --scenario "$2" \
        --csv "$out/$name.csv" --uart "$out/$name.uart" >"$out/$name.log" 2>&1 ||
        trouble="drive ended with $?: $(tail -n 1 "$out/$name.log")"
    echo "$name $trouble"
}
export -f run_one
export out board

mapfile -t drives < <(ls -r "$out"/*.scn) # the longest are among the first
total=$((4 * ${#drives[@]})) ended=0 failed=0
while read -r name trouble; do
    ended=$((ended + 1))
    [ ! -t 2 ] || printf '\restimator.sh: %d of %d drives ' "$ended" "$total" >&2
    [ -z "$trouble" ] || {
        echo "estimator.sh: error: $name: $trouble; see $out/$name.log" >&2
        failed=1
    }
done < <(parallel -j "${JOBS:-2}" --will-cite run_one ::: {hcsr04,tfluna}-{difference,smooth} ::: "${drives[@]}")
[ ! -t 2 ] || echo >&2
[ "$ended" -eq "$total" ] || {
    echo "estimator.sh: error: $ended of $total drives ended" >&2
    failed=1
}
[ "$failed" -eq 0 ] || exit 1

# --- results ----------------------------------------------------------------------------------------

# A row of the table, and in a last column "most changes a second of more than 2 points".
figures() { # SENSOR-ESTIMATOR CONDITION
    local runs=$out/$1-$2
    # A reading comes every so many rows of 10 ms, the first one at that row. A TF-Luna's is the mean of the
    # 10 ms before it is sent.
    local rows=6 row=0
    case $1 in tfluna-*) rows=1 row=2 ;; esac
    awk -F, -v "each=$rows" -v "from=$row" -v name="${1#*-}" -v noise_cm="${2%-*}" -v missing_pct="${2#*-}" '
    function abs(x) { return x < 0 ? -x : x }
    function larger(a, b) { return a > b ? a : b }
    FNR == 1 { row = 0 }
    /^t_s/ || run == "" { next }
    is_uart { # a line a reading, but for those that the line has no time for
        if (NF == 9 && $1 ~ /^[0-9]+$/) speed_mps[run, from + each * ($1 - 1)] = $4 / 1000
        next
    }
    {
        gap_m[run, row] = $2
        closing_mps[run, row] = $3 - $4
        brake_pct[run, row] = int($6 + 0.5)
        rows[run] = ++row
    }
    # Standing still from row `from` to before row `to`.
    function hold(from, to,    k, n, sum, square, counted2, counted3, changes2, changes3, duty) {
        for (k = from; k < to; k++) {
            duty = brake_pct["hold", k]
            if (k == from) counted2 = counted3 = duty
            if (abs(duty - counted2) > 2) { counted2 = duty; changes2++ }
            if (abs(duty - counted3) > 3) { counted3 = duty; changes3++ }
            if (k % each) continue
            n++; sum += duty; square += duty ^ 2
            if (("hold", k) in speed_mps) { readings++; noise += (speed_mps["hold", k] - closing_mps["hold", k]) ^ 2 }
        }
        most2 = larger(most2, changes2 / (to - from) * 100)
        most3 = larger(most3, changes3 / (to - from) * 100)
        duty_noise = larger(duty_noise, sqrt(larger(0, square / n - (sum / n) ^ 2)))
    }
    # Most that the brake rises and falls from row `from` on, against the run without the wild reading.
    function wild(from,    k, d, rise, fall) {
        for (k = from; k < from + 80; k++) {
            d = brake_pct["wild", k] - brake_pct["hold", k]
            rise = larger(rise, d)
            fall = larger(fall, -d)
        }
        return sprintf("%d/%d", rise, fall)
    }
    # RUN from row 90 to the last metre; REFERENCE is the same without noise.
    function ramp(run, reference,    k, first, last) {
        for (k = 90; k < rows[run] && gap_m[run, k] > 1.1; k += each) {
            if (gap_m[run, k - each] < 4.9) { # the reading that this brake is for
                ramp_duties++
                ramp_square += (brake_pct[run, k] - brake_pct[reference, k]) ^ 2
            }
            if (!((run, k) in speed_mps)) continue
            if (!first) first = k
            last = k
            errors++
            error_mps += closing_mps[run, k] - speed_mps[run, k]
        }
        slope_mps2 += (closing_mps[run, last] - closing_mps[run, first]) / (last - first) * 100 / 2
    }
    END {
        hold(60, 320); hold(540, 780); hold(1000, rows["hold"])
        ramp("ramp1", "reference1"); ramp("ramp2", "reference2")
        printf "%-10s %6d %3d %%  %6.3f %6.3f %6.2f %6.2f  %6.2f  %6.2f  %7s %7s %7s", name, noise_cm, missing_pct,
            sqrt(noise / readings), error_mps / errors / slope_mps2, duty_noise, sqrt(ramp_square / ramp_duties),
            most2, most3, wild(80), wild(160), wild(240)
        printf "|%.2f\n", most2
    }' run=hold "$runs-hold.csv" run=wild "$runs-wild.csv" \
        run=ramp1 "$runs-ramp1.csv" run=ramp2 "$runs-ramp2.csv" \
        run=reference1 "$out/$1-0-0-ramp1.csv" run=reference2 "$out/$1-0-0-ramp2.csv" \
        is_uart=1 run=hold "$runs-hold.uart" run=ramp1 "$runs-ramp1.uart" run=ramp2 "$runs-ramp2.uart"
}

# Prints the table of a sensor and whether its goal is held.
table() { # SENSOR
    local estimator condition line held=held most=0 where='all cases'
    cat <<'END'
                  read-    rate         brake noise   changes a second  one reading short by
            noise  ings   noise    lag  hold    ramp    of more than    1 m   0.5 m   0.2 m:
estimator      cm  lost     m/s      s     points       2       3     brake rises/falls by points
END
    for estimator in difference smooth; do
        for condition in "${conditions[@]}"; do
            line=$(figures "$1-$estimator" "$condition")
            echo "${line%|*}"
            if awk -v a="$most" -v b="${line#*|}" 'BEGIN { exit b <= a }'; then
                most=${line#*|}
                where="$estimator, ${condition%-*} cm, ${condition#*-} % lost"
            fi
        done
        case $1-$estimator in
        hcsr04-difference) echo '     study      1     -   0.243  0.03  1.2 (worst of 5)          < 1    30 to 50 unguarded, 1 (p99) gated' ;;
        hcsr04-smooth) echo '     study      1     -   0.047  0.15  0.5 (worst of 5)            -    30 to 50 unguarded, 1 (p99) gated' ;;
        esac
    done
    awk -v most="$most" 'BEGIN { exit most > 1 }' || held=MISSED
    echo "    goal: at a constant gap at most 1 change of more than 2 points a second: $held (most $most: $where)"
    [ "$held" = held ] || missed=1
}

missed=0
echo "The estimators in the loop ($board; readings every 60 ms, rounded to 1 cm), beside the study's:"
table hcsr04
echo "The same with a TF-Luna ($board; readings every 10 ms, rounded to 1 cm):"
table tfluna
exit $missed
