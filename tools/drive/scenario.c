#include "scenario.h"

#include "diag.h"

#include <ctype.h>
#include <errno.h>
#include <ini.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 48 };

enum value_kind { VALUE_NUMBER, VALUE_CHOICE, VALUE_TEXT, VALUE_PROFILE };

/* One key: where its value goes and what it may be. */
struct key {
    const char *section, *name;
    enum value_kind kind;
    size_t offset; /* in struct scenario; of a [fault] key: in struct fault */
    double low, high;
    const char *choices; /* "one two three": the value is its index */
    unsigned faults;     /* of a [fault] key: bit k: belongs to kind k */
    bool required;
};

#define AT(member)       offsetof(struct scenario, member)
#define IN_FAULT(member) offsetof(struct fault, member)
#define FOR(kind)        (1u << FAULT_##kind)
#define ANY_FAULT        ((1u << FAULT_KINDS) - 1)

static const struct key keys[] = {
    {.section = "scenario",
     .name = "title",
     .kind = VALUE_TEXT,
     .offset = AT(title),
     .required = true},
    {"scenario", "duration_s", VALUE_NUMBER, AT(duration_s), 0.1, 3600, NULL, 0, true},
    {"scenario", "hold_s", VALUE_NUMBER, AT(hold_s), 0, 3600, NULL, 0, false},
    {"scenario", "event_s", VALUE_NUMBER, AT(event_s), 0, 3600, NULL, 0, false},
    {"scenario", "seed", VALUE_NUMBER, AT(seed), 0, 4294967295, NULL, 0, false},
    {"ego", "speed_mps", VALUE_NUMBER, AT(ego.speed_mps), 0, 60, NULL, 0, true},
    {"ego", "brake_max_mps2", VALUE_NUMBER, AT(ego.brake_max_mps2), 0.5, 20, NULL, 0, false},
    {"ego", "brake_lag_s", VALUE_NUMBER, AT(ego.brake_lag_s), 0.01, 2, NULL, 0, false},
    {"ego", "brake_dead_s", VALUE_NUMBER, AT(ego.brake_dead_s), 0, 1, NULL, 0, false},
    {"ego", "rolling_mps2", VALUE_NUMBER, AT(ego.rolling_mps2), 0, 2, NULL, 0, false},
    {"ego", "driver", VALUE_CHOICE, AT(ego.driver), 0, 0, "holds coasts", 0, false},
    {"ego", "driver_mps", VALUE_NUMBER, AT(ego.driver_mps), 0, 60, NULL, 0, false},
    {"ego", "driver_mps2", VALUE_NUMBER, AT(ego.driver_mps2), 0.1, 10, NULL, 0, false},
    {"lead", "gap_m", VALUE_NUMBER, AT(lead.gap_m), 0.01, 1000, NULL, 0, true},
    {"lead", "speed_mps", VALUE_NUMBER, AT(lead.speed_mps), 0, 60, NULL, 0, false},
    {"lead", "change_s", VALUE_NUMBER, AT(lead.change_s), 0, 3600, NULL, 0, false},
    {"lead", "change_mps2", VALUE_NUMBER, AT(lead.change_mps2), -20, 20, NULL, 0, false},
    {"lead", "change_to_mps", VALUE_NUMBER, AT(lead.change_to_mps), 0, 60, NULL, 0, false},
    {"lead", "profile", VALUE_PROFILE, AT(lead.profile), 0, 60, NULL, 0, false},
    {"lead", "appears_s", VALUE_NUMBER, AT(lead.appears_s), 0, 3600, NULL, 0, false},
    {"lead", "leaves_s", VALUE_NUMBER, AT(lead.leaves_s), 0, 3600, NULL, 0, false},
    {"sensor", "noise_m", VALUE_NUMBER, AT(sensor.noise_m), 0, 1, NULL, 0, false},
    {"sensor", "dropout", VALUE_NUMBER, AT(sensor.dropout), 0, 1, NULL, 0, false},
    {"sensor", "step_m", VALUE_NUMBER, AT(sensor.step_m), 0, 1, NULL, 0, false},
    {"sensor", "temp_c", VALUE_NUMBER, AT(sensor.temp_c), -40, 60, NULL, 0, false},
    {"sensor", "min_m", VALUE_NUMBER, AT(sensor.min_m), 0, 1, NULL, 0, false},
    {"sensor", "max_m", VALUE_NUMBER, AT(sensor.max_m), 0.5, 6, NULL, 0, false},
    {"sensor", "delay_us", VALUE_NUMBER, AT(sensor.delay_us), 450, 2000, NULL, 0, false},
    {"sensor", "no_echo_us", VALUE_NUMBER, AT(sensor.no_echo_us), 20000, 60000, NULL, 0, false},
    {"sensor", "no_target", VALUE_CHOICE, AT(sensor.no_target), 0, 0, "pulse silent high", 0,
     false},
    {"fault", "kind", VALUE_CHOICE, IN_FAULT(kind), 0, 0,
     "off stuck garbage wrong slow delayed intermittent glitch high", ANY_FAULT, true},
    {"fault", "from_s", VALUE_NUMBER, IN_FAULT(from_s), 0, 3600, NULL, ANY_FAULT, true},
    {"fault", "for_s", VALUE_NUMBER, IN_FAULT(for_s), 0.001, 3600, NULL, ANY_FAULT & ~FOR(GLITCH),
     false},
    {"fault", "line", VALUE_CHOICE, IN_FAULT(line), 0, 0, "low high", FOR(OFF) | FOR(INTERMITTENT),
     false},
    {"fault", "dist_m", VALUE_NUMBER, IN_FAULT(dist_m), 0.01, 6, NULL, FOR(STUCK) | FOR(GLITCH),
     false},
    {"fault", "readings", VALUE_NUMBER, IN_FAULT(readings), 1, 1000, NULL, FOR(GLITCH), false},
    {"fault", "scale", VALUE_NUMBER, IN_FAULT(scale), 0.1, 10, NULL, FOR(WRONG), false},
    {"fault", "offset_m", VALUE_NUMBER, IN_FAULT(offset_m), -5, 5, NULL, FOR(WRONG), false},
    {"fault", "period_s", VALUE_NUMBER, IN_FAULT(period_s), 0.01, 10, NULL, FOR(SLOW), true},
    {"fault", "delay_s", VALUE_NUMBER, IN_FAULT(delay_s), 0.001, 10, NULL, FOR(DELAYED), true},
    {"fault", "on_s", VALUE_NUMBER, IN_FAULT(on_s), 0.001, 100, NULL, FOR(INTERMITTENT), true},
    {"fault", "off_s", VALUE_NUMBER, IN_FAULT(off_s), 0.001, 100, NULL, FOR(INTERMITTENT), true},
    {"override", "from_s", VALUE_NUMBER, AT(override.from_s), 0, 3600, NULL, 0, true},
    {"override", "for_s", VALUE_NUMBER, AT(override.for_s), 0.001, 3600, NULL, 0, true},
    {"uart", "at_s", VALUE_NUMBER, AT(uart.at_s), 0, 3600, NULL, 0, true},
    {"uart", "send", VALUE_TEXT, AT(uart.send), 0, 0, NULL, 0, true},
};
enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

