/* SPDX-License-Identifier: MIT */
#include "plot.h"

#include "diag.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { COLUMNS_MAX = 32, NAME_SIZE = 40, PANEL_HEIGHT = 260 };

/* A run's columns; NAN: no value. */
struct table {
    char names[COLUMNS_MAX][NAME_SIZE];
    double *values[COLUMNS_MAX];
    int columns;
    size_t rows, capacity;
};

/* A unit that a column's name may end in, the panel that it is drawn in, and the factor to there.
 */
static const struct unit {
    const char *suffix, *panel;
    double factor;
    bool is_reported; /* by a controller, in units that suit it */
} units[] = {
    {"_m", "m", 1, false},        {"_mm", "m", 1e-3, true},
    {"_cm", "m", 1e-2, true},     {"_mps", "m/s", 1, false},
    {"_mmps", "m/s", 1e-3, true}, {"_dkmh", "m/s", 0.1 / 3.6, true},
    {"_mps2", "m/s2", 1, false},  {"_cmps2", "m/s2", 1e-2, true},
    {"_pct", "%", 1, false},      {"_deg", "degrees", 1, false},
    {"_us", "us", 1, true},
};
enum { UNITS = sizeof units / sizeof units[0] };

static void free_table(struct table *table)
{
    for (int i = 0; i < table->columns; i++) {
        free(table->values[i]);
    }
}

static double *cell(struct table *table, size_t row, int column)
{
    return &table->values[column][row];
}

/* Makes room for one more row, without values. */
static void add_row(struct table *table)
{
    if (table->rows == table->capacity) {
        table->capacity = table->capacity * 2 + 1024;
        for (int i = 0; i < table->columns; i++) {
            table->values[i] = realloc(table->values[i], table->capacity * sizeof(double));
            if (table->values[i] == NULL) {
                abort();
            }
        }
    }
    for (int i = 0; i < table->columns; i++) {
        *cell(table, table->rows, i) = NAN;
    }
    table->rows++;
}

static bool add_column(struct table *table, const char *name)
{
    if (table->columns == COLUMNS_MAX || strlen(name) >= NAME_SIZE) {
        return false;
    }
    strcpy(table->names[table->columns], name);
    table->values[table->columns++] = NULL;
    return true;
}

/* --- reading -------------------------------------------------------------------------------- */

static bool read_csv(struct table *table, char *text)
{
    char *line = strsep(&text, "\n"), *name;

    while ((name = strsep(&line, ",")) != NULL) {
        if (!add_column(table, name)) {
            return false;
        }
    }
    while ((line = strsep(&text, "\n")) != NULL && line[0] != '\0') {
        add_row(table);
        for (int i = 0; i < table->columns && (name = strsep(&line, ",")) != NULL; i++) {
            char *end;
            double value = strtod(name, &end);

            if (end != name && *end == '\0') {
                *cell(table, table->rows - 1, i) = value;
            }
        }
    }
    return true;
}

static bool read_json(struct table *table, const char *text)
{
    cJSON *root = cJSON_Parse(text), *series = cJSON_GetObjectItem(root, "series"), *one, *value;
    bool is_read = cJSON_IsObject(series);

    cJSON_ArrayForEach(one, series)
    {
        is_read = is_read && add_column(table, one->string);
    }
    for (int row = 0; is_read && row < cJSON_GetArraySize(series->child); row++) {
        add_row(table);
    }
    one = is_read ? series->child : NULL;
    for (int i = 0; one != NULL; i++, one = one->next) {
        size_t row = 0;

        cJSON_ArrayForEach(value, one)
        {
            if (cJSON_IsNumber(value) && row < table->rows) {
                *cell(table, row, i) = value->valuedouble;
            }
            row++;
        }
    }
    cJSON_Delete(root);
    return is_read;
}

static char *read_text(const char *file)
{
    FILE *stream = fopen(file, "r");
    char *text = NULL;
    size_t size = 0;
    ssize_t got = stream == NULL ? -1 : getdelim(&text, &size, '\0', stream);

    if (stream != NULL) {
        fclose(stream);
    }
    if (got < 0) {
        free(text);
        return NULL;
    }
    return text;
}

/* --- drawing -------------------------------------------------------------------------------- */

static const struct unit *unit_of(const char *name)
{
    for (int k = 0; k < UNITS; k++) {
        size_t length = strlen(name), suffix = strlen(units[k].suffix);

        if (length > suffix && strcmp(name + length - suffix, units[k].suffix) == 0) {
            return &units[k];
        }
    }
    return NULL;
}

/* Is COLUMN drawn in the panel of that unit? It has values then. */
static bool belongs(const struct table *table, int column, const char *panel)
{
    const struct unit *unit = unit_of(table->names[column]);

    if (unit == NULL || strcmp(unit->panel, panel) != 0) {
        return false;
    }
    for (size_t row = 0; row < table->rows; row++) {
        if (!isnan(table->values[column][row])) {
            return true;
        }
    }
    return false;
}

static bool has_panel(const struct table *table, const char *panel)
{
    for (int i = 0; i < table->columns; i++) {
        if (belongs(table, i, panel)) {
            return true;
        }
    }
    return false;
}

/* Whether units[K] is the first of its panel, and the run has that panel. */
static bool begins_panel(const struct table *table, int k)
{
    for (int earlier = 0; earlier < k; earlier++) {
        if (strcmp(units[earlier].panel, units[k].panel) == 0) {
            return false;
        }
    }
    return has_panel(table, units[k].panel);
}

