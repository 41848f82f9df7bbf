/* SPDX-License-Identifier: MIT */
#include "telemetry.h"

#include <stdlib.h>
#include <string.h>

void telemetry_init(struct telemetry *telemetry)
{
    memset(telemetry, 0, sizeof *telemetry);
    telemetry->capacity = 4096;
    telemetry->log = calloc(1, telemetry->capacity);
    if (telemetry->log == NULL) {
        abort();
    }
}

void telemetry_free(struct telemetry *telemetry)
{
    free(telemetry->log);
    telemetry->log = NULL;
}

static void keep(struct telemetry *telemetry, const char *bytes, size_t size)
{
    while (telemetry->length + size + 1 > telemetry->capacity) {
        telemetry->capacity *= 2;
        telemetry->log = realloc(telemetry->log, telemetry->capacity);
        if (telemetry->log == NULL) {
            abort();
        }
    }
    memcpy(telemetry->log + telemetry->length, bytes, size);
    telemetry->length += size;
    telemetry->log[telemetry->length] = '\0';
}

/* Cuts LINE at its commas. Returns the number of fields, 0 when it is no CSV line of ours. */
static int split(char *line, char *fields[TELEMETRY_FIELDS])
{
    int count = 0;
    char *field;

    while ((field = strsep(&line, ",")) != NULL) {
        if (count == TELEMETRY_FIELDS || strlen(field) >= TELEMETRY_FIELD_SIZE) {
            return 0;
        }
        fields[count++] = field;
    }
    return count;
}

/* The header begins with "seq,"; later lines with as many fields, the first a number, are data. */
static bool take_line(struct telemetry *telemetry)
{
    char *fields[TELEMETRY_FIELDS];
    int count = split(telemetry->line, fields);

    if (count > 1 && strcmp(fields[0], "seq") == 0) {
        telemetry->fields = count;
        for (int i = 0; i < count; i++) {
            strcpy(telemetry->names[i], fields[i]);
        }
        return false;
    }
    if (count < 2 || count != telemetry->fields || strspn(fields[0], "0123456789") == 0) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        strcpy(telemetry->values[i], fields[i]);
    }
    return true;
}

void telemetry_take(struct telemetry *telemetry, int64_t t_ns, int64_t measured_ns,
                    const char *bytes, size_t size,
                    void (*line_done)(void *user, const struct telemetry *telemetry), void *user)
{
    keep(telemetry, bytes, size);
    for (size_t i = 0; i < size; i++) {
        char c = bytes[i];

        if (telemetry->line_length == 0) {
            telemetry->begun_ns = t_ns;
            telemetry->begun_for_ns = measured_ns > telemetry->line_for_ns ? measured_ns : t_ns;
        }
        if (c != '\r' && c != '\n') {
            if (telemetry->line_length < TELEMETRY_LINE - 1) {
                telemetry->line[telemetry->line_length++] = c == '\0' ? '?' : c;
            }
            continue;
        }
        telemetry->line[telemetry->line_length] = '\0';
        telemetry->line_length = 0;
        if (take_line(telemetry)) {
            telemetry->line_ns = telemetry->begun_ns;
            telemetry->line_for_ns = telemetry->begun_for_ns;
            if (line_done != NULL) {
                line_done(user, telemetry);
            }
        }
    }
}

const char *telemetry_value(const struct telemetry *telemetry, const char *name)
{
    for (int i = 0; i < telemetry->fields; i++) {
        if (strcmp(telemetry->names[i], name) == 0) {
            return telemetry->values[i];
        }
    }
    return "";
}