static const char *const fault_sections[SCENARIO_FAULTS] = {"fault", "fault2", "fault3", "fault4"};

struct reader {
    struct scenario *scenario;
    const char *place; /* the file, or "--set" */
    FILE *stream;
    int line;
    int faults_found;
    int given[SCENARIO_FAULTS][KEY_COUNT]; /* the line of each key; 0: not given */
    int expect_line;
    bool setting; /* a value from the command line replaces the file's */
};

static int complain(struct reader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static int complain(struct reader *reader, const char *format, ...)
{
    char what[512];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    diag_error(reader->place, reader->line, "%s", what);
    reader->faults_found++;
    return 0;
}

/* --- values ------------------------------------------------------------------------------- */

static bool parse_number(const char *text, double *number)
{
    char *end;

    errno = 0;
    *number = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*number);
}

/* Index of WORD in a list of words separated by blanks, or -1. */
static int choice_index(const char *choices, const char *word)
{
    int index = 0;

    for (const char *at = choices; *at != '\0'; index++) {
        size_t length = strcspn(at, " ");

        if (strlen(word) == length && strncmp(at, word, length) == 0)
            return index;
        at += length;
        at += strspn(at, " ");
    }
    return -1;
}

/* "0:2, 1.5:2, 2:0": seconds and metres a second. */
static int set_profile(struct reader *reader, const char *text)
{
    struct lead *lead = &reader->scenario->lead;
    char copy[512], *rest = copy, *item;

    snprintf(copy, sizeof copy, "%s", text);
    lead->points = 0;
    while ((item = strsep(&rest, ",")) != NULL) {
        struct point point;
        int used = 0;

        if (lead->points == SCENARIO_POINTS)
            return complain(reader, "the profile has more than %d points; leave some out",
                            SCENARIO_POINTS);
        if (sscanf(item, "%lf :%lf %n", &point.t_s, &point.speed_mps, &used) != 2 ||
            item[used] != '\0')
            return complain(reader,
                            "'%s' is no point of a profile; write seconds:metres_a_second,"
                            " as in 0:2, 1.5:2, 2:0",
                            item);
        if (point.t_s < 0 || !(point.speed_mps >= 0 && point.speed_mps <= 60) ||
            (lead->points > 0 && point.t_s <= lead->profile[lead->points - 1].t_s))
            return complain(reader,
                            "the profile's point '%s': times rise from 0 on, speeds lie in"
                            " 0..60",
                            item);
        lead->profile[lead->points++] = point;
    }
    return 1;
}

