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

enum { NAME_SIZE = 48, MIN_RADIUS_M = 31 };

enum value_kind { VALUE_NUMBER, VALUE_COUNT, VALUE_CHOICE, VALUE_TEXT, VALUE_PROFILE, VALUE_APP };

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
#define IN_FRAME(member) offsetof(struct frame_fault, member)
#define FOR(kind)        (1u << FAULT_##kind)
#define ANY_FAULT        ((1u << FAULT_KINDS) - 1)

static const struct key keys[] = {
    {.section = "scenario",
     .name = "title",
     .kind = VALUE_TEXT,
     .offset = AT(title),
     .required = true},
    {"scenario", "app", VALUE_APP, AT(app), 0, 0, NULL, 0, false},
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
    {"lead", "lane", VALUE_NUMBER, AT(lead.lane), -3, 3, NULL, 0, false},
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
    {"road", "radius_m", VALUE_NUMBER, AT(road.radius_m), -10000, 10000, NULL, 0, true},
    {"road", "lane_m", VALUE_NUMBER, AT(road.lane_m), 2, 6, NULL, 0, false},
    {"front", "range_noise_m", VALUE_NUMBER, AT(front.range_noise_m), 0, 10, NULL, 0, false},
    {"front", "closing_noise_mps", VALUE_NUMBER, AT(front.closing_noise_mps), 0, 5, NULL, 0, false},
    {"front", "azimuth_noise_deg", VALUE_NUMBER, AT(front.azimuth_noise_deg), 0, 5, NULL, 0, false},
    {"front", "dropout", VALUE_NUMBER, AT(front.dropout), 0, 1, NULL, 0, false},
    {"front", "max_m", VALUE_NUMBER, AT(front.max_m), 1, 500, NULL, 0, false},
    {"front", "fov_deg", VALUE_NUMBER, AT(front.fov_deg), 1, 44, NULL, 0, false},
    {"front", "beats", VALUE_CHOICE, AT(front.beats), 0, 0, "signed unsigned", 0, false},
    {"park", "x_m", VALUE_NUMBER, AT(park.x_m), -39, 39, NULL, 0, true},
    {"park", "y_m", VALUE_NUMBER, AT(park.y_m), 0.1, 39, NULL, 0, true},
    {"park", "heading_deg", VALUE_NUMBER, AT(park.heading_deg), -360, 360, NULL, 0, true},
    {"park", "speed_mps", VALUE_NUMBER, AT(park.speed_mps), 0.1, 10, NULL, 0, false},
    {"park", "length_m", VALUE_NUMBER, AT(park.length_m), 1, 10, NULL, 0, false},
    {"park", "steer_deg", VALUE_NUMBER, AT(park.steer_deg), 1, 80, NULL, 0, false},
    {"lane", "lead_mps", VALUE_NUMBER, AT(lane.lead_mps), 0, 2, NULL, 0, true},
    {"head", "warm_up", VALUE_NUMBER, AT(head.warm_up), 0, 100, NULL, 0, false},
    {"head", "delay_ms", VALUE_NUMBER, AT(head.delay_ms), 0.5, 80, NULL, 0, false},
    {"frame", "kind", VALUE_CHOICE, IN_FRAME(kind), 0, 0,
     "silence corrupt truncate insert resync repeat range noise", ANY_FAULT, true},
    {"frame", "from_s", VALUE_NUMBER, IN_FRAME(from_s), 0, 3600, NULL, ANY_FAULT, true},
    {"frame", "for_s", VALUE_NUMBER, IN_FRAME(for_s), 0.001, 3600, NULL, ANY_FAULT, false},
    {"frame", "share", VALUE_NUMBER, IN_FRAME(share), 0, 1, NULL, ANY_FAULT, false},
    {"frame", "every", VALUE_COUNT, IN_FRAME(every), 1, 10000, NULL, ANY_FAULT, false},
    {"frame", "first", VALUE_COUNT, IN_FRAME(first), 1, 10000, NULL, ANY_FAULT, false},
    {"uart", "at_s", VALUE_NUMBER, AT(uart.at_s), 0, 3600, NULL, 0, true},
    {"uart", "send", VALUE_TEXT, AT(uart.send), 0, 0, NULL, 0, true},
};
enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

