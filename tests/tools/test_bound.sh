#!/bin/bash
# SPDX-License-Identifier: MIT
# build/bound as the build calls it: every image of the default board has its bounds, and what cannot be
# bounded or does not fit ends with status 1 and a reason.
. tests/lib.sh
out=build/tests/bound
board=build/stc89c516rd
mkdir -p "$out"

for image in "$board"/*.ihx; do
    bound=${image%.ihx}.bound
    grep -qE '^stack: at most [0-9]+ of [0-9]+ bytes' "$bound" && grep -qE '^main: at most [0-9]+ cycles a round' "$bound" &&
        grep -qE '^[a-z_]+: at most [0-9]+ cycles$' "$bound"
    say "bounds of $(basename "$image" .ihx)" $? "$(cat "$bound" 2>&1)"
done

refuses "a stack that does not fit" 1 'bytes, and 19 are free' \
    build/bound --iram=$((256 - $(awk '$1 == "stack:" { print $6 }' "$board/gap.bound") + 19)) "$board/gap.ihx"
refuses "an image that is not there" 1 'nosuch.ihx: error: cannot read the image' build/bound "$out/nosuch.ihx"
refuses "a listing that is not there" 1 'nosuch.rst: error: cannot read the listing' build/bound "$board/gap.ihx" "$out/nosuch.rst"
refuses "a listing of another image" 1 'link the image again' build/bound "$board/gap.ihx" "$board/follow/frames/frame.rst"
refuses "a function that is not there" 1 "no function 'nosuch'" build/bound --cycles=nosuch "$board/gap.ihx" "$board/gap.map"
refuses "a loop that no line bounds" 1 'hal_trigger: a loop without a bound; do without this call, or give --loop=hal_trigger:N' build/bound --cycles=hal_trigger "$board/gap.ihx" "$board/gap.map"
refuses "no image" 2 'Usage' build/bound
refuses "RAM that no 8051 has" 2 'give a whole number in 128..256' build/bound --iram=64 "$board/gap.ihx"

cat >"$out/recursive.c" <<'END'
static unsigned char down(unsigned char n) { return n == 0 ? 0 : (unsigned char)(down(n - 1) + 1); }
volatile unsigned char depth;
void main(void) { depth = down(depth); }
END
cat >"$out/pointer.c" <<'END'
void (*volatile act)(void);
void main(void) { act(); }
END
cat >"$out/divides.c" <<'END'
volatile unsigned int a, b, c;
static unsigned int ratio(unsigned int x) { return x / b; }
void main(void) { for (;;) { c = ratio(a); } }
END
# As the firmware is built: without what SDCC 4.5 adds where the interrupts' vectors are.
for kind in recursive pointer divides; do
    { sdcc -mmcs51 -c "$out/$kind.c" -o "$out/$kind.rel" && tools/no_atomics.sh "$out/$kind.rel" &&
        sdcc -mmcs51 "$out/$kind.rel" -o "$out/$kind.ihx"; } >"$out/sdcc.log" 2>&1
    say "$kind.c compiles" $? "$(cat "$out/sdcc.log")"
done
divides=(build/bound --round=main "$out/divides.ihx" "$out/divides.map" "$out/divides.rst")
refuses "a loop of SDCC's library" 1 "_divuint, called at $out/divides.c:2: a loop without a bound; do without this call, or give --loop=_divuint:N" "${divides[@]}"
check "a bound for a loop of the library" sh -c '"$@" | grep -q "^main: at most [0-9]* cycles a round"' sh "${divides[@]}" --loop=_divuint:16
refuses "a loop of no function" 1 "no function 'nosuch'" "${divides[@]}" --loop=nosuch:16
refuses "a loop without number" 2 "--loop=_divuint: give FUNCTION:N" "${divides[@]}" --loop=_divuint

refuses "recursion" 1 'calls itself' build/bound "$out/recursive.ihx"
refuses "a call through a pointer" 1 'through a pointer' build/bound "$out/pointer.ihx"
finish
