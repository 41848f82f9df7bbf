/* SPDX-License-Identifier: MIT */
/* Tokens of the files that describe fuzzy systems. */
#include "scan.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "fis.h"

/* Length of the UTF-8 character at S, 0 if there is no valid one. Bytes after the end are 0. */
static size_t utf8_length(const unsigned char *s)
{
    size_t length = s[0] < 0x80   ? 1
                    : s[0] < 0xC2 ? 0
                    : s[0] < 0xE0 ? 2
                    : s[0] < 0xF0 ? 3
                    : s[0] < 0xF5 ? 4
                                  : 0;

    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    return length;
}

static bool is_utf8(const char *text)
{
    while (*text != '\0') {
        size_t length = utf8_length((const unsigned char *)text);
        if (length == 0) {
            return false;
        }
        text += length;
    }
    return true;
}

static char *utf8_from_latin1(const char *text)
{
    char *utf8 = malloc(2 * strlen(text) + 1);
    char *out = utf8;

    if (utf8 == NULL) {
        return NULL;
    }
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c >= 0x80) {
            *out++ = (char)(0xC0 | c >> 6);
            c = (unsigned char)(0x80 | (c & 0x3F));
        }
        *out++ = (char)c;
    }
    *out = '\0';
    return utf8;
}

int scan_open(struct scan *scan, const char *file, const char *text, size_t length)
{
    memset(scan, 0, sizeof *scan);
    scan->file = file;
    if (length > FIS_BYTES_MAX) {
        return diag_error(file, 0, "larger than %d bytes, the limit; is this a .fis file?",
                          FIS_BYTES_MAX);
    }
    if (length >= 10 && memcmp(text, "MATLAB 5.0", 10) == 0) {
        return diag_error(
            file, 0,
            "is a workspace of MATLAB's (.mat), not a .fis; in MATLAB write the system "
            "by writefis(fis, 'name')");
    }
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
        text += 3;
        length -= 3;
    }
    if (length > 0 && text[length - 1] == 0x1A) { /* DOS end of file */
        length--;
    }
    for (size_t i = 0; i < length; i++) {
        if ((unsigned char)text[i] < ' ' && strchr("\t\n\v\f\r", text[i]) == NULL) {
            return diag_error(
                file, 0, "holds a control character (byte %d is 0x%02X); a .fis is a text file",
                (int)i + 1, (unsigned)text[i]);
        } else if (text[i] == '\0') {
            return diag_error(file, 0, "holds a zero byte; save it as plain text, not as UTF-16");
        }
    }
    scan->text = malloc(length + 1);
    if (scan->text == NULL) {
        return diag_error(file, 0, "out of memory");
    }
    memcpy(scan->text, text, length);
    scan->text[length] = '\0';
    if (!is_utf8(scan->text)) {
        char *utf8 = utf8_from_latin1(scan->text);
        free(scan->text);
        scan->text = utf8;
        if (utf8 == NULL) {
            return diag_error(file, 0, "out of memory");
        }
    }
    scan->next = scan->text;
    return EXIT_FINE;
}

void scan_close(struct scan *scan)
{
    free(scan->text);
    scan->text = NULL;
}

static void skip_blanks(struct scan *scan)
{
    while (isspace((unsigned char)*scan->at)) {
        scan->line += scan->free_form && *scan->at == '\n';
        scan->at++;
    }
}

static void cut_comment(char *line, char comment)
{
    char quote = '\0';

    if (comment == '#') {
        line[strcspn(line, "#")] = '\0';
        return;
    }
    for (; *line != '\0'; line++) {
        if (quote != '\0') {
            if (*line == quote) {
                quote = '\0';
            }
        } else if (*line == '\'' || *line == '"') {
            quote = *line;
        } else if (*line == '%') {
            *line = '\0';
            return;
        }
    }
}

bool scan_line(struct scan *scan, const char *comment)
{
    while (scan->next != NULL) {
        char *end = scan->next + strcspn(scan->next, "\r\n");

        scan->at = scan->next;
        scan->line++;
        if (*end == '\0') {
            scan->next = NULL;
        } else {
            scan->next = end + (end[0] == '\r' && end[1] == '\n' ? 2 : 1);
        }
        *end = '\0';
        cut_comment(scan->at, *comment);
        skip_blanks(scan);
        if (*scan->at != '\0' && *scan->at != '#' && strncmp(scan->at, "//", 2) != 0) {
            return true;
        }
    }
    return false;
}

