/* SPDX-License-Identifier: MIT */
/* Timer 2: the baud rate of the UART, 9600 8N1. */
#include "sfr.h"

void uart_init(void)
{
    RCAP2L = (uint8_t)BAUD_RELOAD;
    RCAP2H = (uint8_t)(BAUD_RELOAD >> 8);
    T2CON = 0x34; /* RCLK, TCLK, TR2: both directions by timer 2 */
    SCON = 0x52;  /* 8 bits, receiver on, ready to send */
}
