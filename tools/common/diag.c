/* SPDX-License-Identifier: MIT */
#include "diag.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
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

/* --- files ----------------------------------------------------------------------------------- */

/* The temporary files that are open now, for the handler of signals. A slot is free while its first
 * byte is 0. */
enum { PENDING_MAX = 8, LINKS_MAX = 40 };
static char pending[PENDING_MAX][PATH_MAX];

/* Removes what is half written, then lets the signal do what it does by default. */
static void remove_pending(int number)
{
    for (int i = 0; i < PENDING_MAX; i++) {
        if (pending[i][0] != '\0') {
            unlink(pending[i]);
        }
    }
    raise(number); /* SA_RESETHAND has put the default back */
}

static void watch_signals(void)
{
    static const int number[] = {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU, SIGXFSZ};
    static bool done;
    struct sigaction now,
        ours = {.sa_handler = remove_pending, .sa_flags = (int)(SA_RESETHAND | SA_NODEFER)};

    for (size_t i = 0; !done && i < sizeof number / sizeof number[0]; i++) {
        /* A signal that is ignored, or that the program handles itself, stays so. */
        if (sigaction(number[i], NULL, &now) == 0 && now.sa_handler == SIG_DFL) {
            sigaction(number[i], &ours, NULL);
        }
    }
    done = true;
}

static void set_pending(const char *temporary)
{
    for (int i = 0; i < PENDING_MAX; i++) {
        if (pending[i][0] == '\0' && strlen(temporary) < PATH_MAX) {
            strcpy(pending[i], temporary);
            return;
        }
    }
}

static void clear_pending(const char *temporary)
{
    for (int i = 0; i < PENDING_MAX; i++) {
        if (strcmp(pending[i], temporary) == 0) {
            pending[i][0] = '\0';
        }
    }
}

/* The descriptor that PATH names, as -, /dev/stdout and /dev/fd/7 do; -1 if it names none. */
static int descriptor_of(const char *path)
{
    static const char *const folder[] = {"/dev/fd/", "/proc/self/fd/"};

    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0) {
        return STDOUT_FILENO;
    }
    if (strcmp(path, "/dev/stderr") == 0) {
        return STDERR_FILENO;
    }
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(folder[i]);

        if (strncmp(path, folder[i], length) == 0) {
            return atoi(path + length);
        }
    }
    return -1;
}

/* The name of the file that PATH means when all links in it are followed, also where the last one
 * points to nothing yet. NULL if a link is not to be read, or there are too many. To be freed. */
static char *target_of(const char *path)
{
    char *at = strdup(path);

    for (int links = 0; at != NULL && links < LINKS_MAX; links++) {
        char link[PATH_MAX];
        char *slash, *next;
        ssize_t length = descriptor_of(at) >= 0 ? -1 : readlink(at, link, sizeof link - 1);

        if (length < 0) {
            return at;
        }
        link[length] = '\0';
        slash = strrchr(at, '/');
        next = malloc(strlen(at) + strlen(link) + 2);
        if (next != NULL && (link[0] == '/' || slash == NULL)) {
            strcpy(next, link);
        } else if (next != NULL) {
            sprintf(next, "%.*s/%s", (int)(slash - at), at, link);
        }
        free(at);
        at = next;
    }
    free(at);
    return NULL;
}

/* PATH without links and dots in it, or NULL. To be freed. */
static char *canonical(const char *path)
{
    char *target = target_of(path);
    char *slash = target != NULL ? strrchr(target, '/') : NULL;
    const char *name = slash != NULL ? slash + 1 : target;
    char *folder, *whole = NULL;

    if (target == NULL) {
        return NULL;
    }
    if (slash != NULL) {
        *slash = '\0';
    }
    folder = realpath(slash == NULL ? "." : slash == target ? "/" : target, NULL);
    if (folder != NULL && (whole = malloc(strlen(folder) + strlen(name) + 2)) != NULL) {
        sprintf(whole, "%s/%s", folder, name);
    }
    free(folder);
    free(target);
    return whole;
}

/* Do A and B name one regular file, there already or not yet? */
static bool is_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    bool a_is_there = stat(a, &of_a) == 0, b_is_there = stat(b, &of_b) == 0;
    char *name_a, *name_b;
    bool same;

    if (a_is_there || b_is_there) {
        return a_is_there && b_is_there && S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev &&
               of_a.st_ino == of_b.st_ino;
    }
    name_a = canonical(a);
    name_b = canonical(b);
    same = name_a != NULL && name_b != NULL && strcmp(name_a, name_b) == 0;
    free(name_a);
    free(name_b);
    return same;
}

