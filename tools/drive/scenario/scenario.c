/* SPDX-License-Identifier: MIT */
#include "scenario.h"

#include "diag.h"
#include "world.h"

#include <ctype.h>
#include <errno.h>
#include <ini.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 48, SECTIONS_MAX = 16 };

/* The file is read twice: first only for its app, which says what sections it may have. */
struct reader {
    struct scenario *scenario;
    const char *file;
    const char *place; /* of what is read now: the file, or "--set" */
    FILE *stream;      /* NULL: there is no file, only settings */
    int line;
    int faults_found;
    int given[SECTIONS_MAX][SECTION_COPIES_MAX][KEYS_MAX]; /* the line of each key; 0: not given */
    bool only_app;                                         /* the first reading */
    bool setting; /* a value from the command line replaces the file's */
};

static int complain(struct reader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static int complain(struct reader *reader, const char *format, ...)
{
    char what[1400];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    diag_error(reader->place, reader->line, "%s", what);
    reader->faults_found++;
    return 0;
}

/* --- words -------------------------------------------------------------------------------- */

int word_index(const char *words, const char *word)
{
    int index = 0;

    for (const char *at = words; *at != '\0'; index++) {
        size_t length = strcspn(at, " ");

        if (strlen(word) == length && strncmp(at, word, length) == 0) {
            return index;
        }
        at += length;
        at += strspn(at, " ");
    }
    return -1;
}

const char *word_at(const char *words, int index)
{
    static char word[NAME_SIZE];

    while (index-- > 0) {
        words += strcspn(words, " ");
        words += strspn(words, " ");
    }
    snprintf(word, sizeof word, "%.*s", (int)strcspn(words, " "), words);
    return word;
}

/* --- values ------------------------------------------------------------------------------- */

static bool parse_number(const char *text, double *number)
{
    char *end;

    errno = 0;
    *number = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*number);
}

static int set_number(struct reader *reader, const struct key *key, double *target,
                      const char *value)
{
    double number;

    if (!parse_number(value, &number)) {
        return complain(reader, "'%s' is no number; give %s a value in %.10g..%.10g", value,
                        key->name, key->low, key->high);
    }
    if (number < key->low || number > key->high) {
        return complain(reader, "%s = %s is out of range; give it a value in %.10g..%.10g",
                        key->name, value, key->low, key->high);
    }
    if (key->kind == VALUE_COUNT && number > floor(number)) {
        return complain(reader, "%s = %s is no whole number; give it one", key->name, value);
    }
    *target = number;
    return 1;
}

/* "0:2, 1.5:2, 2:0": seconds and metres a second. */
static int set_profile(struct reader *reader, const struct key *key, struct profile *profile,
                       const char *text)
{
    char copy[512], *rest = copy, *item;

    snprintf(copy, sizeof copy, "%s", text);
    profile->count = 0;
    while ((item = strsep(&rest, ",")) != NULL) {
        double t_s, speed_mps, last_s = -1;
        int used = 0;

        if (profile->count == PROFILE_POINTS) {
            return complain(reader, "the profile has more than %d points; leave some out",
                            PROFILE_POINTS);
        }
        if (sscanf(item, "%lf :%lf %n", &t_s, &speed_mps, &used) != 2 || item[used] != '\0') {
            return complain(reader,
                            "'%s' is no point of a profile; write seconds:metres_a_second,"
                            " as in 0:2, 1.5:2, 2:0",
                            item);
        }
        if (profile->count > 0) {
            last_s = profile->points[profile->count - 1].t_s;
        }
        if (!(t_s >= 0 && t_s > last_s && speed_mps >= key->low && speed_mps <= key->high)) {
            return complain(reader,
                            "the profile's point '%s': times rise from 0 on, speeds lie in %g..%g",
                            item, key->low, key->high);
        }
        profile->points[profile->count].t_s = t_s;
        profile->points[profile->count++].speed_mps = speed_mps;
    }
    return 1;
}

static int set_value(struct reader *reader, const struct key *key, void *target, const char *value)
{
    int choice;

    switch (key->kind) {
    case VALUE_NUMBER:
    case VALUE_COUNT:
        return set_number(reader, key, target, value);
    case VALUE_CHOICE:
        choice = word_index(key->choices, value);
        if (choice < 0) {
            return complain(reader, "%s = '%s' is unknown; use one of: %s", key->name, value,
                            key->choices);
        }
        *(int *)target = choice;
        return 1;
    case VALUE_TEXT:
        if (value[0] == '\0' || strlen(value) >= SCENARIO_TEXT) {
            return complain(reader, "%s wants 1 to %d characters", key->name, SCENARIO_TEXT - 1);
        }
        strcpy(target, value);
        return 1;
    case VALUE_PROFILE:
        return set_profile(reader, key, target, value);
    }
    return 0;
}

