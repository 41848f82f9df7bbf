/* SPDX-License-Identifier: MIT */
/* Receives frames, byte by byte. */
#include "frame.h"
#include "crc16.h"

#define START_BIT   0x80U
#define KIND_MASK   0xF0U /* and the start bit */
#define COUNT_MASK  0x0FU
#define COUNT_NONE  0xFFU
#define GROUP_BYTES 7
#define TAIL_BYTES  3 /* number of the measurement, check sum */
#define ITEMS_MASK  0x0FU
#define ITEMS_OPEN  0xFFU /* items_left until the byte that says it */

__idata uint8_t frame_body[FRAME_BODY_MAX_BYTES];

static __idata uint8_t start_and_kind; /* what the start byte must be, without its count */
static __idata uint8_t fixed_bytes;    /* of the payload, before its items */
static __idata uint8_t item_bytes;     /* of each item; 0: the payload has none */
static __idata uint8_t items_left;     /* still to come in this frame */
static __idata uint8_t part_end;       /* in frame_body: where the part that comes now will end */
static uint8_t filled;                 /* bytes in frame_body */
static uint8_t group_left; /* bytes still to come in this group; 0: the next byte is top bits */
static uint8_t top_bits;
static __idata uint8_t count;       /* of the frame that is being received */
static __idata uint8_t count_last;  /* of the last good one */
static __idata uint8_t number_last; /* of the measurement in the last good frame */
static __idata uint8_t asked;       /* frames asked for since the last good one */
static __idata uint8_t unanswered;  /* triggers since the last complete frame */
static __idata uint8_t slow;        /* frames in a row after an unanswered trigger */
static uint8_t crc_high, crc_low;
static bool inside;          /* a start byte came, the last byte of its frame did not */
static __idata uint16_t bad; /* frames */

/* Holds from frame_init on. */
/*@ predicate frame_is_valid =
        1 <= fixed_bytes <= FRAME_BODY_MAX_BYTES - TAIL_BYTES &&
        item_bytes <= FRAME_BODY_MAX_BYTES - fixed_bytes &&
        (items_left != 0 ==> item_bytes != 0) &&
        (items_left <= ITEMS_MASK || items_left == ITEMS_OPEN) &&
        (items_left == 0 ==> part_end == fixed_bytes + TAIL_BYTES) &&
        filled < part_end <= FRAME_BODY_MAX_BYTES && group_left <= GROUP_BYTES; */

/*@ assigns start_and_kind, fixed_bytes, item_bytes, items_left, part_end, count_last, inside,
            filled, group_left, bad, asked, unanswered, slow;
    ensures frame_is_valid && !inside && bad == 0; */
void frame_init(uint8_t kind, uint8_t payload_bytes, uint8_t bytes_of_item)
{
    start_and_kind = (uint8_t)(START_BIT | (kind << 4));
    fixed_bytes = payload_bytes;
    item_bytes = bytes_of_item;
    items_left = 0;
    part_end = (uint8_t)(payload_bytes + TAIL_BYTES);
    count_last = COUNT_NONE;
    inside = false;
    filled = 0;
    group_left = 0;
    bad = 0;
    asked = FRAME_ASKED_ANY;
    unanswered = 0;
    slow = 0;
}

/*@ assigns bad; */
void frame_refuse(void)
{
    if (bad != UINT16_MAX) {
        bad++;
    }
}

/*@ assigns inside, bad, asked, unanswered;
    ensures !inside;
    ensures \result <==> \old(inside); */
bool frame_ask(void)
{
    bool is_late = inside;

    if (is_late) {
        inside = false;
        unanswered = 0;
        frame_refuse();
    }
    if (asked < FRAME_ASKED_ANY) {
        asked++;
    }
    if (unanswered != UINT8_MAX) {
        unanswered++;
    }
    return is_late;
}

/* A frame is complete: counts how slow the head is. */
/*@ assigns unanswered, slow; */
static void note_answer(void)
{
    if (unanswered > 1) {
        if (slow < FRAME_SLOW_MAX) {
            slow++;
        }
    } else if (unanswered == 1) {
        slow = 0;
    }
    unanswered = 0;
}

/* Whether the number of a measurement follows that of the last good frame. */
/*@ assigns \nothing;
    ensures \result && asked < FRAME_ASKED_ANY ==>
                1 <= (uint8_t)(number - number_last) <= asked + 1; */
static bool is_fresh(uint8_t number)
{
    uint8_t more = (uint8_t)(number - number_last);

    if (asked >= FRAME_ASKED_ANY) {
        return true;
    }
    return asked != 0 && more != 0 && more <= (uint8_t)(asked + 1U);
}

