/* SPDX-License-Identifier: MIT */
#include "head.h"

#include <math.h>
#include <string.h>

enum { GROUP = 7, PULSE_NS = 10000 };

/* --- good frames -------------------------------------------------------------------------- */

void head_put_16(uint8_t *at, long value)
{
    at[0] = (uint8_t)((unsigned long)value >> 8);
    at[1] = (uint8_t)value;
}

void head_put_24(uint8_t *at, long value)
{
    at[0] = (uint8_t)((unsigned long)value >> 16);
    head_put_16(at + 1, value);
}

long head_limited(double value, long low, long high)
{
    return value <= (double)low ? low : value >= (double)high ? high : lround(value);
}

double head_noisy(struct head *head, double value, double deviation)
{
    return value + deviation * random_normal(&head->noise);
}

double head_distance(struct head *head, double value, double deviation)
{
    return head_noisy(head, value * head->scale, deviation);
}

double head_speed(struct head *head, double value, double deviation)
{
    return head_noisy(head, value * head->speed_scale, deviation);
}

/* CRC-16/CCITT-FALSE, bit by bit. */
static unsigned crc16(unsigned crc, uint8_t byte)
{
    for (int bit = 7; bit >= 0; bit--) {
        unsigned carry = (crc >> 15 ^ (unsigned)byte >> bit) & 1;

        crc = (crc << 1 & 0xFFFF) ^ (carry ? 0x1021u : 0);
    }
    return crc;
}

size_t head_encode(int kind, int count, const uint8_t *payload, int payload_bytes, int number,
                   uint8_t line[HEAD_LINE_MAX])
{
    uint8_t body[HEAD_PAYLOAD_MAX + 3];
    int body_bytes = payload_bytes + 3;
    uint8_t start = (uint8_t)(0x80 | kind << 4 | count);
    unsigned crc = crc16(0xFFFF, start);
    size_t size = 0;

    memcpy(body, payload, (size_t)payload_bytes);
    body[payload_bytes] = (uint8_t)number;
    for (int i = 0; i <= payload_bytes; i++) {
        crc = crc16(crc, body[i]);
    }
    head_put_16(body + payload_bytes + 1, (long)crc);

    line[size++] = start;
    for (int group = 0; group < body_bytes; group += GROUP) {
        size_t top_bits = size++;

        line[top_bits] = 0;
        for (int i = 0; i < GROUP && group + i < body_bytes; i++) {
            line[top_bits] = (uint8_t)(line[top_bits] | body[group + i] >> 7 << i);
            line[size++] = body[group + i] & 0x7F;
        }
    }
    return size;
}

/* --- bad frames --------------------------------------------------------------------------- */

/* Whether a fault whose time it is strikes the answer that is its COUNT-th. */
static bool strikes(struct head *head, const struct frame_fault *fault, int count)
{
    int past = count - (int)fault->first;

    if (fault->every < 0) {
        return random_uniform(&head->random) < fault->share;
    }
    return past >= 0 && past % (int)fault->every == 0;
}

/* The fault that this answer suffers, or NULL: the first of those that strike it. */
static const struct frame_fault *fault_now(struct head *head, int64_t t_ns)
{
    const struct frame_fault *found = NULL;
    double t_s = (double)t_ns * 1e-9;

    if (!head->started) {
        return NULL;
    }
    for (int i = 0; i < HEAD_FAULTS; i++) {
        const struct frame_fault *fault = &head->faults[i];

        if (fault->kind < 0 || t_s < fault->from_s ||
            (fault->for_s >= 0 && t_s >= fault->from_s + fault->for_s)) {
            continue;
        }
        head->answers[i]++;
        if (found == NULL && strikes(head, fault, head->answers[i])) {
            found = fault;
        }
    }
    return found;
}

static size_t pick(struct head *head, size_t count)
{
    return (size_t)(random_uniform(&head->random) * (double)count);
}

static uint8_t any_byte(struct head *head)
{
    return (uint8_t)pick(head, 256);
}

static size_t insert(uint8_t *line, size_t size, size_t at, uint8_t byte)
{
    memmove(line + at + 1, line + at, size - at);
    line[at] = byte;
    return size + 1;
}

/* One to three different bits turn over. */
static void corrupt(struct head *head, uint8_t *line, size_t size)
{
    uint8_t good[HEAD_LINE_MAX];

    memcpy(good, line, size);
    do {
        for (size_t flips = 1 + pick(head, 3); flips > 0; flips--) {
            line[pick(head, size)] ^= (uint8_t)(1u << pick(head, 8));
        }
    } while (memcmp(good, line, size) == 0);
}

void head_spoil_one(struct random *random, uint8_t *payload, const struct head_value *values,
                    int count)
{
    const struct head_value *one = &values[(int)(random_uniform(random) * count)];

    if (one->bytes == 2) {
        head_put_16(payload + one->at, one->value);
    } else {
        payload[one->at] = (uint8_t)one->value;
    }
}