/* Sections that may stand there several times: [fault], [fault2], and so on. */
static const char *const numbered[] = {"fault", "frame"};
enum { NUMBERED_COUNT = sizeof numbered / sizeof numbered[0] };

/* Controllers by name, the sections that each of them has beside [scenario] and [expect], and those
 * of them that must be there. */
static const struct {
    const char *name, *sections, *needed;
} worlds[WORLD_KINDS] = {
    {"brake", "ego lead sensor fault override uart", "ego"},
    {"radar", "ego lead road front head frame", "ego"},
    {"gap", "ego lead head frame", "ego"},
    {"follow", "ego lead lane head frame", "ego lead"},
    {"park", "park head frame", "park"},
};

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
    char what[1400];
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

        if (strlen(word) == length && strncmp(at, word, length) == 0) {
            return index;
        }
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

        if (lead->points == SCENARIO_POINTS) {
            return complain(reader, "the profile has more than %d points; leave some out",
                            SCENARIO_POINTS);
        }
        if (sscanf(item, "%lf :%lf %n", &point.t_s, &point.speed_mps, &used) != 2 ||
            item[used] != '\0') {
            return complain(reader,
                            "'%s' is no point of a profile; write seconds:metres_a_second,"
                            " as in 0:2, 1.5:2, 2:0",
                            item);
        }
        if (point.t_s < 0 || !(point.speed_mps >= 0 && point.speed_mps <= 60) ||
            (lead->points > 0 && point.t_s <= lead->profile[lead->points - 1].t_s)) {
            return complain(reader,
                            "the profile's point '%s': times rise from 0 on, speeds lie in"
                            " 0..60",
                            item);
        }
        lead->profile[lead->points++] = point;
    }
    return 1;
}

/* "radar" or "radar_mom": the controller, and possibly which variant of its image. */
static int set_app(struct reader *reader, const char *name)
{
    size_t length = strcspn(name, "_");
    char known[128] = "";

    for (int world = 0; world < WORLD_KINDS; world++) {
        if (strlen(worlds[world].name) == length &&
            strncmp(worlds[world].name, name, length) == 0 &&
            strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") == strlen(name) &&
            strlen(name) < NAME_SIZE) {
            strcpy(reader->scenario->app, name);
            reader->scenario->world = world;
            return 1;
        }
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", worlds[world].name);
    }
    return complain(reader, "no app '%s'; write one of:%s, or one of them, _ and a variant", name,
                    known);
}

static int set_value(struct reader *reader, const struct key *key, char *target, const char *value)
{
    double number;
    int choice;

    switch (key->kind) {
    case VALUE_NUMBER:
    case VALUE_COUNT:
        if (!parse_number(value, &number)) {
            return complain(reader, "'%s' is no number; give %s a value in %g..%g", value,
                            key->name, key->low, key->high);
        }
        if (number < key->low || number > key->high) {
            return complain(reader, "%s = %s is out of range; give it a value in %g..%g", key->name,
                            value, key->low, key->high);
        }
        if (key->kind == VALUE_COUNT && number > floor(number)) {
            return complain(reader, "%s = %s counts frames; give it a whole number", key->name,
                            value);
        }
        memcpy(target, &number, sizeof number);
        return 1;
    case VALUE_CHOICE:
        choice = choice_index(key->choices, value);
        if (choice < 0) {
            return complain(reader, "%s = '%s' is unknown; use one of: %s", key->name, value,
                            key->choices);
        }
        memcpy(target, &choice, sizeof choice);
        return 1;
    case VALUE_TEXT:
        if (value[0] == '\0' || strlen(value) >= SCENARIO_TEXT) {
            return complain(reader, "%s wants 1 to %d characters", key->name, SCENARIO_TEXT - 1);
        }
        strcpy(target, value);
        return 1;
    case VALUE_PROFILE:
        return set_profile(reader, value);
    case VALUE_APP:
        return set_app(reader, value);
    }
    return 0;
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
    if (wanted.metric == METRIC_IMPACT && choice_index("none any", value) < 0) {
        return complain(reader, "impact = '%s' is unknown; use one of: none any", value);
    }
    if (wanted.metric == METRIC_PARKED && choice_index("yes no", value) < 0) {
        return complain(reader, "parked = '%s' is unknown; use one of: yes no", value);
    }
    scenario->expect[scenario->expect_count++] = wanted;
    return 1;
}

