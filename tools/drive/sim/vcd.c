/* SPDX-License-Identifier: MIT */
#include "vcd.h"

#include <stdlib.h>
#include <string.h>

void vcd_init(struct vcd_reader *reader)
{
    memset(reader, 0, sizeof *reader);
    reader->unit_ps = 1000;
}

int vcd_var_index(const struct vcd_reader *reader, const char *name)
{
    for (int i = 0; i < reader->var_count; i++) {
        if (strcmp(reader->vars[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

static int index_of_id(const struct vcd_reader *reader, char id)
{
    for (int i = 0; i < reader->var_count; i++) {
        if (reader->vars[i].id == id) {
            return i;
        }
    }
    return -1;
}

/* "1ps", "10ns", ... */
static bool parse_timescale(struct vcd_reader *reader, const char *text)
{
    static const struct {
        const char *name;
        int64_t ps;
    } units[] = {{"ps", 1}, {"ns", 1000}, {"us", 1000000}, {"ms", 1000000000}};
    char *unit;
    long count = strtol(text, &unit, 10);

    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (count > 0 && strcmp(unit, units[i].name) == 0) {
            reader->unit_ps = count * units[i].ps;
            return true;
        }
    }
    return false;
}

/* One word between $keyword and $end. */
static bool header_word(struct vcd_reader *reader, const char *word)
{
    reader->words++;
    if (strcmp(reader->keyword, "$timescale") == 0) {
        return parse_timescale(reader, word);
    }
    if (strcmp(reader->keyword, "$var") != 0) {
        return true;
    }
    if (reader->words == 3) {
        reader->declared.id = word[0];
    }
    if (reader->words == 4) {
        if (strlen(word) >= VCD_NAME_SIZE || reader->var_count == VCD_MAX_VARS) {
            return false;
        }
        strcpy(reader->declared.name, word);
        reader->vars[reader->var_count++] = reader->declared;
    }
    return true;
}

static void keyword_ends(struct vcd_reader *reader)
{
    if (strcmp(reader->keyword, "$enddefinitions") == 0) {
        reader->in_body = true;
    }
    reader->keyword[0] = '\0';
}

static bool report(struct vcd_reader *reader, char id, uint32_t value, vcd_change_fn *change,
                   void *user)
{
    int var = index_of_id(reader, id);

    if (var < 0) {
        return false;
    }
    if (!reader->in_dumpvars) {
        change(user, reader->time_ns, var, value);
    }
    return true;
}

static bool body_token(struct vcd_reader *reader, const char *token, vcd_change_fn *change,
                       void *user)
{
    if (reader->vector_pending) {
        reader->vector_pending = false;
        return token[1] == '\0' && report(reader, token[0], reader->vector, change, user);
    }
    switch (token[0]) {
    case '#':
        reader->time_ns = (strtoll(token + 1, NULL, 10) * reader->unit_ps + 500) / 1000;
        return true;
    case '0':
    case '1':
    case 'x': /* a pin that nothing has set yet counts as high, as the port's pull-up makes it */
        return token[1] != '\0' && token[2] == '\0' &&
               report(reader, token[1], token[0] != '0', change, user);
    case 'b':
        reader->vector = (uint32_t)strtoul(token + 1, NULL, 2);
        reader->vector_pending = true;
        return true;
    case '$':
        reader->in_dumpvars = strcmp(token, "$dumpvars") == 0;
        return true;
    default:
        return false;
    }
}

static bool take_token(struct vcd_reader *reader, vcd_change_fn *change, void *user)
{
    const char *token = reader->token;

    if (reader->in_body) {
        return body_token(reader, token, change, user);
    }
    if (reader->keyword[0] == '\0') {
        if (token[0] != '$' || strlen(token) >= sizeof reader->keyword) {
            return false;
        }
        strcpy(reader->keyword, token);
        reader->words = 0;
        return true;
    }
    if (strcmp(token, "$end") != 0) {
        return header_word(reader, token);
    }
    keyword_ends(reader);
    return true;
}

bool vcd_feed(struct vcd_reader *reader, const char *bytes, size_t size, vcd_change_fn *change,
              void *user)
{
    for (size_t i = 0; i < size && !reader->malformed; i++) {
        char c = bytes[i];
        bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';

        if (!blank && reader->token_length < VCD_TOKEN_SIZE - 1) {
            reader->token[reader->token_length++] = c;
        } else if (!blank) {
            reader->malformed = true;
        } else if (reader->token_length > 0) {
            reader->token[reader->token_length] = '\0';
            reader->token_length = 0;
            reader->malformed = !take_token(reader, change, user);
        }
    }
    return !reader->malformed;
}
