/* SPDX-License-Identifier: MIT */
#include "canary.h"

#include "diag.h"
#include "s51.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    PULSE_FROM_US = 2000,
    PULSE_US = 5800,
    TICK_US = 5000, /* two interrupts in a period of the PWM */
    RUN_US = 56000,
    CLK_HZ = 12000000
};

/* What the firmware needs: an echo of 1 mm takes 5.83 us; 0.1 % of the PWM's period. */
#define PULSE_TOLERANCE_US 2.9
#define TICK_TOLERANCE_US  (TICK_US * 0.001)

struct figures {
    double pulse_us, tick_us;
    unsigned long hash; /* of all edges and bytes */
    size_t bytes;
};

static unsigned long mix(unsigned long hash, uint64_t value)
{
    return (hash ^ (unsigned long)value) * 1099511628211u;
}

/* The image stands beside the program. */
static void image_path(char *path, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", path, size - 1);

    path[length > 0 ? length : 0] = '\0';
    if (strrchr(path, '/') != NULL) {
        *strrchr(path, '/') = '\0';
    }
    snprintf(path + strlen(path), size - strlen(path), "/canary.ihx");
}

static enum sim_status observe(struct sim *sim, struct figures *figures)
{
    int64_t first_ns = 0, last_ns = 0;
    size_t edges = 0;
    char text[64] = "";

    for (int t_us = 400; t_us <= RUN_US; t_us += 400) {
        enum sim_status status;

        if (t_us == PULSE_FROM_US) {
            sim_set_pin(sim, (PULSE_FROM_US - 1) * 1000LL, 0, true);
        }
        if (t_us == PULSE_FROM_US + PULSE_US + 200) {
            sim_set_pin(sim, (PULSE_FROM_US + PULSE_US - 1) * 1000LL, 0, false);
        }
        status = sim_run_to(sim, t_us * 1000LL);
        if (status != SIM_RAN) {
            return status;
        }
        for (size_t i = 0; i < sim->edge_count; i++) {
            last_ns = sim->edges[i].time_ns;
            first_ns = edges++ == 0 ? last_ns : first_ns;
            figures->hash = mix(figures->hash, (uint64_t)last_ns);
        }
    }
    figures->bytes = sim_receive(sim, text, sizeof text - 1);
    for (size_t i = 0; i < figures->bytes; i++) {
        figures->hash = mix(figures->hash, (uint64_t)text[i]);
    }
    figures->pulse_us = figures->bytes > 0 ? atof(text) : NAN;
    figures->tick_us = edges > 1 ? (double)(last_ns - first_ns) * 1e-3 / (double)(edges - 1) : NAN;
    return SIM_RAN;
}

static int run_once(struct figures *figures)
{
    static const uint8_t watch[] = {0x90}, drive[] = {0xB2};
    char path[512];
    const struct sim_setup setup = {.hex = path,
                                    .s51_type = "C52",
                                    .clk_hz = CLK_HZ,
                                    .watch = watch,
                                    .watch_count = 1,
                                    .drive = drive,
                                    .drive_count = 1};
    struct sim *sim;
    enum sim_status status;

    memset(figures, 0, sizeof *figures);
    image_path(path, sizeof path);
    if (sim_start(&s51_engine, &sim, &setup) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    status = observe(sim, figures);
    sim_stop(sim);
    return status == SIM_FAILED ? EXIT_USAGE : EXIT_FINE;
}

/* Says what is wrong with SECOND, in words that follow "s51 VERSION"; "" when nothing is. */
static void find_fault(const struct figures *first, const struct figures *second, char fault[160])
{
    fault[0] = '\0';
    if (second->bytes == 0) {
        snprintf(fault, 160, "sends no serial byte");
    } else if (!(fabs(second->pulse_us - PULSE_US) < PULSE_TOLERANCE_US)) {
        snprintf(fault, 160, "reads a pulse of %d us as %.0f us (%+.1f %%)", PULSE_US,
                 second->pulse_us, (second->pulse_us / PULSE_US - 1) * 100);
    } else if (!(fabs(second->tick_us - TICK_US) < TICK_TOLERANCE_US)) {
        snprintf(fault, 160, "has interrupts every %.2f us in place of %d (%+.1f %%)",
                 second->tick_us, TICK_US, (second->tick_us / TICK_US - 1) * 100);
    } else if (first->hash != second->hash) {
        snprintf(fault, 160, "does not run twice alike");
    }
}

static int measure(const char *version, struct figures *figures)
{
    struct figures first;
    char fault[160];

    if (run_once(&first) != EXIT_FINE || run_once(figures) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    find_fault(&first, figures, fault);
    if (fault[0] == '\0') {
        return EXIT_FINE;
    }
    diag_error("s51", 0, "version %s %s; install version %s", version, fault, S51_VERSIONS);
    return EXIT_USAGE;
}

int canary_check_version(void)
{
    struct figures figures;
    char version[32];

    if (s51_version(version, sizeof version) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    if (s51_is_known(version)) {
        return EXIT_FINE;
    }
    if (measure(version, &figures) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    diag_warning("s51", 0, "version %s is not %s, but it keeps time", version, S51_VERSIONS);
    return EXIT_FINE;
}

int canary_run(void)
{
    struct figures figures;
    char version[32];

    if (s51_version(version, sizeof version) != EXIT_FINE ||
        measure(version, &figures) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    printf("s51 %s keeps time: a pulse of %d us reads %.0f us, an interrupt every %d us comes "
           "every %.2f us, serial bytes arrive, two runs are alike\n",
           version, PULSE_US, figures.pulse_us, TICK_US, figures.tick_us);
    return EXIT_FINE;
}
