/* SPDX-License-Identifier: MIT */
#include "s51.h"

#include "canary.h"
#include "diag.h"
#include "hexfile.h"
#include "vcd.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/pidfd.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

/* A watchdog reset takes simulated time back to 0. A change that is written late, by up to 0.5 us
 * in version 0.8.15, is none: no reset comes so early. */
enum {
    PROBES = 8,
    CLOCKS_PER_CYCLE = 12,
    LATE_NS = 100000,
    SILENCE_MS = 500,
    BYTE_NS = 1100000 /* a byte on the serial line, at 9600 Bd, and some more */
};

/* The names of the program: Debian 12's and Debian 13's. tools/s51 looks for the same. */
static char *const program_names[] = {"s51", "ucsim_51"};
enum { PROGRAM_NAMES = sizeof program_names / sizeof program_names[0] };
struct s51 {
    struct sim base;
    pid_t pid;
    int pid_fd, out_fd, in_fd, stdin_fd, log_fd, uart_fd, send_fd;
    char folder[128];
    int watch_count;
    bool levels[SIM_MAX_PINS]; /* of the watched pins, as last reported */
    int watch_vars[SIM_MAX_PINS];
    int sync_var;
    bool sync_level; /* what sync is set to next */
    bool marker_seen;
    int64_t marker_ns;
    bool was_reset;
    int silences, waits;  /* how often nothing came, one after the other; and it slept */
    double silent_from_s; /* its processor time then */
    struct vcd_reader vcd;
    char text[4096]; /* for the in FIFO, not yet sent */
    size_t text_length;
    int64_t text_ns; /* time of its last stamp */
    off_t uart_offset;
    bool listening; /* s51 looks for serial bytes in each cycle */
    int64_t listen_until_ns;
};

/* --- a child process ---------------------------------------------------------------------- */

/* Becomes s51: its own process group, and an end together with this process, however that ends. */
static void become_s51(char *arguments[], pid_t parent, const char *folder, int in, int out,
                       int report)
{
    int reason;

    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && dup2(in, 0) >= 0 && dup2(out, 1) >= 0 && dup2(out, 2) >= 0 &&
        (folder == NULL || chdir(folder) == 0)) {
        for (int i = 0; i < PROGRAM_NAMES && (i == 0 || errno == ENOENT); i++) {
            arguments[0] = program_names[i];
            execvp(arguments[0], arguments);
        }
    }
    reason = errno;
    if (write(report, &reason, sizeof reason) < 0) {
        _exit(127);
    }
    _exit(126);
}

/* Forks and executes s51. Returns the child, or -1 with errno set: also when there is no such
 * program.
 */
static pid_t spawn(char *arguments[], const char *folder, int in, int out)
{
    pid_t parent = getpid(), child;
    int report[2], reason = 0;
    ssize_t got;

    if (pipe2(report, O_CLOEXEC) != 0) {
        return -1;
    }
    child = fork();
    if (child == 0) {
        become_s51(arguments, parent, folder, in, out, report[1]);
    }
    close(report[1]);
    if (child > 0) {
        setpgid(child, child);
        do {
            got = read(report[0], &reason, sizeof reason);
        } while (got < 0 && errno == EINTR);
        if (got == sizeof reason) {
            waitpid(child, NULL, 0);
            child = -1;
            errno = reason;
        }
    }
    close(report[0]);
    return child;
}

static int no_s51(int reason)
{
    if (reason == ENOENT) {
        diag_error("s51", 0,
                   "not found in PATH, nor is ucsim_51; install sdcc-ucsim (tools/deps.sh does)");
    } else {
        diag_error("s51", 0, "cannot be started: %s", strerror(reason));
    }
    return EXIT_USAGE;
}

enum wait_result { WAIT_INTERRUPTED, WAIT_SILENCE, WAIT_ENDED, WAIT_READABLE };

/* Waits for bytes from FD, or the end of the process behind ENDED_FD (-1: the end of FD). */
static enum wait_result wait_for_bytes(int fd, int ended_fd)
{
    struct pollfd requests[] = {{.fd = fd, .events = POLLIN}, {.fd = ended_fd, .events = POLLIN}};
    int ready;

    do {
        ready = sim_is_interrupted ? -1 : poll(requests, 2, SILENCE_MS);
    } while (ready < 0 && errno == EINTR && !sim_is_interrupted);
    if (ready < 0) {
        return WAIT_INTERRUPTED;
    }
    if (ready == 0) {
        return WAIT_SILENCE;
    }
    return (requests[0].revents & POLLIN) != 0 ? WAIT_READABLE : WAIT_ENDED;
}

