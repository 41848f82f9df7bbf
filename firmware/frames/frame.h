/* SPDX-License-Identifier: MIT */
/* Frames that a sensor head sends on the UART: one start byte, a body of fixed length, a check sum.
 *
 *     start   1 kkk cccc   the only byte of a frame with bit 7 set. kkk is the kind of the payload
 *                          (enum frame_kind). cccc is a count: it goes up by one each frame, and
 *                          from 15 to 0
 *     body    the payload, the number of the measurement, then CRC-16/CCITT-FALSE over start byte,
 *             payload and number, high byte first. The number has one byte. Whoever measures, not
 *             whoever sends, adds one to it with each measurement. The body is sent in groups of
 *             up to seven bytes. A group begins with one byte that holds their top bits (bit 0:
 *             the first byte's, bit 1: the second's, and so on; unused bits are 0). Then each byte
 *             follows without its top bit.
 *
 * A payload can end in items of equal length, 0 to 15 of them, such as the targets of a radar. Then
 * the low four bits of the last byte before them are their number. Each item is read as soon as it
 * is complete, so one place is enough for all; what it says counts only when the frame is good.
 *
 * So n payload bytes always take 1 + (n + 3) + ceil((n + 3) / 7) bytes on the line; nothing is
 * escaped. A receiver that starts in the middle of a frame, or that loses or gains a byte, is in
 * step again at the next start byte: a frame that is cut short does not spoil the next one. Values
 * are big-endian; signed ones are two's complement.
 *
 * The controller asks for each frame. A control step begins with a pulse on TRIGGER; then the head
 * measures and answers with one frame. So the age of a reading is known, and the two need no common
 * clock.
 *
 * What happens when something goes wrong:
 *     bytes before a start byte     are ignored
 *     a start byte inside a frame   the frame that it cuts short is FRAME_BAD; a new one begins
 *     wrong check sum               FRAME_BAD
 *     the count of the last good frame again (the head repeats itself)   FRAME_BAD
 *     a frame of another kind       is ignored: it is for another receiver
 *     a measurement's number that does not follow (see below)            FRAME_BAD
 *     a frame is not complete when the next one is asked for             frame_ask drops it: it is
 *                                                                        late, and counts as bad
 *     a payload value out of range  the user of the payload calls frame_refuse()
 * FRAME_BAD does not change what the last good frame said and is no sign of life. link.h decides
 * what happens when no good frame comes for LINK_SILENCE_MS.
 *
 * The number of a measurement follows if it is larger than that of the last good frame, by at most
 * one more than the frames that were asked for since. So these are bad: a frozen measurement with
 * fresh counts, old frames in whatever order, and frames that nobody asked for. After
 * FRAME_ASKED_ANY frames asked for without a good one any number follows: the head may have been
 * started again. A head that FRAME_SLOW_MAX times in a row answers only every second trigger, or
 * less often, is too slow: its frames are bad until it answers two triggers in a row. */
#ifndef FUZZY51_FRAME_H
#define FUZZY51_FRAME_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

enum frame_kind {
    FRAME_RADAR = 1,
    FRAME_GAP = 2,
    FRAME_FOLLOW = 3,
    FRAME_PARK = 4,
};

enum frame_result {
    FRAME_NONE, /* the frame is not complete yet */
    FRAME_ITEM, /* an item of a frame is complete: read it before the next frame_push */
    FRAME_GOOD, /* a complete frame: read its payload before the next frame_push */
    FRAME_BAD,  /* a frame was lost: wrong check sum, cut short, or not the one asked for */
};

#define FRAME_BODY_MAX_BYTES 13
#define FRAME_ASKED_ANY      64
#define FRAME_SLOW_MAX       8

/* The bytes of one frame on the line, for a payload of `bytes` with all its items. */
#define FRAME_LINE_BYTES(bytes) (1 + ((bytes) + 3) + ((bytes) + 3 + 6) / 7)

/* Of the frame that is being received: the payload without its items, then the item that came last,
 * or the end of the body. */
extern __idata uint8_t frame_body[FRAME_BODY_MAX_BYTES];

/* From now on receives frames of `kind` (1..7) with a payload of `payload_bytes` (1 to
 * FRAME_BODY_MAX_BYTES - 3) and then items of `bytes_of_item` each (at most FRAME_BODY_MAX_BYTES -
 * payload_bytes; 0: without items). Forgets all that was received before. */
/*@ requires 1 <= kind <= 7 && 1 <= payload_bytes <= FRAME_BODY_MAX_BYTES - 3;
    requires bytes_of_item <= FRAME_BODY_MAX_BYTES - payload_bytes; */
void frame_init(uint8_t kind, uint8_t payload_bytes, uint8_t bytes_of_item);

/* Says that a trigger asks for a frame now. Returns whether it dropped a frame that was not
 * complete, which counts as bad. */
bool frame_ask(void);

/* Takes one byte from the line and returns enum frame_result. Less than 200 mc. */
/*@ ensures \result == FRAME_NONE || \result == FRAME_ITEM || \result == FRAME_GOOD ||
            \result == FRAME_BAD; */
uint8_t frame_push(uint8_t byte);

/* After FRAME_ITEM: returns how many items of this frame are still to come. */
/*@ assigns \nothing; */
uint8_t frame_items_left(void);

/* Says that the last good frame has an impossible value: it counts as a bad one. */
void frame_refuse(void);

/* Returns the number of bad frames since frame_init; it stops at 65535. */
/*@ assigns \nothing; */
uint16_t frame_bad_count(void);

/* Return the big-endian value at byte `at` of the payload: two bytes unsigned, or three bytes with
 * sign. */
/*@ requires at + 1 < FRAME_BODY_MAX_BYTES;
    assigns \nothing;
    ensures \result == frame_body[at] * 256 + frame_body[at + 1]; */
uint16_t frame_u16(uint8_t at);
/*@ requires at + 2 < FRAME_BODY_MAX_BYTES;
    assigns \nothing;
    ensures tried: -8388608 <= \result <= 8388607; */
int32_t frame_i24(uint8_t at);

#endif
