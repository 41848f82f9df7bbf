/* SPDX-License-Identifier: MIT */
/* The brake's registers as pwm.c, baud.c and the sensor's file have set them at start. */
#include "sfr.h"

#ifdef SENSOR_tfluna
#define TMOD_AT_START (T1_M0 | T0_M0)
#define IE_AT_START   0x98 /* EA, ES, ET1 */
#define IP_AT_START   0x08 /* PT1 */
#else
#define TMOD_AT_START (T1_M0 | T0_GATE | T0_M0)
#define IE_AT_START   0x88 /* EA, ET1 */
#define IP_AT_START   0
#endif
#define T2CON_AT_START 0x34
#define SCON_MODE      0x50 /* 8 bits, receiver on */
#define SCON_MODE_MASK 0xF0

void hal_registers_restore(void)
{
    TMOD = TMOD_AT_START;
    IE = IE_AT_START;
    IP = IP_AT_START;
    TR1 = 1;
#ifdef SENSOR_tfluna
    TR0 = 1;
#else
    IT0 = 1;
#endif
    P3 |= 0x0F; /* the latches of inputs and UART; low they would hold their pins low */
    T2CON = T2CON_AT_START;
    RCAP2L = (uint8_t)BAUD_RELOAD;
    RCAP2H = (uint8_t)(BAUD_RELOAD >> 8);
    /* To write it at any time could undo a flag that the UART is just setting. */
    if ((SCON & SCON_MODE_MASK) != SCON_MODE) {
        SCON = SCON_MODE | 2U; /* ready to send */
    }
}
