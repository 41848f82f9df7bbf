/* SPDX-License-Identifier: MIT */
#include "head.h"

#define AT(member)                                                                                 \
    offsetof(struct head_settings, head.member) - offsetof(struct head_settings, head)
static const struct key head_keys[] = {
    {.name = "warm_up",
     .meaning = "frames that are answered before the scenario starts",
     .kind = VALUE_COUNT,
     .at = AT(warm_up),
     .high = 100,
     .initial = 5},
    {.name = "delay_ms",
     .meaning = "from a trigger to the first byte of the answer",
     .at = AT(delay_ms),
     .low = 0.5,
     .high = 90,
     .initial = 2},
    {.name = "dropout",
     .meaning = "probability that a trigger gets no answer",
     .at = AT(dropout),
     .high = 1},
    {.name = "age_frames",
     .meaning = "its filter is late: what it sends was measured so many triggers ago",
     .kind = VALUE_COUNT,
     .at = AT(age_frames),
     .high = HEAD_AGE_MAX},
    {.name = "scale",
     .meaning = "factor on each distance that it measures",
     .at = AT(scale),
     .low = 0.5,
     .high = 2,
     .initial = 1},
    {.name = "speed_scale",
     .meaning = "factor on each speed that it measures",
     .at = AT(speed_scale),
     .low = 0.5,
     .high = 2,
     .initial = 1},
};
#undef AT

const struct section head_section = {.name = "head",
                                     .meaning = "the sensor head on the serial line",
                                     SECTION_KEYS(head_keys),
                                     .size = sizeof(((struct head_settings *)NULL)->head)};

#define AT(member) offsetof(struct frame_fault, member)
static const struct key frame_keys[] = {
    {.name = "kind",
     .meaning = "silence: no answer; corrupt: wrong bits; truncate: the end is missing; insert: a "
                "byte too much; resync: the beginning is missing; repeat: the last good frame "
                "again; range: an impossible value with a right check sum; noise: random bytes; "
                "frozen: the last good "
                "measurement with a fresh count; old: the last three good frames by turns; "
                "unasked: after every second answer another one at once",
     .kind = VALUE_CHOICE,
     .at = AT(kind),
     .choices = "silence corrupt truncate insert resync repeat range noise frozen old unasked",
     .initial = -1,
     .required = true},
    {.name = "from_s",
     .meaning = "when it begins",
     .at = AT(from_s),
     .high = 3600,
     .required = true},
    {.name = "for_s",
     .meaning = "how long it lasts",
     .at = AT(for_s),
     .low = 0.001,
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "to the end"},
    {.name = "share",
     .meaning = "share of the frames that are bad, at random",
     .at = AT(share),
     .high = 1,
     .initial = 1},
    {.name = "every",
     .meaning = "or: each frame of this number is bad, as in every = 4",
     .kind = VALUE_COUNT,
     .at = AT(every),
     .low = 1,
     .high = 10000,
     .initial = SCENARIO_UNSET,
     .unset = "by share"},
    {.name = "first",
     .meaning = "the first bad frame, with every",
     .kind = VALUE_COUNT,
     .at = AT(first),
     .low = 1,
     .high = 10000,
     .initial = 1},
};
#undef AT

/* Frames are bad at random or by schedule, not both. */
static void check_frame(struct section_check *check, const void *values)
{
    int share = section_line(check, "share");
    bool has_every = section_line(check, "every") != 0;

    (void)values;
    if (share != 0 && has_every) {
        section_complain(
            check, "every",
            "frames are bad by every or by share, which stands in line %d; keep one of the two",
            share);
    }
    if (!has_every && section_line(check, "first") != 0) {
        section_complain(check, "first",
                         "first says where every begins to count; add every, or take first out");
    }
}

const struct section frame_section = {.name = "frame",
                                      .meaning = "what is wrong with frames for a time",
                                      SECTION_KEYS(frame_keys),
                                      .size = sizeof(struct frame_fault),
                                      .check = check_frame};

#define AT(member) offsetof(struct head_noise, member)
static const struct key noise_keys[] = {
    {.name = "gap_m", .meaning = "standard deviation of the gap", .at = AT(gap_m), .high = 10},
    {.name = "own_mps",
     .meaning = "standard deviation of the own speed",
     .at = AT(own_mps),
     .high = 5},
    {.name = "lead_mps",
     .meaning = "standard deviation of the speed of the one ahead",
     .at = AT(lead_mps),
     .high = 5},
    {.name = "lead_mps2",
     .meaning = "standard deviation of the acceleration of the one ahead",
     .at = AT(lead_mps2),
     .high = 5},
};
#undef AT

const struct section head_noise_section = {.name = "noise",
                                           .meaning = "noise of what the head measures",
                                           SECTION_KEYS(noise_keys),
                                           .size = sizeof(struct head_noise)};
