/* expect: SDCC loses the store of this comparison; write: if (...) it = true; else it = false; */
#include <stdbool.h>

struct lamp {
    unsigned char level;
    bool is_on;
};
struct lamp lamp;
bool is_dark[4];
unsigned char level;

void set(void)
{
    lamp.is_on = level > 2;  /* lost */
    is_dark[2] = level == 1; /* lost */
}

void set_all_the_same(void)
{
    if (level > 2) {
        lamp.is_on = true;
    } else {
        lamp.is_on = false;
    }
    is_dark[2] = !(level != 1);
}

void main(void)
{
    set();
    set_all_the_same();
}
