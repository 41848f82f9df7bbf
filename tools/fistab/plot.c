/* SPDX-License-Identifier: MIT */
/* Sheets for gnuplot: a surface or a curve for each output, then a panel of sets for each variable.
 */
#include "plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"

/* The sheet in points of the SVG; the PNG has SCALE times as many pixels. */
enum {
    SHEET_WIDTH = 720,
    SURFACE_HEIGHT = 380,
    HALF_HEIGHT = 280, /* of a surface where two stand side by side */
    SETS_HEIGHT = 220,
    SETS_ACROSS = 3,
    SCALE = 2,
    SURFACE_NODES = 41,
    CURVE_NODES = 501,
};

/* Of a character of a set's name, in widths of its panel's frame; of a row of names, in degrees of
 * membership. */
#define NAME_WIDTH  0.039
#define NAME_HEIGHT 0.13
enum { NAME_LONGEST = 24 }; /* characters; a longer name is cut */

struct sheet {
    FILE *out;
    const struct fis *fis;
    const struct plot_options *options;
    double height;
    double *value; /* of the outputs, node after node; NaN where no rule fires */
    size_t nodes;  /* along an axis */
};

/* Units that a name may end in, as distance_m does. */
static const struct {
    const char *ending, *unit;
} units[] = {
    {"_m", "m"},      {"_mm", "mm"},       {"_cm", "cm"},   {"_km", "km"},     {"_s", "s"},
    {"_ms", "ms"},    {"_us", "us"},       {"_mps", "m/s"}, {"_mmps", "mm/s"}, {"_kmph", "km/h"},
    {"_kmh", "km/h"}, {"_mps2", "m/s²"},   {"_pct", "%"},   {"_percent", "%"}, {"_deg", "degrees"},
    {"_rad", "rad"},  {"_radps", "rad/s"}, {"_degc", "°C"}, {"_hz", "Hz"},     {"_khz", "kHz"},
    {"_v", "V"},      {"_a", "A"},         {"_n", "N"},     {"_nm", "Nm"},     {"_kg", "kg"},
};

/* LENGTH bytes of a name, which is UTF-8, inside a string of gnuplot's: underscores become blanks.
 */
static void put_name(FILE *out, const char *name, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)name[i];

        if (c == '\'') {
            fputs("''", out);
        } else {
            putc(c == '_' || c < ' ' ? ' ' : c, out);
        }
    }
}

/* How many bytes the first CHARACTERS of NAME take. */
static size_t bytes_of(const char *name, size_t characters)
{
    size_t bytes = 0;

    while (name[bytes] != '\0' && characters > 0) {
        bytes++;
        while ((name[bytes] & 0xC0) == 0x80) {
            bytes++;
        }
        characters--;
    }
    return bytes;
}

static size_t characters_of(const char *name)
{
    size_t characters = 0;

    for (; *name != '\0'; name++) {
        characters += (*name & 0xC0) != 0x80;
    }
    return characters;
}

/* "distance (m)", inside a string of gnuplot's */
static void put_quantity(FILE *out, const struct variable *variable)
{
    size_t length = strlen(variable->name);

    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        size_t ending = strlen(units[i].ending);

        if (length <= ending || strcmp(variable->name + length - ending, units[i].ending) != 0) {
            continue;
        }
        put_name(out, variable->name, length - ending);
        fprintf(out, " (%s)", units[i].unit);
        return;
    }
    put_name(out, variable->name, length);
}

static double node(const struct variable *variable, size_t index, size_t nodes)
{
    return variable->min + (variable->max - variable->min) * (double)index / (double)(nodes - 1);
}

/* --- the outputs at the nodes ---------------------------------------------------------------- */

static size_t node_count(const struct sheet *sheet)
{
    return sheet->fis->inputs == 1 ? sheet->nodes : sheet->nodes * sheet->nodes;
}

static bool has_a_value(const struct sheet *sheet)
{
    for (size_t i = 0; i < node_count(sheet) * sheet->fis->outputs; i++) {
        if (!isnan(sheet->value[i])) {
            return true;
        }
    }
    return false;
}

