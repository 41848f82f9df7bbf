/* SPDX-License-Identifier: MIT */
/* Times the control steps of a controller, with the interrupts off. Prints the least and the most
 * machine cycles, what did not go as meant (nothing should), and "end". */
#include <8052.h>
#include "step.h"

#define SIMULATOR (*(volatile uint8_t __xdata *)0xFFFF)

static void print(char c)
{
    SIMULATOR = 'p';
    SIMULATOR = (uint8_t)c;
}

static void print_number(uint16_t number)
{
    uint16_t unit = 10000;

    while (unit > 1 && number < unit) {
        unit /= 10;
    }
    for (; unit > 0; unit /= 10) {
        print((char)('0' + number / unit % 10));
    }
    print(' ');
}

/* Direct RAM is the controllers'. */
static __idata uint16_t n, least = 65535U, most;

void bench_run(void)
{
    TMOD = 1;
    for (n = 0; n < bench_steps; n++) {
        uint16_t taken = bench_step(n);

        if (taken < least) {
            least = taken;
        }
        if (taken > most) {
            most = taken;
        }
    }
    print('\n');
    print_number(least);
    print_number(most);
    print_number(bench_misses());
    print('e');
    print('n');
    print('d');
    print('\n');
    SIMULATOR = 's';
    for (;;)
        ;
}
