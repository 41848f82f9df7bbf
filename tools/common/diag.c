/* SPDX-License-Identifier: MIT */
#include "diag.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

extern char *program_invocation_short_name;

static void print_place(const char *file, int line, const char *severity, const char *format,
                        va_list arguments)
{
    if (file == NULL) {
        file = program_invocation_short_name;
    }
    if (line > 0) {
        fprintf(stderr, "%s:%d: %s: ", file, line, severity);
    } else {
        fprintf(stderr, "%s: %s: ", file, severity);
    }
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

int diag_error(const char *file, int line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_place(file, line, "error", format, arguments);
    va_end(arguments);
    return EXIT_INPUT;
}

void diag_warning(const char *file, int line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_place(file, line, "warning", format, arguments);
    va_end(arguments);
}

int outfile_open(struct outfile *out, const char *path)
{
    static const char suffix[] = ".XXXXXX";
    struct stat there;
    bool is_device = stat(path, &there) == 0 && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
    int handle;

    out->stream = NULL;
    out->path = strdup(path);
    out->temporary = malloc(strlen(path) + sizeof suffix);
    if (out->path == NULL || out->temporary == NULL) {
        outfile_abandon(out);
        return diag_error(path, 0, "out of memory");
    }
    if (is_device) {
        /* A rename would put a file in the place of /dev/null. */
        free(out->temporary);
        out->temporary = NULL;
        out->stream = fopen(path, "w");
    } else {
        strcpy(out->temporary, path);
        strcat(out->temporary, suffix);
        handle = mkstemp(out->temporary);
        if (handle >= 0) {
            out->stream = fdopen(handle, "w");
        }
    }
    if (out->stream == NULL) {
        int reason = errno;
        outfile_abandon(out);
        return diag_error(path, 0, "cannot write: %s%s", strerror(reason),
                          reason == ENOENT ? "; make its folder first" : "");
    }
    return EXIT_FINE;
}

int outfile_commit(struct outfile *out)
{
    int failed = ferror(out->stream);
    mode_t mask = umask(0);

    umask(mask);
    if (out->temporary != NULL && fchmod(fileno(out->stream), 0666 & ~mask) != 0) {
        failed = 1;
    }
    if (fclose(out->stream) != 0) {
        failed = 1;
    }
    out->stream = NULL;
    if (!failed && out->temporary != NULL && rename(out->temporary, out->path) != 0) {
        failed = 1;
    }
    if (failed) {
        diag_error(out->path, 0, "cannot write: %s", strerror(errno));
    } else {
        free(out->temporary);
        out->temporary = NULL;
    }
    outfile_abandon(out);
    return failed ? EXIT_INPUT : EXIT_FINE;
}

void outfile_abandon(struct outfile *out)
{
    if (out->stream != NULL) {
        fclose(out->stream);
    }
    if (out->temporary != NULL) {
        unlink(out->temporary);
        free(out->temporary);
    }
    free(out->path);
    memset(out, 0, sizeof *out);
}
