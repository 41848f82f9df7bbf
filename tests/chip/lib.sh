# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Runs an image with pins driven at exact times, in s51 or, with ENGINE=fast, in our own simulator; for
# tests/chip/*.sh and tests/bench/*.sh:
#
#     . tests/chip/lib.sh
#     s51_start BOARD IMAGE.ihx CELL...   watches P1.0..P1.4 and the CELLs (names of s51's, iram[0x2f])
#     s51_pin 700000 echo 1               at 700,000 us the echo line goes high; times only grow
#     s51_set 2752 0x54                   half a microsecond after 2,752 us the byte of RAM becomes 0x54 that
#                                         S51_SETS='iram[0x50]' s51_start named
#     s51_jump 800000 0x38e               half a microsecond after 800,000 us the program goes on at this
#                                         address, where it hangs if that is 0xfffe; fast engine only
#     s51_type "s"                        the UART receives this, now; only after S51_TYPES=1 s51_start,
#                                         which takes twice the time
#     s51_until 900000                    simulates up to 900,000 us
#     s51_ask 900010                      there prints time, the part of it in interrupts, and all internal RAM;
#                                         s51 only
#     s51_stop                            ends it
#     s51_edges NAME                      "time_us value time_us_since_reset" of each write
#     $s51_uart                           the file of what the UART sent
#     $s51_dir/covered                    after s51_stop, if S51_COVERS=1 is exported: the address of each
#                                         instruction that was run, one a line; fast engine only
#
# The simulator stands still whenever it has eaten all pin events; so all is exact and repeats to the byte.

. tests/listing.sh

s51_board() { # BOARD KNOB
    awk -v knob="$2" '$1 == knob { print $3 }' "firmware/boards/$1.mk"
}

# The address of a global variable in the internal RAM of a linked program, from its map.
s51_cell() { # IMAGE.ihx VARIABLE
    awk -v name="_$2" '$2 == name { print "iram[0x" tolower(substr($1, 7)) "]"; exit }' "${1%.ihx}.map"
}

s51_start() {
    local board=$1 image=$2 type clk_hz cell bit
    shift 2
    [ -r "$image" ] || {
        echo "s51: error: no image '$image'; run: make BOARD=$board" >&2
        exit 2
    }
    type=$(s51_board "$board" S51_TYPE)
    clk_hz=$(s51_board "$board" CLK_HZ)
    s51_dir=$(mktemp -d)
    s51_uart=$s51_dir/uart
    mkfifo "$s51_dir/pins" "$s51_dir/keys" "$s51_dir/console"
    {
        echo 'set mem sfr 0x87 0x10' # PCON.4, POF, which power-on sets in a chip and not in s51
        echo 'var sync'
        if [ -n "${S51_TYPES:-}" ]; then echo 'uart0_check_often=1'; fi
        echo "set hw vcd[0] output \"$s51_dir/out\""
        for bit in 0 1 2 3 4; do echo "set hw vcd[0] add port1_value.$bit"; done
        for cell in "$@"; do echo "set hw vcd[0] add $cell"; done
        echo 'set hw vcd[0] add sync'
        echo 'set hw vcd[0] start'
        echo 'set hw vcd[0] new 1'
        echo "set hw vcd[1] input \"$s51_dir/pins\""
        echo 'set hw vcd[1] start'
    } >"$s51_dir/start.cfg"
    # Opened for both directions they neither block nor end.
    exec {s51_console}<>"$s51_dir/console" {s51_keys}<>"$s51_dir/keys"
    # Processor time is limited, so that a busy machine fails nothing.
    if [ "${ENGINE:-s51}" = fast ]; then
        timeout -k 1 3000 prlimit --cpu=120 build/tests/fast_pins "$(s51_board "$board" WATCHDOG)" "$clk_hz" "$image" \
            "$s51_dir" "$@" >"$s51_dir/log" 2>&1 &
    else
        timeout -k 1 3000 prlimit --cpu=120 tools/s51 -t "$type" -X "$clk_hz" -R 1 -S "uart=0,in=$s51_dir/keys,out=$s51_uart" \
            -C "$s51_dir/start.cfg" -g "$image" <&"$s51_console" >"$s51_dir/log" 2>&1 &
    fi
    s51_pid=$!
    trap s51_stop EXIT
    exec {s51_pins}>"$s51_dir/pins"
    # shellcheck disable=SC2016  # VCD's own words
    printf '%s\n' '$timescale 1ns $end' '$scope module m $end' '$var wire 1 ! pin3.2 $end' '$var wire 1 @ pin3.3 $end' \
        ${S51_SETS:+"\$var wire 16 & $S51_SETS \$end"} '$var wire 1 % sync $end' '$var wire 1 ^ sim_stop $end' '$upscope $end' '$enddefinitions $end' '#1500' '0!' '1@' '0%' >&"$s51_pins"
}

# When the firmware triggers the sensor for the first time; it goes on every 60 ms.
s51_first_trigger() {
    s51_edges port1_value.2 | awk '$2 == 1 && $1 > 1000 { printf "%d", $1; exit }'
}

# Events lie half a microsecond off the grid of machine cycles.
s51_pin() { # TIME_US echo|override LEVEL
    local id='!'
    [ "$2" = echo ] || id='@'
    printf '#%d500\n%d%s\n' "$1" "$3" "$id" >&"$s51_pins"
}

s51_nibbles=(0000 0001 0010 0011 0100 0101 0110 0111 1000 1001 1010 1011 1100 1101 1110 1111)
s51_bits() { # NUMBER; leaves its 16 bits in $bits
    bits=${s51_nibbles[$1 >> 12 & 15]}${s51_nibbles[$1 >> 8 & 15]}${s51_nibbles[$1 >> 4 & 15]}${s51_nibbles[$1 & 15]}
}

