/* SPDX-License-Identifier: MIT */
/* Fuzzes the readers, the checks, the inference and the writers of fistab: `make fuzz`.
 * Whatever the bytes, no crash, hang or leak; whatever the system, finite outputs, a Mamdani's in
 * its range; and the .fis written from a system gives the same outputs as the system. The first
 * byte, where no text begins with it, chooses: after 2 comes an .fll, after 3 an .fcl, and after 1
 * the choices of a generator that writes a .fis, so that the fuzzer reaches odd sets and rules
 * without having to spell them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/diag.h"
#include "fistab/check.h"
#include "fistab/header.h"
#include "fistab/infer.h"
#include "fistab/table.h"
#include "fistab/write_fis.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(bool holds, const char *what)
{
    if (holds) {
        return;
    }
    printf("fuzz_fis: %s\n", what);
    abort();
}

/* The corners and some points between, and one far outside. */
static void coordinates(const struct fis *fis, int point, double *x)
{
    static const double share[] = {0, 1, 0.5, 0.25, 0.8191, 1e6};

    for (size_t i = 0; i < fis->inputs; i++) {
        double s = share[((size_t)point + i * (size_t)(point % 3)) % 6];
        x[i] = fis->input[i].min + s * (fis->input[i].max - fis->input[i].min);
    }
}

static void evaluate(const struct fis *fis, const struct infer_options *options)
{
    struct engine *engine = engine_create(fis, options);
    double x[FIS_VARIABLES_MAX], y[FIS_VARIABLES_MAX], again[FIS_VARIABLES_MAX];

    if (engine == NULL) {
        return;
    }
    for (int point = 0; point < 12; point++) {
        coordinates(fis, point, x);
        engine_eval(engine, x, y);
        for (size_t o = 0; o < fis->outputs; o++) {
            demand(isfinite(y[o]), "an output is not finite");
            demand(fis->output[o].type == FIS_SUGENO ||
                       (y[o] >= fis->output[o].min && y[o] <= fis->output[o].max),
                   "an output is outside its range");
        }
        for (size_t r = 0; r < fis->rules; r++) {
            demand(engine_strength(engine, r) >= 0 && engine_strength(engine, r) <= 1,
                   "a strength is not 0..1");
        }
    }
    coordinates(fis, 0, x);
    engine_eval(engine, x, y);
    coordinates(fis, 1, x);
    engine_eval(engine, x, again);
    coordinates(fis, 0, x);
    engine_eval(engine, x, again);
    for (size_t o = 0; o < fis->outputs; o++) {
        demand(y[o] == again[o], "a point has two answers");
    }
    engine_free(engine);
}

static void tabulate(const struct fis *fis)
{
    struct table_options options = {.infer = {.samples = 11}, .dims = {3, 2, 2, 2}, .levels = 255};
    static struct laws laws = {
        .any = true, .text = "-1", .common = {.text = "-1", .direction = {-1}}};
    struct findings findings = {0, 0};
    struct table table;
    uint8_t bytes[24];
    struct header_array array = {.suffix = "out1", .dimensions = fis->inputs, .byte = bytes};
    struct header_options header = {.name = "lut", .array = &array, .arrays = 1};
    char *text = NULL;
    size_t length;
    FILE *out;

    if (table_make(fis, &options, &table) != EXIT_FINE) {
        return;
    }
    check_monotone(&table, &laws, &findings);
    for (size_t i = 0; i < table.cells; i++) {
        demand(table.cell[0][i] >= 0 && table.cell[0][i] <= 255, "a cell is not 0..255");
        /* cppcheck-suppress unreadVariable ; array.byte points to it */
        bytes[i] = (uint8_t)table.cell[0][i];
    }
    for (size_t i = 0; i < fis->inputs; i++) {
        array.dims[i] = table.dims[i];
    }
    out = open_memstream(&text, &length);
    header_write(out, &table, &header);
    csv_write(out, &table);
    fclose(out);
    free(text);
    table_free(&table);
}

/* The same system as a .fis: where that can be, its exact outputs are the same. */
static void convert(const struct fis *fis)
{
    struct infer_options exact = {.exact = true};
    double x[FIS_VARIABLES_MAX], y[FIS_VARIABLES_MAX], again[FIS_VARIABLES_MAX];
    struct engine *engine, *other;
    struct fis copy;
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    int status = write_fis(out, fis);

    fclose(out);
    if (status == EXIT_FINE) {
        demand(fis_parse("copy.fis", text, length, &copy) == EXIT_FINE, "the .fis is not readable");
        engine = engine_create(fis, &exact);
        other = engine_create(&copy, &exact);
        for (int point = 0; engine != NULL && other != NULL && point < 4; point++) {
            coordinates(fis, point, x); /* within the ranges, so that no lock acts */
            engine_eval(engine, x, y);
            engine_eval(other, x, again);
            for (size_t o = 0; o < fis->outputs; o++) {
                demand(fis->output[o].lock_range || fis->output[o].type == FIS_SUGENO
                           ? true
                           : y[o] == again[o],
                       "the .fis has other outputs");
            }
        }
        engine_free(engine);
        engine_free(other);
        fis_free(&copy);
    }
    free(text);
}

