/* SPDX-License-Identifier: MIT */
#include "listing.h"

#include "diag.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *copy(const char *text, size_t length)
{
    char *made = strndup(text, length);

    if (made == NULL) {
        abort();
    }
    return made;
}

void listing_init(struct listing *listing)
{
    memset(listing, 0, sizeof *listing);
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        listing->rounds[i] = LISTING_NO_BOUND;
    }
}

void listing_free(struct listing *listing)
{
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        free(listing->names[i]);
        free(listing->places[i]);
    }
}

/* SDCC writes an underscore before a C name; a name without is one of assembly, or what the linker
 * and the debugger say of areas ("s_CSEG") and lines ("C$x.c$1"). If two files have a static
 * function of one name, the first one is taken. */
static void name_it(struct listing *listing, unsigned long address, const char *name, size_t length)
{
    bool is_c = length > 1 && name[0] == '_';

    if (address >= HEX_CODE_SIZE || listing->names[address] != NULL || length == 0 ||
        strncmp(name, "s_", 2) == 0 || strncmp(name, "l_", 2) == 0 || name[0] == '.' ||
        memchr(name, '$', length) != NULL) {
        return;
    }
    listing->names[address] = copy(name + is_c, length - is_c);
}

/* The position in a listing: the current area and the current source line. */
struct source {
    bool is_code;
    char *place;
    long rounds;
};

/* ";	FILE:LINE: TEXT" begins a source line; ";	[registers] ic:NUMBER: ..." does not. */
static void read_source(struct source *source, const char *comment)
{
    const char *colon = strchr(comment, ':'), *bound = strstr(comment, "rounds: ");
    const char *end = colon == NULL ? NULL : strchr(colon + 1, ':');

    if (comment[0] == '[' || end == NULL || end == colon + 1 ||
        strspn(colon + 1, "0123456789") != (size_t)(end - colon - 1)) {
        return;
    }
    free(source->place);
    source->place = copy(comment, (size_t)(end - comment));
    source->rounds =
        bound == NULL ? LISTING_NO_BOUND : strtol(bound + strlen("rounds: "), NULL, 10);
}

/* Returns whether the image has the bytes that the listing shows: " E5 32            [12]  238
 * ...".
 */
static bool is_of(const struct hexfile *hex, unsigned long address, const char *text)
{
    while (text[0] == ' ' && text[1] != ' ' && text[1] != '[') {
        char *end;
        unsigned long byte = strtoul(text + 1, &end, 16);

        if (end != text + 3 || address >= HEX_CODE_SIZE || !hex->used[address] ||
            hex->code[address] != byte) {
            return false;
        }
        address++;
        text = end;
    }
    return true;
}

/* "      000673 E5 32            [12]  238 	mov ..." is an instruction; without bytes it
 * is a label. Returns false if the image has other bytes there. */
static bool read_line(struct listing *listing, const struct hexfile *hex, struct source *source,
                      const char *line)
{
    const char *comment = strstr(line, ";\t"), *area = strstr(line, "\t.area ");
    char *end;
    unsigned long address;

    if (area != NULL) {
        source->is_code = strstr(area, "(CODE") != NULL;
    }
    if (comment != NULL && strspn(line, " 0123456789") == (size_t)(comment - line)) {
        read_source(source, comment + 2);
        return true;
    }
    if (!source->is_code || strncmp(line, "      ", 6) != 0) {
        return true;
    }
    address = strtoul(line + 6, &end, 16);
    if (end != line + 12 || address >= HEX_CODE_SIZE) {
        return true;
    }
    if (strchr(end, '[') == NULL || end[1] == ' ') {
        end += strspn(end, " 0123456789");
        name_it(listing, address, end, strcspn(end, ":"));
        return true;
    }
    if (source->place != NULL && listing->places[address] == NULL) {
        listing->places[address] = copy(source->place, strlen(source->place));
        listing->rounds[address] = source->rounds;
    }
    return is_of(hex, address, end);
}

int listing_read(struct listing *listing, const struct hexfile *hex, const char *path)
{
    FILE *stream = fopen(path, "r");
    struct source source = {.rounds = LISTING_NO_BOUND};
    char line[1024];
    int number = 0, status = EXIT_FINE;

    if (stream == NULL) {
        return diag_error(path, 0, "cannot read the listing: %s; build the image again",
                          strerror(errno));
    }
    while (status == EXIT_FINE && fgets(line, sizeof line, stream) != NULL) {
        unsigned long address;
        char name[128];

        number++;
        if (sscanf(line, "C: %lx %127s", &address, name) == 2) { /* a line of the map */
            name_it(listing, address, name, strlen(name));
        } else if (!read_line(listing, hex, &source, line)) {
            status = diag_error(
                path, number,
                "this is not in the image: the listing is of another one; link the image again");
        }
    }
    free(source.place);
    fclose(stream);
    return status;
}

long listing_find(const struct listing *listing, const char *name)
{
    for (int i = 0; i < HEX_CODE_SIZE; i++) {
        if (listing->names[i] != NULL && strcmp(listing->names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

const char *listing_name(const struct listing *listing, uint16_t address)
{
    static char text[8][8];
    static unsigned next;

    if (listing->names[address] != NULL) {
        return listing->names[address];
    }
    next = (next + 1) % 8;
    snprintf(text[next], sizeof text[next], "0x%04X", address);
    return text[next];
}
