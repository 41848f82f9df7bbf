/* SPDX-License-Identifier: MIT */
/* The UART, by polling, without an interrupt. */
#include "sfr.h"

bool hal_uart_ready(void)
{
    return TI;
}

void hal_uart_put(char c)
{
    TI = 0;
    SBUF = (uint8_t)c;
}

char hal_uart_get(void)
{
    char c = 0;

    if (RI) {
        c = (char)SBUF;
        RI = 0;
    }
    return c;
}
