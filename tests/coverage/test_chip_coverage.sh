#!/bin/bash
# SPDX-License-Identifier: MIT
# Each instruction of firmware/mcu and of the main loops is run in the fast simulator, on each board that has it:
#     tests/coverage/test_chip_coverage.sh BOARD,... IMAGE...
# Images that a board does not hold are left out. The drives are what happens seldom, below, and those of tests/loop.
# An instruction needs to be run in one of the images that have it, and an image is driven until nothing of it is
# left. A line with an instruction that no program reaches says so beside it or just above it, after "unreached:",
# with the reason. Leaves build/coverage/chip.json, of which the report makes a page.
. tests/lib.sh
. tests/chip/lib.sh
. tests/chip/walk_bringup.sh
export ENGINE=fast S51_COVERS=1

# --- what can be run ----------------------------------------------------------------------------

# What seldom happens, in each controller: a bit of RAM is stuck; a bit flips in the byte that tells a full stack, or in
# the mode of the UART; interrupts come that nobody uses, or too many.
seldom() {
    echo flip.kind=low flip.place=ram flip.address=0x50 flip.bit=0 flip.at_cycle=0
    echo flip.place=ram flip.address=0xFF flip.bit=0 flip.at_s=0.5
    echo flip.place=sfr flip.address=0x98 flip.bit=4 flip.at_s=0.5
    echo flip.place=sfr flip.address=0xA8 flip.bit=5 flip.at_s=0.5 flip2.place=sfr flip2.address=0xC8 flip2.bit=7 flip2.at_s=0.5
    echo flip.kind=interrupts flip.at_s=0.5 flip.for_s=0.015
}

telling() { # CONTROLLER
    case $1 in
    brake) echo fault_garbage fault_high brake/pin_pwm_low brake/stuck_register_bank brake/flip_register_bank brake/stuck_interrupts_off ;;
    gap) echo all_troubles_at_once case3_lead_brakes ;;
    park) echo dead_zone_out_of_range head_noise edge_noise ;;
    radar) echo case_70 frame_free_road ;;
    follow) echo a_lane_free ;;
    esac
}

# The ways to drive an image, one a line: a function of those below and its arguments. They come in up to four goes,
# with a line -- between: the usual drive, what is special to a controller, the telling drives, all drives.
ways() { # CONTROLLER
    local folder=tests/loop/$1 usual
    case $1 in
    bringup)
        printf '%s\n' walk -- 'walk table' 'walk ram'
        return
        ;;
    brake)
        folder=tests/loop
        usual=$folder/standing_car_3mps.scn
        printf '%s\n' "drive $usual" -- "type_keys _dropped" "type_keys _seconds" "type_keys _seq" high_line \
            "jump $(label_at brake/main _main)" "jump $(label_at brake/main _finish_selftest)" "overwrite brake/main _flow" \
            'overwrite mcu/code _state 200000 8' 'overwrite mcu/code _state 200000 16' \
            "jump $(line_at brake/main 'flow != FLOW_TICK')" \
            "flip_cell tests/loop/constant_gap_noise.scn brake/brake _brake 1 0 5" \
            "flip_cell tests/loop/constant_gap_noise.scn mcu/code _state 4 0 5" # the sum that it has learned
        ;;
    *)
        usual=$folder/frame_corrupt.scn
        printf '%s\n' "drive $usual" -- 'jump 0' 'jump 0xFFFE' "overwrite frames/frames _seconds"
        ;;
    esac
    [ "$1" != brake ] || echo --
    # Those that are the only ones to run an instruction: it saves time.
    # shellcheck disable=SC2046  # words
    printf "drive $folder/%s.scn\n" $(telling "$1")
    # From DEAD_ZONE to READY: no drive of tests/loop leaves the dead zone.
    [ "$1" != park ] || echo "flip_cell $folder/t6_dead_zone_6m.scn park/park _park 17 0 0.5"
    seldom | sed "s|^|drive $usual |"
    echo "flip_table $usual"
    echo --
    printf 'drive %s\n' "$folder"/*.scn
    [ "$1" != brake ] || printf 'drive %s\n' tests/loop/brake/*.scn
}

drive() { # SCENARIO KEY=VALUE...
    local scenario=$1
    shift
    build/drive run --brief --board "$board" --hex "$hex" --scenario "$scenario" "${@/#/--set=}" --coverage "$out/covered" >"$out/drive.log" 2>&1
}

# A bit flips in a variable.
flip_cell() { # SCENARIO MODULE VARIABLE OFFSET BIT AT_S
    drive "$1" flip.place=ram "flip.address=$(($(label_at "$2" "$3") + $4))" "flip.bit=$5" "flip.at_s=$6"
}
label_at() { # MODULE LABEL
    address_of "$2" "build/$image/$1.rst"
}
# Where the first line with that text begins.
line_at() { # MODULE TEXT
    awk -v text="$2" 'is_next && length($1) == 6 && $1 ~ /^[0-9A-F]+$/ { print "0x" $1; exit } index($0, text) { is_next = 1 }' \
        "build/$image/$1.rst"
}

# A bit of the table; the self-test finds it.
flip_table() { # SCENARIO
    local hex=$hex
    flipped_table
    drive "$1"
}
flipped_table() { # sets hex
    awk -v "address=$(($(label_at lib/lut _lut_out1) + 100))" -f tests/chip/flip_byte.awk "$hex" >"$out/flipped.ihx"
    hex=$out/flipped.ihx
}

at_step() { :; }
walk() { # "", table or ram
    local hex=$hex
    [ "${1:-}" != table ] || flipped_table
    if [ "${1:-}" = ram ]; then
        # The key comes while the table is being tested, too early.
        S51_TYPES=1 S51_SETS='iram[0x50]' s51_start "$board" "$hex"
        for ((time_us = 500; time_us < 3000; time_us++)); do s51_set "$time_us" 0; done
        s51_until 20000
        s51_type n
        s51_until 1500000
        s51_stop
    else
        walk_bringup "$board" "$hex"
    fi
    keep_covered
}
keep_covered() {
    cp "$s51_dir/covered" "$out"
    s51_clean
}

# All commands, each after the answer to the one before, while a counter of two bytes overflows the lower one.
type_keys() { # COUNTER
    local key now=800000 cell
    cell=iram[$(label_at brake/main "$1")]
    S51_SETS=$cell S51_TYPES=1 s51_start "$board" "$hex"
    s51_set 700000 255
    s51_until "$now"
    for key in '?' s x t $'t\r\n' v; do
        s51_type "$key"
        now=$((now + 150000))
        s51_until "$now"
    done
    s51_stop
    keep_covered
}

high_line() {
    s51_start "$board" "$hex"
    s51_pin 2 echo 1
    s51_until 1000000
    s51_stop
    keep_covered
}

# A byte is 255, a few times within 2 ms: so the lower byte of a counter overflows, and the marks of a round are wrong.
# Or, at another time, it is another value.
overwrite() { # MODULE VARIABLE [US VALUE]
    local k
    S51_SETS="iram[$(label_at "$1" "$2")]" s51_start "$board" "$hex"
    for ((k = 0; k < 20; k++)); do s51_set $((${3:-700000} + 97 * k)) "${4:-255}"; done
    s51_until 2000000
    s51_stop
    keep_covered
}

# The program runs wild, to this place.
jump() { # ADDRESS
    s51_start "$board" "$hex"
    s51_jump 800000 "$1"
    s51_until 1600000
    s51_stop
    keep_covered
}

# --- what is left -------------------------------------------------------------------------------

boards=${1//,/ }
shift
for one in $boards; do
    for name; do
        find "build/$one" -maxdepth 2 -name "$name.lk"
    done
done | sed 's/\.lk$//; s/^build.//' | awk '!seen[$0]++' >"$out/images"
while read -r one; do
    sed -n 's/\.rel$/.rst/p' "build/$one.lk"
done <"$out/images" | xargs awk -f tests/coverage/instructions.awk >"$out/instructions"

# Lines that say why.
grep -rnE 'unreached: ' firmware/mcu firmware/*/main.c firmware/frames/frames.c |
    awk -F: '{ for (line = $2; line <= $2 + 2; line++) print $1 ":" line }' >"$out/explained"