/* Spoils the good frame of SIZE bytes in LINE. Returns how many bytes are to be sent. */
static size_t spoil(struct head *head, enum frame_fault_kind kind, uint8_t *line, size_t size)
{
    uint8_t payload[HEAD_PAYLOAD_MAX];
    uint8_t byte;
    size_t from;

    switch (kind) {
    case FRAME_CORRUPT:
        corrupt(head, line, size);
        return size;
    case FRAME_TRUNCATE:
        return pick(head, size);
    case FRAME_INSERT:
        do {
            byte = any_byte(head);
        } while (byte == line[0]); /* that would begin the whole frame anew */
        return insert(line, size, 1 + pick(head, size - 1), byte);
    case FRAME_RESYNC: /* the line is heard from the middle of the frame on */
        from = 1 + pick(head, size - 1);
        memmove(line, line + from, size - from);
        return size - from;
    case FRAME_REPEAT:
        memcpy(line, head->last[head->last_at], head->last_size);
        return head->last_size;
    case FRAME_OLD: /* from the oldest one on */
        head->old_at = (head->old_at + 1) % HEAD_OLD;
        memcpy(line, head->last[head->old_at], head->last_size);
        return head->last_size;
    case FRAME_FROZEN:
        return head_encode(head->kind, head->count, head->last_payload, head->payload_bytes,
                           head->last_number, line);
    case FRAME_RANGE:
        memcpy(payload, head->payload, sizeof payload);
        head->spoil(&head->random, payload);
        return head_encode(head->kind, head->count, payload, head->payload_bytes, head->number,
                           line);
    case FRAME_NOISE:
        for (size_t i = 0; i < size; i++) {
            line[i] = any_byte(head);
        }
        return size;
    default: /* FRAME_SILENCE */
        return 0;
    }
}

/* --- outside ------------------------------------------------------------------------------ */

void head_init(struct head *head, const struct head_settings *settings, uint64_t seed, int kind,
               int payload_bytes, head_spoil_fn *spoil_payload)
{
    memset(head, 0, sizeof *head);
    head->kind = kind;
    head->payload_bytes = payload_bytes;
    head->delay_ns = (int64_t)llround(settings->head.delay_ms * 1e6);
    head->warm_left = (int)settings->head.warm_up;
    head->dropout = settings->head.dropout;
    head->age_frames = (int)settings->head.age_frames;
    head->scale = settings->head.scale;
    head->speed_scale = settings->head.speed_scale;
    memcpy(head->faults, settings->faults, sizeof head->faults);
    random_seed(&head->random, seed ^ 0x46524D45u);
    random_seed(&head->noise, seed ^ 0x4E4F4953u);
    head->spoil = spoil_payload;
    head->due_ns = head->bad_ns = head->rise_ns = INT64_MAX;
}

bool head_is_warm(const struct head *head)
{
    return head->warm_left == 0;
}

void head_start(struct head *head)
{
    head->started = true;
    head->answered_ns = 0;
    head->due_ns = head->bad_ns = head->rise_ns = INT64_MAX;
}

bool head_trigger(struct head *head, int64_t t_ns, bool level)
{
    bool is_pulse = !level && t_ns - head->rise_ns >= PULSE_NS;

    head->rise_ns = level ? t_ns : INT64_MAX;
    return is_pulse && head->due_ns == INT64_MAX;
}

/* The payload to send: PAYLOAD, or what was measured age_frames before; at first the oldest that
 * there is. */
static void grow_old(struct head *head, const uint8_t *payload)
{
    size_t size = sizeof head->aging[0];

    memcpy(head->payload, head->aging_count > 0 ? head->aging[0] : payload,
           (size_t)head->payload_bytes);
    if (head->aging_count == head->age_frames) {
        memmove(head->aging, head->aging + 1, sizeof head->aging - size);
        head->aging_count -= head->aging_count > 0;
    }
    if (head->aging_count < head->age_frames) {
        memcpy(head->aging[head->aging_count++], payload, (size_t)head->payload_bytes);
    }
}

void head_measured(struct head *head, int64_t t_ns, const uint8_t *payload)
{
    grow_old(head, payload);
    head->number = (head->number + 1) % 256;
    head->due_ns = t_ns + head->delay_ns;
}

int64_t head_due_ns(const struct head *head)
{
    return head->due_ns;
}

static size_t encode_answer(const struct head *head, uint8_t *line)
{
    return head_encode(head->kind, head->count, head->payload, head->payload_bytes, head->number,
                       line);
}

/* A good frame, for faults that send it again. */
static void remember(struct head *head, const uint8_t *line, size_t size)
{
    head->last_at = (head->last_at + 1) % HEAD_OLD;
    head->old_at = head->last_at;
    memcpy(head->last[head->last_at], line, size);
    head->last_size = size;
    memcpy(head->last_payload, head->payload, sizeof head->last_payload);
    head->last_number = head->number;
}

static const struct frame_fault dropped = {.kind = FRAME_SILENCE};

static bool is_dropped(struct head *head)
{
    return head->started && head->dropout > 0 && random_uniform(&head->random) < head->dropout;
}

size_t head_take(struct head *head, int64_t t_ns, uint8_t line[HEAD_LINE_MAX])
{
    const struct frame_fault *fault;
    size_t size;

    if (t_ns < head->due_ns) {
        return 0;
    }
    size = encode_answer(head, line);
    fault = fault_now(head, head->due_ns);
    if (fault == NULL && is_dropped(head)) {
        fault = &dropped;
    }
    if (fault == NULL || fault->kind == FRAME_UNASKED) {
        remember(head, line, size);
        head->bad_ns = INT64_MAX;
    } else {
        size = spoil(head, (enum frame_fault_kind)fault->kind, line, size);
        if (head->bad_ns == INT64_MAX) {
            head->bad_ns = head->due_ns;
        }
    }
    head->doubled = fault != NULL && fault->kind == FRAME_UNASKED && !head->doubled;
    if (head->doubled) {
        head->count = (head->count + 1) % 16;
        head->number = (head->number + 1) % 256;
        size += encode_answer(head, line + size);
    }
    head->count = (head->count + 1) % 16;
    if (head->warm_left > 0) {
        head->warm_left--;
    }
    head->answered_ns = head->due_ns - head->delay_ns;
    head->due_ns = INT64_MAX;
    return size;
}

int64_t head_blind_ns(const struct head *head)
{
    return head->bad_ns == INT64_MAX ? INT64_MAX : head->bad_ns + HEAD_GRACE_NS;
}