void section_defaults(const struct section *section, void *values)
{
    for (int i = 0; i < section->key_count; i++) {
        const struct key *key = &section->keys[i];
        void *target = (char *)values + key->at;

        if (key->kind == VALUE_TEXT) {
            snprintf(target, SCENARIO_TEXT, "%s", key->text);
        } else if (key->kind == VALUE_CHOICE) {
            *(int *)target = (int)key->initial;
        } else if (key->kind != VALUE_PROFILE) {
            *(double *)target = key->initial;
        }
    }
}

/* --- [expect] ----------------------------------------------------------------------------- */

static void list_metrics(char *text, size_t size)
{
    text[0] = '\0';
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++) {
        snprintf(text + strlen(text), size - strlen(text), " %s", expect_name(metric));
    }
}

/* inih splits "min_gap_m >= 0.5" at the equals sign, so the name arrives as "min_gap_m >". */
static int set_expectation(struct reader *reader, const char *name, const char *value)
{
    struct scenario *scenario = reader->scenario;
    struct expectation wanted = {.line = reader->line, .op = '='};
    char bare[NAME_SIZE], known[1200];
    size_t length = strlen(name);
    enum expect_kind kind;

    if (length > 0 && strchr("<>", name[length - 1]) != NULL) {
        wanted.op = name[--length];
    }
    while (length > 0 && isspace((unsigned char)name[length - 1])) {
        length--;
    }
    snprintf(bare, sizeof bare, "%.*s", (int)length, name);
    wanted.metric = expect_find(bare);
    if (wanted.metric == METRIC_COUNT) {
        list_metrics(known, sizeof known);
        return complain(reader, "nothing measures '%s'; use one of:%s", bare, known);
    }
    if (scenario->expect_count == EXPECT_MAX) {
        return complain(reader, "more than %d outcomes; leave some out", EXPECT_MAX);
    }
    if (value[0] == '\0' || strlen(value) >= sizeof wanted.text) {
        return complain(reader, "%s wants 1 to %zu characters", bare, sizeof wanted.text - 1);
    }
    strcpy(wanted.text, value);
    kind = expect_kind(wanted.metric);
    if (kind == KIND_NUMBER || kind == KIND_COUNT) {
        if (!parse_number(value, &wanted.limit)) {
            return complain(reader, "'%s' is no number; write %s <= NUMBER or >= NUMBER", value,
                            bare);
        }
        if (kind == KIND_NUMBER && wanted.op == '=') {
            return complain(reader, "%s is measured, not counted; write %s <= %s or >= %s", bare,
                            bare, value, value);
        }
    } else if (wanted.op != '=') {
        return complain(reader, "%s is no number; write %s = %s", bare, bare, value);
    }
    if (wanted.metric == METRIC_IMPACT && word_index("none any", value) < 0) {
        return complain(reader, "impact = '%s' is unknown; use one of: none any", value);
    }
    if (wanted.metric == METRIC_PARKED && word_index("yes no", value) < 0) {
        return complain(reader, "parked = '%s' is unknown; use one of: yes no", value);
    }
    scenario->expect[scenario->expect_count++] = wanted;
    return 1;
}

/* --- sections and keys -------------------------------------------------------------------- */

static const struct section_use *use_at(const struct reader *reader, int index)
{
    return &reader->scenario->world->sections[index];
}

static int copies_of(const struct section_use *use)
{
    return use->copies > 1 ? use->copies : 1;
}

static void *values_of(const struct reader *reader, int index, int copy)
{
    const struct section_use *use = use_at(reader, index);

    return (char *)reader->scenario + use->at + (size_t)copy * use->section->size;
}

/* Finds "fault3": the index of [fault] among the world's sections, and 2. Returns -1 for a section
 * that the world does not have. */
static int find_section(const struct reader *reader, const char *name, int *copy)
{
    for (int i = 0; i < reader->scenario->world->section_count; i++) {
        const struct section_use *use = use_at(reader, i);
        size_t length = strlen(use->section->name);
        const char *digit = name + length;

        if (strncmp(name, use->section->name, length) != 0) {
            continue;
        }
        *copy = *digit == '\0' ? 0 : *digit - '1';
        if (*digit == '\0' || (*copy >= 1 && *copy < copies_of(use) && digit[1] == '\0')) {
            return i;
        }
    }
    return -1;
}