/* --- sections and keys -------------------------------------------------------------------- */

/* "fault3" -> 2, with the name cut to "fault"; any other section -> 0. */
static int section_number(const char **section)
{
    for (int k = 0; k < NUMBERED_COUNT; k++) {
        size_t length = strlen(numbered[k]);
        const char *digit = *section + length;

        if (strncmp(*section, numbered[k], length) == 0 && *digit >= '2' &&
            *digit < '1' + SCENARIO_FAULTS && digit[1] == '\0') {
            *section = numbered[k];
            return *digit - '1';
        }
    }
    return 0;
}

static bool is_numbered(const char *section)
{
    for (int k = 0; k < NUMBERED_COUNT; k++) {
        if (strcmp(section, numbered[k]) == 0) {
            return true;
        }
    }
    return false;
}

static bool known_section(const char *section)
{
    for (int i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0) {
            return true;
        }
    }
    return false;
}

static void check_section(struct reader *reader, const char *section)
{
    const char *bare = section;
    char known[256] = "";

    section_number(&bare);
    if (known_section(bare) || strcmp(section, "expect") == 0) {
        return;
    }
    for (int i = 0; i < KEY_COUNT; i++) {
        if (i == 0 || strcmp(keys[i].section, keys[i - 1].section) != 0) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s%s", keys[i].section,
                     is_numbered(keys[i].section) ? " (also with 2, 3 or 4)" : "");
        }
    }
    complain(reader, "no section [%s]; the sections are:%s expect", section, known);
}

static int unknown_key(struct reader *reader, const char *section, const char *name)
{
    char known[512] = "";

    if (section[0] == '\0') {
        return complain(reader, "'%s' stands before the first section; put [scenario] above it",
                        name);
    }
    if (!known_section(section)) { /* a line of the file was complained about at its section */
        if (reader->setting) {
            check_section(reader, section);
        }
        return 0;
    }
    for (int i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0) {
            snprintf(known + strlen(known), sizeof known - strlen(known), " %s", keys[i].name);
        }
    }
    return complain(reader, "no key '%s' in [%s]; its keys are:%s", name, section, known);
}

static int take_value(void *user, const char *section, const char *name, const char *value)
{
    struct reader *reader = user;
    struct scenario *scenario = reader->scenario;
    int fault, i = 0;
    char *target;

    if (strcmp(section, "expect") == 0) {
        return set_expectation(reader, name, value);
    }
    fault = section_number(&section);
    while (i < KEY_COUNT &&
           (strcmp(keys[i].section, section) != 0 || strcmp(keys[i].name, name) != 0)) {
        i++;
    }
    if (i == KEY_COUNT) {
        return unknown_key(reader, section, name);
    }
    if (reader->given[fault][i] != 0 && !reader->setting) {
        return complain(reader, "%s stands here and in line %d; keep one", name,
                        reader->given[fault][i]);
    }
    reader->given[fault][i] = reader->line > 0 ? reader->line : 1;
    if (strcmp(section, "lead") == 0) {
        scenario->lead.present = true;
    }
    target = strcmp(section, "fault") == 0   ? (char *)&scenario->faults[fault]
             : strcmp(section, "frame") == 0 ? (char *)&scenario->frames[fault]
                                             : (char *)scenario;
    return set_value(reader, &keys[i], target + keys[i].offset, value);
}

/* --- what only the whole shows ------------------------------------------------------------- */

