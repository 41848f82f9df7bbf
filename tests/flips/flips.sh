#!/bin/bash
# SPDX-License-Identifier: MIT
# What a flipped bit does, `make flips`:
#     tests/flips/flips.sh BOARD...
# Flips each bit of RAM and of each register that the brake uses, at 20 instants of five drives; then bits of
# the code and of the program counter by chance, and bits of RAM that stick. Leaves build/flips/BOARD.txt, a
# table, build/flips/map.csv, which the report shows, and all runs as build/flips/BOARD.DRIVE.WHAT.csv. Ends with 1 if on a board with a watchdog a flip of
# RAM or of a register is unsafe, but for those that stop the clock (PCON).
#
# INSTANTS, CODE, PCS in the environment: how many instants a drive (1 to 4), random flips of the code and of
# the program counter a drive. WINDOW: in place of all that, each bit at each cycle of so many milliseconds in
# each drive; then the table counts bits and cycles, and lies in build/flips/BOARD.space.txt. That takes hours: it goes
# from 10 ms to 10 ms in all drives, and goes on where it was interrupted, as long as the image is the same.
set -u
shopt -s nullglob # a kind of fault that was not asked for has no files
cd "$(dirname "$0")/../.." || exit 2
. tests/flips/image.sh
out=build/flips
mkdir -p "$out"
instants=${INSTANTS:-4} code=${CODE:-2000} pcs=${PCS:-400} window=${WINDOW:-0}
slice=$((window < 10 ? window : 10)) # a multiple of 10 ms has a checkpoint
# SP DPL DPH PCON TCON TMOD TL0 TL1 TH0 TH1 P1 SCON IE P3 IP T2CON RCAP2L RCAP2H TL2 TH2 PSW ACC B
registers=81-83,87-8D,90,98,A8,B0,B8,C8,CA-CD,D0,E0,F0
# Drive, the least brake that it must keep, and instants, the most telling one first.
drives=("approach 0 0.2 0.5 0.8 1.1" "follow 0 0.5 1 0.2 1.5" "stop 100 0.5 0.1 0.8 1.1" "fault 60 0.7 0.4 1 1.2" "start 0 -0.08 -0.14 -0.12 -0.02")

