/* SPDX-License-Identifier: MIT */
/* The chip's side of the steps. host.c writes a step's input to xdata from STEP_IN on, and then
 * STEP_GO; it reads each byte that this image writes to STEP_OUT. */
#include "steps.h"
#include "cells.h"

#define IN  ((volatile uint8_t __xdata *)STEP_IN)
#define GO  (*(volatile uint8_t __xdata *)STEP_GO)
#define OUT (*(volatile uint8_t __xdata *)STEP_OUT)

static uint8_t at; /* the next byte of the input */

uint8_t take(void)
{
    return IN[at++];
}

void put(uint8_t byte)
{
    OUT = byte;
}

void main(void)
{
    steps_begin();
    for (;;) {
        while (GO == 0) {
        }
        GO = 0;
        at = 0;
        step();
    }
}
