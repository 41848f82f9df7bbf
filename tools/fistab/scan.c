/* Tokens of a .fis file. */
#include "scan.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "fis.h"

/* Length of the UTF-8 character at S, 0 if it is none. Bytes after the end are 0. */
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
        scan->at++;
    }
}

static void cut_comment(char *line)
{
    char quote = '\0';

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

bool scan_line(struct scan *scan)
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
        cut_comment(scan->at);
        skip_blanks(scan);
        if (*scan->at != '\0' && *scan->at != '#' && strncmp(scan->at, "//", 2) != 0) {
            return true;
        }
    }
    return false;
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

static const char *rest(const struct scan *scan)
{
    return *scan->at != '\0' ? scan->at : "the end of the line";
}

int scan_number(struct scan *scan, double *number)
{
    size_t length;
    char *end;

    skip_blanks(scan);
    length = strcspn(scan->at, " \t\v\f,;:()[]'\"");
    *number = strtod(scan->at, &end);
    if (length == 0 || end != scan->at + length || memchr(scan->at, 'x', length) != NULL ||
        memchr(scan->at, 'X', length) != NULL || isnan(*number)) {
        return diag_error(scan->file, scan->line, "expected a number, found %.40s", rest(scan));
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
        return diag_error(scan->file, scan->line, "expected a name in quotes, found %.40s",
                          rest(scan));
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
        return diag_error(scan->file, scan->line, "the quote %c is not closed", quote);
    }
    scan->at++;
    return EXIT_FINE;
}
