/* SPDX-License-Identifier: MIT */
#include "live.h"

#include <langinfo.h>
#include <locale.h>
#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { FRAME_NS = 40000000, PLAIN_NS = 250000000, ROAD_LINES = 7, YARD_LINES = YARD_ROWS + 2 };

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
    live->is_utf8 = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    if (ioctl(fileno(live->out), TIOCGWINSZ, &size) == 0 && size.ws_col >= 40) {
        live->width = size.ws_col - 1 < YARD_WIDTH_MAX ? size.ws_col - 1 : YARD_WIDTH_MAX;
    }
    fputs("\033[?25l", live->out); /* no cursor */
    fflush(live->out);
}

void live_begin(struct live *live, const struct scenario *scenario, const struct world_class *class,
                FILE *out)
{
    *live = (struct live){.title = scenario->title, .class = class, .out = out, .width = 80};
    live->is_terminal = isatty(fileno(out)) == 1;
    live->view_m = fmax(scenario->lead.present ? scenario->lead.gap_m * 1.1 : 0, 6);
    live->begin_s = real_s();
    live->is_yard = strcmp(scenario->world->name, "park") == 0; /* soon: the world draws */
    if (live->is_terminal) {
        find_terminal(live);
    }
    if (live->is_yard) {
        yard_init(&live->yard, 10, 25, 4, live->width);
    }
}

static double column(const struct live *live, const char *name, const double *values)
{
    for (int i = 0; i < live->class->column_count; i++) {
        if (strcmp(live->class->columns[i].name, name) == 0) {
            return values[i];
        }
    }
    return NAN;
}

static void repeat(FILE *out, const char *text, int count)
{
    while (count-- > 0) {
        fputs(text, out);
    }
}

/* A car, the open road, the car ahead: its rear stands where the gap ends. */
static void draw_road(const struct live *live, double gap_m)
{
    static const char ego[] = "[##>", lead[] = "[##]";
    int lane = live->width - (int)(sizeof ego + sizeof lead) + 1;
    int free = isnan(gap_m) ? lane : (int)(gap_m / live->view_m * lane);
    bool in_sight = !isnan(gap_m) && free <= lane;
    const char *rail = live->is_utf8 ? "\u2500" : "-", *mark = live->is_utf8 ? "\u00b7" : ".";

    free = free < 0 ? 0 : free > lane ? lane : free;
    repeat(live->out, rail, live->width);
    fputs("\033[K\n", live->out);
    fputs(ego, live->out);
    for (int i = 0; i < free; i++) {
        fputs(i % 4 == 3 ? mark : " ", live->out);
    }
    fprintf(live->out, "%s\033[K\n", in_sight ? lead : "");
    repeat(live->out, rail, live->width);
    fputs("\033[K\n", live->out);
}

static void draw_bar(const struct live *live, double part)
{
    int width = live->width - 24;
    int full = (int)(fmin(fmax(part, 0), 1) * width + 0.5);

    repeat(live->out, live->is_utf8 ? "\u2588" : "#", full);
    repeat(live->out, live->is_utf8 ? "\u2591" : ".", width - full);
    fputs("\033[K\n", live->out);
}

static void draw_drive(const struct live *live, const double *values)
{
    double gap = column(live, "gap_m", values), brake = column(live, "brake_pct", values);

    draw_road(live, gap);
    if (isnan(gap)) {
        fprintf(live->out, " gap         -       ");
    } else {
        fprintf(live->out, " gap     %6.2f m     ", gap);
    }
    draw_bar(live, isnan(gap) ? 1 : gap / live->view_m);
    fprintf(live->out, " brake   %6.1f %%     ", brake);
    draw_bar(live, brake / 100);
    fprintf(live->out, " speed   %6.2f m/s   ", column(live, "ego_mps", values));
}

static void draw_parking(struct live *live, const double *values)
{
    double x_m = column(live, "x_m", values), y_m = column(live, "y_m", values);
    double steer_deg = column(live, "steer_deg", values);

    yard_draw(&live->yard, x_m, y_m, column(live, "heading_deg", values), steer_deg, live->out);
    fprintf(live->out, " x %6.2f m  y %6.2f m  steering %5.1f   ", x_m, y_m, steer_deg);
}

/* What else is on: "STOP LINE  LAMP  ". */
static void draw_words(const struct live *live, const double *values)
{
    static const char *const words[][2] = {
        {"stop", "STOP LINE"},        {"lamp", "LAMP"},
        {"buzzer", "BUZZER"},         {"cut", "THROTTLE CUT"},
        {"throttle_pct", "THROTTLE"}, {"asks_lane", "ASKS FOR LANE"},
        {"lane", "OTHER LANE"},
    };

    for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
        if (column(live, words[k][0], values) > 0) {
            fprintf(live->out, "%s  ", words[k][1]);
        }
    }
}

static void draw(struct live *live, int64_t t_ns, const double *values, const char *state)
{
    if (live->drawn > 0) {
        fprintf(live->out, "\033[%dA", live->drawn);
    }
    fprintf(live->out, "%-*.*s %6.2f s\033[K\n", live->width - 9, live->width - 9, live->title,
            (double)t_ns * 1e-9);
    if (live->is_yard) {
        draw_parking(live, values);
    } else {
        draw_drive(live, values);
    }
    fprintf(live->out, "%-10s", state);
    draw_words(live, values);
    fputs("\033[K\n", live->out);
    live->drawn = live->is_yard ? YARD_LINES : ROAD_LINES;
}

static void print_line(const struct live *live, int64_t t_ns, const double *values,
                       const char *state)
{
    double gap = column(live, "gap_m", values);

    fprintf(live->out, "%6.2f s  ", (double)t_ns * 1e-9);
    if (live->is_yard) {
        fprintf(live->out, "x %7.3f m  y %7.3f m  heading %6.1f  steering %5.1f  %s",
                column(live, "x_m", values), column(live, "y_m", values),
                column(live, "heading_deg", values), column(live, "steer_deg", values), state);
    } else if (isnan(gap)) {
        fprintf(live->out, "nothing ahead");
    } else {
        fprintf(live->out, "gap %7.3f m", gap);
    }
    if (!live->is_yard) {
        fprintf(live->out, "  speed %6.3f m/s  brake %5.1f %%  %s", column(live, "ego_mps", values),
                column(live, "brake_pct", values), state);
    }
    fprintf(live->out, "%s%s%s\n", column(live, "stop", values) > 0 ? "  stop line" : "",
            column(live, "lamp", values) > 0 ? "  lamp" : "",
            column(live, "buzzer", values) > 0 ? "  buzzer" : "");
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
    draw(live, t_ns, values, state);
    fflush(live->out);
}

void live_end(struct live *live)
{
    if (live->is_terminal) {
        fputs("\033[?25h", live->out);
    }
    fflush(live->out);
}