# Each drive draws other bits of the code and of the program counter.
fly() { # BOARD DRIVE LEAST WHAT FILE AT...
    local board=$1 drive=$2 least=$3 what=$4 file=$5 stack
    shift 5
    stack=$(($(stack_at "$out" "$board") + $(awk '/^stack: at most/ { print $4 }' "$out/$board"/brake.bound)))
    local options=(--ram=00-FF --seed="$(cksum <<<"$drive" | cut -d " " -f 1)")
    [[ $what != bits && $what != space ]] || options+=("--sfr=$registers")
    [ "$what" != space ] || options+=("--window=$slice" --sample=200 --jobs=1)
    [ "$what" != code ] || options+=(--count=$(((code + $# - 1) / $#)))
    [ "$what" != pc ] || options+=(--count=$(((pcs + $# - 1) / $#)))
    build/flip --board="$board" --hex="$out/$board/brake.ihx" --scenario="tests/flips/$drive.scn" --what="$what" --at="$(tr ' ' , <<<"$*")" \
        --least="$least" --fault-state="$(variable_at "$out" "$board" fault_state)" --unused="$(printf %X $stack)" \
        --told="$(variable_at "$out" "$board" stack_unused)" "${options[@]}" -o "$file" || return
    [ "$(wc -l <"$file")" -gt 1 ] || {
        echo "flips: error: no run is in $file" >&2
        return 1
    }
}

# The outcomes, a line a drive and kind, of files in which a line is a run, or with counts of bits and cycles.
summary() { # FILE...
    printf '%-10s %-6s %10s %10s %10s %10s %10s %10s %10s\n' drive what runs none corrected safe-stop FAULT watchdog unsafe
    awk -F , '
        BEGIN { names = split("none corrected safe-stop FAULT watchdog unsafe", name, " ") }
        FNR == 1 {
            counts = $4 == "none"
            split(FILENAME, part, "[./]")
            kind = sprintf("%-10s %-6s", part[4], part[5])
            if (!(kind in runs)) { kinds[++n] = kind; runs[kind] = 0 }
            next
        }
        counts { for (i = 1; i <= names; i++) { count[kind name[i]] += $(3 + i); runs[kind] += $(3 + i) } }
        !counts { runs[kind]++; count[kind ($6 == "lost" ? "unsafe" : $6)]++ }
        END {
            for (k = 1; k <= n; k++) {
                printf "%s %10d", kinds[k], runs[kinds[k]]
                for (i = 1; i <= names; i++) printf " %10d", count[kinds[k] name[i]]
                print ""
            }
        }' "$@"
}

# The ten addresses of a kind that are unsafe most often, with why.
worst() { # BOARD WHAT
    local files=("$out/$1".*."$2".csv "$out/$1".*."$2".*.csv)
    [ ${#files[@]} -gt 0 ] || return
    echo
    echo "the worst of $2: unsafe ones, place, address, why"
    awk -F , '
        FNR == 1 { counts = $4 == "none"; next }
        counts && $9 > 0 { n[$1 " " $2] += $9 }
        !counts && ($6 == "unsafe" || $6 == "lost") { place = $1 " " ($1 == "pc" ? "bit " $4 : $3); n[place]++; if (!index(why[place], $7)) why[place] = why[place] " " $7 }
        END { for (place in n) print n[place], place why[place] }' "${files[@]}" |
        sort -k1,1nr -k2 | head -n 10 | sed 's/^/  /'
}

# The ten functions whose code is unsafe most often, and how often the flips come to what.
worst_functions() { # BOARD
    local files=("$out/$1".*.code.csv)
    [ ${#files[@]} -gt 0 ] || return
    echo
    echo "the worst functions: unsafe flips of their code, why"
    {
        sed -nE 's/^ +00([0-9A-F]{4}) +[0-9]+ _(\w+):+$/\1 \2/p' "$out/$1"/brake/*/*.rst
        awk -F , '$6 == "unsafe" || $6 == "lost" { print substr("000" substr($3, 3), length($3) - 2), "flip", $7 }' "${files[@]}"
    } | sort -s -k 1,1 | awk '
        NF == 2 { name = $2 }
        NF == 3 { n[name]++; why[name, $3]++; reasons[$3] }
        END {
            for (name in n) {
                printf "%d %s", n[name], name
                for (reason in reasons) if ((name, reason) in why) printf " %s %d", reason, why[name, reason]
                print ""
            }
        }' | sort -k1,1nr -k2 | head -n 10 | sed 's/^/  /'
}

# For the report, of the first board: of each byte the worst that any bit of it came to; a register's line is
# 16 more than in its address.
map() { # BOARD
    awk -F , '
        BEGIN { print "high,low,outcome"; names = split("none corrected safe-stop FAULT watchdog unsafe", name, " "); for (i = 1; i <= names; i++) rank[name[i]] = i - 1; rank["lost"] = names - 1 }
        function nibble(digit) { return index("0123456789ABCDEF", digit) - 1 }
        FNR > 1 { place = 16 * nibble(substr($3, 3, 1)) + nibble(substr($3, 4, 1)) + ($1 == "sfr" ? 256 : 0); if (!(place in worst) || rank[$6] > worst[place]) worst[place] = rank[$6] }
        END { for (place = 0; place < 512; place++) if (place in worst) print int(place / 16) "," place % 16 "," worst[place] }' "$out/$1".*.bits.csv >"$out/map.csv"
}

# Each bit at each cycle. As many drives at a time as there are cores, each as one process: two for one drive would
# both look for the flips that come to the same.
every_cycle() { # BOARD
    local board=$1 name least at from file flying=0
    cmp -s "$out/$board/brake.ihx" "$out/$board.space.ihx" || rm -f "$out/$board".*.space.*.csv*
    cp "$out/$board/brake.ihx" "$out/$board.space.ihx"
    trap end_all EXIT
    trap 'exit 130' INT TERM HUP
    for ((from = 0; from < window; from += slice)); do
        for drive in "${drives[@]}"; do
            read -r name least at _ <<<"$drive"
            file=$out/$board.$name.space.$from.csv
            [ ! -f "$file" ] || continue
            at=$(awk -v at="$at" -v from="$from" 'BEGIN { printf "%.3f", at + from / 1000 }')
            [ $flying -lt "$(nproc)" ] || one_ends "$board"
            fly "$board" "$name" "$least" space "$file" "$at" 2>"$file.log" &
            flying=$((flying + 1))
        done
    done
    while [ $flying -gt 0 ]; do one_ends "$board"; done
    trap - EXIT INT TERM HUP
    tell_space "$board"
    cat "$out/$board.space.txt"
    awk '/drawn by chance/ { exit $1 != $(NF - 1) }' "$out/$board.space.txt" || {
        echo "flips: error: flips that were run by themselves came to something else; see $out/$board.*.space.*.csv.log" >&2
        exit 1
    }
}
end_all() { # each job is a shell that waits for flip
    local job
    for job in $(jobs -p); do pkill -TERM -P "$job"; done
}
one_ends() { # BOARD
    wait -n || {
        cat "$out/$1".*.space.*.csv.log >&2
        exit 1
    }
    flying=$((flying - 1))
    tell_space "$1"
    echo "flips: $1: $(printf '%s\n' "$out/$1".*.space.*.csv | wc -l) of $((${#drives[@]} * ((window + slice - 1) / slice))) parts done; see $out/$1.space.txt" >&2
}
tell_space() { # BOARD
    local files=("$out/$1".*.space.*.csv)
    {
        echo "$1: what became of each bit, flipped at each cycle of $window ms, of which ${#files[@]} parts are done"
        summary "${files[@]}"
        cat /dev/null "$out/$1".*.space.*.csv.log |
            awk '/ agree$/ { chosen += $5; agree += $(NF - 1) } END { print chosen + 0 " of these flips, drawn by chance, were run by themselves: " agree + 0 " agree" }'
        worst "$1" space
        echo
        echo "unsafe ones of PCON, which stops the clock, and others:"
        awk -F , 'FNR > 1 { split(FILENAME, part, "."); drives[part[2]]; if ($2 == "0x87") clock[part[2]] += $9; else others[part[2]] += $9 }
            END { for (drive in drives) printf "  %-10s %10d %10d\n", drive, clock[drive], others[drive] }' "${files[@]}" | sort
    } >"$out/$1.space.txt"
}

# Each bit at some instants; the code and the program counter by chance.
some_instants() { # BOARD
    local board=$1 name least at what
    rm -f "$out/$board".*.{bits,pc,code,stuck}.csv
    for drive in "${drives[@]}"; do
        read -r name least at <<<"$drive"
        # shellcheck disable=SC2206  # a list of words
        at=($at)
        fly "$board" "$name" "$least" bits "$out/$board.$name.bits.csv" "${at[@]:0:instants}" || exit 1
        [ "$pcs" -eq 0 ] || fly "$board" "$name" "$least" pc "$out/$board.$name.pc.csv" "${at[@]:0:instants}" || exit 1
        [ "$code" -eq 0 ] || fly "$board" "$name" "$least" code "$out/$board.$name.code.csv" "${at[@]:0:instants}" || exit 1
        [ "$instants" -lt 4 ] || fly "$board" "$name" "$least" stuck "$out/$board.$name.stuck.csv" "${at[0]}" || exit 1
    done
    {
        echo "$board: what became of flipped bits"
        summary "$out/$board".*.{bits,pc,code,stuck}.csv
        for what in bits code pc; do worst "$board" "$what"; done
        worst_functions "$board"
    } | tee "$out/$board.txt"
    [ "$board" != "$first" ] || map "$board"
}

status=0
first=${1:?"which board?"}
for board; do
    link_brake "$out" "$board" || exit 2
    if [ "$window" -gt 0 ]; then
        every_cycle "$board"
        continue
    fi
    some_instants "$board"
    if ! grep -q 'WATCHDOG *:= *none' "firmware/boards/$board.mk" &&
        awk -F , '$6 == "unsafe" && $3 != "0x87" { found = 1 } END { exit !found }' "$out/$board".*.bits.csv; then
        echo "flips: error: on $board a flip of RAM or of a register is unsafe; see $out/$board.*.bits.csv" >&2
        status=1
    fi
done
exit $status
