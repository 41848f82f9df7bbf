/* SPDX-License-Identifier: MIT */
/* The code memory while the program runs: a sum over all of it, and a sum of the sums, slice by
 * slice. The first pass learns both, each later one compares. Each single bit that changes shows.
 */
#include <stdbool.h>
#include <stdint.h>
#include "hal.h"

/* Address (low byte first), sum, sum of sums; then both as learned, 0 and 0 before that. It is
 * assembly because the same in C takes twice the time and the code. */
static __idata uint8_t state[6];

bool hal_code_is_good(void) __naked
{
    (void)state;
    /* clang-format off */
    __asm
        mov     r0, #_state
        mov     dpl, @r0
        inc     r0
        mov     dph, @r0
        inc     r0
        mov     6, @r0
        inc     r0
        mov     7, @r0
        mov     r5, #8
    00001$:
        clr     a
        movc    a, @a+dptr
        inc     dptr
        add     a, r6
        mov     r6, a
        add     a, r7
        mov     r7, a
        djnz    r5, 00001$          ; rounds: 8
        mov     a, dph
        cjne    a, #((s_XINIT + 0x100) >> 8), 00004$    ; XINIT comes after all code
        inc     r0
        mov     a, @r0
        inc     r0
        orl     a, @r0
        jz      00002$
        mov     a, @r0
        xrl     a, r7
        jnz     00005$
        dec     r0
        mov     a, @r0
        xrl     a, r6
        jnz     00005$
        sjmp    00003$
    00002$:                         ; learn
        mov     @r0, 7
        dec     r0
        mov     @r0, 6
    00003$:                         ; the next pass
        clr     a
        mov     dpl, a
        mov     dph, a
        mov     r6, a
        mov     r7, a
    00004$:
        mov     r0, #_state
        mov     @r0, dpl
        inc     r0
        mov     @r0, dph
        inc     r0
        mov     @r0, 6
        inc     r0
        mov     @r0, 7
        mov     dpl, #1
        ret
    00005$:
        mov     dpl, #0
        ret
    __endasm; /* rounds: 8 */
    /* clang-format on */
}