static int set_value(struct reader *reader, const struct key *key, char *target, const char *value)
{
    double number;
    int choice;

    switch (key->kind) {
    case VALUE_NUMBER:
        if (!parse_number(value, &number))
            return complain(reader, "'%s' is no number; give %s a value in %g..%g", value,
                            key->name, key->low, key->high);
        if (number < key->low || number > key->high)
            return complain(reader, "%s = %s is out of range; give it a value in %g..%g", key->name,
                            value, key->low, key->high);
        memcpy(target, &number, sizeof number);
        return 1;
    case VALUE_CHOICE:
        choice = choice_index(key->choices, value);
        if (choice < 0)
            return complain(reader, "%s = '%s' is unknown; use one of: %s", key->name, value,
                            key->choices);
        memcpy(target, &choice, sizeof choice);
        return 1;
    case VALUE_TEXT:
        if (value[0] == '\0' || strlen(value) >= SCENARIO_TEXT)
            return complain(reader, "%s wants 1 to %d characters", key->name, SCENARIO_TEXT - 1);
        strcpy(target, value);
        return 1;
    case VALUE_PROFILE:
        return set_profile(reader, value);
    }
    return 0;
}

/* --- [expect] ----------------------------------------------------------------------------- */

static void list_metrics(char *text, size_t size)
{
    text[0] = '\0';
    for (enum metric metric = 0; metric < METRIC_COUNT; metric++)
        snprintf(text + strlen(text), size - strlen(text), " %s", expect_name(metric));
}

/* inih splits "min_gap_m >= 0.5" at the equals sign, so the name arrives as "min_gap_m >". */
static int set_expectation(struct reader *reader, const char *name, const char *value)
{
    struct scenario *scenario = reader->scenario;
    struct expectation wanted = {.line = reader->line, .op = '='};
    char bare[NAME_SIZE], known[700];
    size_t length = strlen(name);
    enum expect_kind kind;

    if (length > 0 && strchr("<>", name[length - 1]) != NULL)
        wanted.op = name[--length];
    while (length > 0 && name[length - 1] == ' ')
        length--;
    snprintf(bare, sizeof bare, "%.*s", (int)length, name);
    wanted.metric = expect_find(bare);
    if (wanted.metric == METRIC_COUNT) {
        list_metrics(known, sizeof known);
        return complain(reader, "nothing measures '%s'; use one of:%s", bare, known);
    }
    if (scenario->expect_count == EXPECT_MAX)
        return complain(reader, "more than %d outcomes; leave some out", EXPECT_MAX);
    if (value[0] == '\0' || strlen(value) >= sizeof wanted.text)
        return complain(reader, "%s wants 1 to %zu characters", bare, sizeof wanted.text - 1);
    strcpy(wanted.text, value);
    kind = expect_kind(wanted.metric);
    if (kind == KIND_NUMBER || kind == KIND_COUNT) {
        if (!parse_number(value, &wanted.limit))
            return complain(reader, "'%s' is no number; write %s <= NUMBER or >= NUMBER", value,
                            bare);
        if (kind == KIND_NUMBER && wanted.op == '=')
            return complain(reader, "%s is measured, not counted; write %s <= %s or >= %s", bare,
                            bare, value, value);
    } else if (wanted.op != '=') {
        return complain(reader, "%s is no number; write %s = %s", bare, bare, value);
    }
    if (wanted.metric == METRIC_IMPACT && choice_index("none any", value) < 0)
        return complain(reader, "impact = '%s' is unknown; use one of: none any", value);
    scenario->expect[scenario->expect_count++] = wanted;
    return 1;
}

/* --- sections and keys -------------------------------------------------------------------- */

/* "fault3" -> 2; any other section -> 0, with its own name left as it is. */
static int fault_number(const char **section)
{
    for (int i = 0; i < SCENARIO_FAULTS; i++)
        if (strcmp(*section, fault_sections[i]) == 0) {
            *section = "fault";
            return i;
        }
    return 0;
}