/* "fault" and 2 -> "fault3" */
static const char *section_name(const struct key *key, int number)
{
    static char name[NAME_SIZE];

    if (number == 0) {
        return key->section;
    }
    snprintf(name, sizeof name, "%s%d", key->section, number + 1);
    return name;
}

static bool is_used(const struct reader *reader, const char *section, int number)
{
    if (strcmp(section, "scenario") == 0 ||
        choice_index(worlds[reader->scenario->world].needed, section) >= 0) {
        return true;
    }
    for (int i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0 && reader->given[number][i] != 0) {
            return true;
        }
    }
    return false;
}

/* A key that only some kinds of fault have, and not the one of the section. */
static bool is_foreign(const struct reader *reader, const struct key *key, int number)
{
    int kind = reader->scenario->faults[number].kind;

    return strcmp(key->section, "fault") == 0 && strcmp(key->name, "kind") != 0 &&
           (kind < 0 || (key->faults >> kind & 1) == 0);
}

static void check_required(struct reader *reader)
{
    for (int number = 0; number < SCENARIO_FAULTS; number++) {
        for (int i = 0; i < KEY_COUNT; i++) {
            const struct key *key = &keys[i];

            if ((number == 0 || is_numbered(key->section)) && key->required &&
                is_used(reader, key->section, number) && !is_foreign(reader, key, number) &&
                reader->given[number][i] == 0) {
                complain(reader, "[%s] lacks %s; add it", section_name(key, number), key->name);
            }
        }
    }
}

static void check_fault_keys(struct reader *reader)
{
    for (int number = 0; number < SCENARIO_FAULTS; number++) {
        for (int i = 0; i < KEY_COUNT; i++) {
            if (reader->given[number][i] != 0 && reader->scenario->faults[number].kind >= 0 &&
                is_foreign(reader, &keys[i], number)) {
                reader->line = reader->given[number][i];
                complain(reader, "a fault of this kind has no %s; take it out", keys[i].name);
            }
        }
    }
    reader->line = 0;
}

/* Sections that belong to another controller; each is named once. */
static void check_sections(struct reader *reader)
{
    const char *sections = worlds[reader->scenario->world].sections;
    const char *last = "";

    for (int i = 0; i < KEY_COUNT; i++) {
        for (int number = 0; number < SCENARIO_FAULTS; number++) {
            const char *section = keys[i].section;

            if (reader->given[number][i] == 0 || strcmp(section, "scenario") == 0 ||
                strcmp(section, last) == 0 || choice_index(sections, section) >= 0) {
                continue;
            }
            reader->line = reader->given[number][i];
            complain(reader, "app %s has no [%s]; its sections are: scenario %s expect",
                     reader->scenario->app, section, sections);
            last = section;
        }
    }
    reader->line = 0;
}

/* The line in which a key stands; 0: it was not given. */
static int line_of(const struct reader *reader, const char *section, int number, const char *name)
{
    for (int i = 0; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].section, section) == 0 && strcmp(keys[i].name, name) == 0) {
            return reader->given[number][i];
        }
    }
    return 0;
}

static bool was_given(const struct reader *reader, const char *section, const char *name)
{
    return line_of(reader, section, 0, name) != 0;
}

/* Frames are bad at random or by schedule, not both. */
static void check_schedules(struct reader *reader)
{
    for (int number = 0; number < SCENARIO_FAULTS; number++) {
        int share = line_of(reader, "frame", number, "share");
        int every = line_of(reader, "frame", number, "every");
        int first = line_of(reader, "frame", number, "first");

        reader->line = every;
        if (share != 0 && every != 0) {
            complain(reader,
                     "frames are bad by every or by share, which stands in line %d; keep one",
                     share);
        }
        reader->line = first;
        if (first != 0 && every == 0) {
            complain(reader, "first says where every begins to count; add every, or take it out");
        }
    }
    reader->line = 0;
}

