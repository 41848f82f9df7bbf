/* SPDX-License-Identifier: MIT */
/* Lines of text, one character at a time. */
#include "telemetry.h"

__idata union telemetry_value telemetry_values[TELEMETRY_VALUES];

static const uint16_t __code POWERS[] = {10000, 1000, 100, 10, 1};
#define DECIMAL_HUNDREDS 2U
#define DECIMAL_END      5U

static const char __code *rest;     /* the rest of the format; 0: no line is being sent */
static const char __code *text;     /* the rest of a text value; 0: none is being sent */
static uint8_t value;               /* the index of the next value */
static uint16_t number;             /* the rest of the number being sent */
static uint8_t power = DECIMAL_END; /* the power of its next digit; DECIMAL_END: no number */
static bool is_leading;             /* no digit of the number was sent, so zeros are left out */

bool telemetry_is_busy(void)
{
    /* SDCC 4.5 would make `return rest != 0;` always true in the large memory model. */
    if (rest != 0) {
        return true;
    }
    return false;
}

void telemetry_say(const char __code *format)
{
    rest = format;
    value = 0;
}

/* Counts how often the power fits: nine subtractions take half the time of a division by 10, which
 * takes 380 mc. */
static char next_decimal(void)
{
    char digit = '0';

    for (;;) {
        uint16_t step = POWERS[power]; /* rounds: 5 */

        while (number >= step) { /* rounds: 9 */
            number -= step;
            digit++;
        }
        power++;
        if (digit != '0' || !is_leading || power == DECIMAL_END) {
            is_leading = false;
            return digit;
        }
    }
}

/* Begins to send the next value. */
static void take(char conversion)
{
    number = telemetry_values[value].number;
    is_leading = true;
    switch (conversion) {
    case 's':
        text = telemetry_values[value].text;
        break;
    case 'm':
        is_leading = telemetry_values[value - 1].number == 0;
        power = DECIMAL_HUNDREDS;
        break;
    case 'o':
        if (number == 0) {
            break;
        }
        /* fall through */
    default:
        power = 0;
        if (number < 1000U) { /* saves the time of finding leading zeros */
            power = number < 100U ? 3 : 2;
        }
    }
    value++;
}

char telemetry_next(void)
{
    while (rest != 0) { /* rounds: 3, because a text can be empty */
        char c;

        if (power < DECIMAL_END) { /* not !=: a bit of it may turn over */
            return next_decimal();
        }
        if (text != 0) {
            c = *text;
            text++;
            if (c != 0) {
                return c;
            }
            text = 0;
        }
        c = *rest;
        rest++;
        if (c == 0) {
            rest = 0;
        } else if (c == '%') {
            c = *rest;
            rest++;
            take(c);
        } else {
            return c;
        }
    }
    return 0;
}
