/* SPDX-License-Identifier: MIT */
/* The example of docs/bound.md. */
static volatile unsigned int whole, part, percent;

static unsigned int ratio(unsigned int a, unsigned int b)
{
    return b == 0 ? 0 : a / b;
}

void main(void)
{
    for (;;) {
        percent = ratio(part, whole);
    }
}
