/* SPDX-License-Identifier: MIT */
/* The code memory while the program runs: a sum over all of it, and a sum of the sums, slice by
 * slice. tools/identify.sh has made both 0 by two bytes of the image. Each single bit that changes
 * shows. */
#include <stdint.h>
#include "hal.h"

/* Address (low byte first), sum, sum of sums. It is assembly because the same in C takes twice the
 * time and the code. */
static __idata uint8_t state[4];

uint8_t hal_code_test(void) __naked
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
        mov     a, dph              ; r5 is 0, HAL_CODE_RUNNING
        cjne    a, #((s_XINIT + 0xFF) >> 8), 00003$     ; XINIT comes after all code
        inc     r5                  ; HAL_CODE_GOOD
        mov     a, r6
        orl     a, r7
        jz      00002$
        inc     r5                  ; HAL_CODE_BAD
    00002$:                         ; the next pass
        clr     a
        mov     dpl, a
        mov     dph, a
        mov     r6, a
        mov     r7, a
    00003$:
        mov     r0, #_state
        mov     @r0, dpl
        inc     r0
        mov     @r0, dph
        inc     r0
        mov     @r0, 6
        inc     r0
        mov     @r0, 7
        mov     dpl, r5
        ret
    __endasm; /* rounds: 8 */
    /* clang-format on */
}
