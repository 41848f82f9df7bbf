/* SPDX-License-Identifier: MIT */
/* Unity's way out of the 8051 in s51: the simulator interface that tests/run_chip.sh switches on.
 * 'p' prints the character that follows, 's' stops the simulator. */
#define SIMULATOR (*(volatile unsigned char __xdata *)0xFFFF)

void chip_print(int c)
{
    SIMULATOR = 'p';
    SIMULATOR = (unsigned char)c;
}

void chip_end(void)
{
    SIMULATOR = 's';
}