static bool known_section(const char *section)
{
    for (int i = 0; i < KEY_COUNT; i++)
        if (strcmp(keys[i].section, section) == 0)
            return true;
    return false;
}

static void check_section(struct reader *reader, const char *section)
{
    fault_number(&section);
    if (!known_section(section) && strcmp(section, "expect") != 0)
        complain(reader,
                 "no section [%s]; the sections are: scenario ego lead sensor fault fault2"
                 " fault3 fault4 override uart expect",
                 section);
}

static int unknown_key(struct reader *reader, const char *section, const char *name)
{
    char known[512] = "";

    if (section[0] == '\0')
        return complain(reader, "'%s' stands before the first section; put [scenario] above it",
                        name);
    if (!known_section(section)) { /* a line of the file was complained about at its section */
        if (reader->setting)
            check_section(reader, section);
        return 0;
    }
    for (int i = 0; i < KEY_COUNT; i++)
        if (strcmp(keys[i].section, section) == 0)
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s", keys[i].name);
    return complain(reader, "no key '%s' in [%s]; its keys are:%s", name, section, known);
}

static int take_value(void *user, const char *section, const char *name, const char *value)
{
    struct reader *reader = user;
    struct scenario *scenario = reader->scenario;
    int fault, i = 0;
    char *target;

    if (strcmp(section, "expect") == 0)
        return set_expectation(reader, name, value);
    fault = fault_number(&section);
    while (i < KEY_COUNT &&
           (strcmp(keys[i].section, section) != 0 || strcmp(keys[i].name, name) != 0))
        i++;
    if (i == KEY_COUNT)
        return unknown_key(reader, section, name);
    if (reader->given[fault][i] != 0 && !reader->setting)
        return complain(reader, "%s stands here and in line %d; keep one", name,
                        reader->given[fault][i]);
    reader->given[fault][i] = reader->line > 0 ? reader->line : 1;
    if (strcmp(section, "lead") == 0)
        scenario->lead.present = true;
    target = keys[i].faults != 0 ? (char *)&scenario->faults[fault] : (char *)scenario;
    return set_value(reader, &keys[i], target + keys[i].offset, value);
}

/* --- what only the whole shows ------------------------------------------------------------- */

static void check_required(struct reader *reader)
{
    for (int fault = 0; fault < SCENARIO_FAULTS; fault++)
        for (int i = 0; i < KEY_COUNT; i++) {
            const struct key *key = &keys[i];
            const struct scenario *scenario = reader->scenario;
            bool section_used =
                strcmp(key->section, "scenario") == 0 || strcmp(key->section, "ego") == 0;

            if (fault > 0 && key->faults == 0)
                continue;
            for (int other = 0; other < KEY_COUNT; other++)
                if (strcmp(keys[other].section, key->section) == 0 &&
                    reader->given[fault][other] != 0)
                    section_used = true;
            if (key->faults != 0 && strcmp(key->name, "kind") != 0 &&
                (scenario->faults[fault].kind < 0 ||
                 (key->faults >> scenario->faults[fault].kind & 1) == 0))
                section_used = false;
            if (key->required && section_used && reader->given[fault][i] == 0)
                complain(reader, "[%s] lacks %s; add it",
                         key->faults != 0 ? fault_sections[fault] : key->section, key->name);
        }
}

static void check_fault_keys(struct reader *reader)
{
    for (int fault = 0; fault < SCENARIO_FAULTS; fault++) {
        int kind = reader->scenario->faults[fault].kind;

        for (int i = 0; i < KEY_COUNT && kind >= 0; i++)
            if (keys[i].faults != 0 && reader->given[fault][i] != 0 &&
                (keys[i].faults >> kind & 1) == 0) {
                reader->line = reader->given[fault][i];
                complain(reader, "a fault of this kind has no %s; take it out", keys[i].name);
            }
    }
    reader->line = 0;
}

static bool was_given(const struct reader *reader, const char *section, const char *name)
{
    for (int i = 0; i < KEY_COUNT; i++)
        if (strcmp(keys[i].section, section) == 0 && strcmp(keys[i].name, name) == 0)
            return reader->given[0][i] != 0;
    return false;
}

