/* SPDX-License-Identifier: MIT */
/* Reading a fuzzy system: which format it is in, and what the readers share. */
#include "read.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "crc.h"
#include "diag.h"

int fis_read(const char *path, struct fis *fis)
{
    FILE *stream = fopen(path, "rb");
    char *text;
    size_t length = 0;
    int status;

    if (stream == NULL) {
        return diag_error(path, 0, "cannot read: %s", strerror(errno));
    }
    text = malloc(FIS_BYTES_MAX + 1); /* one more than allowed, to see that there is more */
    if (text == NULL) {
        fclose(stream);
        return diag_error(path, 0, "out of memory");
    }
    length = fread(text, 1, FIS_BYTES_MAX + 1, stream);
    if (ferror(stream)) {
        status = diag_error(path, 0, "cannot read: %s", strerror(errno));
    } else {
        status = fis_parse(path, text, length, fis);
    }
    free(text);
    fclose(stream);
    return status;
}

/* By the ending of the name, or else by how the text begins. */
static enum fis_format format_of(const char *file, const char *text)
{
    const char *ending = strrchr(file, '.');

    if (ending != NULL && strcasecmp(ending, ".fll") == 0) {
        return FORMAT_FLL;
    }
    if (ending != NULL && strcasecmp(ending, ".fcl") == 0) {
        return FORMAT_FCL;
    }
    while (*text != '\0') { /* passes over empty lines and comments */
        text += strspn(text, " \t\r\n\v\f");
        if (*text != '#' && *text != '%' && strncmp(text, "//", 2) != 0) {
            break;
        }
        text += strcspn(text, "\r\n");
    }
    if (strncmp(text, "Engine", 6) == 0 && text[6 + strspn(text + 6, " \t")] == ':') {
        return FORMAT_FLL;
    }
    return strncasecmp(text, "FUNCTION_BLOCK", 14) == 0 || strncmp(text, "(*", 2) == 0 ? FORMAT_FCL
                                                                                       : FORMAT_FIS;
}

int fis_parse(const char *file, const char *text, size_t length, struct fis *fis)
{
    static int (*const reader[])(struct scan *, struct fis *) = {
        [FORMAT_FIS] = read_fis, [FORMAT_FLL] = read_fll, [FORMAT_FCL] = read_fcl};
    struct scan scan;
    int status;

    memset(fis, 0, sizeof *fis);
    status = scan_open(&scan, file, text, length);
    if (status == EXIT_FINE && (fis->file = strdup(file)) == NULL) {
        status = diag_error(file, 0, "out of memory");
    }
    if (status == EXIT_FINE) {
        fis->format = format_of(file, scan.text);
        status = reader[fis->format](&scan, fis);
    }
    scan_close(&scan);
    if (status == EXIT_FINE) {
        status = fis_validate(fis);
    }
    if (status != EXIT_FINE) {
        fis_free(fis);
    } else {
        fis->crc32 = crc32_update(0, text, length);
    }
    return status;
}

int not_supported(const struct scan *scan, const char *feature, const char *advice)
{
    return SCAN_FAIL(scan, "%s: fistab does not support this; %s", feature, advice);
}

struct set *add_set(struct scan *scan, struct variable *variable)
{
    struct set *set;

    if (variable->sets == FIS_SETS_MAX) {
        SCAN_FAIL(scan, "more than %d sets in one variable, fistab's limit", FIS_SETS_MAX);
        return NULL;
    }
    if (!fis_grow((void **)&variable->set, &variable->sets, variable->sets, sizeof *set)) {
        SCAN_FAIL(scan, "out of memory");
        return NULL;
    }
    set = &variable->set[variable->sets - 1];
    set->line = scan->line;
    set->height = 1;
    return set;
}

struct variable *add_variable(struct scan *scan, struct variable **list, size_t *count)
{
    struct variable *variable;

