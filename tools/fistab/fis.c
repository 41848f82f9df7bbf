/* struct fis as a whole: from a file, validated, freed. */
#include "fis.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diag.h"
#include "fis_internal.h"

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
    }
    free(fis->rule);
    free(fis->name);
    free(fis->file);
    memset(fis, 0, sizeof *fis);
}

const struct set *fis_set(const struct variable *variable, int term)
{
    return term == 0 ? NULL : &variable->set[abs(term) - 1];
}

static int validate_set(const struct fis *fis, const struct variable *variable, size_t number,
                        struct set *set, bool is_output)
{
    bool wants_sugeno = is_output && fis->type == FIS_SUGENO;
    size_t wanted = mf_parameters(set->kind, fis->inputs);
    const char *name = mf_name(set->kind);
    const char *fault;

    if (set->line == 0) {
        return diag_error(fis->file, variable->line, "MF%zu of '%s' is missing", number,
                          variable->name);
    }
    if (mf_is_sugeno(set->kind) && !wants_sugeno) {
        return diag_error(fis->file, set->line, "'%s' is for Sugeno outputs only", name);
    }
    if (!mf_is_sugeno(set->kind) && wants_sugeno) {
        return diag_error(fis->file, set->line,
                          "a Sugeno output has sets 'constant' and 'linear', not '%s'", name);
    }
    if (wanted == 0) {
        if (set->parameters < 4 || set->parameters % 2 != 0) {
            return diag_error(fis->file, set->line,
                              "'%s' takes points x1 y1 x2 y2 ..., two or more", name);
        }
    } else {
        /* Files of MATLAB 4 fill every list with zeros to one length. */
        while (set->parameters > wanted && set->parameter[set->parameters - 1] == 0) {
            set->parameters--;
        }
        if (set->parameters != wanted) {
            return diag_error(fis->file, set->line, "'%s' takes %zu numbers here, not %zu", name,
                              wanted, set->parameters);
        }
    }
    fault = mf_fault(set->kind, set->parameter, set->parameters);
    if (fault != NULL) {
        return diag_error(fis->file, set->line, "'%s' wants %s", name, fault);
    }
    return EXIT_FINE;
}

static int validate_variables(const struct fis *fis, const char *what, struct variable *list,
                              size_t count, size_t declared, const size_t *declared_sets,
                              int system_line)
{
    if (declared != NOT_DECLARED && declared != count) {
        return diag_error(fis->file, system_line, "Num%ss=%zu, but the file has %zu [%sN] sections",
                          what, declared, count, what);
    }
    if (count == 0) {
        return diag_error(fis->file, 0, "there is no [%s1] section", what);
    }
    for (size_t i = 0; i < count; i++) {
        struct variable *variable = &list[i];

        if (variable->line == 0) {
            return diag_error(fis->file, 0, "[%s%zu] is missing", what, i + 1);
        }
        if (variable->name == NULL) {
            return diag_error(fis->file, variable->line, "[%s%zu] has no Name", what, i + 1);
        }
        if (!(variable->min < variable->max)) {
            return diag_error(fis->file, variable->line, "[%s%zu] has no Range", what, i + 1);
        }
        if (declared_sets[i] != NOT_DECLARED && declared_sets[i] != variable->sets) {
            return diag_error(fis->file, variable->line, "NumMFs=%zu, but [%s%zu] has MF1 to MF%zu",
                              declared_sets[i], what, i + 1, variable->sets);
        }
        for (size_t k = 0; k < variable->sets; k++) {
            if (validate_set(fis, variable, k + 1, &variable->set[k], what[0] == 'O') !=
                EXIT_FINE) {
                return EXIT_INPUT;
            }
        }
    }
    return EXIT_FINE;
}

