/* SPDX-License-Identifier: MIT */
/* The begin of a round of main, and the way back to the start for a program that ran wild. */
#include "sfr.h"

/* It is assembly because C knows no stack pointer. Two bytes are on the stack here: the return
 * address. `reti` returns as `ret` does and also ends an interrupt that a wild program left open;
 * no other of its level would come any more. */
void hal_begin_round(void) __naked
{
    /* clang-format off */
    __asm
        mov     a, #0x55            ; two patterns go through all registers
    00001$:
        mov     b, a
        mov     dpl, b
        mov     dph, dpl
        mov     psw, #0xE6          ; all flags, bank 0
        mov     r0, dph
        mov     1, r0
        mov     a, psw
        orl     a, #1               ; but the parity
        cjne    a, #0xE7, _hal_restart
        mov     a, r1
        mov     r2, a
        mov     a, r2
        mov     r3, a
        mov     a, r3
        mov     r4, a
        mov     a, r4
        mov     r5, a
        mov     a, r5
        mov     r6, a
        mov     a, r6
        mov     r7, a
        mov     a, r7
        cjne    a, #0x55, 00002$
        mov     a, #0xAA
        sjmp    00001$              ; rounds: 2
    00002$:
        cjne    a, #0xAA, _hal_restart
        add     a, #0x80            ; 0x2A with carry and overflow
        jnb     ov, _hal_restart
        addc    a, #0xD5            ; so 0, with carry and half carry
        jnz     _hal_restart
        jnc     _hal_restart
        jnb     ac, _hal_restart
        mov     psw, #0
        mov     a, psw
        jnz     _hal_restart
        mov     a, sp
        cjne    a, #(__start__stack + 1), _hal_restart
    __endasm;
#ifdef WATCHDOG_none
    __asm__("djnz _round_guard, 00003$\n sjmp _hal_restart\n00003$:"); /* timer 1 makes no ticks */
#endif
    __asm__("reti");
    /* clang-format on */
}

/* EXTERNAL_STARTUP sets the pins. */
void hal_restart(void) __naked
{
    /* clang-format off */
    __asm
        clr     ea
        ljmp    0
    __endasm;
    /* clang-format on */
}
