/* Timer 2: the baud rate. Asked, never interrupting. */
#include "sfr.h"

#define BAUD        9600U
#define BAUD_RELOAD (65536UL - (CLK_HZ + 16UL * BAUD) / (32UL * BAUD))

void uart_init(void)
{
    RCAP2L = (uint8_t)BAUD_RELOAD;
    RCAP2H = (uint8_t)(BAUD_RELOAD >> 8);
    T2CON = 0x34; /* RCLK, TCLK, TR2: both directions by timer 2 */
    SCON = 0x52;  /* 8 bits, receiver on, ready to send */
}

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