static bool evaluate(struct sheet *sheet)
{
    const struct fis *fis = sheet->fis;
    const size_t *axis = sheet->options->axis;
    struct engine *engine = engine_create(fis, &sheet->options->infer);
    double x[FIS_VARIABLES_MAX], y[FIS_VARIABLES_MAX];

    sheet->nodes = fis->inputs == 1 ? CURVE_NODES : SURFACE_NODES;
    sheet->value = calloc(node_count(sheet) * fis->outputs, sizeof *sheet->value);
    if (engine == NULL || sheet->value == NULL) {
        engine_free(engine);
        return false;
    }
    for (size_t i = 0; i < fis->inputs; i++) {
        x[i] = (fis->input[i].min + fis->input[i].max) / 2;
    }
    for (size_t n = 0; n < node_count(sheet); n++) {
        if (fis->inputs > 1) {
            x[axis[1]] = node(&fis->input[axis[1]], n % sheet->nodes, sheet->nodes);
        }
        x[axis[0]] =
            node(&fis->input[axis[0]], fis->inputs > 1 ? n / sheet->nodes : n, sheet->nodes);
        engine_eval(engine, x, y);
        for (size_t o = 0; o < fis->outputs; o++) {
            sheet->value[n * fis->outputs + o] = engine_fired(engine, o) ? y[o] : NAN;
        }
    }
    engine_free(engine);
    return true;
}

/* Lines of x [y] output1 output2 ..., an empty line after each row of a surface. */
static void write_values(const struct sheet *sheet)
{
    const struct fis *fis = sheet->fis;
    const struct variable *first = &fis->input[sheet->options->axis[0]];
    const struct variable *second = &fis->input[sheet->options->axis[1]];

    fprintf(sheet->out, "$outputs << end_of_data\n");
    for (size_t n = 0; n < node_count(sheet); n++) {
        if (fis->inputs == 1) {
            fprintf(sheet->out, "%.10g", node(first, n, sheet->nodes));
        } else {
            fprintf(sheet->out, "%s%.10g %.10g", n > 0 && n % sheet->nodes == 0 ? "\n" : "",
                    node(first, n / sheet->nodes, sheet->nodes),
                    node(second, n % sheet->nodes, sheet->nodes));
        }
        for (size_t o = 0; o < fis->outputs; o++) {
            double value = sheet->value[n * fis->outputs + o];
            if (isnan(value)) {
                fprintf(sheet->out, " NaN");
            } else {
                fprintf(sheet->out, " %.10g", value);
            }
        }
        putc('\n', sheet->out);
    }
    fprintf(sheet->out, "end_of_data\n");
}

/* The output's range, wider where a Sugeno system leaves it. */
static struct variable drawn_range(const struct sheet *sheet, size_t output)
{
    struct variable range = sheet->fis->output[output];

    for (size_t n = 0; n < node_count(sheet); n++) {
        range.min = fmin(range.min, sheet->value[n * sheet->fis->outputs + output]);
        range.max = fmax(range.max, sheet->value[n * sheet->fis->outputs + output]);
    }
    return range;
}

/* The turn about the upright axis that brings the surface's lowest corner to the left, where it
 * hides nothing. */
static int view_degrees(const struct sheet *sheet, size_t output)
{
    size_t last = sheet->nodes - 1, row = sheet->nodes;
    /* which corner is left at 40, 130, 220 and 310 degrees */
    const size_t corner[] = {0, last * row, last * row + last, last};
    int lowest = 0;

    for (int i = 1; i < 4; i++) {
        if (sheet->value[corner[i] * sheet->fis->outputs + output] <
            sheet->value[corner[lowest] * sheet->fis->outputs + output]) {
            lowest = i;
        }
    }
    return 40 + 90 * lowest;
}

/* --- panels ----------------------------------------------------------------------------------- */

static void place(const struct sheet *sheet, double left, double top, double width, double height)
{
    fprintf(sheet->out, "set origin %.6f, %.6f\nset size %.6f, %.6f\n", left / SHEET_WIDTH,
            (sheet->height - top - height) / sheet->height, width / SHEET_WIDTH,
            height / sheet->height);
}

/* A round distance between about five tics. */
static double tic_step(const struct variable *range)
{
    double least = (range->max - range->min) / 5;
    double step = pow(10, floor(log10(least)));

    return least <= step       ? step
           : least <= 2 * step ? 2 * step
           : least <= 5 * step ? 5 * step
                               : 10 * step;
}

static void write_range(FILE *out, const char *axis, const struct variable *variable)
{
    fprintf(out, "set %srange [%.10g:%.10g]\nset %stics nomirror %.10g\nset %slabel '", axis,
            variable->min, variable->max, axis, tic_step(variable), axis);
    put_quantity(out, variable);
    fprintf(out, "'\n");
}