static void check_whole(struct reader *reader)
{
    struct scenario *scenario = reader->scenario;
    struct lead *lead = &scenario->lead;
    int changes = was_given(reader, "lead", "change_s") + was_given(reader, "lead", "change_mps2") +
                  was_given(reader, "lead", "change_to_mps");

    reader->line = 0;
    check_sections(reader);
    check_required(reader);
    check_fault_keys(reader);
    check_schedules(reader);
    for (int i = 0; i < SCENARIO_FAULTS; i++) {
        if (scenario->faults[i].kind == FAULT_GLITCH && scenario->faults[i].dist_m < 0) {
            complain(reader, "[%s] lacks dist_m; add it",
                     section_name(&(struct key){.section = "fault"}, i));
        }
    }
    if (changes != 0 && changes != 3) {
        complain(reader,
                 "[lead] change_s, change_mps2 and change_to_mps go together; give all three");
    }
    if (lead->points > 0 && (changes > 0 || was_given(reader, "lead", "speed_mps"))) {
        complain(reader, "[lead] has a profile and other speeds; keep one of the two");
    }
    if (lead->appears_s >= 0 && lead->leaves_s >= 0 && lead->leaves_s <= lead->appears_s) {
        complain(reader, "[lead] leaves_s comes before appears_s; exchange them");
    }
    if (fabs(scenario->road.radius_m) > 0 && fabs(scenario->road.radius_m) < MIN_RADIUS_M) {
        complain(reader, "[road] radius_m is below %d m, for which no frame has a curvature",
                 MIN_RADIUS_M);
    }
    if (scenario->sensor.min_m >= scenario->sensor.max_m) {
        complain(reader, "[sensor] min_m is not below max_m");
    }
    if (scenario->expect_count == 0) {
        complain(reader, "[expect] states no outcome; say at least impact = none or impact = any");
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

        complain(reader, "line of more than %d characters; shorten it", size - 2);
        while ((c = fgetc(reader->stream)) != '\n' && c != EOF)
            ;
        text[0] = '\0';
    }
    memmove(text, text + strspn(text, " \t"), strlen(text + strspn(text, " \t")) + 1);
    if (sscanf(text, "[%47[^]]]", section) == 1) {
        check_section(reader, section);
    }
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
    scenario->road.lane_m = 3.75;
    scenario->lane.lead_mps = SCENARIO_UNSET;
    scenario->front.max_m = 300;
    scenario->front.fov_deg = 30;
    scenario->park = (struct parking){.speed_mps = 5, .length_m = 4, .steer_deg = 45};
    for (int i = 0; i < SCENARIO_FAULTS; i++) {
        scenario->faults[i] = (struct fault){.kind = -1,
                                             .for_s = SCENARIO_UNSET,
                                             .dist_m = SCENARIO_UNSET,
                                             .scale = 1,
                                             .readings = 1};
        scenario->frames[i] = (struct frame_fault){
            .kind = -1, .for_s = SCENARIO_UNSET, .share = 1, .every = SCENARIO_UNSET, .first = 1};
    }
    strcpy(scenario->app, "brake");
    scenario->head.warm_up = 5;
    scenario->head.delay_ms = 2;
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
    if (reader.stream == NULL) {
        return diag_error(file, 0, "cannot read the scenario: %s", strerror(errno));
    }
    errno = 0;
    bad_line = ini_parse_stream(next_line, &reader, take_value, &reader);
    if (ferror(reader.stream)) {
        fclose(reader.stream);
        return diag_error(file, 0, "cannot read the scenario: %s", strerror(errno));
    }
    fclose(reader.stream);
    if (bad_line > 0 && reader.faults_found == 0) {
        reader.line = bad_line;
        complain(&reader, "neither [section] nor key = value nor ; comment");
    }
    reader.setting = true;
    reader.line = 0;
    reader.place = "--set";
    for (int i = 0; i < count; i++) {
        apply_setting(&reader, settings[i]);
    }
    reader.place = file;
    if (reader.faults_found == 0) {
        check_whole(&reader);
    }
    return reader.faults_found == 0 ? EXIT_FINE : EXIT_INPUT;
}
