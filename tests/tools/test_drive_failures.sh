#!/bin/bash
# SPDX-License-Identifier: MIT
# Whatever goes wrong with the simulator, the image, the options or the outputs, drive says so in one
# line, ends with the right status in bounded time, and leaves no process and no file behind.
. tests/lib.sh
# What fails here is s51. What is about the image alone runs in the engine that is asked for.
any=(--engine="${ENGINE:-s51}")
export ENGINE=s51
work=$PWD/$out
mkdir -p "$work/tmp" "$work/out" "$work/images" "$work/fake"
export TMPDIR=$work/tmp
drive=$PWD/build/drive
limit=("$(command -v timeout)" 60)
real_path=$PATH

cat >"$work/road.scn" <<'END'
[scenario]
title = An empty road
duration_s = 0.7
[ego]
speed_mps = 2
[expect]
impact = none
END
for kind in PLAIN SILENT HANG POWER_DOWN HURRY ECHO_BYTES; do
    sdcc -mmcs51 --std-c11 --Werror "-D$kind" tests/tools/images/odd.c -o "$work/images/$kind.ihx" || exit 1
done

run() { # IMAGE [option...]: a run of that image that also writes a trace
    image=$1
    shift
    "${limit[@]}" "$drive" run --hex "$work/images/$image.ihx" --board at89s52 --scenario "$work/road.scn" \
        --csv "$work/out/trace.csv" "$@"
}

# A process of ours still sits in the simulator's folder?
strays() {
    find /proc/[0-9]*/cwd -maxdepth 0 -lname "$TMPDIR*" 2>/dev/null | wc -l
}

