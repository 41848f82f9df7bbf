/* SPDX-License-Identifier: MIT */
/* The code memory while the program runs: the CRC-16 of crc16.h over all of it, but from 0 on,
 * slice by slice. Two bytes of the image, which tools/identify.sh has set, make it 0. */
#include <stdint.h>
#include "hal.h"

/* Address (low byte first), CRC (high byte first). It is assembly because the same in C takes twice
 * the time and the code. */
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
        xrl     a, r6               ; x ^= x >> 4
        mov     r4, a
        swap    a
        anl     a, #0x0F
        xrl     a, r4
        mov     r4, a
        swap    a                   ; high = low ^ (x << 4) ^ (x >> 3)
        mov     r3, a
        anl     a, #0xF0
        xrl     a, r7
        mov     r6, a
        mov     a, r3
        rl      a
        mov     r3, a
        anl     a, #0x1F
        xrl     a, r6
        mov     r6, a
        mov     a, r3               ; low = (x << 5) ^ x
        anl     a, #0xE0
        xrl     a, r4
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
