/* SPDX-License-Identifier: MIT */
#include "list.h"

#include "diag.h"
#include "scenario.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int is_scenario(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');

    return dot != NULL && dot != entry->d_name && strcmp(dot, ".scn") == 0;
}

static int list_one(const char *folder, const char *name)
{
    struct scenario scenario;
    char path[sizeof scenario.file], expected[128];

    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (scenario_read(&scenario, path, NULL, 0) != EXIT_FINE) {
        return EXIT_INPUT;
    }
    printf("%-32.*s %s:", (int)(strrchr(name, '.') - name), name, scenario.title);
    for (int i = 0; i < scenario.expect_count; i++) {
        expect_format(&scenario.expect[i], expected, sizeof expected);
        printf("%s %s", i > 0 ? "," : "", expected);
    }
    putchar('\n');
    return EXIT_FINE;
}

int list_scenarios(const char *folder)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_scenario, alphasort), status = EXIT_FINE;

    if (count < 0) {
        return diag_error(folder, 0, "cannot be read: %s; name a folder of scenarios",
                          strerror(errno));
    }
    if (count == 0) {
        status = diag_error(folder, 0, "holds no scenario (.scn)");
    }
    for (int i = 0; i < count; i++) {
        if (list_one(folder, entries[i]->d_name) != EXIT_FINE) {
            status = EXIT_INPUT;
        }
        free(entries[i]);
    }
    free(entries);
    return status;
}
