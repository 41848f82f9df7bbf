#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs an image that tests or measures itself until the image ends the run, and prints what it prints, in s51
# or, with ENGINE=fast, in our own simulator:
#     tests/run_image.sh IMAGE.ihx [FILE]        FILE gets the bytes that the image writes
# The image talks through uCsim's simulator interface at xram 0xffff: 'p' and a byte prints the byte, 'w'
# and a byte writes it, 's' ends the run. The exit status says nothing about the image: s51 always exits
# with 0. So an image prints a last line of its own, and the caller looks for that line.
set -u
cpu_seconds=120 # processor time, so that a busy machine fails no test
if [ ! -r "${1:-}" ]; then
    echo "run_image.sh: error: no image '${1:-}'; use: tests/run_image.sh IMAGE.ihx [FILE]" >&2
    exit 2
fi

if [ "${ENGINE:-s51}" = fast ]; then
    prlimit --cpu="$cpu_seconds" build/tests/fast_image "$@" 2>&1
    status=$?
    [ $status -eq 0 ] || echo "run_image.sh: fast_image ended with status $status; it has $cpu_seconds s of processor time"
    exit
fi

# s51 quits when its input ends. Its input is a pipe that `sleep` keeps open and never writes to.
coproc open_pipe { exec sleep $((cpu_seconds * 20 + 5)); }
timeout -k 1 $((cpu_seconds * 20)) prlimit --cpu="$cpu_seconds" tools/s51 -t C52 -q -b -R 1 -G \
    -I "if=xram[0xffff]${2:+,out=$2}" "$1" <&"${open_pipe[0]}" 2>&1
status=$?
# shellcheck disable=SC2154  # coproc sets it
kill "$open_pipe_PID" 2>/dev/null
[ $status -eq 0 ] || echo "run_image.sh: s51 ended with status $status; it has $cpu_seconds s of processor time"
