# SPDX-License-Identifier: MIT
# What all shell tests share. A test is started in the repository's root and begins with
#     . tests/lib.sh
# It has the empty folder $out, build/tests/NAME, for its files, prints one line a case, as tests/run.sh
# expects them, and ends with
#     finish
# shellcheck shell=bash
set -u
out=build/tests/$(basename "$0" .sh)
rm -rf "$out"
mkdir -p "$out"
cases_failed=0

# say NAME STATUS [WHY]: the case passes if STATUS is 0.
say() {
    # The line of the test itself, however many functions called each other from there.
    local place="$0:${BASH_LINENO[-2]}:$1"
    if [ "$2" -eq 0 ]; then
        echo "$place:PASS"
    else
        echo "$place:FAIL: $(tr '\n' ' ' <<<"${3:-}" | head -c 500)"
        cases_failed=$((cases_failed + 1))
    fi
}

# faultless NAME FAULT: the case passes if FAULT, a text that says what is wrong, is empty.
faultless() {
    [ -z "$2" ]
    say "$1" $? "$2"
}

# check NAME COMMAND...: the case passes if COMMAND succeeds; otherwise its output says why.
check() {
    local name=$1 output
    shift
    output=$("$@" 2>&1)
    say "$name" $? "$*: $output"
}

# expect NAME STATUS STDOUT STDERR COMMAND...: COMMAND ends with STATUS and prints STDOUT ('*': anything);
# its stderr contains STDERR, or is empty if STDERR is.
expect() {
    local name=$1 status=$2 stdout=$3 stderr=$4 fault='' got_stdout got_status got_stderr
    shift 4
    got_stdout=$("$@" 2>"$out/expect.stderr")
    got_status=$?
    got_stderr=$(<"$out/expect.stderr")
    [ "$got_status" -eq "$status" ] || fault="exit status $got_status, not $status: ${got_stderr:0:1000}"
    [ "$stdout" = '*' ] || [ "$got_stdout" = "$stdout" ] || fault="printed '$got_stdout', not '$stdout'"
    if [ -z "$stderr" ]; then
        [ -z "$got_stderr" ] || fault="its stderr is not empty: ${got_stderr:0:1000}"
    else
        [[ $got_stderr == *"$stderr"* ]] || fault="did not say '$stderr', but: ${got_stderr:0:1000}"
    fi
    faultless "$name" "$fault"
}

# refuses NAME STATUS MESSAGE COMMAND...: COMMAND ends with STATUS, and the first line of its stderr that
# names an error (of all lines, if none does) contains MESSAGE.
refuses() {
    local name=$1 status=$2 message=$3 got_status said
    shift 3
    said=$("$@" 2>&1 >/dev/null)
    got_status=$?
    said=$(grep -a -m 1 -e 'error' -e '\*\*\*' <<<"$said" || echo "$said")
    [ "$got_status" -eq "$status" ] && [[ $said == *"$message"* ]]
    say "$name" $? "exit status $got_status (expected $status), stderr (expected '$message'): $said"
}

# Ends the test: exit status 1 if a case failed.
finish() {
    exit $((cases_failed > 0))
}

# A test that calls a helper that does not exist fails.
command_not_found_handle() {
    say "command $1" 1 "not found"
    return 127
}
