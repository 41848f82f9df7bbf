/* SPDX-License-Identifier: MIT */
/* Reads laws of monotony. */
#include "law.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"

static bool parse_law(const char *text, struct law *law)
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

bool laws_add(struct laws *laws, const char *text)
{
    struct law *law = &laws->common;
    size_t used = strlen(laws->text);
    const char *colon = strchr(text, ':');

    if (colon != NULL) {
        char *end;
        unsigned long output = isdigit((unsigned char)*text) ? strtoul(text, &end, 10) : 0;

        if (output < 1 || output > FIS_VARIABLES_MAX || end != colon) {
            return false;
        }
        law = &laws->output[output - 1];
    }
    if (law->text != NULL || !parse_law(colon != NULL ? colon + 1 : text, law)) {
        return false;
    }
    snprintf(laws->text + used, sizeof laws->text - used, "%s%s", laws->any ? " " : "", text);
    laws->any = true;
    return true;
}

const struct law *laws_of(const struct laws *laws, size_t output)
{
    return laws->output[output].text != NULL ? &laws->output[output] : &laws->common;
}

static int check_inputs(const struct law *law, const struct fis *fis, const char *option)
{
    for (size_t i = fis->inputs; i < FIS_VARIABLES_MAX; i++) {
        if (law->text != NULL && law->direction[i] != 0) {
            diag_error(fis->file, 0, "%s=%s names input %zu, but the system has %zu inputs", option,
                       law->text, i + 1, fis->inputs);
            return EXIT_USAGE;
        }
    }
    return EXIT_FINE;
}

int laws_check(const struct laws *laws, const struct fis *fis, const char *option)
{
    for (size_t o = 0; o < FIS_VARIABLES_MAX; o++) {
        if (laws->output[o].text == NULL) {
            continue;
        }
        if (o >= fis->outputs) {
            diag_error(fis->file, 0, "%s=%zu:%s names output %zu, but the system has %zu outputs",
                       option, o + 1, laws->output[o].text, o + 1, fis->outputs);
            return EXIT_USAGE;
        }
        if (check_inputs(&laws->output[o], fis, option) != EXIT_FINE) {
            return EXIT_USAGE;
        }
    }
    return check_inputs(&laws->common, fis, option);
}