clean() { # NAME: nothing was left behind
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        [ "$(strays)" -eq 0 ] && break
        sleep 0.2
    done
    [ "$(strays)" -eq 0 ] && [ -z "$(ls -A "$TMPDIR")" ] && [ -z "$(ls -A "$work/out")" ]
    say "$1, nothing left behind" $? "$(strays) processes; in $TMPDIR: $(ls -A "$TMPDIR") $(ls -A "$work/out")"
    rm -rf "${work:?}/out"/* "${TMPDIR:?}"/*
}

one_error() { # COMMAND...: its exit status, but 99 if its stderr has more than one error
    "$@" 2>"$work/stderr"
    local status=$?
    cat "$work/stderr" >&2
    [ "$(grep -c error "$work/stderr")" -le 1 ] || status=99
    return "$status"
}

fails() { # NAME STATUS MESSAGE COMMAND...: one message, and nothing left behind
    refuses "$1" "$2" "$3" one_error "${@:4}"
    clean "$1"
}

# --- usage and inputs ---
fails "no command" 2 "say what to do: run, list DIR, keys, plot, scenarios DIR or canary" "$drive"
fails "unknown command" 2 "say what to do" "$drive" fly
fails "run without options" 2 "run wants --board and --scenario" "$drive" run
fails "unknown option" 2 "unrecognized option" "$drive" run --fast
fails "quantum beyond the sensor's delay" 2 "--quantum-us=401: give a whole number in 10..400" run PLAIN --quantum-us 401
fails "step of no length" 2 "--step-us=0: give a whole number" run PLAIN --step-us 0
fails "unknown board" 2 "no board 'at89s51'; the boards are: $(basename -as .mk firmware/boards/*.mk | xargs)" run PLAIN --board at89s51
fails "missing scenario" 1 "nowhere.scn: error: cannot read the scenario" run PLAIN --scenario nowhere.scn
fails "folder as a scenario" 1 "error: cannot read the scenario: Is a directory" run PLAIN --scenario "$work"
fails "bad setting" 1 "--set: error: 'speed=4': write section.key=value" run PLAIN --set speed=4
fails "setting of no key" 1 "--set: error: no key 'speed' in [ego]" run PLAIN --set ego.speed=4
fails "setting of no section" 1 "--set: error: app brake has no section [car]" run PLAIN --set car.speed=4
fails "setting out of range" 1 "--set: error: speed_mps = 99 is out of range" run PLAIN --set ego.speed_mps=99
fails "missing image" 2 "NOTHERE.ihx: error: cannot read the image" run NOTHERE
echo "hello" >"$work/images/TEXT.ihx"
fails "text as an image" 2 "TEXT.ihx:1: error: not an Intel HEX record" run TEXT
head -n 3 "$work/images/PLAIN.ihx" >"$work/images/CUT.ihx"
fails "image without its end" 2 "CUT.ihx:3: error: the image ends without an end record" run CUT
echo ":00000001FF" >"$work/images/EMPTY.ihx"
fails "empty image" 2 "EMPTY.ihx: error: the image is empty" run EMPTY
fails "list of no folder" 1 "nowhere: error: cannot be read" "$drive" list nowhere
fails "list of an empty folder" 1 "holds no scenario (.scn)" "$drive" list "$work/fake"

# --- outputs ---
fails "trace into no folder" 1 "cannot write: No such file or directory" run PLAIN --csv "$work/no/trace.csv"
fails "trace onto a full disk" 1 "/dev/full: error: cannot write" run PLAIN --csv /dev/full
fails "result onto a full disk" 1 "/dev/full: error: cannot write" run PLAIN --json /dev/full
with_tmp() {
    (
        export TMPDIR=$1
        shift
        "$@"
    )
}
fails "no temporary folder" 2 "no room for the simulator's files" with_tmp "$work/nowhere" run PLAIN

# --- the controller ---
fails "no trigger ever" 1 "no trigger pulse within 10 s" run SILENT "${any[@]}"
run HANG "${any[@]}" >"$work/stdout" 2>"$work/stderr"
[ $? -eq 1 ] && grep -q "FAILS  resets = 0 .* 1" "$work/stdout"
say "a watchdog reset fails a run that expects none" $? "$(cat "$work/stdout" "$work/stderr")"
rm -f "$work/out/trace.csv"
run HANG "${any[@]}" --set expect.resets=1 --set "expect.reset_brake_pct <=0" >"$work/stdout" 2>"$work/stderr"
say "a watchdog reset is seen, and the brake after it" $? "$(cat "$work/stdout" "$work/stderr")"
rm -f "$work/out/trace.csv"
fails "chip powered down" 2 "s51: error: hangs: no sign for" run POWER_DOWN
run ECHO_BYTES "${any[@]}" --set uart.at_s=0.5 --set uart.send=HAL --set expect.uart_says=IBM >"$work/stdout" 2>&1
say "bytes reach the controller" $? "$(cat "$work/stdout")"
rm -f "$work/out/trace.csv"

# --- a guess that goes wrong: begun again, and the same numbers as without guesses ---
near=(--set lead.gap_m=3 --set ego.speed_mps=0 --stats)
run HURRY "${near[@]}" --vcd "$work/out/guess.vcd" >"$work/stdout"
run HURRY "${near[@]}" --vcd "$work/out/sure.vcd" --quantum-us 400 >/dev/null
grep -q "begun again" "$work/stdout" && cmp -s "$work/out/guess.vcd" "$work/out/sure.vcd"
say "a trigger earlier than ever" $? "$(tail -n 1 "$work/stdout")"
rm -f "$work/out"/*

# --- the simulator ---
with_path() { # PATH command...
    (
        PATH=$1
        shift
        "$@"
    )
}
fails "no s51" 2 "s51: error: not found in PATH, nor is ucsim_51; install sdcc-ucsim" with_path "$work/fake" run PLAIN
fake() { # a script that takes the simulator's place; s51 in it is the real one
    printf '#!/bin/sh\nreal=%s\n%s\n' "$(command -v s51 || command -v ucsim_51)" "$1" >"$work/fake/s51"
    chmod +x "$work/fake/s51"
}
with_fake() {
    with_path "$work/fake:$real_path" "$@"
}
fake 'echo "sh: hello"'
fails "another program called s51" 2 "s51: error: does not answer to -v" with_fake run PLAIN
fake 'sleep 100'
fails "s51 that never answers" 2 "s51: error: does not answer to -v" with_fake run PLAIN
fake '[ "$1" = -v ] && exec $real -v; exit 3'
fails "s51 that ends at once" 2 "s51: error: ended with status 3" with_fake run PLAIN
mkdir -p "$work/loop"
cp "$work/road.scn" "$work/loop"
! with_fake tests/run_loop.sh at89s52 "$work/loop" >"$work/stdout" 2>&1 && grep -q ':FAIL: drive ended with 2: s51: error: ended with status 3' "$work/stdout" &&
    ! grep -q 'PASS$' "$work/stdout"
say "a run whose s51 ended is no pass" $? "$(cat "$work/stdout")"
fake '[ "$1" = -v ] && exec $real -v; kill -SEGV $$'
fails "s51 that crashes at once" 2 "s51: error: died of signal 11" with_fake run PLAIN
fake '[ "$1" = -v ] && exec $real -v; sleep 100'
fails "s51 that does nothing" 2 "s51: error: hangs: no sign for" with_fake run PLAIN
fake '[ "$1" = -v ] && exec $real -v; echo "what now" >out; sleep 100'
fails "s51 that talks nonsense" 2 "does not write a value change dump" with_fake run PLAIN
fake '[ "$1" = -v ] && exec $real -v; exec $real $(echo " $* " | sed "s/ -C start / -C start2 /")'
fails "s51 that does not find its start file" 2 "s51: error: " with_fake run PLAIN

fake '[ "$1" = -v ] && { echo "s51: 0.9.9"; exit; }; exec $real "$@"'
with_fake run PLAIN >"$work/stdout" 2>"$work/stderr" &&
    grep -q "s51: warning: version 0.9.9 is not 0.6.4 (Debian 12) or 0.8.15 (Debian 13), but it keeps time" "$work/stderr"
say "another version that keeps time" $? "$(cat "$work/stderr")"
rm -f "$work/out"/*
fake '[ "$1" = -v ] && { echo "s51: 0.9.9"; exit; }; exec $real $(echo "$*" | sed s/12000000/11059200/)'
fails "another version that does not keep time" 2 \
    " %); install version 0.6.4" with_fake run PLAIN
fails "canary of another version" 2 "version 0.9.9 reads a pulse" with_fake "$drive" canary
"$drive" canary >"$work/stdout" 2>&1 &&
    grep -q "^s51 [0-9.]* keeps time: a pulse of 5800 us reads 5800 us" "$work/stdout"
say "the canary is content with this version" $? "$(cat "$work/stdout")"

# --- violence ---
simulator_of() { # the pid of the s51 that the drive of pid $1 runs; the one that it asks for its version has no -g
    for _ in $(seq 50); do
        pgrep -P "$1" -f '51 .*-g' && return
        sleep 0.1
    done
}
begin() { # starts a long run; leaves its pid in $pid, its simulator's in $simulator, a moment on
    "$drive" run --hex "$work/images/PLAIN.ihx" --board at89s52 --scenario "$work/road.scn" --set scenario.duration_s=60 \
        --csv "$work/out/trace.csv" >"$work/stdout" 2>"$work/stderr" &
    pid=$!
    simulator=$(simulator_of $pid | tail -n 1)
    sleep 0.3
}
begin
kill -KILL "$simulator"
wait $pid
[ $? -eq 2 ] && grep -q "s51: error: died of signal 9 (Killed) at" "$work/stderr" && [ "$(wc -l <"$work/stderr")" -eq 1 ]
say "s51 killed in the middle" $? "$(cat "$work/stderr")"
clean "s51 killed in the middle"
begin
kill -TERM $pid
wait $pid
[ $? -eq 2 ] && grep -q "interrupted at" "$work/stderr"
say "drive terminated" $? "$(cat "$work/stderr")"
clean "drive terminated"
begin
kill -KILL $pid
wait $pid 2>/dev/null
for _ in $(seq 30); do
    kill -0 "$simulator" 2>/dev/null || break
    sleep 0.1
done
! kill -0 "$simulator" 2>/dev/null
say "drive killed: its s51 ends" $? "s51 $simulator runs on"
rm -f "$work/out"/.??* "$work/out"/* # the half-written trace beside its place
clean "drive killed"
begin
kill -STOP "$simulator"
sleep 3
kill -0 $pid && kill -CONT "$simulator"
kill -TERM $pid
wait $pid
grep -q "interrupted" "$work/stderr"
say "a simulator that gets no time is waited for" $? "$(cat "$work/stderr")"
clean "a simulator that gets no time is waited for"
finish
