#!/bin/bash
# SPDX-License-Identifier: MIT
# The build's gate against what SDCC compiles wrongly or unsafely. It rejects each bad fixture with the
# fixture's message, and it accepts the firmware. The build runs it before each link.
. tests/lib.sh

is_refused() { # FIXTURE
    local expected name
    name=$(basename "$1" .c)
    expected=$(sed -n '1s|^/\* expect: \(.*\) \*/$|\1|p' "$1")
    sdcc -mmcs51 --std-c11 --i-code-in-asm -c "$1" -o "$out/$name.rel" || return 1
    # An interrupt without a vector is one whose file has no main.
    tools/check_asm.sh "$out/$name.asm" 2>"$out/said" && return 1
    [ -n "$expected" ] && grep -qF "error: $expected" "$out/said"
}

for fixture in tests/bad/isr_*.c tests/bad/store_*.c; do
    check "refuses_$(basename "$fixture" .c)" is_refused "$fixture"
done
for board in $(cd firmware/boards && ls -- *.mk); do
    check "accepts_the_brake_of_${board%.mk}" tools/check_asm.sh "build/${board%.mk}/brake"/*/*.asm
done

# Every lost store is named by its line, and no other one.
names_lost_stores() {
    cmp <(grep -n '/\* lost' tests/bad/store_lost.c | sed 's|:.*||; s|^|tests/bad/store_lost.c:|') \
        <(tools/check_asm.sh "$out/store_lost.asm" 2>&1 | sed 's|: error:.*||')
}
check "names_lost_stores" names_lost_stores

# SDCC 4.2 loses them indeed: this part of the gate can go when Debian 12 does.
loses_stores() {
    sed -n '/^_set:/,/ret$/{s/;.*//;p}' "$out/store_lost.asm" >"$out/set"
    grep -q 'subb.*_level' "$out/set" && ! grep -qE '_lamp|_is_dark|@r' "$out/set"
}
if sdcc --version | grep -q ' 4\.2\.'; then
    check "sdcc_loses_stores" loses_stores
fi

# Without what it reads it must not be content.
refuses_plain_asm() {
    sdcc -mmcs51 --std-c11 -c tests/bad/store_lost.c -o "$out/plain.rel" || return 1
    tools/check_asm.sh "$out/plain.asm" 2>"$out/said" && return 1
    grep -qF 'compile with --i-code-in-asm' "$out/said"
}
check "refuses_asm_without_intermediate_code" refuses_plain_asm

# The link itself stops: the gate is not just a script that nobody calls.
stops_the_link() {
    ! make -s BOARD=stc89c516rd build/stc89c516rd/tests/bad/isr_calls.ihx 2>"$out/said" && grep -qF "calls '_scale'" "$out/said" && [ ! -e build/stc89c516rd/tests/bad/isr_calls.ihx ]
}
check "stops_the_link" stops_the_link
finish
