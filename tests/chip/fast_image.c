/* SPDX-License-Identifier: MIT */
/* Runs an image that tests or measures itself in our own simulator, as tests/run_image.sh runs it
 * in s51: a byte written to xram 0xFFFF is a command. 'p' and a byte prints the byte, 'w' and a
 * byte writes it to FILE, 's' ends the run. Nothing else ends it: the caller limits its time.
 *     fast_image IMAGE.ihx [FILE] */
#include "diag.h"
#include "hexfile.h"
#include "mcs52.h"

#include <stdio.h>
#include <stdlib.h>

enum { SIMULATOR = 0xFFFF, SLICE_MC = 1000000 };

struct interface {
    struct mcs52 *chip;
    FILE *written;
    uint8_t command; /* whose byte comes next; 0: a command comes next */
    bool ended;
};

static void take(void *user, uint64_t cycle, uint8_t value)
{
    struct interface *interface = user;

    (void)cycle;
    switch (interface->command) {
    case 'p':
        putchar(value);
        break;
    case 'w':
        putc(value, interface->written != NULL ? interface->written : stderr);
        break;
    default:
        interface->ended = value == 's';
        if (interface->ended) {
            mcs52_stop(interface->chip);
        }
        interface->command = value;
        return;
    }
    interface->command = 0;
}

int main(int count, char **words)
{
    static struct hexfile hex;
    struct interface interface = {.ended = false};
    const struct mcs52_outside outside = {.user = &interface, .xdata = take};

    if (count < 2 || count > 3) {
        diag_error(NULL, 0, "use: fast_image IMAGE.ihx [FILE]");
        return EXIT_USAGE;
    }
    if (hexfile_read(&hex, words[1]) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    interface.written = count == 3 ? fopen(words[2], "wb") : NULL;
    interface.chip = mcs52_create(MCS52_INTEL, &outside);
    if (interface.chip == NULL || (count == 3 && interface.written == NULL)) {
        return diag_error(words[count - 1], 0, "cannot be written");
    }
    mcs52_load(interface.chip, 0, hex.code, sizeof hex.code);
    mcs52_watch_xdata(interface.chip, SIMULATOR);
    while (!interface.ended) {
        mcs52_run(interface.chip, mcs52_cycles(interface.chip) + SLICE_MC);
    }
    mcs52_destroy(interface.chip);
    return interface.written != NULL && fclose(interface.written) != 0 ? EXIT_INPUT : EXIT_FINE;
}
