/* SPDX-License-Identifier: MIT */
/* The begin of a round of main, and the way back to the start for a program that ran wild. */
#include "hal.h"

/* It is assembly because C knows no stack pointer. Two bytes are on the stack here: the return
 * address. `reti` returns as `ret` does and also ends an interrupt that a wild program left open;
 * no other of its level would come any more. */
void hal_begin_round(void) __naked
{
    /* clang-format off */
    __asm
        mov     psw, #0
        mov     a, sp
        cjne    a, #(__start__stack + 1), _hal_restart
        reti
    __endasm;
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