static char *blank_until(char *at, const char *end)
{
    char *stop = strstr(at, end);

    if (stop == NULL) {
        stop = at + strlen(at);
    }
    for (; at < stop; at++) {
        if (*at != '\n') {
            *at = ' ';
        }
    }
    return stop;
}

void scan_free_form(struct scan *scan)
{
    bool at_start = true; /* of a line */

    for (char *at = scan->text; *at != '\0'; at++) {
        if (at[0] == '(' && at[1] == '*') {
            at = blank_until(at, "*)");
            if (*at != '\0') {
                at[0] = at[1] = ' ';
            }
        } else if (*at == '#' || (at[0] == '/' && at[1] == '/') || (*at == '%' && at_start)) {
            at = blank_until(at, "\n");
        }
        if (*at == '\0') {
            break;
        }
        at_start = *at == '\n' || (at_start && isspace((unsigned char)*at));
    }
    scan->at = scan->text;
    scan->next = NULL;
    scan->line = 1;
    scan->free_form = true;
}

bool scan_char(struct scan *scan, char c)
{
    skip_blanks(scan);
    if (*scan->at != c) {
        return false;
    }
    scan->at++;
    return true;
}

bool scan_end(struct scan *scan)
{
    while (scan_char(scan, ';') || scan_char(scan, ','))
        ;
    return *scan->at == '\0';
}

bool scan_word(struct scan *scan)
{
    size_t length = 0;

    skip_blanks(scan);
    while (isalnum((unsigned char)scan->at[length]) || scan->at[length] == '_') {
        length++;
    }
    if (length == 0 || length >= sizeof scan->word) {
        return false;
    }
    memcpy(scan->word, scan->at, length);
    scan->word[length] = '\0';
    scan->at += length;
    return true;
}

bool scan_name(struct scan *scan)
{
    size_t length;

    skip_blanks(scan);
    length = strcspn(scan->at, " \t\r\n\v\f()[],;:=|");
    if (length == 0 || length >= sizeof scan->word) {
        return false;
    }
    memcpy(scan->word, scan->at, length);
    scan->word[length] = '\0';
    scan->at += length;
    return true;
}

const char *scan_found(const struct scan *scan)
{
    static char found[64];
    size_t length = strcspn(scan->at, " \t\r\n\v\f,;()[]");

    if (*scan->at == '\0') {
        return scan->free_form ? "the end of the file" : "the end of the line";
    }
    snprintf(found, sizeof found, "'%.*s'",
             length == 0   ? 1
             : length > 40 ? 40
                           : (int)length,
             scan->at);
    return found;
}

int scan_number(struct scan *scan, double *number)
{
    size_t length;
    char *end;

    skip_blanks(scan);
    length = strcspn(scan->at, " \t\r\n\v\f,;:|()[]'\"");
    *number = strtod(scan->at, &end);
    if (length == 0 || end != scan->at + length || memchr(scan->at, 'x', length) != NULL ||
        memchr(scan->at, 'X', length) != NULL || isnan(*number)) {
        return diag_error(scan->file, scan->line, "expected a number such as 12.5, found %s",
                          scan_found(scan));
    }
    if (isfinite(*number) && fabs(*number) > FIS_NUMBER_MAX) {
        return diag_error(scan->file, scan->line, "'%.*s' is beyond the limit of %g", (int)length,
                          scan->at, FIS_NUMBER_MAX);
    }
    scan->at += length;
    return EXIT_FINE;
}

int scan_quoted(struct scan *scan, char **string)
{
    char quote;
    char *out;

    skip_blanks(scan);
    quote = *scan->at;
    if (quote != '\'' && quote != '"') {
        return diag_error(scan->file, scan->line, "expected a name in quotes, found %s",
                          scan_found(scan));
    }
    *string = out = malloc(strlen(scan->at));
    if (out == NULL) {
        return diag_error(scan->file, scan->line, "out of memory");
    }
    scan->at++;
    while (*scan->at != '\0' && (scan->at[0] != quote || scan->at[1] == quote)) {
        if (*scan->at == quote) { /* doubled: means itself */
            scan->at++;
        }
        *out++ = *scan->at++;
    }
    *out = '\0';
    if (*scan->at != quote) {
        free(*string);
        *string = NULL;
        return diag_error(scan->file, scan->line,
                          "the quote %c is not closed; write one at the end of the name", quote);
    }
    scan->at++;
    return EXIT_FINE;
}