# What is left: the image, its address and its name of each instruction that no program has run yet.
awk -F '\t' 'FILENAME ~ /explained$/ { explained[$0]; next }
    { split($3, part, " ") } !(part[1] in explained)' "$out/explained" "$out/instructions" >"$out/left"
reach() {
    awk -F '\t' -v image="$image" 'FILENAME ~ /covered$/ { ran[$0]; next } $1 == image && $2 in ran { print $3 }' \
        "$out/covered" "$out/left" >"$out/new"
    [ -s "$out/new" ] || return
    awk -F '\t' 'FILENAME ~ /new$/ { done[$0]; next } !($3 in done)' "$out/new" "$out/left" >"$out/still_left"
    mv "$out/still_left" "$out/left"
}

# Runs the ways of one go, of each image of a board, until nothing of it is left.
run_ways() { # GO
    local words
    while read -r image; do
        hex=build/$image.ihx
        while read -r words; do
            grep -q "^$image"$'\t' "$out/left" || break
            : >"$out/covered"
            # shellcheck disable=SC2086  # the words of a way
            $words </dev/null
            reach
            echo "$image: $words: $(wc -l <"$out/new") new" >>"$out/log"
        done < <(ways "$(sed -n 's|.*/\([a-z]*\)/main\.rel$|\1|p' "build/$image.lk")" | awk -v go="$1" '/^--$/ { before++; next } before + 1 == go')
    done < <(grep "^$board/" "$out/images")
}
# Each go on all boards: what one image does not run, another one may.
for go in 1 2 3 4; do
    for board in $boards; do run_ways $go; done
done

cut -f 3 "$out/instructions" | sort -u >"$out/names"
sed 's/:.*//' "$out/names" | sort -u >"$out/files"
while read -r file; do
    faultless "$file" "$(awk -F '\t' -v file="$file:" 'index($3, file) == 1 { print $3 " (at " $2 " of " $1 ") is run by no drive;" }' "$out/left")"
done <"$out/files"
mkdir -p build/coverage
awk -F '\t' -v OFS='\t' '
    function file(name) { sub(/:.*/, "", name); return name }
    FILENAME ~ /explained$/ { explained[$0]; next }
    FILENAME ~ /left$/ { left[$3]; next }
    { split($1, part, " "); all[file($1)]++ }
    part[1] in explained { said[file($1)]++; next }
    !($1 in left) { run[file($1)]++ }
    END { for (name in all) print name, all[name], run[name] + 0, said[name] + 0 }' "$out/explained" "$out/left" "$out/names" |
    sort | jq -Rn --arg boards "$boards" '{boards: ($boards | split(" ")), files: [inputs | split("\t")
        | {file: .[0], instructions: (.[1] | tonumber), run: (.[2] | tonumber), explained: (.[3] | tonumber)}]}' >build/coverage/chip.json
finish