/* The inputs that stay in the middle of their range: "opening (m/s) at 0.4". */
static void write_title(const struct sheet *sheet)
{
    const size_t *axis = sheet->options->axis;
    const char *between = "";

    fprintf(sheet->out, "set title '");
    for (size_t i = 0; i < sheet->fis->inputs && sheet->fis->inputs > 1; i++) {
        const struct variable *input = &sheet->fis->input[i];

        if (i == axis[0] || i == axis[1]) {
            continue;
        }
        fputs(between, sheet->out);
        put_quantity(sheet->out, input);
        fprintf(sheet->out, " at %.6g", (input->min + input->max) / 2);
        between = ", ";
    }
    fprintf(sheet->out, "'\n");
}

static void write_surface_panel(const struct sheet *sheet, size_t output)
{
    const struct fis *fis = sheet->fis;
    struct variable range = drawn_range(sheet, output);
    FILE *out = sheet->out;

    write_title(sheet);
    write_range(out, "x", &fis->input[sheet->options->axis[0]]);
    if (fis->inputs == 1) {
        write_range(out, "y", &range);
        fprintf(out,
                "set grid\n"
                "plot $outputs using 1:%zu with lines linewidth 2 linecolor rgb '#2166ac' notitle\n"
                "unset grid\n",
                output + 2);
        return;
    }
    write_range(out, "y", &fis->input[sheet->options->axis[1]]);
    write_range(out, "z", &range);
    fprintf(out,
            "set cbrange [%.10g:%.10g]\n"
            "set xlabel rotate parallel\nset ylabel rotate parallel\nset zlabel rotate parallel\n"
            "set view 55, %d\n"
            "splot $outputs using 1:2:%zu with pm3d notitle\n",
            range.min, range.max, view_degrees(sheet, output), output + 3);
}

/* Lines of x degree1 degree2 ... */
static void write_degrees(FILE *out, const struct variable *variable)
{
    fprintf(out, "$sets << end_of_data\n");
    for (size_t i = 0; i < CURVE_NODES; i++) {
        double x = node(variable, i, CURVE_NODES);

        fprintf(out, "%.10g", x);
        for (size_t s = 0; s < variable->sets; s++) {
            const struct set *set = &variable->set[s];
            fprintf(out, " %.6g", set_degree(set, x));
        }
        putc('\n', out);
    }
    fprintf(out, "end_of_data\n");
}

/* The middle of the place where the set is highest, within the range. */
static double summit(const struct variable *variable, const struct set *set)
{
    double best = -1, first = 0, last = 0;

    for (size_t i = 0; i < CURVE_NODES; i++) {
        double x = node(variable, i, CURVE_NODES);
        double degree = set_degree(set, x);

        if (degree > best + 1e-9) {
            best = degree;
            first = x;
        }
        if (degree >= best - 1e-9) {
            last = x;
        }
    }
    return (first + last) / 2;
}

/* Where a name stands, in widths of the frame and in rows. */
struct name_place {
    double left, right;
    size_t row;
};

/* Places the names of all sets over x[set], each in the lowest row where it meets no other, none
 * outside the frame. Returns how many rows that takes. */
static size_t place_names(const struct variable *range, const double *x, struct name_place *name)
{
    size_t rows = 0;

    for (size_t s = 0; s < range->sets; s++) {
        size_t characters = characters_of(range->set[s].name);
        double width =
            (double)((characters > NAME_LONGEST ? NAME_LONGEST : characters) + 1) * NAME_WIDTH;
        double middle = (x[s] - range->min) / (range->max - range->min);

        name[s].left = fmax(fmin(middle - width / 2, 1 - width), 0);
        name[s].right = name[s].left + width;
        name[s].row = 0;
        for (size_t other = 0; other < s; other++) {
            if (name[other].row != name[s].row || name[other].right <= name[s].left ||
                name[s].right <= name[other].left) {
                continue;
            }
            name[s].row++;
            other = (size_t)-1; /* all others again, in the next row */
        }
        if (name[s].row + 1 > rows) {
            rows = name[s].row + 1;
        }
    }
    return rows;
}

/* Of set INDEX of COUNT, as #rrggbb: no two sets of a panel have the same. Seven that people tell
 * apart, also in print, and for more sets all around the circle of hues. */
