/* SPDX-License-Identifier: MIT */
#include "identity.h"

#include "diag.h"

#include <stdio.h>
#include <string.h>

void identity_find(struct identity *identity, const struct hexfile *hex)
{
    char image[2 * IDENTITY_WORD];
    size_t at = (size_t)hex->code[IDENTITY_AT] + 256U * hex->code[IDENTITY_AT + 1];

    memset(identity, 0, sizeof *identity);
    if (!hex->used[IDENTITY_AT] || !hex->used[IDENTITY_AT + 1]) {
        return;
    }
    for (size_t k = 0; k < IDENTITY_TEXT - 1 && at < HEX_CODE_SIZE && hex->used[at] &&
                       hex->code[at] >= ' ' && hex->code[at] <= '~';
         k++, at++) {
        identity->text[k] = (char)hex->code[at];
    }
    if (sscanf(identity->text, "fuzzy51 %*15s %63s %31s %ld Hz %31s table=", image, identity->board,
               &identity->clk_hz, identity->sensor) != 4) {
        memset(identity, 0, sizeof *identity);
        return;
    }
    if (strncmp(identity->sensor, "table=", strlen("table=")) == 0) {
        strcpy(identity->sensor, "hcsr04"); /* the first of them goes without saying */
    }
    snprintf(identity->controller, sizeof identity->controller, "%.*s", (int)strcspn(image, "/"),
             image);
}

int identity_check(const struct identity *identity, const char *hex, const char *board,
                   const char *controller)
{
    if (identity->text[0] == '\0') {
        return EXIT_FINE;
    }
    if (strcmp(identity->board, board) != 0) {
        diag_error(hex, 0,
                   "this image was built for board %s, not for %s; give --board=%s, or run: "
                   "make BOARD=%s",
                   identity->board, board, identity->board, board);
        return EXIT_USAGE;
    }
    if (strcmp(identity->controller, controller) != 0) {
        diag_error(hex, 0,
                   "this image is a controller '%s', and the scenario drives '%s', which has "
                   "another sensor and another world; give an image of '%s'",
                   identity->controller, controller, controller);
        return EXIT_USAGE;
    }
    return EXIT_FINE;
}
