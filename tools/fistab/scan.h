/* SPDX-License-Identifier: MIT */
/* Text of a file that describes a fuzzy system, token by token. A .fis and an .fll are read line by
 * line: scan_line() goes to the next one. An .fcl is read as a whole: after scan_free_form() the
 * ends of lines are blanks. Scanners that fail print the message. */
#ifndef FUZZY51_SCAN_H
#define FUZZY51_SCAN_H

#include <stdbool.h>
#include <stddef.h>

struct scan {
    const char *file;
    char *text; /* a copy of the file, UTF-8 */
    char *next; /* where the next line starts; NULL: after the last */
    char *at;   /* the rest of this line, or of the text */
    int line;
    bool free_form;
    char word[256];
};

/* Copies TEXT; Latin-1 becomes UTF-8. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int scan_open(struct scan *scan, const char *file, const char *text, size_t length);
void scan_close(struct scan *scan);

/* Goes to the next line that holds more than blanks and comments; false after the last one. With
 * COMMENT "%" (.fis) a comment begins with % outside quotes, or with # or // at the start of a line
 * (Octave, fuzzylite). With "#" (.fll) it begins with # anywhere. */
bool scan_line(struct scan *scan, const char *comment);

/* Makes the text one long line, without its comments: FCL's, which go from (* to *) or from // to
 * the end of the line, and fuzzylite's, which begin with #, or with % at the start of a line. */
void scan_free_form(struct scan *scan);

/* Each skips blanks first. The char, word and name scanners are silent where there is none. */
bool scan_char(struct scan *scan, char c);
bool scan_end(struct scan *scan);  /* of the line; a last ; or , counts as nothing */
bool scan_word(struct scan *scan); /* letters, digits and _ into scan->word */
bool scan_name(struct scan *scan); /* all but blanks and ()[],;:=| into scan->word */
int scan_number(struct scan *scan, double *number);
int scan_quoted(struct scan *scan, char **string); /* the caller frees it */

/* For a message: the token that stands next, in quotes, or "the end of the line". The text is good
 * until the next call. */
const char *scan_found(const struct scan *scan);

#endif