    if (*count == FIS_VARIABLES_MAX) {
        SCAN_FAIL(scan, "more than %d variables of one kind, fistab's limit", FIS_VARIABLES_MAX);
        return NULL;
    }
    if (!fis_grow((void **)list, count, *count, sizeof **list)) {
        SCAN_FAIL(scan, "out of memory");
        return NULL;
    }
    variable = &(*list)[*count - 1];
    variable->line = variable->agg_line = scan->line;
    variable->default_value = NAN;
    return variable;
}

struct block *add_block(struct scan *scan, struct fis *fis)
{
    struct block *block;

    if (fis->blocks == FIS_RULES_MAX) {
        SCAN_FAIL(scan, "more than %d rule blocks, fistab's limit", FIS_RULES_MAX);
        return NULL;
    }
    if (!fis_grow((void **)&fis->block, &fis->blocks, fis->blocks, sizeof *fis->block)) {
        SCAN_FAIL(scan, "out of memory");
        return NULL;
    }
    block = &fis->block[fis->blocks - 1];
    block->and_line = block->or_line = block->imp_line = scan->line;
    return block;
}

struct rule *add_rule(struct scan *scan, struct fis *fis, size_t terms)
{
    struct rule *rule;

    if (fis->rules == FIS_RULES_MAX) {
        SCAN_FAIL(scan, "more than %d rules, fistab's limit", FIS_RULES_MAX);
        return NULL;
    }
    if (!fis_grow((void **)&fis->rule, &fis->rules, fis->rules, sizeof *rule)) {
        SCAN_FAIL(scan, "out of memory");
        return NULL;
    }
    rule = &fis->rule[fis->rules - 1];
    rule->line = scan->line;
    rule->weight = 1;
    rule->term = calloc(terms, sizeof *rule->term);
    rule->hedges = calloc(terms, sizeof *rule->hedges);
    if (rule->term == NULL || rule->hedges == NULL) {
        SCAN_FAIL(scan, "out of memory");
        return NULL;
    }
    return rule;
}

int take_fuzzylite_set(struct scan *scan, struct set *set, const char *class,
                       const double *parameter, size_t count)
{
    const char *fault;
    size_t wanted;

    set->parameter = malloc((count + 2) * sizeof *set->parameter);
    if (set->parameter == NULL) {
        return SCAN_FAIL(scan, "out of memory");
    }
    memcpy(set->parameter, parameter, count * sizeof *parameter);
    set->parameters = count;
    set->kind = mf_from_fuzzylite(class, set->parameter, &set->parameters, &fault);
    if (set->kind == MF_UNKNOWN) {
        return not_supported(scan, class,
                             strcmp(class, "Function") == 0
                                 ? "a custom function cannot become a fuzzy set; use one of the "
                                   "other functions, or Constant and Linear in an output"
                                 : "use Triangle, Trapezoid, Rectangle, Ramp, Binary, Discrete, "
                                   "Gaussian, GaussianProduct, Bell, Sigmoid, SigmoidDifference, "
                                   "SigmoidProduct, SShape, ZShape, PiShape, Cosine, Spike or "
                                   "Concave, or for Sugeno outputs Constant or Linear");
    }
    /* One number more than the function takes is its height. */
    wanted = set->kind == MF_LINEAR ? 0 : mf_parameters_of_class(class);
    if ((wanted != 0 && count == wanted + 1) || (set->kind == MF_PWLMF && count % 2 == 1)) {
        double height = parameter[count - 1];

        if (!(height > 0 && height <= 1)) {
            return SCAN_FAIL(scan, "the height of '%s' is %g; it is a number above 0, up to 1",
                             set->name, height);
        }
        set->height = height;
        set->parameters = count - 1;
        memcpy(set->parameter, parameter, set->parameters * sizeof *parameter);
        set->kind = mf_from_fuzzylite(class, set->parameter, &set->parameters, &fault);
    }
    if (fault != NULL) {
        return SCAN_FAIL(scan, "'%s' takes %s", class, fault);
    }
    return EXIT_FINE;
}
