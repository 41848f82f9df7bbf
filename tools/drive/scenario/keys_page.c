/* SPDX-License-Identifier: MIT */
#include "keys_page.h"

#include "diag.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool is_asked_for(const struct world_class *world, const char *app)
{
    return app == NULL || strcmp(world->name, app) == 0;
}

static const struct section_use *use_of(const struct world_class *world,
                                        const struct section *section)
{
    for (int i = 0; i < world->section_count; i++) {
        if (world->sections[i].section == section) {
            return &world->sections[i];
        }
    }
    return NULL;
}

/* Whether an earlier one of the worlds has the section, too: then it was printed there. */
static bool was_printed(const struct section *section, int world, const char *app)
{
    for (int i = 0; i < world; i++) {
        if (is_asked_for(world_at(i), app) && use_of(world_at(i), section) != NULL) {
            return true;
        }
    }
    return false;
}

/* "For brake, gap and radar (one); follow: speed_mps." */
static void print_users(const struct section *section, const char *app)
{
    const char *separator = "For";

    for (int i = 0; world_at(i) != NULL; i++) {
        const struct section_use *use = use_of(world_at(i), section);

        if (use == NULL || !is_asked_for(world_at(i), app)) {
            continue;
        }
        printf("%s %s", separator, world_at(i)->name);
        if (use->required) {
            printf(", required");
        }
        if (use->copies > 1) {
            printf(", up to %d: `[%s]`, `[%s2]`%s", use->copies, section->name, section->name,
                   use->copies > 2 ? ", ..." : "");
        }
        if (use->only != NULL) {
            printf(", only %s", use->only);
        }
        separator = ";";
    }
    printf(".\n\n");
}

static void print_range(const struct key *key)
{
    switch (key->kind) {
    case VALUE_NUMBER:
        printf("%.10g..%.10g", key->low, key->high);
        break;
    case VALUE_COUNT:
        printf("%.10g..%.10g, whole", key->low, key->high);
        break;
    case VALUE_CHOICE:
        for (int i = 0; word_at(key->choices, i)[0] != '\0'; i++) {
            printf("%s`%s`", i > 0 ? ", " : "", word_at(key->choices, i));
        }
        break;
    case VALUE_TEXT:
        printf("text");
        break;
    case VALUE_PROFILE:
        printf("up to %d points", PROFILE_POINTS);
        break;
    }
}

static void print_default(const struct key *key)
{
    if (key->required) {
        printf("required");
    } else if (key->unset != NULL) {
        printf("%s", key->unset);
    } else if (key->kind == VALUE_TEXT) {
        printf("%s", key->text);
    } else if (key->kind == VALUE_CHOICE) {
        printf("%s", word_at(key->choices, (int)key->initial));
    } else if (key->kind == VALUE_PROFILE) {
        printf("none");
    } else {
        printf("%.10g", key->initial);
    }
}

static void print_section(const struct section *section, const char *app)
{
    printf("### [%s]: %s\n\n", section->name, section->meaning);
    print_users(section, app);
    printf("| key | range | default | meaning |\n|---|---|---|---|\n");
    for (int i = 0; i < section->key_count; i++) {
        const struct key *key = &section->keys[i];

        printf("| `%s` | ", key->name);
        print_range(key);
        printf(" | ");
        print_default(key);
        printf(" | %s", key->meaning);
        if (key->kinds != NULL) {
            printf(" (kind %s)", key->kinds);
        }
        printf(" |\n");
    }
    putchar('\n');
}

/* The worlds that measure METRIC; all do what is read off the serial line. A static buffer. */
static const char *measurers(enum metric metric, const char *app)
{
    static char names[128];

    if (expect_kind(metric) > KIND_CHOICE) {
        return "all";
    }
    names[0] = '\0';
    for (int i = 0; world_at(i) != NULL; i++) {
        struct scenario scenario;
        struct outcome outcome;

        scenario_defaults(&scenario, world_at(i));
        scenario_measures(&scenario, &outcome);
        if (is_asked_for(world_at(i), app) && !isnan(outcome.values[metric])) {
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s",
                     names[0] == '\0' ? "" : ", ", world_at(i)->name);
        }
    }
    return names;
}

static const char *form(enum expect_kind kind)
{
    switch (kind) {
    case KIND_NUMBER:
        return "<= or >=";
    case KIND_COUNT:
        return "=, <= or >=";
    default:
        return "=";
    }
}

static void print_outcomes(const char *app)
{
    printf("### [expect]: the stated outcomes\n\n"
           "`impact = none` and `resets = 0` are judged also when the file does not state them.\n\n"
           "| outcome | write | unit | measured by | meaning |\n|---|---|---|---|---|\n");
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        const char *names = measurers(metric, app);

        if (names[0] != '\0') {
            printf("| `%s` | %s | %s | %s | %s |\n", expect_name(metric), form(expect_kind(metric)),
                   expect_unit(metric), names, expect_meaning(metric));
        }
    }
}

int keys_page_print(const char *app)
{
    if (app != NULL && world_find(app) == NULL) {
        diag_error(NULL, 0, "no app '%s'; the apps are: %s", app, world_names());
        return EXIT_USAGE;
    }
    for (int i = 0; world_at(i) != NULL; i++) {
        const struct world_class *world = world_at(i);

        for (int k = 0; is_asked_for(world, app) && k < world->section_count; k++) {
            if (!was_printed(world->sections[k].section, i, app)) {
                print_section(world->sections[k].section, app);
            }
        }
    }
    print_outcomes(app);
    return EXIT_FINE;
}