/* A block of data: all versions of gnuplot take it in a figure of several panels. The points of a
 * reported column change with each of its values alone. */
static void send_column(FILE *gnuplot, const struct table *table, int column)
{
    const struct unit *unit = unit_of(table->names[column]);
    double last = NAN;

    fprintf(gnuplot, "$column%d << END\n", column);
    for (size_t row = 0; row < table->rows; row++) {
        double value = table->values[column][row];
        bool is_same = fabs(value - last) <= 0;

        if (!isnan(value) && !(unit->is_reported && is_same)) {
            fprintf(gnuplot, "%.4f %.6g\n", table->values[0][row], value * unit->factor);
        }
        last = value;
    }
    fputs("END\n", gnuplot);
}

/* gnuplot warns of a panel in which nothing changes, so that gets a range. */
static void set_range(FILE *gnuplot, const struct table *table, const char *panel)
{
    double low = INFINITY, high = -INFINITY;

    for (int i = 0; i < table->columns; i++) {
        bool is_shown = belongs(table, i, panel);

        for (size_t row = 0; is_shown && row < table->rows; row++) {
            low = fmin(low, table->values[i][row]);
            high = fmax(high, table->values[i][row]);
        }
    }
    if (low < high) {
        fputs("set yrange [*:*]\n", gnuplot);
    } else {
        fprintf(gnuplot, "set yrange [%g:%g]\n", low - 1, high + 1);
    }
}

static void draw_panel(FILE *gnuplot, const struct table *table, const char *panel)
{
    const char *separator = "plot";

    fprintf(gnuplot, "set ylabel '%s'\n", panel);
    set_range(gnuplot, table, panel);
    for (int i = 0; i < table->columns; i++) {
        if (belongs(table, i, panel)) {
            bool is_reported = unit_of(table->names[i])->is_reported;

            fprintf(gnuplot, "%s $column%d using 1:2 with %s title '%s' noenhanced", separator, i,
                    is_reported ? "points pt 7 ps 0.35" : "lines lw 2", table->names[i]);
            separator = ",";
        }
    }
    fputc('\n', gnuplot);
}

static void draw(FILE *gnuplot, const struct table *table, const char *out, bool is_png)
{
    int panels = 0, drawn = 0;

    for (int k = 0; k < UNITS; k++) {
        panels += begins_panel(table, k);
        for (int i = 0; begins_panel(table, k) && i < table->columns; i++) {
            if (belongs(table, i, units[k].panel)) {
                send_column(gnuplot, table, i);
            }
        }
    }
    fprintf(gnuplot, "set terminal %s size 1000,%d font 'sans,12' background 'white'\n",
            is_png ? "pngcairo" : "svg", PANEL_HEIGHT * panels + 60);
    fprintf(gnuplot, "set output '%s'\n", out);
    fprintf(gnuplot, "set multiplot layout %d,1 margins 0.09,0.97,0.08,0.98 spacing 0.03\n",
            panels);
    fprintf(gnuplot, "set grid lc rgb '#dddddd'\nset key top right\nset xrange [%.4f:%.4f]\n",
            table->values[0][0], table->values[0][table->rows - 1]);
    fputs("set format x ''\n", gnuplot);
    for (int k = 0; k < UNITS; k++) {
        if (begins_panel(table, k)) {
            if (++drawn == panels) {
                fputs("set format x '%g'\nset xlabel 'time, s'\n", gnuplot);
            }
            draw_panel(gnuplot, table, units[k].panel);
        }
    }
    fputs("unset multiplot\n", gnuplot);
}

/* Runs gnuplot, which writes to PART; then moves PART to OUT. */
static int draw_to(const struct table *table, const char *out, const char *part, bool is_png)
{
    FILE *gnuplot = popen("gnuplot", "w");
    int status;

    if (gnuplot == NULL) {
        abort();
    }
    draw(gnuplot, table, part, is_png);
    status = pclose(gnuplot);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
        diag_error(NULL, 0, "gnuplot was not found in PATH; install gnuplot-nox");
        return EXIT_USAGE;
    }
    if (status != 0 || access(part, F_OK) != 0 || rename(part, out) != 0) {
        unlink(part);
        return diag_error(out, 0, "gnuplot could not write it; does the folder exist?");
    }
    return EXIT_FINE;
}

int plot_run(const char *file, const char *out)
{
    struct table table = {.columns = 0};
    const char *suffix = strrchr(out, '.');
    bool is_png = suffix != NULL && strcmp(suffix, ".png") == 0, is_read;
    char part[512], *text;
    int status;

    if (!is_png && (suffix == NULL || strcmp(suffix, ".svg") != 0)) {
        return diag_error(out, 0, "is neither .svg nor .png; name one of the two");
    }
    if (strchr(out, '\'') != NULL || strlen(out) + 8 > sizeof part) {
        return diag_error(out, 0, "gnuplot takes no such name; leave out quotes, and shorten it");
    }
    text = read_text(file);
    if (text == NULL) {
        return diag_error(file, 0, "cannot be read: %s", errno != 0 ? strerror(errno) : "empty");
    }
    is_read = text[0] == '{' ? read_json(&table, text) : read_csv(&table, text);
    free(text);
    if (!is_read || table.rows < 2 || strcmp(table.names[0], "t_s") != 0) {
        status = diag_error(file, 0, "is no run; give a file that drive run --csv or --json wrote");
    } else {
        snprintf(part, sizeof part, "%s.part", out);
        status = draw_to(&table, out, part, is_png);
    }
    free_table(&table);
    return status;
}
