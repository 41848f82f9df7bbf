/* expect: interrupt 'overflow' calls '__divuint'; let main do it, or write it inline */
#include <8052.h>

static volatile unsigned int sum, divisor;

void overflow(void) __interrupt(1)
{
    sum = sum / divisor;
}

void main(void)
{
    for (;;) {
    }
}
