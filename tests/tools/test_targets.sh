#!/bin/bash
# SPDX-License-Identifier: MIT
# make's targets for single uses: the unit tests alone, one drive, the simulator's console; and that
# NO_INSTALL=1 names what is missing and installs nothing.
. tests/lib.sh

prints() { # NAME, PATTERN, COMMAND...: COMMAND succeeds and prints a line like PATTERN
    local name=$1 pattern=$2 output
    shift 2
    output=$("$@" 2>&1) && grep -qE "$pattern" <<<"$output"
    say "$name" $? "no '$pattern' in: $output"
}

prints "one unit test" '^ *[1-9][0-9]* passed +0 failed +[0-9.]+ s  build/unit/test_lamp$' make unit TEST=lamp
prints "one unit test on the chip" '^ *[1-9][0-9]* passed +0 failed +[0-9.]+ s  tests/run_chip.sh build/chip/test_lamp.ihx$' make unit-chip TEST=lamp
prints "without TEST all of them" 'tests/run.sh .*/test_brake.ihx.*/test_warning.ihx' make -n run-unit-chip
refuses "a unit test that is not there" 2 "no test 'nosuch'; the tests are: brake " make unit TEST=nosuch
refuses "a test that the chip does not have" 2 "test 'golden' is not one of the chip's; these are: brake " make unit-chip TEST=golden

prints "one drive" '^  holds  parked = yes' make sim APP=park SCENARIO=tests/loop/park/t1_demo.scn
refuses "a drive of an app that is not there" 2 "no app 'nosuch'; the apps are: brake" make sim APP=nosuch
console() {
    printf 'step 1000\nstate\nquit\n' | make sim BOARD=at89s52
}
prints "the console has the image loaded" 'Simulated [1-9][0-9]* ticks' console

# What is written to the keys arrives at the UART: the program for a freshly wired board goes a step on. The
# simulator looks for a key once in a million instructions or more; a key that comes during the self-test, which
# takes two to three million, does nothing.
bringup() {
    mkdir -p build/sim
    [ -p build/sim/keys ] || mkfifo build/sim/keys
    exec {keys}<>build/sim/keys
    printf nnnnnnnn >&"$keys"
    printf 'step 8000000\nquit\n' | make sim APP=bringup >"$out/console" 2>&1
    exec {keys}>&-
    tr -d '\r' <build/sim/uart
}
prints "the console sends keys" '^# step 1 lamp: on$' bringup

# A machine without apt, and with next to nothing else.
mkdir -p "$out/bin"
for program in sh dirname cat sed; do ln -s "$(command -v $program)" "$out/bin/$program"; done
without() {
    env "$@" PATH="$out/bin" tools/deps.sh unit
}
refuses "without apt all that is missing is named" 1 "these are missing; install them and call make again:" without A=1
[[ $(without A=1 2>&1) == *sdcc*"s51 or ucsim_51"*"<ini.h>"*parallel* ]]
say "each thing has its line" $? "$(without A=1 2>&1)"
printf '#!/bin/sh\necho apt-get was called >&2\nexit 3\n' >"$out/bin/apt-get"
chmod +x "$out/bin/apt-get"
refuses "NO_INSTALL=1 installs nothing" 1 "these are missing" without NO_INSTALL=1
check "NO_INSTALL=1 goes on where all is there" env NO_INSTALL=1 tools/deps.sh unit
# A Debian that has none of them.
ln -s "$(command -v id)" "$(command -v env)" "$out/bin"
printf '#!/bin/sh\n' >"$out/bin/apt-get"
printf '#!/bin/sh\nexit 100\n' >"$out/bin/apt-cache"
chmod +x "$out/bin/apt-cache"
refuses "a package that this Debian lacks is named" 1 "this Debian has no package gcc" without A=1
finish
