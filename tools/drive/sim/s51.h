/* The simulator s51 as a process in lockstep: pins in, pins out, serial bytes, exact times.
 *
 * s51 runs free and blocks only in its own reading of a value change dump, from a FIFO: it halts at
 * each sync time until it is told the next one. A variable that the dump sets at each sync comes
 * back in the dump that s51 writes; when it has been read, every pin change before it has been,
 * too. So results depend on no clock and no scheduler. Times are nanoseconds since reset. */
#ifndef FUZZY51_S51_H
#define FUZZY51_S51_H

#include "vcd.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* Versions that are known to keep time, as messages name them. */
#define S51_VERSIONS "0.6.4 (Debian 12) or 0.8.15 (Debian 13)"

enum {
    S51_MAX_PINS = 12,
    S51_SILENCE_MS = 500,
    S51_BYTE_NS = 1100000 /* a byte on the serial line, at 9600 Bd, and some more */
};

struct s51_setup {
    const char *hex;  /* the image */
    const char *type; /* -t of s51 */
    long clk_hz;
    const uint8_t *watch; /* bit addresses of the pins that are reported */
    int watch_count;
    const uint8_t *drive; /* bit addresses of the pins that are driven */
    int drive_count;
    uint32_t levels; /* bit k: level of drive[k] from the start */
    bool uart_in;    /* s51_send will be used */
};

struct s51_edge {
    int64_t time_ns;
    int pin; /* index into watch */
    bool level;
    bool after_reset; /* the time counts from the watchdog's reset */
};

enum s51_status {
    S51_RAN,
    S51_RESET, /* a watchdog reset: simulated time jumped back to 0 */
    S51_FAILED /* s51 died, hangs, or was interrupted; a message has been printed */
};

struct s51 {
    pid_t pid;
    int pid_fd, out_fd, in_fd, stdin_fd, log_fd, uart_fd, send_fd;
    char folder[128];
    long clk_hz;
    int watch_count;
    bool levels[S51_MAX_PINS]; /* of the watched pins, as last reported */
    int watch_vars[S51_MAX_PINS];
    int sync_var;
    bool sync_level; /* what sync is set to next */
    bool marker_seen;
    int64_t marker_ns;
    int64_t sync_ns; /* s51 stands here */
    int64_t last_ns; /* of the last change read */
    bool was_reset;
    int silences, waits;  /* how often nothing came, one after the other; and it slept */
    double silent_from_s; /* its processor time then */
    struct vcd_reader vcd;
    struct s51_edge *edges; /* since the last call of s51_run_to, in order of time */
    size_t edge_count, edge_capacity;
    char text[4096]; /* for the in FIFO, not yet sent */
    size_t text_length;
    int64_t text_ns; /* time of its last stamp */
    off_t uart_offset;
    bool listening; /* s51 looks for serial bytes in each cycle */
    int64_t listen_until_ns;
};

/* Catches SIGINT, SIGTERM and SIGHUP, so that an interrupted run ends in S51_FAILED and cleans up.
 */
void s51_catch_signals(void);

/* Whether this version is known to keep time. */
bool s51_is_known(const char *version);

/* Asks s51 for its version. Returns EXIT_FINE, or EXIT_USAGE after a message. */
int s51_version(char *version, size_t size);

/* Starts s51 with the image and lets it run its first half microsecond, with the driven pins at
 * their levels. Returns EXIT_FINE, or EXIT_USAGE after a message, with nothing left behind. */
int s51_start(struct s51 *sim, const struct s51_setup *setup);

/* First sync time at or after TIME_NS: half way between two machine cycles, where rounding in s51
 * cannot move an event across one. */
int64_t s51_grid_ns(const struct s51 *sim, int64_t time_ns);

/* Sets pin DRIVE (index into setup.drive) at TIME_NS, rounded to the grid. Calls come in order of
 * time, after the present sync time. */
void s51_set_pin(struct s51 *sim, int64_t time_ns, int drive, bool level);

/* Lets s51 run to the grid point at or after TIME_NS and collects the edges on the way. */
enum s51_status s51_run_to(struct s51 *sim, int64_t time_ns);

/* After S51_RESET: collects edges until WINDOW_NS after the reset, or until s51 stands still at the
 * sync time it had before the reset. Plant input is not possible any more. */
enum s51_status s51_run_after_reset(struct s51 *sim, int64_t window_ns);

/* Reads serial bytes that came out since the last call; the bytes of frames that end before the
 * present sync time are there. Returns their number. */
size_t s51_receive(struct s51 *sim, char *bytes, size_t size);

/* Queues serial bytes for the chip; they arrive at line rate from the next s51_run_to on. s51 looks
 * for them in each cycle, which costs half its speed, only as long as they take; so bytes must not
 * be queued while earlier ones are still on their way. */
void s51_send(struct s51 *sim, const char *bytes, size_t size);

/* Ends s51 and removes what it needed; harmless when it runs no more. */
void s51_stop(struct s51 *sim);

#endif
