/* The canary: measures a pulse on P3.2 with timer 0 and prints its length, while timer 2 interrupts
 * every 100 machine cycles and toggles P1.0. Built by SDCC, run by `drive canary`. */
#include <8052.h>
#include <stdint.h>

void tick(void) __interrupt(5) __using(1)
{
    P1_0 = !P1_0;
    TF2 = 0;
}

static void put(char c)
{
    SBUF = c;
    while (!TI)
        ;
    TI = 0;
}

static void put_decimal(uint16_t number)
{
    uint16_t unit = 10000;

    for (; unit > 0; unit /= 10) {
        put('0' + (char)(number / unit % 10));
    }
    put('\n');
}

void main(void)
{
    TMOD = 0x29; /* timer 1: 8 bit with reload, for the line; timer 0: 16 bit, runs while P3.2 is
                    high */
    TH1 = 0xF3;
    PCON = 0x80;
    SCON = 0x40; /* 4800 baud: one character is 2,080 cycles */
    TR1 = 1;
    RCAP2H = (uint8_t)((65536 - 100) >> 8);
    RCAP2L = (uint8_t)(65536 - 100);
    TH2 = RCAP2H;
    TL2 = RCAP2L;
    TR2 = 1;
    ET2 = 1;
    EA = 1;
    for (;;) {
        TR0 = 0;
        TH0 = TL0 = 0;
        TR0 = 1;
        while (!P3_2)
            ;
        while (P3_2)
            ;
        put_decimal((uint16_t)TH0 << 8 | TL0);
    }
}
