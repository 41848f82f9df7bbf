#!/bin/bash
# The build gate for what SDCC compiles wrongly or unsafely: refuses each bad fixture with its message,
# is silent about the firmware, and stands in the link.
set -u
. tests/chip/check.sh
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

refuses() { # FIXTURE
    local expected name
    name=$(basename "$1" .c)
    expected=$(sed -n '1s|^/\* expect: \(.*\) \*/$|\1|p' "$1")
    sdcc -mmcs51 --std-c11 --i-code-in-asm -c "$1" -o "$dir/$name.rel" || return 1
    # An interrupt without a vector is one whose file has no main.
    tools/check_asm.sh "$dir/$name.asm" 2>"$dir/said" && return 1
    [ -n "$expected" ] && grep -qF "error: $expected" "$dir/said"
}

for fixture in tests/bad/isr_*.c tests/bad/store_*.c; do
    check "refuses_$(basename "$fixture" .c)" refuses "$fixture"
done
for board in $(cd firmware/boards && ls -- *.mk); do
    check "accepts_the_brake_of_${board%.mk}" tools/check_asm.sh "build/${board%.mk}/brake"/*/*.asm
done

# Every lost store is named by its line, and no other one.
names_lost_stores() {
    cmp <(grep -n '/\* lost' tests/bad/store_lost.c | sed 's|:.*||; s|^|tests/bad/store_lost.c:|') \
        <(tools/check_asm.sh "$dir/store_lost.asm" 2>&1 | sed 's|: error:.*||')
}
check "names_lost_stores" names_lost_stores

# They are lost indeed; the day that SDCC stores there, this part of the gate can go.
loses_stores() {
    sed -n '/^_set:/,/ret$/{s/;.*//;p}' "$dir/store_lost.asm" >"$dir/set"
    grep -q 'subb.*_level' "$dir/set" && ! grep -qE '_lamp|_is_dark|@r' "$dir/set"
}
check "sdcc_loses_stores" loses_stores

# Without what it reads it must not be content.
refuses_plain_asm() {
    sdcc -mmcs51 --std-c11 -c tests/bad/store_lost.c -o "$dir/plain.rel" || return 1
    tools/check_asm.sh "$dir/plain.asm" 2>"$dir/said" && return 1
    grep -qF 'compile with --i-code-in-asm' "$dir/said"
}
check "refuses_asm_without_intermediate_code" refuses_plain_asm

# The link itself stops: the gate is not just a script that nobody calls.
stops_the_link() {
    make -s BOARD=stc89c516rd build/stc89c516rd/tests/bad/isr_calls.ihx 2>"$dir/said"
    [ $? -ne 0 ] && grep -qF "calls '_scale'" "$dir/said" && [ ! -e build/stc89c516rd/tests/bad/isr_calls.ihx ]
}
check "stops_the_link" stops_the_link
check_end