static void kill_group(pid_t child)
{
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR)
        ;
}

bool s51_is_known(const char *version)
{
    return strcmp(version, "0.6.4") == 0 || strcmp(version, "0.8.15") == 0;
}

int s51_version(char *version, size_t size)
{
    char *arguments[] = {"s51", "-v", NULL};
    char text[256] = "";
    const char *answer;
    size_t length = 0;
    int output[2], nothing, reason, silences = 0;
    ssize_t got;
    pid_t child;

    if (pipe2(output, O_CLOEXEC) != 0) {
        return no_s51(errno);
    }
    nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    child = spawn(arguments, NULL, nothing, output[1]);
    reason = errno;
    close(nothing);
    close(output[1]);
    if (child < 0) {
        close(output[0]);
        return no_s51(reason);
    }
    while (length < sizeof text - 1 && silences < 10) {
        enum wait_result result = wait_for_bytes(output[0], -1);

        if (result == WAIT_SILENCE) {
            silences++;
            continue;
        }
        got =
            result == WAIT_READABLE ? read(output[0], text + length, sizeof text - 1 - length) : 0;
        if (got <= 0) {
            break;
        }
        length += (size_t)got;
    }
    close(output[0]);
    kill_group(child);
    text[length] = '\0';
    for (int i = 0; i < PROGRAM_NAMES; i++) {
        answer = strstr(text, program_names[i]); /* after the path that it was started by */
        if (answer != NULL && strncmp(answer + strlen(program_names[i]), ": ", 2) == 0) {
            answer += strlen(program_names[i]) + 2;
            snprintf(version, size, "%.*s", (int)strcspn(answer, "\r\n "), answer);
            return EXIT_FINE;
        }
    }
    diag_error("s51", 0, "does not answer to -v; is the s51 in PATH uCsim's (package sdcc-ucsim)?");
    return EXIT_USAGE;
}

/* --- starting ----------------------------------------------------------------------------- */

static const char *pin_file(uint8_t bit_address, const char *kind, char name[24])
{
    bool is_output = strcmp(kind, "port") == 0;

    snprintf(name, 24, is_output ? "port%d_value.%d" : "pin%d.%d", (bit_address - 0x80) >> 4,
             bit_address & 7);
    return name;
}

/* Some addresses of the image, spread over all of it, to see that it was loaded. */
static int choose_probes(const struct hexfile *hex, uint16_t probes[PROBES])
{
    size_t seen = 0;
    int count = 0;

    for (size_t address = 0; address < HEX_CODE_SIZE && count < PROBES; address++) {
        if (!hex->used[address]) {
            continue;
        }
        if (seen * (PROBES - 1) >= (size_t)count * (hex->bytes - 1)) {
            probes[count++] = (uint16_t)address;
        }
        seen++;
    }
    return count;
}

static bool write_start_file(const struct s51 *sim, const struct sim_setup *setup,
                             const uint16_t *probes, int probe_count)
{
    char path[sizeof sim->folder + 16], name[24];
    FILE *file;

    snprintf(path, sizeof path, "%s/start", sim->folder);
    file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fputs("file \"image.ihx\"\n", file);
    for (int i = 0; i < probe_count; i++) {
        fprintf(file, "expr rom[%u]\n", probes[i]);
    }
    /* Otherwise version 0.8.15 takes the line for a Telnet connection and loses bytes of frames.
     * 0.6.4 does not know the command, and does not need it. */
    /* PCON.4, POF, which power-on sets in a chip and not in s51. */
    fputs("set mem sfr 0x87 0x10\n", file);
    fputs("set hw uart[0] raw 1\nvar sync\nset hw vcd[0] output \"out\"\n", file);
    for (int i = 0; i < setup->watch_count; i++) {
        fprintf(file, "set hw vcd[0] add %s\n", pin_file(setup->watch[i], "port", name));
    }
    fputs("set hw vcd[0] add sync\nset hw vcd[0] start\n"
          "set hw vcd[0] new 1\nset hw vcd[1] input \"in\"\nset hw vcd[1] start\n",
          file);
    return fclose(file) == 0;
}

static const char *in_folder(const struct s51 *sim, const char *name)
{
    static char path[sizeof sim->folder + 16];

    snprintf(path, sizeof path, "%s/%s", sim->folder, name);
    return path;
}

