/* SPDX-License-Identifier: MIT */
#include "listing.h"

#include "diag.h"
#include "memory.h"

#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_BYTES = 1024, NAME_BYTES = 128 };

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

/* What follows BEGIN in TEXT; NULL: TEXT does not begin so. */
static const char *behind(const char *text, const char *begin)
{
    size_t length = strlen(begin);

    return strncmp(text, begin, length) == 0 ? text + length : NULL;
}

/* SDCC writes an underscore before a C name; a name without is one of assembly, or what the linker
 * and the debugger say of areas ("s_CSEG") and lines ("C$x.c$1"). If two files have a static
 * function of one name, the first one is taken. */
static void name_it(struct listing *listing, unsigned long address, const char *name)
{
    const char *c_name = behind(name, "_");

    if (address >= HEX_CODE_SIZE || listing->names[address] != NULL || behind(name, "s_") != NULL ||
        behind(name, "l_") != NULL || (c_name == NULL && !isalpha((unsigned char)*name)) ||
        strchr(name, '$') != NULL) {
        return;
    }
    name = c_name != NULL ? c_name : name;
    listing->names[address] = memory_copy(name, strlen(name));
}

/* The position in a listing: the current area and the current source line. */
struct source {
    bool is_code;
    char *place;
    long rounds;
};

/* ";	FILE:LINE: TEXT" begins a source line; ";	[registers] ic:NUMBER: ..." does not.
 * Returns EXIT_FINE, or EXIT_INPUT after a message. */
static int read_source(struct source *source, const char *comment)
{
    static const char bound[] = "rounds: ";
    const char *rounds = strstr(comment, bound);
    int length = 0, end = 0;
    char *stop;

    sscanf(comment, "%*[^][:]:%*[0-9]%n%*1[:]%n", &length, &end);
    if (end == 0) {
        return EXIT_FINE;
    }
    free(source->place);
    source->place = memory_copy(comment, (size_t)length);
    source->rounds = LISTING_NO_BOUND;
    if (rounds == NULL) {
        return EXIT_FINE;
    }
    rounds += strlen(bound);
    source->rounds = strtol(rounds, &stop, 10);
    if (stop == rounds || source->rounds < 1 || source->rounds > LISTING_MOST_ROUNDS) {
        return diag_error(source->place, 0,
                          "`rounds:` is not followed by a whole number in 1..%d; write how many "
                          "rounds the loop has at most",
                          LISTING_MOST_ROUNDS);
    }
    return EXIT_FINE;
}

/* Returns whether the image has the bytes that the listing shows: " E5 32            [12] ...". */
static bool is_of(const struct hexfile *hex, unsigned long address, const char *bytes)
{
    unsigned byte;
    int length;

    for (; sscanf(bytes, "%2x%n", &byte, &length) == 1; bytes += length) {
        if (address >= HEX_CODE_SIZE || !hex->used[address] || hex->code[address] != byte) {
            return false;
        }
        address++;
    }
    return true;
}

/* What follows an ADDRESS of code in a listing: " E5 32            [12]  238 	mov ..." is an
 * instruction, "                        236 _work:" a label. Other bytes are data, which may be set
 * after the link. Returns false if the image has another instruction there. */
static bool read_code(struct listing *listing, const struct hexfile *hex,
                      const struct source *source, unsigned long address, const char *text)
{
    char name[NAME_BYTES], colon[2];

    if (sscanf(text, " %*u %127[A-Za-z0-9_$]%1[:]", name, colon) == 2) {
        name_it(listing, address, name);
        return true;
    }
    if (text[strspn(text, " 0123456789ABCDEF")] != '[') {
        return true;
    }
    if (!is_of(hex, address, text)) {
        return false;
    }
    if (source->place != NULL && listing->places[address] == NULL) {
        listing->places[address] = memory_copy(source->place, strlen(source->place));
        listing->rounds[address] = source->rounds;
    }
    return true;
}

/* One line of a listing, number NUMBER of the file PATH. */
static int read_line(struct listing *listing, const struct hexfile *hex, struct source *source,
                     const char *line, const char *path, int number)
{
    const char *text = line + strspn(line, " 0123456789");
    const char *comment = behind(text, ";\t"), *area = behind(text, "\t.area ");
    int end = 0;
    unsigned long address;

    if (comment != NULL) {
        return read_source(source, comment);
    }
    if (area != NULL) {
        source->is_code = strstr(area, "(CODE") != NULL;
    }
    if (source->is_code && sscanf(line, "      %6lx%n", &address, &end) == 1 && end == 12 &&
        address < HEX_CODE_SIZE && !read_code(listing, hex, source, address, line + end)) {
        return diag_error(
            path, number,
            "this is not in the image: the listing is of another one; link the image again");
    }
    return EXIT_FINE;
}

int listing_read(struct listing *listing, const struct hexfile *hex, const char *path)
{
    FILE *stream = fopen(path, "r");
    struct source source = {.rounds = LISTING_NO_BOUND};
    char line[LINE_BYTES];
    int status = EXIT_FINE;

    if (stream == NULL) {
        return diag_error(path, 0, "cannot read the listing: %s; build the image again",
                          strerror(errno));
    }
    for (int number = 1; status == EXIT_FINE && fgets(line, sizeof line, stream) != NULL;
         number++) {
        unsigned long address;
        char name[NAME_BYTES];

        if (sscanf(line, "C: %lx %127s", &address, name) == 2) { /* a line of the map */
            name_it(listing, address, name);
        } else {
            status = read_line(listing, hex, &source, line, path, number);
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