static int validate_rule(const struct fis *fis, const struct rule *rule)
{
    if (rule->inputs != fis->inputs || rule->outputs != fis->outputs) {
        return diag_error(fis->file, rule->line,
                          "this rule has %zu inputs and %zu outputs, the system %zu and %zu; "
                          "write 0 for one that is not used",
                          rule->inputs, rule->outputs, fis->inputs, fis->outputs);
    }
    for (size_t i = 0; i < rule->inputs + rule->outputs; i++) {
        bool is_output = i >= rule->inputs;
        const struct variable *variable =
            is_output ? &fis->output[i - rule->inputs] : &fis->input[i];
        int term = rule->term[i];

        if ((size_t)abs(term) > variable->sets) {
            return diag_error(fis->file, rule->line,
                              "this rule names set %d of '%s', which has %zu", abs(term),
                              variable->name, variable->sets);
        }
        if (term < 0 && is_output && fis->type == FIS_SUGENO) {
            return diag_error(fis->file, rule->line,
                              "'not' (%d) has no meaning for a Sugeno output", term);
        }
    }
    return EXIT_FINE;
}

static size_t conditions(const struct rule *rule)
{
    size_t count = 0;
    for (size_t i = 0; i < rule->inputs; i++) {
        count += rule->term[i] != 0;
    }
    return count;
}

static int missing_method(const struct fis *fis, int line, const char *key, const char *example)
{
    return diag_error(fis->file, line,
                      "%s is empty, but the rules need it; write for instance %s='%s'", key, key,
                      example);
}

static int validate_methods(const struct fis *fis, int system_line)
{
    bool mamdani = fis->type == FIS_MAMDANI;
    bool weighted = fis->defuzz_method == DEFUZZ_WTAVER || fis->defuzz_method == DEFUZZ_WTSUM;

    for (size_t i = 0; i < fis->rules; i++) {
        const struct rule *rule = &fis->rule[i];
        if (conditions(rule) < 2) {
            continue;
        }
        if (rule->is_or && fis->or_method == 0) {
            return missing_method(fis, system_line, "OrMethod", "max");
        }
        if (!rule->is_or && fis->and_method == 0) {
            return missing_method(fis, system_line, "AndMethod", "min");
        }
    }
    if (mamdani && fis->imp_method == 0) {
        return missing_method(fis, system_line, "ImpMethod", "min");
    }
    if (mamdani && fis->agg_method == 0) {
        return missing_method(fis, system_line, "AggMethod", "max");
    }
    if (fis->defuzz_method == 0) {
        return missing_method(fis, system_line, "DefuzzMethod", mamdani ? "centroid" : "wtaver");
    }
    if (mamdani == weighted) {
        return diag_error(fis->file, system_line, "DefuzzMethod '%s' is not for Type '%s'; use %s",
                          fis_defuzz_words[fis->defuzz_method], fis_type_words[fis->type],
                          mamdani ? "centroid, bisector, mom, lom or som" : "wtaver or wtsum");
    }
    return EXIT_FINE;
}

int fis_validate(struct fis *fis, const struct declared *declared)
{
    int line = declared->system_line;

    if (line == 0) {
        return diag_error(fis->file, 0, "there is no [System] section; is this a .fis file?");
    }
    if (fis->type == 0) {
        return diag_error(fis->file, line, "Type is empty; write Type='mamdani' or Type='sugeno'");
    }
    if (validate_variables(fis, "Input", fis->input, fis->inputs, declared->inputs,
                           declared->input_sets, line) != EXIT_FINE ||
        validate_variables(fis, "Output", fis->output, fis->outputs, declared->outputs,
                           declared->output_sets, line) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    if (declared->rules != NOT_DECLARED && declared->rules != fis->rules) {
        return diag_error(fis->file, line, "NumRules=%zu, but [Rules] has %zu", declared->rules,
                          fis->rules);
    }
    for (size_t i = 0; i < fis->rules; i++) {
        if (validate_rule(fis, &fis->rule[i]) != EXIT_FINE) {
            return EXIT_INPUT;
        }
    }
    return validate_methods(fis, line);
}
