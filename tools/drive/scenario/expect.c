/* SPDX-License-Identifier: MIT */
#include "expect.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name, *unit;
    int decimals;
    enum expect_kind kind;
    const char *meaning;
} metrics[METRIC_COUNT] = {
#define EXPECT_ROW(id, name, unit, decimals, kind, meaning) {name, unit, decimals, kind, meaning},
    EXPECT_METRICS(EXPECT_ROW)
#undef EXPECT_ROW
};

void outcome_clear(struct outcome *outcome)
{
    *outcome = (struct outcome){.uart = ""};
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        outcome->values[metric] = NAN;
    }
    outcome->values[METRIC_RESETS] = 0;
    outcome->values[METRIC_RESET_BRAKE] = INFINITY;
}

const char *expect_name(enum metric metric)
{
    return metrics[metric].name;
}

const char *expect_unit(enum metric metric)
{
    return metrics[metric].unit;
}

const char *expect_meaning(enum metric metric)
{
    return metrics[metric].meaning;
}

enum expect_kind expect_kind(enum metric metric)
{
    return metrics[metric].kind;
}

enum metric expect_find(const char *name)
{
    enum metric metric = 0;

    while (metric < METRIC_COUNT && strcmp(metrics[metric].name, name) != 0) {
        metric++;
    }
    return metric;
}

void expect_format(const struct expectation *expectation, char *text, size_t size)
{
    const char *name = expect_name(expectation->metric);

    if (expectation->op == '=') {
        snprintf(text, size, "%s = %s", name, expectation->text);
    } else {
        snprintf(text, size, "%s %c= %s", name, expectation->op, expectation->text);
    }
}

void expect_value(enum metric metric, const struct outcome *outcome, char *text, size_t size)
{
    double value = outcome->values[metric];

    if (metric == METRIC_PARKED && !isnan(value)) {
        snprintf(text, size, "%s", value > 0 ? "yes" : "no");
    } else if (metric == METRIC_IMPACT && !isnan(value)) {
        snprintf(text, size, "%s", outcome->values[METRIC_IMPACT] > 0 ? "any" : "none");
    } else if (metric == METRIC_FINAL_STATE) {
        snprintf(text, size, "%s", outcome->final_state[0] ? outcome->final_state : "none");
    } else if (metric == METRIC_UART_SAYS) {
        snprintf(text, size, "%zu bytes", strlen(outcome->uart));
    } else if (metrics[metric].kind == KIND_LIST) {
        snprintf(text, size, "%.*s", (int)strlen(outcome->states) - (outcome->states[0] != '\0'),
                 outcome->states);
    } else if (isnan(value)) {
        snprintf(text, size, "not measured by this app");
    } else if (isinf(value)) {
        snprintf(text, size, "%s", value > 0 ? "never" : "none before");
    } else {
        snprintf(text, size, "%.*f%s%s", metrics[metric].decimals, value,
                 metrics[metric].unit[0] ? " " : "", metrics[metric].unit);
    }
}

/* Is WORD one of the states that occurred? */
static bool occurred(const struct outcome *outcome, const char *word, size_t length)
{
    for (const char *at = outcome->states; *at != '\0'; at += strcspn(at, " ") + 1) {
        if (strcspn(at, " ") == length && strncmp(at, word, length) == 0) {
            return true;
        }
    }
    return false;
}

/* How many of the listed states (separated by commas or blanks) occurred, and how many are listed.
 */
static int count_occurred(const struct outcome *outcome, const char *list, int *listed)
{
    int count = 0;

    *listed = 0;
    while (*(list += strspn(list, " ,")) != '\0') {
        size_t length = strcspn(list, " ,");

        count += occurred(outcome, list, length);
        ++*listed;
        list += length;
    }
    return count;
}

bool expect_holds(const struct expectation *expectation, const struct outcome *outcome)
{
    double value = outcome->values[expectation->metric];
    int listed, count;

    switch (expectation->metric) {
    case METRIC_IMPACT:
        return strcmp(expectation->text, "any") == 0 || value <= 0;
    case METRIC_PARKED:
        return strcmp(expectation->text, value > 0 ? "yes" : "no") == 0 && !isnan(value);
    case METRIC_FINAL_STATE:
        return strcmp(expectation->text, outcome->final_state) == 0;
    case METRIC_REACHED:
        count = count_occurred(outcome, expectation->text, &listed);
        return count == listed;
    case METRIC_NEVER:
        return count_occurred(outcome, expectation->text, &listed) == 0;
    case METRIC_UART_SAYS:
        return strstr(outcome->uart, expectation->text) != NULL;
    default:
        break;
    }
    if (expectation->op == '<') {
        return value <= expectation->limit;
    }
    if (expectation->op == '>') {
        return value >= expectation->limit;
    }
    return value >= expectation->limit && value <= expectation->limit;
}
