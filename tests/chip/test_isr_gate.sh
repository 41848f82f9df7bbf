#!/bin/bash
# The build gate for interrupts: refuses each bad fixture with its message, is silent about the
# firmware, and stands in the link.
set -u
. tests/chip/check.sh
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

refuses() { # FIXTURE
    local expected name
    name=$(basename "$1" .c)
    expected=$(sed -n '1s|^/\* expect: \(.*\) \*/$|\1|p' "$1")
    sdcc -mmcs51 --std-c11 -c "$1" -o "$dir/$name.rel" || return 1
    # An interrupt without a vector is one whose file has no main.
    tools/check_isr.sh "$dir/$name.asm" 2>"$dir/said" && return 1
    [ -n "$expected" ] && grep -qF "error: $expected" "$dir/said"
}

for fixture in tests/bad/isr_*.c; do
    check "refuses_$(basename "$fixture" .c)" refuses "$fixture"
done
for board in $(cd firmware/boards && ls -- *.mk); do
    check "accepts_the_brake_of_${board%.mk}" tools/check_isr.sh "build/${board%.mk}/brake"/*/*.asm
done

# The link itself stops: the gate is not just a script that nobody calls.
stops_the_link() {
    make -s BOARD=stc89c516rd build/stc89c516rd/tests/bad/isr_calls.ihx 2>"$dir/said"
    [ $? -ne 0 ] && grep -qF "calls '_scale'" "$dir/said" && [ ! -e build/stc89c516rd/tests/bad/isr_calls.ihx ]
}
check "stops_the_link" stops_the_link
check_end
