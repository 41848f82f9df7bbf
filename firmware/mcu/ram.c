/* SPDX-License-Identifier: MIT */
/* RAM while the program runs: a transparent March in slices. */
#include <stdbool.h>
#include <stdint.h>
#include "hal.h"

/* The byte that was tested last, and one bit: its partner's address differs in it. Not static, so
 * that a test finds it in the map. */
__idata uint8_t ram_tested[2];

/* A byte's partner is inverted, then the byte; both are put back, and looked at after each write.
 * So a stuck bit shows, and an address line that is stuck or tied to another one: each line has its
 * turn. In between, nothing else may look at them: no interrupt is let through, and none of the
 * PWM is due, so that no edge is late. R0 and R1 point to the bytes, so these two cannot be tested;
 * what is kept is in registers outside of RAM. It is assembly for that. */
bool hal_ram_test(void) __naked
{
    /* clang-format off */
    __asm
        mov     r0, #_ram_tested
        mov     a, @r0
        inc     a
        mov     @r0, a
        mov     r1, a
        xrl     a, @r0
        jnz     00004$              ; a bit of this byte is stuck
        inc     r0
        mov     a, r1
        jnz     00001$
        mov     a, @r0              ; all bytes had their turn: the next address line
        rl      a
        mov     @r0, a
    00001$:
        mov     a, @r0
        jnz     00002$
        inc     @r0                 ; the first one
        inc     a
    00002$:
        xrl     a, r1
        mov     r0, a
        anl     a, #0xFE
        jz      00003$
        mov     a, r1
        anl     a, #0xFE
        jz      00003$
        mov     a, th1              ; 0xFF: an edge is due in less than 256 cycles; 0: it is due now
        inc     a
        anl     a, #0xFE
        jz      00003$
        clr     ea
        mov     b, @r0
        mov     dpl, @r1
        mov     a, b
        cpl     a
        mov     @r0, a              ; the partner inverted
        xrl     a, @r0
        mov     dph, a              ; all that is wrong
        mov     a, @r1
        xrl     a, dpl
        orl     dph, a
        mov     a, dpl
        cpl     a
        mov     @r1, a              ; the byte inverted, too
        xrl     a, @r1
        orl     dph, a
        mov     a, @r0
        cpl     a
        xrl     a, b
        orl     dph, a
        mov     @r0, b              ; the partner put back
        mov     a, @r1
        cpl     a
        xrl     a, dpl
        orl     dph, a
        mov     @r1, dpl            ; the byte put back
        mov     a, @r0
        xrl     a, b
        orl     dph, a
        mov     a, @r1
        xrl     a, dpl
        orl     a, dph
        setb    ea
        jz      00003$
    00004$:
        mov     dpl, #0
        ret
    00003$:
        mov     dpl, #1
        ret
    __endasm;
    /* clang-format on */
}