static void check_text(const char *file, const char *text, size_t size)
{
    struct infer_options sampled = {.samples = 21}, exact = {.exact = true};
    struct findings findings = {0, 0};
    struct fis fis;

    if (fis_parse(file, text, size, &fis) != EXIT_FINE) {
        return;
    }
    evaluate(&fis, &sampled);
    evaluate(&fis, &exact);
    check_fis(&fis, &findings);
    tabulate(&fis);
    convert(&fis);
    fis_free(&fis);
}

/* --- the generator --------------------------------------------------------------------------- */

struct choices {
    const uint8_t *data;
    size_t size;
};

/* 0..COUNT-1; 0 when the data are used up. */
static unsigned choose(struct choices *c, unsigned count)
{
    if (c->size == 0) {
        return 0;
    }
    c->size--;
    return *c->data++ % count;
}

static double choose_number(struct choices *c)
{
    static const double special[] = {0,      1,      -1,  0.5,   2,      10,  -10, 1e-9,
                                     1e-300, 5e-324, 1e9, 1e100, -1e100, 0.1, 3};
    unsigned choice = choose(c, 40);

    return choice < 15 ? special[choice] : (double)choose(c, 200) / 16 - 3;
}

static void write_set(struct choices *c, FILE *out, unsigned number, bool is_sugeno)
{
    unsigned kind = is_sugeno ? MF_CONSTANT + choose(c, 2) : choose(c, MF_CONSTANT);
    size_t count = mf_parameters(kind, 2) != 0 ? mf_parameters(kind, 2) : 4 + 2 * choose(c, 3);
    double last = -1e100;

    fprintf(out, "MF%u='s':'%s',[", number, mf_name(kind));
    for (size_t i = 0; i < count; i++) {
        double value = choose_number(c);
        /* ascending, mostly, where the kind wants it */
        if ((kind == MF_TRIMF || kind == MF_TRAPMF || kind == MF_LINSMF || kind == MF_LINZMF) &&
            value < last) {
            value = last;
        }
        if (kind == MF_PWLMF) {
            value = i % 2 == 1 ? (double)choose(c, 5) / 4 : (double)i + (double)choose(c, 3);
        }
        last = value;
        fprintf(out, "%.17g ", value);
    }
    fprintf(out, "]\n");
}

static void write_variable(struct choices *c, FILE *out, const char *section, bool is_sugeno)
{
    double min = choose_number(c);
    unsigned sets = 1 + choose(c, 4);

    fprintf(out, "[%s]\nName='v'\nRange=[%.17g %.17g]\n", section, min,
            min + fabs(choose_number(c)));
    for (unsigned k = 1; k <= sets; k++) {
        write_set(c, out, k, is_sugeno);
    }
}

static void write_system(struct choices *c, FILE *out)
{
    bool is_sugeno = choose(c, 4) == 3;
    unsigned rules = choose(c, 6);

    fprintf(out, "[System]\nType='%s'\n", fis_type_words[is_sugeno ? FIS_SUGENO : FIS_MAMDANI]);
    fprintf(out, "AndMethod='%s'\nOrMethod='%s'\n", tnorm_name[1 + choose(c, 7)].fis,
            snorm_name[1 + (choose(c, 8) + 2) % 9].fis);
    fprintf(out, "ImpMethod='%s'\nAggMethod='%s'\n", tnorm_name[1 + choose(c, 7)].fis,
            snorm_name[1 + choose(c, 9)].fis);
    fprintf(out, "DefuzzMethod='%s'\n",
            fis_defuzz_words[is_sugeno ? DEFUZZ_WTAVER + choose(c, 2) : 1 + choose(c, 5)]);
    write_variable(c, out, "Input1", false);
    write_variable(c, out, "Input2", false);
    write_variable(c, out, "Output1", is_sugeno);
    fprintf(out, "[Rules]\n");
    for (unsigned r = 0; r < rules; r++) {
        fprintf(out, "%d %d, %d (%g) : %u\n", (int)choose(c, 5) - 2, (int)choose(c, 5) - 2,
                (int)choose(c, 4) - (is_sugeno ? 0 : 1), (double)choose(c, 5) / 4,
                1 + choose(c, 2));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct choices choices = {data + 1, size - 1};
    char *text = NULL;
    size_t length;
    FILE *out;

    if (size == 0 || data[0] < 1 || data[0] > 3) {
        check_text("fuzz", (const char *)data, size);
        return 0;
    }
    if (data[0] > 1) {
        check_text(data[0] == 2 ? "fuzz.fll" : "fuzz.fcl", (const char *)data + 1, size - 1);
        return 0;
    }
    out = open_memstream(&text, &length);
    write_system(&choices, out);
    fclose(out);
    if (getenv("FUZZ_SHOW") != NULL) {
        printf("%s", text);
    }
    check_text("fuzz.fis", text, length);
    free(text);
    return 0;
}