/* The next part of the body comes: an item, or the tail. */
/*@ requires 1 <= fixed_bytes <= FRAME_BODY_MAX_BYTES - TAIL_BYTES;
    requires item_bytes <= FRAME_BODY_MAX_BYTES - fixed_bytes;
    requires items_left != 0 ==> item_bytes != 0;
    assigns filled, part_end;
    ensures filled == fixed_bytes && filled < part_end <= FRAME_BODY_MAX_BYTES;
    ensures items_left == 0 ==> part_end == fixed_bytes + TAIL_BYTES; */
static void expect_part(void)
{
    filled = fixed_bytes;
    part_end = (uint8_t)(fixed_bytes + (items_left != 0 ? item_bytes : TAIL_BYTES));
}

/* A start byte. */
/*@ requires frame_is_valid;
    assigns inside, count, filled, part_end, items_left, group_left, crc_high, crc_low, bad;
    ensures frame_is_valid;
    ensures \result == FRAME_NONE || \result == FRAME_BAD; */
static uint8_t begin(uint8_t byte)
{
    bool cut_short = inside;

    inside = (byte & KIND_MASK) == start_and_kind;
    count = byte & COUNT_MASK;
    filled = 0;
    if (item_bytes != 0) {
        items_left = ITEMS_OPEN;
        part_end = fixed_bytes;
    }
    group_left = 0;
    crc_high = (uint8_t)(CRC16_START >> 8);
    crc_low = (uint8_t)CRC16_START;
    CRC16_ADD(crc_high, crc_low, byte);
    if (!cut_short) {
        return FRAME_NONE;
    }
    frame_refuse();
    return FRAME_BAD;
}

/*@ requires frame_is_valid;
    assigns inside, count, count_last, filled, part_end, items_left, group_left, top_bits,
            crc_high, crc_low, bad, number_last, asked, unanswered, slow,
            frame_body[0 .. FRAME_BODY_MAX_BYTES - 1];
    ensures frame_is_valid;
    ensures \result == FRAME_ITEM ==> item_bytes != 0 && items_left < ITEMS_MASK;
    ensures crc_protects: \result == FRAME_GOOD ==> crc_high == 0 && crc_low == 0 && top_bits == 0;
    ensures count_protects: \result == FRAME_GOOD ==>
                count != \old(count_last) && count_last == count;
    ensures number_protects: \result == FRAME_GOOD && \old(asked) < FRAME_ASKED_ANY ==>
                1 <= (uint8_t)(number_last - \old(number_last)) <= \old(asked) + 1;
    ensures \result != FRAME_GOOD ==> count_last == \old(count_last); */
uint8_t frame_push(uint8_t byte)
{
    uint8_t number;

    if (byte & START_BIT) {
        return begin(byte);
    }
    if (!inside) {
        return FRAME_NONE;
    }
    if (group_left == 0) {
        top_bits = byte;
        group_left = GROUP_BYTES;
        return FRAME_NONE;
    }
    group_left--;
    if (top_bits & 1) {
        byte |= START_BIT;
    }
    top_bits >>= 1;
    frame_body[filled] = byte;
    filled++;
    CRC16_ADD(crc_high, crc_low, byte);
    if (filled < part_end) {
        return FRAME_NONE;
    }
    if (items_left == ITEMS_OPEN) {
        items_left = (uint8_t)(frame_body[(uint8_t)(fixed_bytes - 1U)] & ITEMS_MASK);
        expect_part();
        return FRAME_NONE;
    }
    if (items_left != 0) {
        items_left--;
        expect_part();
        return FRAME_ITEM;
    }

    inside = false;
    filled = 0;
    note_answer();
    number = frame_body[(uint8_t)(part_end - TAIL_BYTES)];
    /* A right check sum, added to itself, gives 0. If top bits are left, an unused one was 1. */
    if ((crc_high | crc_low | top_bits) != 0 || count == count_last || !is_fresh(number) ||
        slow >= FRAME_SLOW_MAX) {
        frame_refuse();
        return FRAME_BAD;
    }
    count_last = count;
    number_last = number;
    asked = 0;
    return FRAME_GOOD;
}

uint8_t frame_items_left(void)
{
    return items_left;
}

uint16_t frame_bad_count(void)
{
    return bad;
}

uint16_t frame_u16(uint8_t at)
{
    return (uint16_t)((uint16_t)frame_body[at] << 8 | frame_body[(uint8_t)(at + 1)]);
}

int32_t frame_i24(uint8_t at)
{
    uint32_t value = (uint32_t)frame_u16(at) << 8 | frame_body[(uint8_t)(at + 2)];

    if (value & 0x800000UL) {
        value |= 0xFF000000UL;
    }
    return (int32_t)value;
}
