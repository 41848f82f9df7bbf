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
refuses "no image" 2 'Usage' build/bound
refuses "RAM that no 8051 has" 2 'give a whole number in 128..256' build/bound --iram=64 "$board/gap.ihx"

# compile NAME: $out/NAME.c becomes an image, with its map and listing.
compile() {
    sdcc -mmcs51 "$out/$1.c" -o "$out/$1.ihx" 2>"$out/sdcc.log" || say "$1.c compiles" 1 "$(cat "$out/sdcc.log")"
}

cat >"$out/recursive.c" <<'END'
volatile unsigned char depth;
static unsigned char up(void) { extern unsigned char down(void); return (unsigned char)(down() + 1); }
unsigned char down(void) { return depth == 0 ? 0 : up(); }
void main(void) { depth = down(); }
END
cat >"$out/pointer.c" <<'END'
void (*volatile act)(void);
void main(void) { act(); }
END
# Counted loops and SDCC's division need no help; a loop that stops at what the data say does.
cat >"$out/loops.c" <<'END'
#include <string.h>
volatile unsigned int a, b, c;
volatile unsigned char n;
char __xdata text[8];
static unsigned int ratio(unsigned int x) { return x / b; }
static void halve(void) { while (a != 0) { a >>= 1; } }
static void halve_bounded(void) { while (a != 0) { a >>= 1; } /* rounds: 16 */ }
static void measure(void) { n = (unsigned char)strlen(text); }
void main(void) { for (;;) { c = ratio(a); halve(); halve_bounded(); measure(); } }
END
compile loops
loops=(build/bound "$out/loops.ihx" "$out/loops.map" "$out/loops.rst")
check "a loop of SDCC's library" sh -c '"$@" | grep -q "^ratio: at most [0-9]* cycles"' sh "${loops[@]}" --cycles=ratio
check "a loop that a line bounds" sh -c '"$@" | grep -q "^halve_bounded: at most [0-9]* cycles"' sh "${loops[@]}" --cycles=halve_bounded
refuses "a loop that no line bounds" 1 "$out/loops.c:6): a loop without a bound; write /* rounds: N */ on the line of its condition, or give --loop=halve:N" "${loops[@]}" --cycles=halve
refuses "a function of the library that no one bounds" 1 "strlen, called at $out/loops.c:8: a loop without a bound; avoid the call, or give --loop=strlen:N" "${loops[@]}" --cycles=measure
for name in strlen _strlen; do
    check "--loop=$name" sh -c '"$@" | grep -q "^measure: at most [0-9]* cycles"' sh "${loops[@]}" --cycles=measure --loop=$name:8
done
refuses "a loop of no function" 1 "no function 'nosuch'" "${loops[@]}" --loop=nosuch:16
refuses "a loop without number" 2 "--loop=strlen: give FUNCTION:N" "${loops[@]}" --loop=strlen

compile recursive
compile pointer
cat >"$out/late.c" <<'END'
#include <8051.h>
volatile unsigned char n;
void late(void) __interrupt(1) { while (n != 0) { n >>= 1; } }
void main(void) { IE = 0x82; for (;;) { } }
END
compile late
late=(build/bound "$out/late.ihx" "$out/late.map" "$out/late.rst")
refuses "an interrupt without a bound" 1 "$out/late.c:3): a loop without a bound" "${late[@]}"
check "the stack has a bound nevertheless" sh -c '"$@" 2>/dev/null | grep -q "^stack: at most [0-9]* of [0-9]* bytes"' sh "${late[@]}"
printf ':0100800022%s\n:00000001FF\n' 5D >"$out/part.ihx"
refuses "an image that does not begin at 0" 1 'part.ihx: error: no code at address 0' build/bound "$out/part.ihx"

refuses "recursion" 1 "$out/recursive.c:2: down calls itself: down > up > down; the stack of a recursion has no bound" \
    build/bound "$out/recursive.ihx" "$out/recursive.map" "$out/recursive.rst"
refuses "a call through a pointer" 1 "called at $out/pointer.c:2): calls through a function pointer" \
    build/bound "$out/pointer.ihx" "$out/pointer.map" "$out/pointer.rst"
finish