/* "fault" and 2 -> "fault3"; a static buffer. */
static const char *section_name(const struct section_use *use, int copy)
{
    static char name[NAME_SIZE];

    if (copy == 0) {
        return use->section->name;
    }
    snprintf(name, sizeof name, "%s%d", use->section->name, copy + 1);
    return name;
}

/* Whether this key of the section does something in the scenario's world. */
static bool has_effect(const struct section_use *use, const struct key *key)
{
    return use->only == NULL || word_index(use->only, key->name) >= 0;
}

static void check_section(struct reader *reader, const char *section)
{
    char known[256] = "";
    int copy;

    if (strcmp(section, "expect") == 0 || find_section(reader, section, &copy) >= 0) {
        return;
    }
    for (int i = 0; i < reader->scenario->world->section_count; i++) {
        const struct section_use *use = use_at(reader, i);

        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", use->section->name);
        if (copies_of(use) > 1) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " (also %s2%s%s)",
                     use->section->name, copies_of(use) > 2 ? " to " : "",
                     copies_of(use) > 2 ? section_name(use, copies_of(use) - 1) : "");
        }
    }
    complain(reader, "app %s has no section [%s]; its sections are:%s expect",
             reader->scenario->app, section, known);
}

static int unknown_key(struct reader *reader, const struct section_use *use, const char *name)
{
    char known[512] = "";

    for (int i = 0; i < use->section->key_count; i++) {
        const struct key *key = &use->section->keys[i];

        if (has_effect(use, key)) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s", key->name);
        } else if (strcmp(key->name, name) == 0) {
            return complain(reader, "%s of [%s] has no effect with app %s; take it out", name,
                            use->section->name, reader->scenario->app);
        }
    }
    return complain(reader, "no key '%s' in [%s]; its keys are:%s", name, use->section->name,
                    known);
}

static int take_value(void *user, const char *section, const char *name, const char *value)
{
    struct reader *reader = user;
    const struct section_use *use;
    const struct key *key;
    int copy, index, i = 0, *line;

    if (strcmp(section, "expect") == 0) {
        return set_expectation(reader, name, value);
    }
    if (section[0] == '\0') {
        return complain(reader, "'%s' stands before the first section; put [scenario] above it",
                        name);
    }
    index = find_section(reader, section, &copy);
    if (index < 0) { /* the file was complained about at the section's own line */
        if (reader->setting) {
            check_section(reader, section);
        }
        return 0;
    }
    use = use_at(reader, index);
    while (i < use->section->key_count && strcmp(use->section->keys[i].name, name) != 0) {
        i++;
    }
    key = &use->section->keys[i];
    if (i == use->section->key_count || !has_effect(use, key)) {
        return unknown_key(reader, use, name);
    }
    line = &reader->given[index][copy][i];
    if (*line != 0 && !reader->setting) {
        return complain(reader, "%s stands here and in line %d; keep one", name, *line);
    }
    *line = reader->line > 0 ? reader->line : 1;
    return set_value(reader, key, (char *)values_of(reader, index, copy) + key->at, value);
}

/* --- what only the whole shows ------------------------------------------------------------- */

struct section_check {
    struct reader *reader;
    int index, copy; /* the section, among the world's */
};

int section_line(const struct section_check *check, const char *name)
{
    const struct section *section = use_at(check->reader, check->index)->section;

    for (int i = 0; i < section->key_count; i++) {
        if (strcmp(section->keys[i].name, name) == 0) {
            return check->reader->given[check->index][check->copy][i];
        }
    }
    return 0;
}

const void *section_values(const struct section_check *check, const char *name)
{
    int copy, index = find_section(check->reader, name, &copy);

    if (index < 0) {
        abort(); /* a fault of the section's table */
    }
    return values_of(check->reader, index, 0);
}

void section_complain(struct section_check *check, const char *name, const char *format, ...)
{
    struct reader *reader = check->reader;
    char what[512];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    reader->line = name != NULL ? section_line(check, name) : 0;
    complain(reader, "[%s] %s", section_name(use_at(reader, check->index), check->copy), what);
    reader->line = 0;
}

static bool is_given(const struct section_check *check)
{
    for (int i = 0; i < KEYS_MAX; i++) {
        if (check->reader->given[check->index][check->copy][i] != 0) {
            return true;
        }
    }
    return false;
}

/* The word that the section's key `kind` has; NULL: it has no such key, or no value. */
static const char *kind_of(const struct section *section, const void *values)
{
    for (int i = 0; i < section->key_count; i++) {
        const struct key *key = &section->keys[i];

        if (strcmp(key->name, "kind") == 0) {
            int kind = *(const int *)(const void *)((const char *)values + key->at);

            return kind < 0 ? NULL : word_at(key->choices, kind);
        }
    }
    return NULL;
}

