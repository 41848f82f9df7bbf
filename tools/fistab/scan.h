/* Text of a .fis file, line by line and token by token. Failing scanners print the message. */
#ifndef FUZZY51_SCAN_H
#define FUZZY51_SCAN_H

#include <stdbool.h>
#include <stddef.h>

struct scan {
    const char *file;
    char *text; /* a copy of the file, UTF-8 */
    char *next; /* where the next line starts; NULL: after the last */
    char *at;   /* the rest of this line */
    int line;
    char word[64];
};

/* Copies TEXT; Latin-1 becomes UTF-8. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int scan_open(struct scan *scan, const char *file, const char *text, size_t length);
void scan_close(struct scan *scan);

/* Goes to the next line that holds more than blanks and comments; false after the last one. A
 * comment begins with % outside quotes, or with # or // at the start of a line (Octave, fuzzylite).
 */
bool scan_line(struct scan *scan);

/* Each skips blanks first. The char and word scanners are silent where there is none. */
bool scan_char(struct scan *scan, char c);
bool scan_end(struct scan *scan); /* of the line; a last ; or , counts as nothing */
bool scan_word(struct scan *scan);
int scan_number(struct scan *scan, double *number);
int scan_quoted(struct scan *scan, char **string); /* the caller frees it */

#endif
