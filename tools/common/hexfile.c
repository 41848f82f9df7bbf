/* SPDX-License-Identifier: MIT */
#include "hexfile.h"

#include "diag.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { RECORD_DATA = 0, RECORD_END = 1, MAX_RECORD = 5 + 255 };

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return -1;
}

/* ":10 0000 00 ... CC" into bytes: count, address high and low, type, data, check sum. Returns the
 * number of bytes, or 0 when it is no record. */
static size_t parse_record(const char *line, uint8_t record[MAX_RECORD])
{
    size_t count = 0;
    uint8_t sum = 0;

    if (*line++ != ':') {
        return 0;
    }
    while (hex_digit(line[0]) >= 0 && hex_digit(line[1]) >= 0 && count < MAX_RECORD) {
        record[count] = (uint8_t)(hex_digit(line[0]) << 4 | hex_digit(line[1]));
        sum = (uint8_t)(sum + record[count++]);
        line += 2;
    }
    if (line[strspn(line, "\r\n \t\032")] != '\0' || sum != 0) {
        return 0;
    }
    return count >= 5 && count == 5u + record[0] ? count : 0;
}

static bool store(struct hexfile *hex, const uint8_t *record)
{
    size_t address = (size_t)record[1] << 8 | record[2];

    for (size_t i = 0; i < record[0]; i++) {
        if (address + i >= HEX_CODE_SIZE) {
            return false;
        }
        hex->bytes += !hex->used[address + i];
        hex->used[address + i] = true;
        hex->code[address + i] = record[4 + i];
    }
    return true;
}

static int read_records(struct hexfile *hex, FILE *stream, const char *path)
{
    char line[2 * MAX_RECORD + 8];
    int number = 0;

    while (fgets(line, sizeof line, stream) != NULL) {
        uint8_t record[MAX_RECORD];

        number++;
        if (line[strspn(line, "\r\n \t\032")] == '\0') {
            continue;
        }
        if (parse_record(line, record) == 0) {
            diag_error(path, number, "not an Intel HEX record; build the image again");
            return EXIT_USAGE;
        }
        if (record[3] == RECORD_END) {
            return EXIT_FINE;
        }
        if (record[3] != RECORD_DATA || !store(hex, record)) {
            diag_error(path, number, "an 8051 image has data records below 64 KB only");
            return EXIT_USAGE;
        }
    }
    diag_error(path, number, "the image ends without an end record; build it again");
    return EXIT_USAGE;
}

int hexfile_read(struct hexfile *hex, const char *path)
{
    FILE *stream = fopen(path, "r");
    int status;

    memset(hex, 0, sizeof *hex);
    if (stream == NULL) {
        diag_error(path, 0, "cannot read the image: %s; build it with `make`", strerror(errno));
        return EXIT_USAGE;
    }
    status = read_records(hex, stream, path);
    fclose(stream);
    if (status == EXIT_FINE && hex->bytes == 0) {
        diag_error(path, 0, "the image is empty; build it again");
        return EXIT_USAGE;
    }
    return status;
}