static void check_whole(struct reader *reader)
{
    struct scenario *scenario = reader->scenario;
    struct lead *lead = &scenario->lead;
    int changes = was_given(reader, "lead", "change_s") + was_given(reader, "lead", "change_mps2") +
                  was_given(reader, "lead", "change_to_mps");

    reader->line = 0;
    check_required(reader);
    check_fault_keys(reader);
    for (int i = 0; i < SCENARIO_FAULTS; i++)
        if (scenario->faults[i].kind == FAULT_GLITCH && scenario->faults[i].dist_m < 0)
            complain(reader, "[%s] lacks dist_m; add it", fault_sections[i]);
    if (changes != 0 && changes != 3)
        complain(reader,
                 "[lead] change_s, change_mps2 and change_to_mps go together; give all three");
    if (lead->points > 0 && (changes > 0 || was_given(reader, "lead", "speed_mps")))
        complain(reader, "[lead] has a profile and other speeds; keep one of the two");
    if (lead->appears_s >= 0 && lead->leaves_s >= 0 && lead->leaves_s <= lead->appears_s)
        complain(reader, "[lead] leaves_s comes before appears_s; exchange them");
    if (scenario->sensor.min_m >= scenario->sensor.max_m)
        complain(reader, "[sensor] min_m is not below max_m");
    if (scenario->expect_count == 0)
        complain(reader, "[expect] states no outcome; say at least impact = none or impact = any");
}

/* --- reading ------------------------------------------------------------------------------ */

/* A line for inih: counted, and without leading blanks, which would join it to the line before. */
static char *next_line(char *text, int size, void *stream)
{
    struct reader *reader = stream;
    char section[NAME_SIZE];
    size_t length;

    if (fgets(text, size, reader->stream) == NULL)
        return NULL;
    reader->line++;
    length = strlen(text);
    if (length == (size_t)size - 1 && text[length - 1] != '\n') {
        int c;

        complain(reader, "line of more than %d characters; shorten it", size - 2);
        while ((c = fgetc(reader->stream)) != '\n' && c != EOF)
            ;
        text[0] = '\0';
    }
    memmove(text, text + strspn(text, " \t"), strlen(text + strspn(text, " \t")) + 1);
    if (sscanf(text, "[%47[^]]]", section) == 1)
        check_section(reader, section);
    return text;
}

static void set_defaults(struct scenario *scenario, const char *file)
{
    memset(scenario, 0, sizeof *scenario);
    snprintf(scenario->file, sizeof scenario->file, "%s", file);
    scenario->hold_s = SCENARIO_UNSET;
    scenario->seed = 1;
    scenario->ego = (struct ego){.brake_max_mps2 = 8,
                                 .brake_lag_s = 0.2,
                                 .brake_dead_s = 0.05,
                                 .rolling_mps2 = 0.15,
                                 .driver_mps = SCENARIO_UNSET,
                                 .driver_mps2 = 2};
    scenario->lead.appears_s = scenario->lead.leaves_s = SCENARIO_UNSET;
    scenario->lead.change_s = SCENARIO_UNSET;
    scenario->sensor = (struct sensor){
        .temp_c = 20, .min_m = 0.02, .max_m = 5, .delay_us = 450, .no_echo_us = 38000};
    for (int i = 0; i < SCENARIO_FAULTS; i++)
        scenario->faults[i] = (struct fault){.kind = -1,
                                             .for_s = SCENARIO_UNSET,
                                             .dist_m = SCENARIO_UNSET,
                                             .scale = 1,
                                             .readings = 1};
    scenario->override.from_s = SCENARIO_UNSET;
    scenario->uart.at_s = SCENARIO_UNSET;
}

static void apply_setting(struct reader *reader, const char *setting)
{
    char section[NAME_SIZE], name[NAME_SIZE], value[SCENARIO_TEXT];

    if (sscanf(setting, "%47[a-z0-9].%47[a-z0-9_<> ]=%127[^\n]", section, name, value) != 3) {
        complain(reader, "'%s': write section.key=value, as in ego.speed_mps=4", setting);
        return;
    }
    take_value(reader, section, name, value);
}

int scenario_read(struct scenario *scenario, const char *file, char *const *settings, int count)
{
    struct reader reader = {.scenario = scenario, .place = file};
    int bad_line;

    set_defaults(scenario, file);
    reader.stream = fopen(file, "r");
    if (reader.stream == NULL)
        return diag_error(file, 0, "cannot read the scenario: %s", strerror(errno));
    bad_line = ini_parse_stream(next_line, &reader, take_value, &reader);
    fclose(reader.stream);
    if (bad_line > 0 && reader.faults_found == 0) {
        reader.line = bad_line;
        complain(&reader, "neither [section] nor key = value nor ; comment");
    }
    reader.setting = true;
    reader.line = 0;
    reader.place = "--set";
    for (int i = 0; i < count; i++)
        apply_setting(&reader, settings[i]);
    reader.place = file;
    if (reader.faults_found == 0)
        check_whole(&reader);
    return reader.faults_found == 0 ? EXIT_FINE : EXIT_INPUT;
}
