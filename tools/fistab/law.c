/* SPDX-License-Identifier: MIT */
/* Reads laws of monotony. */
#include "law.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"

bool law_parse(const char *text, struct law *law)
{
    const char *at = text;

    memset(law, 0, sizeof *law);
    law->text = text;
    for (;; at++) {
        int direction = *at == '-' ? -1 : 1;
        unsigned long input;
        char *end;

        if ((*at != '-' && *at != '+') || !isdigit((unsigned char)at[1])) {
            return false;
        }
        input = strtoul(at + 1, &end, 10);
        if (input < 1 || input > FIS_VARIABLES_MAX || law->direction[input - 1] != 0) {
            return false;
        }
        law->direction[input - 1] = direction;
        at = end;
        if (*at == '\0') {
            return true;
        }
        if (*at != ',') {
            return false;
        }
    }
}

int law_check(const struct law *law, const struct fis *fis, const char *option)
{
    for (size_t i = fis->inputs; i < FIS_VARIABLES_MAX; i++) {
        if (law->direction[i] == 0) {
            continue;
        }
        diag_error(fis->file, 0, "%s=%s names input %zu, but the system has %zu inputs", option,
                   law->text, i + 1, fis->inputs);
        return EXIT_USAGE;
    }
    return EXIT_FINE;
}