static const char *color_of(size_t index, size_t count, char *text)
{
    static const char *const few[] = {"#2166ac", "#b2182b", "#1b7837", "#762a83",
                                      "#b35806", "#01665e", "#000000"};
    enum { FEW = sizeof few / sizeof few[0] };
    double channel[3];

    if (count <= FEW) {
        return few[index];
    }
    for (int c = 0; c < 3; c++) { /* every third set is darker than its neighbours */
        double turn = 2 * M_PI * ((double)index / (double)count - c / 3.0);
        channel[c] = (index % 3 == 2 ? 90 : 160) * (0.5 + 0.5 * cos(turn));
    }
    sprintf(text, "#%02x%02x%02x", (unsigned)channel[0] & 0xFF, (unsigned)channel[1] & 0xFF,
            (unsigned)channel[2] & 0xFF);
    return text;
}

/* The names are the key: each has the colour of its set. */
static void write_names(FILE *out, const struct variable *range, const struct name_place *name)
{
    char color[16];

    for (size_t s = 0; s < range->sets; s++) {
        const char *text = range->set[s].name;
        bool is_long = characters_of(text) > NAME_LONGEST;

        fprintf(out, "set label '");
        put_name(out, text, bytes_of(text, is_long ? NAME_LONGEST - 1 : NAME_LONGEST));
        fprintf(out, "%s' at graph %.6f, first %.3f center font ',11' textcolor rgb '%s'\n",
                is_long ? "…" : "", (name[s].left + name[s].right) / 2,
                1.02 + NAME_HEIGHT * ((double)name[s].row + 0.5), color_of(s, range->sets, color));
    }
}

/* Sets of a Sugeno output: constants are posts at their value. */
static void write_posts(FILE *out, const struct variable *range)
{
    size_t linear = 0;
    char color[16];

    for (size_t s = 0; s < range->sets; s++) {
        double x = range->set[s].parameter[0];

        if (range->set[s].kind == MF_CONSTANT) {
            fprintf(out,
                    "set arrow from first %.10g, 0 to first %.10g, 1 nohead linewidth 2 linecolor "
                    "rgb '%s'\n",
                    x, x, color_of(s, range->sets, color));
        } else {
            linear++;
        }
    }
    if (linear > 0) {
        fprintf(out, "set label '%zu linear, not drawn' at graph 0.5, 0.4 center\n", linear);
    }
    fprintf(out, "plot -1 notitle\nunset arrow\n");
}

static void write_curves(FILE *out, const struct variable *variable)
{
    char color[16];

    fprintf(out, "plot ");
    for (size_t s = 0; s < variable->sets; s++) {
        fprintf(out, "%s$sets using 1:%zu with lines linewidth 2 linecolor rgb '%s' notitle",
                s == 0 ? "" : ", ", s + 2, color_of(s, variable->sets, color));
    }
    fprintf(out, "\n");
}

/* The range with every constant in it. */
static struct variable range_of_sets(const struct variable *variable)
{
    struct variable range = *variable;

    for (size_t s = 0; s < range.sets; s++) {
        if (range.set[s].kind != MF_CONSTANT) {
            continue;
        }
        range.min = fmin(range.min, range.set[s].parameter[0]);
        range.max = fmax(range.max, range.set[s].parameter[0]);
    }
    return range;
}

static bool write_sets_panel(FILE *out, const struct variable *variable)
{
    struct variable range = range_of_sets(variable);
    bool sugeno = mf_is_sugeno(range.set[0].kind);
    double *x = calloc(range.sets, sizeof *x);
    struct name_place *name = calloc(range.sets, sizeof *name);
    bool enough = x != NULL && name != NULL;

    for (size_t s = 0; enough && s < range.sets; s++) {
        x[s] = sugeno ? range.set[s].parameter[0] : summit(&range, &range.set[s]);
    }
    if (enough) {
        write_range(out, "x", &range);
        fprintf(out, "set yrange [0:%.3f]\n",
                1.04 + NAME_HEIGHT * (double)place_names(&range, x, name));
        fprintf(out, "set ytics nomirror (0, 0.5, 1)\nset ylabel 'membership'\n");
        if (!sugeno) {
            write_degrees(out, &range);
        }
        write_names(out, &range, name);
        if (sugeno) {
            write_posts(out, &range);
        } else {
            write_curves(out, &range);
        }
        fprintf(out, "unset label\n");
    }
    free(x);
    free(name);
    return enough;
}

/* --- the sheet -------------------------------------------------------------------------------- */