static const char *temporary_parent(void)
{
    const char *parent = getenv("TMPDIR");

    return parent != NULL && parent[0] != '\0' ? parent : "/tmp";
}

/* The folder with FIFOs and start file; the FIFOs are opened here so that s51 never waits for us.
 */
static bool make_folder(struct s51 *sim, const struct sim_setup *setup, const struct hexfile *hex)
{
    uint16_t probes[PROBES];
    char *image = realpath(setup->hex, NULL);
    bool made;

    snprintf(sim->folder, sizeof sim->folder, "%s/fuzzy51-XXXXXX", temporary_parent());
    if (image == NULL || mkdtemp(sim->folder) == NULL) {
        sim->folder[0] = '\0';
        free(image);
        return false;
    }
    made = write_start_file(sim, setup, probes, choose_probes(hex, probes)) &&
           symlink(image, in_folder(sim, "image.ihx")) == 0 &&
           mkfifo(in_folder(sim, "out"), 0600) == 0 && mkfifo(in_folder(sim, "in"), 0600) == 0;
    free(image);
    if (!made) {
        return false;
    }
    sim->out_fd = open(in_folder(sim, "out"), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    sim->in_fd = open(in_folder(sim, "in"), O_RDWR | O_CLOEXEC);
    sim->uart_fd = open(in_folder(sim, "tx"), O_RDONLY | O_CREAT | O_CLOEXEC, 0600);
    sim->log_fd = memfd_create("s51-log", MFD_CLOEXEC);
    if (setup->uart_in && mkfifo(in_folder(sim, "rx"), 0600) == 0) {
        sim->send_fd = open(in_folder(sim, "rx"), O_RDWR | O_CLOEXEC);
    }
    return sim->out_fd >= 0 && sim->in_fd >= 0 && sim->uart_fd >= 0 && sim->log_fd >= 0 &&
           (!setup->uart_in || sim->send_fd >= 0);
}

/* Once s51 has opened everything, nothing needs a name any more. */
static void remove_folder(struct s51 *sim)
{
    static const char *const names[] = {"start", "image.ihx", "out", "in", "tx", "rx"};

    if (sim->folder[0] == '\0') {
        return;
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        unlink(in_folder(sim, names[i]));
    }
    rmdir(sim->folder);
    sim->folder[0] = '\0';
}

static bool spawn_s51(struct s51 *sim, const struct sim_setup *setup)
{
    char clock[24];
    char uart[] = "uart=0,in=rx,out=tx";
    char *arguments[] = {
        "s51", "-t", (char *)setup->s51_type, "-X", clock, "-R", "1", "-S", uart, "-C", "start",
        "-g",  NULL};
    int input[2], reason;

    if (!setup->uart_in) {
        strcpy(uart, "uart=0,out=tx");
    }
    snprintf(clock, sizeof clock, "%ld", setup->clk_hz);
    if (pipe2(input, O_CLOEXEC) != 0) {
        return false;
    }
    sim->pid = spawn(arguments, sim->folder, input[0], sim->log_fd);
    reason = errno;
    close(input[0]);
    sim->stdin_fd = input[1]; /* stays open: at its end s51 would quit */
    if (sim->pid < 0) {
        sim->pid = 0;
        errno = reason;
        return false;
    }
    sim->pid_fd = pidfd_open(sim->pid, 0);
    return sim->pid_fd >= 0;
}

/* --- complaints --------------------------------------------------------------------------- */

static void log_text(const struct s51 *sim, char *text, size_t size)
{
    ssize_t got = pread(sim->log_fd, text, size - 1, 0);

    text[got > 0 ? got : 0] = '\0';
}

/* What s51 itself said last, for a message. */
static void last_words(const struct s51 *sim, char words[120])
{
    char text[4096], *line, *rest = text;

    log_text(sim, text, sizeof text);
    strcpy(words, "nothing");
    while ((line = strsep(&rest, "\r\n")) != NULL) {
        if (line[0] != '\0') {
            snprintf(words, 120, "'%.100s'", line);
        }
    }
}

static enum sim_status failed(const struct s51 *sim, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static enum sim_status failed(const struct s51 *sim, const char *format, ...)
{
    char what[200], words[120];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    last_words(sim, words);
    diag_error("s51", 0, "%s; it said last: %s", what, words);
    return SIM_FAILED;
}

static enum sim_status died(struct s51 *sim)
{
    int status = 0;
    pid_t reaped;

    /* Its FIFO closes a moment before it can be reaped. */
    for (int i = 0; (reaped = waitpid(sim->pid, &status, WNOHANG)) == 0 && i < 100; i++) {
        usleep(10000);
    }
    if (reaped != sim->pid) {
        return failed(sim, "closed its output at %.6f s; run it again",
                      (double)sim->base.now_ns * 1e-9);
    }
    sim->pid = 0;
    if (WIFSIGNALED(status)) {
        return failed(sim, "died of signal %d (%s) at %.6f s; does it know the chip (s51 -H)?",
                      WTERMSIG(status), strsignal(WTERMSIG(status)),
                      (double)sim->base.now_ns * 1e-9);
    }
    return failed(sim, "ended with status %d at %.6f s; does it know the chip (s51 -H)?",
                  WEXITSTATUS(status), (double)sim->base.now_ns * 1e-9);
}

/* --- lockstep ----------------------------------------------------------------------------- */

static void add_text(struct s51 *sim, int64_t time_ns, char value, char id)
{
    char line[48];
    int length = 0;

    if (time_ns != sim->text_ns) {
        length = snprintf(line, sizeof line, "#%lld\n", (long long)time_ns);
    }
    length += snprintf(line + length, sizeof line - (size_t)length, "%c%c\n", value, id);
    sim->text_ns = time_ns;
    if (sim->text_length + (size_t)length > sizeof sim->text) {
        abort(); /* no plant has that many events in a quantum */
    }
    memcpy(sim->text + sim->text_length, line, (size_t)length);
    sim->text_length += (size_t)length;
}

static void set_pin(struct sim *base, int64_t time_ns, int drive, bool level)
{
    struct s51 *sim = (struct s51 *)base;
    int64_t earliest_ns = sim->text_ns > sim->base.now_ns ? sim->text_ns : sim->base.now_ns + 1;

    if (time_ns < earliest_ns) {
        time_ns = earliest_ns;
    }
    add_text(sim, sim_grid_ns(&sim->base, time_ns), level ? '1' : '0', (char)('!' + drive));
}

static void note_change(void *user, int64_t time_ns, int var, uint32_t value)
{
    struct s51 *sim = user;

    if (time_ns < sim->base.last_ns - LATE_NS) {
        sim->was_reset = true;
    } else if (time_ns < sim->base.last_ns) {
        time_ns = sim->base.last_ns;
    }
    sim->base.last_ns = time_ns;
    if (sim->sync_var < 0) {
        char name[24];

        sim->sync_var = vcd_var_index(&sim->vcd, "sync");
        for (int i = 0; i < sim->watch_count; i++) {
            sim->watch_vars[i] =
                vcd_var_index(&sim->vcd, pin_file((uint8_t)sim->watch_vars[i], "port", name));
        }
    }
    if (var == sim->sync_var) {
        sim->marker_seen = true;
        sim->marker_ns = time_ns;
    }
    for (int i = 0; i < sim->watch_count; i++) {
        if (var != sim->watch_vars[i] || (value != 0) == sim->levels[i]) {
            continue;
        }
        sim->levels[i] = value != 0;
        sim_add_edge(&sim->base, &(struct sim_edge){time_ns, i, value != 0, sim->was_reset});
    }
}

/* The simulator's state ('R' runs, 'S' waits, ...) and the processor time that it has used. */
static char process_state(pid_t pid, double *used_s)
{
    char path[32], state = '?';
    unsigned long user = 0, system = 0;
    FILE *file;

    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    file = fopen(path, "r");
    if (file != NULL) {
        if (fscanf(file, "%*d (%*[^)]) %c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &state,
                   &user, &system) != 3) {
            state = '?';
        }
        fclose(file);
    }
    *used_s = (double)(user + system) / (double)sysconf(_SC_CLK_TCK);
    return state;
}

/* Nothing came for a while. It hangs if it has used a second of processor time without a word, or
 * waits for nothing; if the machine gave it no time to run, it gets a minute. */
static enum sim_status judge_silence(struct s51 *sim)
{
    double used_s;
    char state = process_state(sim->pid, &used_s);

    if (sim->silences++ == 0) {
        sim->silent_from_s = used_s;
        sim->waits = 0;
    }
    if (state == 'S') {
        sim->waits++;
    }
    if (used_s - sim->silent_from_s < 1 && sim->waits < 6 && sim->silences < 120) {
        return SIM_RAN;
    }
    return failed(sim,
                  "hangs: no sign for %.0f s, last pin change at %.6f s, process state %c; is "
                  "the chip powered down?",
                  sim->silences * SILENCE_MS * 1e-3, (double)sim->base.last_ns * 1e-9, state);
}

/* Waits for what s51 writes, and takes it. */
static enum sim_status read_changes(struct s51 *sim)
{
    char bytes[4096];
    ssize_t got;

    switch (wait_for_bytes(sim->out_fd, sim->pid_fd)) {
    case WAIT_INTERRUPTED:
        return sim_interrupted(&sim->base);
    case WAIT_SILENCE:
        return judge_silence(sim);
    case WAIT_ENDED:
        return died(sim);
    case WAIT_READABLE:
        break;
    }
    got = read(sim->out_fd, bytes, sizeof bytes);
    sim->silences = 0;
    if (got > 0 && !vcd_feed(&sim->vcd, bytes, (size_t)got, note_change, sim)) {
        return failed(sim, "does not write a value change dump; install version %s", S51_VERSIONS);
    }
    return SIM_RAN;
}

static enum sim_status wait_for_marker(struct s51 *sim)
{
    int64_t tolerance_ns = 2 * CLOCKS_PER_CYCLE * 1000000000LL / sim->base.clk_hz;

    while (!sim->marker_seen && !sim->was_reset) {
        if (read_changes(sim) != SIM_RAN) {
            return SIM_FAILED;
        }
    }
    if (sim->was_reset) {
        return SIM_RESET;
    }
    if (llabs(sim->marker_ns - sim->base.now_ns) > tolerance_ns) {
        return failed(sim, "stands at %.6f s and not at %.6f s; install version %s",
                      (double)sim->marker_ns * 1e-9, (double)sim->base.now_ns * 1e-9, S51_VERSIONS);
    }
    return SIM_RAN;
}

static bool send_text(struct s51 *sim)
{
    size_t sent = 0;

    while (sent < sim->text_length) {
        ssize_t put = write(sim->in_fd, sim->text + sent, sim->text_length - sent);

        if (put < 0 && errno != EINTR) {
            return false;
        }
        if (put > 0) {
            sent += (size_t)put;
        }
    }
    sim->text_length = 0;
    return true;
}

static enum sim_status run_to(struct sim *base, int64_t time_ns)
{
    struct s51 *sim = (struct s51 *)base;
    int64_t next_ns = sim_grid_ns(&sim->base, time_ns);

    if (next_ns < sim->text_ns) {
        next_ns = sim->text_ns;
    }
    sim->sync_level = !sim->sync_level;
    add_text(sim, next_ns, sim->sync_level ? '1' : '0', '~');
    if (sim->listening && next_ns > sim->listen_until_ns) {
        add_text(sim, next_ns, '0', '}');
        sim->listening = false;
    }
    sim->base.now_ns = next_ns;
    sim->marker_seen = false;
    if (!send_text(sim)) {
        return failed(sim, "cannot be written to: %s", strerror(errno));
    }
    return wait_for_marker(sim);
}

static enum sim_status run_after_reset(struct sim *base, int64_t window_ns)
{
    struct s51 *sim = (struct s51 *)base;

    while (!sim->marker_seen && sim->base.last_ns < window_ns) {
        if (read_changes(sim) != SIM_RAN) {
            return SIM_FAILED;
        }
    }
    return SIM_RAN;
}

/* --- serial line -------------------------------------------------------------------------- */

static size_t receive(struct sim *base, char *bytes, size_t size)
{
    struct s51 *sim = (struct s51 *)base;
    ssize_t got = pread(sim->uart_fd, bytes, size, sim->uart_offset);

    if (got <= 0) {
        return 0;
    }
    sim->uart_offset += got;
    return (size_t)got;
}

static void send(struct sim *base, const char *bytes, size_t size)
{
    struct s51 *sim = (struct s51 *)base;

    if (size == 0) {
        return;
    }
    if (!sim->listening) {
        add_text(sim, sim_grid_ns(&sim->base, sim->base.now_ns + 1), '1', '}');
    }
    sim->listening = true;
    sim->listen_until_ns = sim->base.now_ns + (int64_t)(size + 1) * BYTE_NS;
    while (size > 0) {
        ssize_t put = write(sim->send_fd, bytes, size);

        if (put <= 0) {
            return; /* the next s51_run_to says what is wrong */
        }
        bytes += put;
        size -= (size_t)put;
    }
}

/* --- start and stop ----------------------------------------------------------------------- */

/* s51 answered each `expr rom[n]` of the start file with the byte it holds. */
static bool is_loaded(const struct s51 *sim, const struct hexfile *hex)
{
    uint16_t probes[PROBES];
    int count = choose_probes(hex, probes);
    char text[4096], question[32];

    log_text(sim, text, sizeof text);
    for (int i = 0; i < count; i++) {
        const char *answer;

        snprintf(question, sizeof question, "expr rom[%u]\n", probes[i]);
        answer = strstr(text, question);
        if (answer == NULL || atoi(answer + strlen(question)) != hex->code[probes[i]]) {
            return false;
        }
    }
    return true;
}

static enum sim_status first_sync(struct s51 *sim, const struct sim_setup *setup)
{
    char name[24];

    sim->text_length = 0;
    sim->text_length += (size_t)sprintf(sim->text, "$timescale 1ns $end\n$scope module m $end\n");
    for (int i = 0; i < setup->drive_count; i++) {
        sim->text_length +=
            (size_t)sprintf(sim->text + sim->text_length, "$var wire 1 %c %s $end\n", '!' + i,
                            pin_file(setup->drive[i], "pin", name));
    }
    sim->text_length +=
        (size_t)sprintf(sim->text + sim->text_length,
                        "%s$var wire 1 ~ sync $end\n$upscope $end\n$enddefinitions $end\n",
                        setup->uart_in ? "$var wire 8 } uart0_check_often $end\n" : "");
    /* s51 takes the first stamp's values while it opens the file, and reports none of them. */
    for (int i = 0; i < setup->drive_count; i++) {
        set_pin(&sim->base, 1, i, (setup->levels >> i & 1) != 0);
    }
    return run_to(&sim->base, sim->text_ns + 1);
}

static int start_process(struct s51 *sim, const struct sim_setup *setup, const struct hexfile *hex)
{
    if (!make_folder(sim, setup, hex)) {
        diag_error(temporary_parent(), 0, "no room for the simulator's files: %s; set TMPDIR",
                   strerror(errno));
        return EXIT_USAGE;
    }
    if (!spawn_s51(sim, setup)) {
        return no_s51(errno);
    }
    if (first_sync(sim, setup) != SIM_RAN) {
        return EXIT_USAGE;
    }
    if (!is_loaded(sim, hex)) {
        failed(sim, "has not loaded '%s'; install version %s", setup->hex, S51_VERSIONS);
        return EXIT_USAGE;
    }
    return EXIT_FINE;
}

static void stop(struct sim *base)
{
    struct s51 *sim = (struct s51 *)base;
    int *const handles[] = {&sim->out_fd, &sim->in_fd,   &sim->stdin_fd, &sim->pid_fd,
                            &sim->log_fd, &sim->uart_fd, &sim->send_fd};

    if (sim->pid > 0) {
        kill_group(sim->pid);
    }
    remove_folder(sim);
    for (size_t i = 0; i < sizeof handles / sizeof handles[0]; i++) {
        if (*handles[i] >= 0) {
            (void)close(*handles[i]);
        }
    }
    free(base->edges);
    free(sim);
}

static int start(struct sim **started, const struct sim_setup *setup)
{
    static struct hexfile hex;
    int status = hexfile_read(&hex, setup->hex);
    struct s51 *sim = status == EXIT_FINE ? calloc(1, sizeof *sim) : NULL;

    if (sim == NULL) {
        return status == EXIT_FINE ? EXIT_USAGE : status;
    }
    sim->base.engine = &s51_engine;
    sim->base.clk_hz = setup->clk_hz;
    sim->out_fd = sim->in_fd = sim->stdin_fd = sim->pid_fd = -1;
    sim->log_fd = sim->uart_fd = sim->send_fd = -1;
    sim->watch_count = setup->watch_count;
    sim->sync_var = -1;
    for (int i = 0; i < setup->watch_count; i++) {
        sim->levels[i] = true; /* as reset leaves a port */
        sim->watch_vars[i] = setup->watch[i];
    }
    vcd_init(&sim->vcd);
    status = start_process(sim, setup, &hex);
    remove_folder(sim);
    if (status != EXIT_FINE) {
        stop(&sim->base);
        return status;
    }
    *started = &sim->base;
    return EXIT_FINE;
}

const struct sim_engine s51_engine = {.name = "s51",
                                      .check = canary_check_version,
                                      .start = start,
                                      .set_pin = set_pin,
                                      .run_to = run_to,
                                      .run_after_reset = run_after_reset,
                                      .receive = receive,
                                      .send = send,
                                      .stop = stop};
