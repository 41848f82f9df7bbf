/* SPDX-License-Identifier: MIT */
#include "live.h"

#include <ctype.h>
#include <langinfo.h>
#include <locale.h>
#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { FRAME_NS = 40000000, PLAIN_NS = 250000000, WIDTH = 80, WIDTH_MIN = 40 };

static double real_s(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void find_terminal(struct live *live)
{
    struct winsize size;

    setlocale(LC_CTYPE, "");
    live->picture.is_utf8 = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    if (ioctl(fileno(live->out), TIOCGWINSZ, &size) == 0 && size.ws_col >= WIDTH_MIN) {
        live->picture.width =
            size.ws_col - 1 < PICTURE_WIDTH_MAX ? size.ws_col - 1 : PICTURE_WIDTH_MAX;
    }
    fputs("\033[?25l", live->out); /* no cursor */
    fflush(live->out);
}

void live_begin(struct live *live, const struct scenario *scenario, FILE *out)
{
    *live = (struct live){.scenario = scenario, .class = scenario->world, .out = out};
    live->picture = (struct picture){.out = out, .width = WIDTH};
    live->picture.view_m = fmax(scenario->lead.present ? scenario->lead.gap_m * 1.1 : 0, 6);
    live->is_terminal = isatty(fileno(out)) == 1;
    live->begin_s = real_s();
    if (live->is_terminal) {
        find_terminal(live);
    }
}

/* "asks_lane" -> "  ASKS LANE": the columns that are on or off, in capitals, where they are on. */
static void print_switches(const struct live *live, const double *values)
{
    for (int i = 0; i < live->class->column_count; i++) {
        const char *name = live->class->columns[i].name;

        if (live->class->columns[i].decimals > 0 || !(values[i] > 0)) {
            continue;
        }
        fputs("  ", live->out);
        for (const char *c = name; *c != '\0'; c++) {
            fputc(*c == '_' ? ' ' : toupper((unsigned char)*c), live->out);
        }
        fputs(strcmp(name, "stop") == 0 ? " PIN" : "", live->out);
    }
}

static void draw(struct live *live, int64_t t_ns, const double *values,
                 const struct telemetry *telemetry)
{
    struct picture *picture = &live->picture;
    int width = picture->width - 9;

    if (picture->lines > 0) {
        fprintf(live->out, "\033[%dA", picture->lines);
    }
    picture->lines = 0;
    picture_text(picture, "%-*.*s %6.2f s", width, width, live->scenario->title,
                 (double)t_ns * 1e-9);
    picture_end(picture);
    live->class->draw(picture, live->scenario, values, telemetry);
    picture_text(picture, " %-10s", telemetry_value(telemetry, "state"));
    print_switches(live, values);
    picture_end(picture);
}

/* A unit as people write it, for the end of a column's name. */
static const char *unit_of(const char *suffix)
{
    static const char *const units[][2] = {
        {"mps", "m/s"}, {"mps2", "m/s2"}, {"pct", "%"}, {"deg", "deg"}, {"m", "m"}};

    for (size_t k = 0; k < sizeof units / sizeof units[0]; k++) {
        if (strcmp(units[k][0], suffix) == 0) {
            return units[k][1];
        }
    }
    return suffix;
}

/* Column "gap_m" of 4.97 -> "  gap 4.970 m". */
static void print_line(const struct live *live, int64_t t_ns, const double *values,
                       const char *state)
{
    fprintf(live->out, "%6.2f s", (double)t_ns * 1e-9);
    for (int i = 0; i < live->class->column_count; i++) {
        const struct world_column *column = &live->class->columns[i];
        const char *suffix = strrchr(column->name, '_');

        if (column->decimals == 0 || suffix == NULL) {
            continue;
        }
        fprintf(live->out, "  %.*s", (int)(suffix - column->name), column->name);
        if (isnan(values[i])) {
            fputs(" -", live->out);
        } else {
            fprintf(live->out, " %.*f %s", column->decimals, values[i] + 0.0, unit_of(suffix + 1));
        }
    }
    fprintf(live->out, "  %s", state);
    print_switches(live, values);
    fputc('\n', live->out);
}

static void wait_until(const struct live *live, int64_t t_ns)
{
    double ahead_s = (double)t_ns * 1e-9 - (real_s() - live->begin_s);
    struct timespec pause;

    if (ahead_s <= 0) {
        return;
    }
    pause.tv_sec = (time_t)ahead_s;
    pause.tv_nsec = (long)((ahead_s - floor(ahead_s)) * 1e9);
    nanosleep(&pause, NULL); /* a signal ends it early, which is meant */
}

void live_row(void *user, int64_t t_ns, const double values[WORLD_COLUMNS],
              const struct telemetry *telemetry)
{
    struct live *live = user;
    const char *state = telemetry_value(telemetry, "state");

    if (t_ns < live->next_ns) {
        return;
    }
    if (!live->is_terminal) {
        live->next_ns = t_ns + PLAIN_NS;
        print_line(live, t_ns, values, state);
        return;
    }
    live->next_ns = t_ns + FRAME_NS;
    wait_until(live, t_ns);
    draw(live, t_ns, values, telemetry);
    fflush(live->out);
}

void live_end(struct live *live)
{
    if (live->is_terminal) {
        fputs("\033[?25h", live->out);
    }
    fflush(live->out);
}
