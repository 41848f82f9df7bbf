/* Times a control step of a controller on frames as it ships: in place of apps/frames.c, with the
 * interrupts off. Prints the least and the most machine cycles of app_read and app_decide together
 * over the payloads of tests/bench/APP.c. */
#include <8052.h>
#include "frames.h"
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

    while (unit > 1 && number < unit)
        unit /= 10;
    for (; unit > 0; unit /= 10)
        print((char)('0' + number / unit % 10));
}

/* Direct RAM is the controllers'. */
static __idata uint16_t n, least = 65535U, most, refused;

void main(void)
{

    TMOD = 1;
    app_init();
    for (n = 0; n < bench_payloads; n++) {
        uint16_t taken;

        bench_payload(n);
        TH0 = 0;
        TL0 = 0;
        TR0 = 1;
        if (app_read())
            app_decide();
        else
            refused++;
        TR0 = 0;
        taken = (uint16_t)((uint16_t)TH0 << 8 | TL0);
        if (taken < least)
            least = taken;
        if (taken > most)
            most = taken;
    }
    print('\n');
    print_number(least);
    print(' ');
    print_number(most);
    print(' ');
    print_number(refused);
    print(' ');
    print('e');
    print('n');
    print('d');
    print('\n');
    SIMULATOR = 's';
    for (;;)
        ;
}
