/* SPDX-License-Identifier: MIT */
/* A sensor head on the controller's serial line: each trigger is answered by one frame, laid out as
 * firmware/frames/frame.h says, and what may be wrong with it. The bytes are made here a second
 * time, so that a misunderstanding of the layout shows. */
#ifndef FUZZY51_HEAD_H
#define FUZZY51_HEAD_H

#include "keys.h"
#include "random.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    HEAD_FAULTS = SECTION_COPIES,
    HEAD_PAYLOAD_MAX = 69,
    HEAD_LINE_MAX = 176,     /* two frames */
    HEAD_OLD = 3,            /* frames that a head repeats by turns */
    HEAD_AGE_MAX = 8,        /* frames */
    HEAD_GRACE_NS = 25000000 /* from a frame's first byte to its effect at a pin, at most */
};

/* What may be wrong with the frames of a sensor head. */
enum frame_fault_kind {
    FRAME_SILENCE,  /* no answer */
    FRAME_CORRUPT,  /* one to three bits are wrong */
    FRAME_TRUNCATE, /* the end is missing */
    FRAME_INSERT,   /* a byte too much */
    FRAME_RESYNC,   /* the beginning is missing */
    FRAME_REPEAT,   /* the last good frame again */
    FRAME_RANGE,    /* a value that cannot be, with a right check sum */
    FRAME_NOISE,    /* as many bytes, each of them random */
    FRAME_FROZEN,   /* the last good measurement again, with a fresh count */
    FRAME_OLD,      /* the last good frames by turns */
    FRAME_UNASKED,  /* the answer, and after every second answer another one at once: not bad */
};

/* Section [frame], [frame2], ... */
struct frame_fault {
    int kind;             /* enum frame_fault_kind, or -1: no fault */
    double from_s, for_s; /* unset for_s: to the end */
    double share;         /* of the frames, at random */
    double every, first;  /* or the first-th frame of that time and each every-th after it; unset
                             every: by share */
};

struct head_settings {
    struct {               /* section [head] */
        double warm_up;    /* frames answered before t = 0, so that the link is up by then */
        double delay_ms;   /* from a trigger to the answer */
        double dropout;    /* probability that a trigger gets no answer */
        double age_frames; /* of what is sent */
        double scale, speed_scale; /* factors on what it measures */
    } head;
    struct frame_fault faults[HEAD_FAULTS];
};

/* Section [noise] of a head that measures a car ahead: standard deviations. */
struct head_noise {
    double gap_m, own_mps, lead_mps, lead_mps2;
};

extern const struct section head_section, frame_section, head_noise_section;

/* For the section table of a world with a head: where its struct head_settings is, and which keys
 * of [head] have an effect (NULL: all). */
#define HEAD_SECTIONS(type, member, keys)                                                          \
    {.section = &head_section, AT_SETTINGS(type, member.head), .only = (keys)},                    \
    {                                                                                              \
        .section = &frame_section, AT_SETTINGS(type, member.faults), .copies = HEAD_FAULTS         \
    }

/* Makes one value of the payload impossible, whichever RANDOM picks. */
typedef void head_spoil_fn(struct random *random, uint8_t *payload);

/* A value of one or two bytes in a payload. */
struct head_value {
    int at, bytes;
    long value;
};

/* Puts one of COUNT values into the payload, whichever RANDOM picks. */
void head_spoil_one(struct random *random, uint8_t *payload, const struct head_value *values,
                    int count);

struct head {
    int kind; /* of frame.h */
    int payload_bytes;
    int64_t delay_ns; /* from the trigger's end to the first byte */
    double dropout, scale, speed_scale;
    struct frame_fault faults[HEAD_FAULTS];
    int answers[HEAD_FAULTS]; /* in the fault's time so far */
    struct random random;
    struct random noise; /* apart, so that noise does not change which frames are bad */
    head_spoil_fn *spoil;
    int64_t rise_ns;     /* of the trigger; INT64_MAX: it has not risen yet */
    int warm_left;       /* frames still to be answered before the world starts */
    bool started;        /* the world has: from now on frames may be bad */
    int count;           /* of the next frame */
    int64_t due_ns;      /* the answer's first byte; INT64_MAX: none is due */
    int64_t answered_ns; /* when the measurement of the last answer was made; 0: none was */
    uint8_t payload[HEAD_PAYLOAD_MAX];
    uint8_t aging[HEAD_AGE_MAX]
                 [HEAD_PAYLOAD_MAX]; /* measured, but not sent yet; the oldest first */
    int age_frames, aging_count;
    int number; /* of the measurement, 0..255 */
    /* the frames before, for a head that repeats itself */
    uint8_t last[HEAD_OLD][HEAD_LINE_MAX];
    size_t last_size;
    int last_at, old_at; /* the newest; the next one of FRAME_OLD */
    uint8_t last_payload[HEAD_PAYLOAD_MAX];
    int last_number;
    bool doubled;   /* another frame followed the last answer */
    int64_t bad_ns; /* the first of the bad answers in a row; INT64_MAX: the last one was good */
};

void head_init(struct head *head, const struct head_settings *settings, uint64_t seed, int kind,
               int payload_bytes, head_spoil_fn *spoil);

/* VALUE with noise of that standard deviation. */
double head_noisy(struct head *head, double value, double deviation);

/* The same on the head's scale. */
double head_distance(struct head *head, double value, double deviation);
double head_speed(struct head *head, double value, double deviation);

/* Whether the next trigger is to be the world's first: the link is up. */
bool head_is_warm(const struct head *head);

/* The world starts: from here on times count from 0 anew. */
void head_start(struct head *head);

/* The trigger pin goes to LEVEL at T_NS. Returns true when that ends a pulse that the head hears:
 * one of 10 us or more, while no answer is due. Then call head_measured. */
bool head_trigger(struct head *head, int64_t t_ns, bool level);

/* What the head has measured at the trigger that ended at T_NS. */
void head_measured(struct head *head, int64_t t_ns, const uint8_t *payload);

/* When the answer's first byte is due; INT64_MAX: none is. */
int64_t head_due_ns(const struct head *head);

/* The answer that is due at T_NS: puts its bytes into LINE and returns their number, 0 for none. */
size_t head_take(struct head *head, int64_t t_ns, uint8_t line[HEAD_LINE_MAX]);

/* From when on the controller can only know what it has known before: nothing but bad frames comes,
 * and the last good one has had its time to take effect. INT64_MAX: the last frame was good. */
int64_t head_blind_ns(const struct head *head);

/* Puts the bytes of one good frame into LINE and returns how many there are. NUMBER is the
 * measurement's, 0..255. */
size_t head_encode(int kind, int count, const uint8_t *payload, int payload_bytes, int number,
                   uint8_t line[HEAD_LINE_MAX]);

/* The whole number nearest to VALUE, in LOW..HIGH. */
long head_limited(double value, long low, long high);

/* Big-endian values into a payload. */
void head_put_16(uint8_t *at, long value);
void head_put_24(uint8_t *at, long value);

#endif
