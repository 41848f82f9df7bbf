/* SPDX-License-Identifier: MIT */
/* How every host tool complains and writes: one line on stderr that says what is wrong and what to
 * do, one exit status a kind of failure, and no half-written file. */
#ifndef FUZZY51_DIAG_H
#define FUZZY51_DIAG_H

#include <stddef.h>
#include <stdio.h>

enum exit_status {
    EXIT_FINE = 0,
    EXIT_INPUT = 1, /* bad input, or an outcome that does not hold; nothing was written */
    EXIT_USAGE = 2, /* bad usage; in drive also: no image to run, or the simulator failed */
};

/* Prints "FILE:LINE: error: WHAT" (LINE 0: without the line; FILE NULL: the program's name in its
 * place) and returns EXIT_INPUT, so that a caller can `return diag_error(...)`. WHAT says what is
 * wrong and what to do about it. */
int diag_error(const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for something that is allowed but is likely not meant: "FILE:LINE: warning: WHAT". */
void diag_warning(const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* A file that appears whole or not at all: it is written beside its place under a temporary name,
 * which is removed also when a signal ends the program. Links in the name are followed and stay
 * links. A file that is replaced keeps its mode. A device, a pipe, /dev/stdout or /dev/fd/N is
 * written as it is; - is stdout, and ./- a file of that name. */
struct outfile {
    FILE *stream;
    char *path;      /* as the user gave it, for messages */
    char *target;    /* the file that PATH means, its links followed */
    char *temporary; /* NULL: written in place */
};

/* May the COUNT files OUTPUT (NULL: none) be written while INPUT (NULL: none) is read? Not if two
 * of them are one file, by whatever names and links, or a name is empty. EXIT_FINE, or EXIT_INPUT
 * after a message. */
int outfile_check(const char *const *output, size_t count, const char *input);

/* Opens PATH for writing. Returns EXIT_FINE, or EXIT_INPUT after a message. */
int outfile_open(struct outfile *out, const char *path);

/* Writes what is still in the buffer. Where a program writes several files, it flushes all of them
 * before it commits the first: either all get their places or none. Returns EXIT_FINE, or
 * EXIT_INPUT after a message (disk full, ...). */
int outfile_flush(struct outfile *out);

/* Flushes the file and renames it to its place. Returns EXIT_FINE, or EXIT_INPUT after a message
 * (disk full, ...), with nothing left behind. */
int outfile_commit(struct outfile *out);

/* Takes the temporary file away; does nothing after a commit. */
void outfile_abandon(struct outfile *out);

#endif
