/* expect: interrupt 'overflow' calls '_scale'; let main do it, or write it inline */
#include <8052.h>

static volatile unsigned char sum;

static unsigned char scale(unsigned char value)
{
    return value * 3;
}

void overflow(void) __interrupt(1)
{
    sum = scale(sum);
}

void main(void)
{
    for (;;) {
        P1 = scale(P1);
    }
}
