/* expect: interrupt 'overflow' has no vector; show its prototype to the file with main */
#include <8052.h>

static volatile unsigned char sum;

void overflow(void) __interrupt(1)
{
    sum++;
}