static void write_head(const struct sheet *sheet)
{
    if (sheet->options
            ->png) { /* whose font sizes are in points at 96 dots an inch, the SVG's in dots */
        fprintf(sheet->out,
                "set terminal pngcairo noenhanced size %d,%.0f font 'Sans,13' fontscale %g "
                "linewidth %d background '#ffffff'\n",
                SHEET_WIDTH * SCALE, sheet->height * SCALE, SCALE * 72.0 / 96, SCALE);
    } else {
        fprintf(sheet->out,
                "set terminal svg noenhanced size %d,%.0f font 'Arial,13' background '#ffffff'\n",
                SHEET_WIDTH, sheet->height);
    }
    fprintf(sheet->out,
            "set encoding utf8\n"
            "set datafile missing NaN\n"
            "set style line 1 linecolor rgb '#404040' linewidth 0.4\n"
            "set pm3d depthorder border linestyle 1\n"
            /* light to dark, so that a print without colour tells low from high */
            "set palette defined (0 '#fff7bc', 0.35 '#a1dab4', 0.65 '#41b6c4', 1 '#225ea8')\n"
            "unset colorbox\n"
            "set xyplane 0\n"
            "set tics font ',11'\n"
            "set ztics offset 0, 0.4\n"
            "set multiplot\n");
}

static void write_surfaces(const struct sheet *sheet, size_t across, double height)
{
    double width = (double)SHEET_WIDTH / (double)across;

    for (size_t o = 0; o < sheet->fis->outputs; o++) {
        double left = (double)(o % across) * width, top = (double)(o / across) * height;

        /* gnuplot leaves little room for the upright axis' label, and much above the surface: room
         * for a title, if there is one */
        if (sheet->fis->inputs == 1) {
            place(sheet, left, top, width, height);
        } else if (sheet->fis->inputs == 2) {
            place(sheet, left + 45, top - height * 0.1, width - 70, height * 1.1);
        } else {
            place(sheet, left + 45, top, width - 70, height);
        }
        write_surface_panel(sheet, o);
    }
}

static bool write_sets(const struct sheet *sheet, double top)
{
    const struct fis *fis = sheet->fis;
    double width = (double)SHEET_WIDTH / SETS_ACROSS;
    size_t drawn = 0;

    /* Text that was turned for a surface stands upright again, on panels of one size. */
    fprintf(sheet->out, "set title ''\nset xlabel norotate\nset ylabel rotate\n"
                        "set tmargin 1\nset bmargin 3.5\nset lmargin 8\nset rmargin 2\n");
    for (size_t v = 0; v < fis->inputs + fis->outputs; v++) {
        const struct variable *variable =
            v < fis->inputs ? &fis->input[v] : &fis->output[v - fis->inputs];

        if (variable->sets == 0) {
            continue;
        }
        place(sheet, (double)(drawn % SETS_ACROSS) * width,
              top + (double)(drawn / SETS_ACROSS * SETS_HEIGHT), width, SETS_HEIGHT);
        if (!write_sets_panel(sheet->out, variable)) {
            return false;
        }
        drawn++;
    }
    return true;
}

static size_t variables_with_sets(const struct fis *fis)
{
    size_t count = 0;

    for (size_t i = 0; i < fis->inputs; i++) {
        count += fis->input[i].sets > 0;
    }
    for (size_t o = 0; o < fis->outputs; o++) {
        count += fis->output[o].sets > 0;
    }
    return count;
}

int plot_write(FILE *out, const struct fis *fis, const struct plot_options *options)
{
    struct sheet sheet = {.out = out, .fis = fis, .options = options};
    size_t across = fis->outputs > 1 ? 2 : 1;
    double surface_height = across > 1 ? HALF_HEIGHT : SURFACE_HEIGHT, sets_top = 0;
    bool enough = true; /* memory */

    if (!options->sets_only) {
        enough = evaluate(&sheet);
        if (enough && !has_a_value(&sheet)) {
            free(sheet.value);
            return diag_error(fis->file, 0,
                              "no rule gives an output here, so there is no surface; add rules, or "
                              "draw the sets alone by --sets");
        }
        if (enough) {
            write_values(&sheet);
        }
        sets_top = (double)((fis->outputs + across - 1) / across) * surface_height;
    }
    sheet.height = sets_top + (double)((variables_with_sets(fis) + SETS_ACROSS - 1) / SETS_ACROSS *
                                       SETS_HEIGHT);
    if (enough) {
        write_head(&sheet);
        if (!options->sets_only) {
            write_surfaces(&sheet, across, surface_height);
        }
        enough = write_sets(&sheet, sets_top);
        fprintf(out, "unset multiplot\n");
    }
    free(sheet.value);
    return enough ? EXIT_FINE : diag_error(fis->file, 0, "out of memory");
}