static void check_keys(struct section_check *check, const void *values)
{
    const struct section_use *use = use_at(check->reader, check->index);
    const char *kind = kind_of(use->section, values);

    for (int i = 0; i < use->section->key_count; i++) {
        const struct key *key = &use->section->keys[i];
        bool belongs = key->kinds == NULL || (kind != NULL && word_index(key->kinds, kind) >= 0);
        bool given = section_line(check, key->name) != 0;

        if (belongs && key->required && has_effect(use, key) && !given) {
            complain(check->reader, "[%s] lacks %s; add it", section_name(use, check->copy),
                     key->name);
        }
        if (!belongs && kind != NULL && given) {
            section_complain(check, key->name, "of kind %s has no %s; take it out", kind,
                             key->name);
        }
    }
}

/* A metric that this world does not measure would never hold. */
static void check_metrics(struct reader *reader)
{
    const struct scenario *scenario = reader->scenario;
    struct outcome outcome;
    enum metric metric;
    char known[1200] = "";

    scenario_measures(scenario, &outcome);
    for (metric = 0; metric < METRIC_COUNT; metric++) {
        if (!isnan(outcome.values[metric])) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s",
                     expect_name(metric));
        }
    }
    for (int i = 0; i < scenario->expect_count; i++) {
        reader->line = scenario->expect[i].line;
        metric = scenario->expect[i].metric;
        if (expect_kind(metric) <= KIND_CHOICE && isnan(outcome.values[metric])) {
            complain(reader, "app %s does not measure %s; it measures:%s", scenario->app,
                     expect_name(metric), known);
        }
    }
    reader->line = 0;
}

static void check_whole(struct reader *reader)
{
    struct scenario *scenario = reader->scenario;

    reader->line = 0;
    for (int index = 0; index < scenario->world->section_count; index++) {
        const struct section_use *use = use_at(reader, index);

        for (int copy = 0; copy < copies_of(use); copy++) {
            struct section_check check = {reader, index, copy};
            const void *values = values_of(reader, index, copy);

            if (!is_given(&check) && !(use->required && copy == 0)) {
                continue;
            }
            check_keys(&check, values);
            if (use->section->check != NULL) {
                use->section->check(&check, values);
            }
            if (use->section == &lead_section) {
                ((struct lead *)values_of(reader, index, copy))->present = true;
            }
        }
    }
    if (scenario->expect_count == 0) {
        complain(reader, "[expect] states no outcome; say at least impact = none or impact = any");
    }
    if (reader->faults_found == 0) {
        check_metrics(reader);
    }
}

/* --- reading ------------------------------------------------------------------------------ */

/* A line for inih: counted, and without leading blanks, which would join it to the line before. */
static char *next_line(char *text, int size, void *stream)
{
    struct reader *reader = stream;
    char section[NAME_SIZE];
    size_t length;

    if (fgets(text, size, reader->stream) == NULL) {
        return NULL;
    }
    reader->line++;
    length = strlen(text);
    if (length == (size_t)size - 1 && text[length - 1] != '\n') {
        int c;

        if (!reader->only_app) {
            complain(reader, "line of more than %d characters; shorten it", size - 2);
        }
        while ((c = fgetc(reader->stream)) != '\n' && c != EOF)
            ;
        text[0] = '\0';
    }
    memmove(text, text + strspn(text, " \t"), strlen(text + strspn(text, " \t")) + 1);
    if (!reader->only_app && sscanf(text, "[%47[^]]]", section) == 1) {
        check_section(reader, section);
    }
    return text;
}

/* "radar" or "radar_mom" -> the radar's world: the controller, and possibly a variant of its image.
 */
static void find_world(struct reader *reader, const char *app)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789_";
    char controller[NAME_SIZE];

    snprintf(controller, sizeof controller, "%.*s", (int)strcspn(app, "_"), app);
    reader->scenario->world = NULL;
    if (strspn(app, letters) == strlen(app) && strlen(app) < NAME_SIZE) {
        reader->scenario->world = world_find(controller);
    }
    if (reader->scenario->world == NULL) {
        complain(reader, "no app '%s'; write one of: %s, or one of them, _ and a variant", app,
                 world_names());
    }
}

/* The first reading: for the app alone. */
static int take_app(void *user, const char *section, const char *name, const char *value)
{
    struct reader *reader = user;

    if (strcmp(section, "scenario") == 0 && strcmp(name, "app") == 0 && !reader->faults_found) {
        find_world(reader, value);
    }
    return 1;
}