int outfile_check(const char *const *output, size_t count, const char *input)
{
    for (size_t i = 0; i < count; i++) {
        if (output[i] == NULL) {
            continue;
        }
        if (output[i][0] == '\0') {
            return diag_error(NULL, 0, "the name of an output file is empty; give a name");
        }
        if (input != NULL && is_same_file(output[i], input)) {
            return diag_error(output[i], 0,
                              "the output would overwrite the input %s; give another name", input);
        }
        for (size_t k = 0; k < i; k++) {
            if (output[k] != NULL && is_same_file(output[i], output[k])) {
                return diag_error(output[i], 0,
                                  "two outputs go to this one file; give each its own name");
            }
        }
    }
    return EXIT_FINE;
}

/* Opens what is no regular file as it is: a rename would put a file in its place. */
static FILE *open_in_place(const char *path)
{
    int number = descriptor_of(path);

    if (number < 0) {
        return fopen(path, "w");
    }
    number = dup(number);
    return number < 0 ? NULL : fdopen(number, "w");
}

static FILE *open_temporary(struct outfile *out)
{
    static const char suffix[] = ".XXXXXX";
    int handle;
    FILE *stream;

    out->temporary = malloc(strlen(out->target) + sizeof suffix);
    if (out->temporary == NULL) {
        return NULL;
    }
    strcpy(out->temporary, out->target);
    strcat(out->temporary, suffix);
    watch_signals();
    handle = mkstemp(out->temporary);
    if (handle < 0) {
        free(out->temporary);
        out->temporary = NULL;
        return NULL;
    }
    set_pending(out->temporary);
    stream = fdopen(handle, "w");
    if (stream == NULL) {
        close(handle);
    }
    return stream;
}

int outfile_open(struct outfile *out, const char *path)
{
    struct stat there;
    bool is_there;
    int reason;

    memset(out, 0, sizeof *out);
    if (path[0] == '\0') {
        return diag_error(NULL, 0, "the name of an output file is empty; give a name");
    }
    out->path = strdup(path);
    out->target = target_of(path);
    if (out->path == NULL || out->target == NULL) {
        outfile_abandon(out);
        return diag_error(path, 0, "cannot write: the name cannot be followed to a file");
    }
    is_there = stat(out->target, &there) == 0;
    errno = 0;
    if (descriptor_of(out->target) >= 0 || (is_there && !S_ISREG(there.st_mode))) {
        out->stream = open_in_place(out->target);
    } else if (!is_there || access(out->target, W_OK) == 0) {
        out->stream = open_temporary(out);
    }
    if (out->stream == NULL) {
        reason = errno;
        outfile_abandon(out);
        return diag_error(path, 0, "cannot write: %s%s", strerror(reason),
                          reason == ENOENT ? "; make its folder first" : "");
    }
    return EXIT_FINE;
}

/* A new file gets the mode that the user's mask leaves; one that is replaced keeps its own. */
static mode_t mode_of(const char *target)
{
    struct stat there;
    mode_t mask;

    if (stat(target, &there) == 0) {
        return there.st_mode & 07777;
    }
    mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

static int cannot_write(const struct outfile *out, int reason)
{
    return diag_error(out->path, 0, "cannot write: %s",
                      reason != 0 ? strerror(reason) : "the file is not whole");
}

int outfile_flush(struct outfile *out)
{
    errno = 0;
    if (fflush(out->stream) != 0 || ferror(out->stream)) {
        return cannot_write(out, errno);
    }
    return EXIT_FINE;
}

int outfile_commit(struct outfile *out)
{
    bool failed = false;
    int reason = 0;

    if (outfile_flush(out) != EXIT_FINE) {
        outfile_abandon(out);
        return EXIT_INPUT;
    }
    if (out->temporary != NULL && fchmod(fileno(out->stream), mode_of(out->target)) != 0) {
        failed = true;
        reason = errno;
    }
    if (fclose(out->stream) != 0 && !failed) {
        failed = true;
        reason = errno;
    }
    out->stream = NULL;
    if (!failed && out->temporary != NULL && rename(out->temporary, out->target) != 0) {
        failed = true;
        reason = errno;
    }
    if (failed) {
        cannot_write(out, reason);
    } else if (out->temporary != NULL) {
        clear_pending(out->temporary);
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
        clear_pending(out->temporary);
        free(out->temporary);
    }
    free(out->path);
    free(out->target);
    memset(out, 0, sizeof *out);
}
