/* expect: interrupt 'overflow' uses '_scale_PARM_2', which shares its place with the locals of main; make it static */
#include <8052.h>

static volatile unsigned char sum;

static unsigned char scale(unsigned char value, unsigned char by)
{
    return value * by;
}

void overflow(void) __interrupt(1)
{
    sum = scale(sum, 3);
}

void main(void)
{
    for (;;) {
        P1 = scale(P1, 2);
    }
}