static bool parse_setting(struct reader *reader, const char *setting, ini_handler take)
{
    char section[NAME_SIZE], name[NAME_SIZE], value[SCENARIO_TEXT];

    if (sscanf(setting, "%47[a-z0-9].%47[a-z0-9_<> ]=%127[^\n]", section, name, value) != 3) {
        return false;
    }
    take(reader, section, name, value);
    return true;
}

static void find_app(struct reader *reader, char *const *settings, int count)
{
    reader->only_app = true;
    if (reader->stream != NULL) {
        ini_parse_stream(next_line, reader, take_app, reader);
        rewind(reader->stream);
    }
    reader->line = 0;
    reader->place = "--set";
    for (int i = 0; i < count; i++) {
        parse_setting(reader, settings[i], take_app);
    }
    if (reader->faults_found == 0 && reader->scenario->world == NULL) {
        find_world(reader, "brake"); /* the file names none */
    }
    reader->place = reader->file;
    reader->only_app = false;
}

static void apply_settings(struct reader *reader, char *const *settings, int count)
{
    reader->setting = true;
    reader->line = 0;
    reader->place = "--set";
    for (int i = 0; i < count; i++) {
        if (!parse_setting(reader, settings[i], take_value)) {
            complain(reader, "'%s': write section.key=value, as in ego.speed_mps=4", settings[i]);
        }
    }
    reader->place = reader->file;
}

void scenario_defaults(struct scenario *scenario, const struct world_class *world)
{
    memset(scenario, 0, sizeof *scenario);
    scenario->world = world;
    scenario->uart.at_s = SCENARIO_UNSET; /* also of a world without that section */
    for (int i = 0; i < world->section_count; i++) {
        const struct section_use *use = &world->sections[i];

        for (int copy = 0; copy < copies_of(use); copy++) {
            section_defaults(use->section,
                             (char *)scenario + use->at + (size_t)copy * use->section->size);
        }
    }
}

void scenario_measures(const struct scenario *scenario, struct outcome *outcome)
{
    struct world *world = scenario->world->create(scenario, 0, WORLD_STEP_NS);

    outcome_clear(outcome);
    scenario->world->measure(world, 1, outcome);
    scenario->world->destroy(world);
}

/* The file's whole text, SIZE bytes of it, so that a pipe, too, can be read twice. Returns NULL
 * with errno set when it cannot be read. */
static char *read_text(const char *file, size_t *size)
{
    FILE *stream = fopen(file, "r"), *copy;
    char part[4096], *text = NULL;
    size_t got;

    if (stream == NULL) {
        return NULL;
    }
    copy = open_memstream(&text, size);
    if (copy == NULL) {
        abort();
    }
    while ((got = fread(part, 1, sizeof part, stream)) > 0) {
        fwrite(part, 1, got, copy);
    }
    fclose(copy);
    if (ferror(stream)) {
        free(text);
        text = NULL;
    }
    fclose(stream);
    return text;
}

static int read_stream(struct reader *reader, char *const *settings, int count)
{
    struct scenario *scenario = reader->scenario;
    int bad_line = 0;

    find_app(reader, settings, count);
    if (reader->faults_found > 0) {
        return EXIT_INPUT;
    }
    scenario_defaults(scenario, scenario->world);
    snprintf(scenario->file, sizeof scenario->file, "%s", reader->file);
    if (reader->stream != NULL) {
        bad_line = ini_parse_stream(next_line, reader, take_value, reader);
    }
    if (bad_line > 0 && reader->faults_found == 0) {
        reader->line = bad_line;
        complain(reader, "neither [section] nor key = value nor ; comment");
    }
    apply_settings(reader, settings, count);
    if (reader->faults_found == 0) {
        check_whole(reader);
    }
    return reader->faults_found == 0 ? EXIT_FINE : EXIT_INPUT;
}

int scenario_from(struct scenario *scenario, char *const *settings, int count)
{
    struct reader reader = {.scenario = scenario, .file = "--set", .place = "--set"};

    memset(scenario, 0, sizeof *scenario);
    return read_stream(&reader, settings, count);
}

int scenario_read(struct scenario *scenario, const char *file, char *const *settings, int count)
{
    struct reader reader = {.scenario = scenario, .file = file, .place = file};
    size_t size;
    char *text = read_text(file, &size);
    int status;

    memset(scenario, 0, sizeof *scenario);
    if (text == NULL) {
        return diag_error(file, 0, "cannot read the scenario: %s", strerror(errno));
    }
    reader.stream = fmemopen(text, size, "r");
    if (reader.stream == NULL) {
        abort();
    }
    status = read_stream(&reader, settings, count);
    fclose(reader.stream);
    free(text);
    return status;
}