# s51 drops the top bit of a vector, so this one has 16.
s51_set() { # TIME_US BYTE
    local bits
    s51_bits "$2"
    printf '#%d500\nb%s &\n' "$1" "$bits" >&"$s51_pins"
}

# Echoes of a target at DIST_MM (none: the sensor's 38 ms for a clear road), as answers to the triggers
# FROM..TO-1 of those that come every 60 ms from FIRST_US on.
s51_echoes() { # FIRST_US FROM TO DIST_MM|none
    local width_us=38000 start_us k
    [ "$4" = none ] || width_us=$((($4 * 20000 + 1716) / 3432))
    for ((k = $2; k < $3; k++)); do
        start_us=$(($1 + 60000 * k + ${s51_echo_after_us:-1500}))
        s51_pin "$start_us" echo 1
        s51_pin "$((start_us + width_us))" echo 0
    done
}

s51_jump() { # TIME_US ADDRESS
    local bits
    s51_bits "$2"
    printf '#%d500\nb%s *\n' "$1" "$bits" >&"$s51_pins"
}

s51_type() {
    printf '%s' "$1" >&"$s51_keys"
}

s51_until() { # TIME_US
    printf '#%d500\n1%%\n#%d500\n' "$1" "$(($1 + 1))" >&"$s51_pins"
    # After the sync it writes at most the edges of one more microsecond before it stands still.
    until { head -n 40 "$s51_dir/out"; tail -n 12 "$s51_dir/out"; } 2>/dev/null | awk -v due="$1" '
        $1 == "$timescale" { scale = $2 ~ /ps/ ? 1e-6 : $2 ~ /ns/ ? 1e-3 : 1; scale *= $2 + 0 }
        $1 == "$var" && $5 == "sync" { id = $4 }
        /^#/ { time = substr($1, 2) * scale; next }
        /^b/ && $2 == id && time >= due && time < due + 3 { seen = 1 }
        END { exit !seen }'; do
        kill -0 "$s51_pid" 2>/dev/null || {
            echo "s51: error: left before $1 us; its last words:" >&2
            tail -n 3 "$s51_dir/log" >&2
            exit 2
        }
        sleep 0.1
    done
}

# After this it goes no further.
s51_ask() { # TIME_US, later than all events
    printf '#%d500\n1^\n#%d500\n' "$1" "$(($1 + 1000000))" >&"$s51_pins"
    printf 'state\ndump iram 0 0xff 16\nexpr 0x186a1\n' >&"$s51_console"
    until grep -qx 100001 "$s51_dir/log"; do
        kill -0 "$s51_pid" 2>/dev/null || {
            echo "s51: error: left before it told its state; its last words:" >&2
            tail -n 3 "$s51_dir/log" >&2
            exit 2
        }
        sleep 0.1
    done
    awk '
        function clocks(text) { sub(/.*\(/, "", text); return text + 0 }
        /^Total time since last reset/ { printf "clocks %d\n", clocks($0) }
        /^Time in isr/ { printf "clocks_in_interrupts %d\n", clocks($0) }
        /^0x[0-9a-f][0-9a-f] / { ram = ram " " substr($0, 27, 48) }
        END { gsub(/ +/, " ", ram); print "ram" ram }' "$s51_dir/log"
}

# Times as s51 writes them restart after a watchdog reset; here they go on, and a line "TIME reset"
# tells where that was.
s51_edges() { # NAME
    awk -v name="$1" '
    BEGIN { gsub(/\[/, "_", name); gsub(/\]/, "", name) }
    $1 == "$timescale" { unit = $2; scale = unit ~ /ps/ ? 1e-6 : unit ~ /ns/ ? 1e-3 : 1; scale *= unit + 0 }
    $1 == "$var" { id = $4; vcd_name = $5; if (vcd_name == name) wanted = id }
    /^#/ {
        time = substr($1, 2) * scale
        # uCsim 0.8.15 writes some changes up to half a microsecond late.
        if (time < before - 100) { base += before; printf "%.3f reset\n", base }
        else if (time < before) time = before
        before = time
        next
    }
    $1 == "$dumpvars" { next }
    wanted != "" && substr($0, length($0)) == wanted && (/^[01]/ || /^b/) {
        value = /^b/ ? substr($1, 2) : substr($1, 1, 1)
        printf "%.3f %s %.3f\n", base + time, value, time
    }' "$s51_dir/out"
}

# For each time in a file, one a line: "time_us time_us" of the cell's first write after it, if that came
# before the next one.
s51_answers() { # CELL FILE
    s51_edges "$1" | awk '
        FNR == NR { asked[++count] = $1; next }
        {
            while (k < count && asked[k + 1] < $1) k++
            if (k != before) printf "%s %s\n", asked[k], $1
            before = k
        }' "$2" -
}

# The byte that brake.c counts its control steps with, right after the duty is set.
s51_steps_cell() { # BOARD APP
    printf 'iram[0x%02x]\n' "$(address_of _seq "build/$1/$2/brake/main.rst")"
}

s51_stop() {
    trap - EXIT
    # fast_pins ends with its input, s51 does not.
    exec {s51_pins}>&-
    [ "${ENGINE:-s51}" = fast ] || kill "$s51_pid" 2>/dev/null || true
    wait "$s51_pid" 2>/dev/null || true
    exec {s51_console}>&- {s51_keys}>&-
}

s51_clean() {
    rm -rf "$s51_dir"
}
