/* SPDX-License-Identifier: MIT */
/* struct fis: what is the same for every file format. */
#include "fis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const fis_type_words[] = {"", "mamdani", "sugeno", NULL};
const char *const fis_defuzz_words[] = {"",    "centroid", "bisector", "mom", "lom",
                                        "som", "wtaver",   "wtsum",    NULL};
const char *const hedge_words[] = {"", "not", "very", "extremely", "somewhat", "seldom", NULL};

bool fis_grow(void **array, size_t *count, size_t index, size_t item)
{
    size_t room = 8;
    char *bigger;

    if (index < *count) {
        return true;
    }
    while (room < *count) {
        room *= 2;
    }
    if (index >= room || *count == 0) {
        while (room <= index) {
            room *= 2;
        }
        bigger = realloc(*array, room * item);
        if (bigger == NULL) {
            return false;
        }
        *array = bigger;
    }
    memset((char *)*array + *count * item, 0, (index + 1 - *count) * item);
    *count = index + 1;
    return true;
}

static void free_variables(struct variable *variable, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < variable[i].sets; k++) {
            free(variable[i].set[k].name);
            free(variable[i].set[k].parameter);
        }
        free(variable[i].set);
        free(variable[i].name);
    }
    free(variable);
}

void fis_free(struct fis *fis)
{
    free_variables(fis->input, fis->inputs);
    free_variables(fis->output, fis->outputs);
    for (size_t i = 0; i < fis->rules; i++) {
        free(fis->rule[i].term);
        free(fis->rule[i].hedges);
    }
    free(fis->rule);
    free(fis->block);
    free(fis->name);
    free(fis->file);
    memset(fis, 0, sizeof *fis);
}

const struct set *fis_set(const struct variable *variable, int term)
{
    return term == 0 ? NULL : &variable->set[abs(term) - 1];
}

double set_degree(const struct set *set, double x)
{
    return set->height * mf_degree(set->kind, set->parameter, set->parameters, x);
}

static double hedge(enum hedge hedge, double degree)
{
    switch (hedge) {
    case HEDGE_NOT:
        return 1 - degree;
    case HEDGE_VERY:
        return degree * degree;
    case HEDGE_EXTREMELY:
        return degree <= 0.5 ? 2 * degree * degree : 1 - 2 * (1 - degree) * (1 - degree);
    case HEDGE_SOMEWHAT:
        return sqrt(degree);
    case HEDGE_SELDOM:
        return degree <= 0.5 ? sqrt(degree / 2) : 1 - sqrt((1 - degree) / 2);
    }
    return degree;
}

double hedges_apply(hedges_t hedges, double degree)
{
    for (; hedges != 0; hedges >>= HEDGE_BITS) {
        degree = hedge(hedges & ((1 << HEDGE_BITS) - 1), degree);
    }
    return degree;
}

double condition_degree(int term, hedges_t hedges, double degree)
{
    if (hedges != 0) {
        return hedges_apply(hedges, degree);
    }
    return term < 0 ? 1 - degree : degree;
}

size_t rule_conditions(const struct rule *rule)
{
    size_t count = 0;

    for (size_t i = 0; i < rule->inputs; i++) {
        count += rule->term[i] != 0;
    }
    return count;
}
