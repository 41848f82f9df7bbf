/* Frames that a sensor head sends on the UART: one start byte, a body of fixed length, a check sum.
 *
 *     start   1 kkk cccc   the only byte of a frame with bit 7 set; kkk: what the body means (enum
 *                          frame_kind), cccc: a count that goes up by one a frame, 15 -> 0
 *     body    the payload bytes of that kind, then CRC-16/CCITT-FALSE over the start byte and the
 *             payload, high byte first. It travels in groups: up to seven body bytes make a group,
 *             which is one byte with their top bits (bit 0: of the first byte, bit 1: of the
 *             second, and so on; unused bits 0) and then each byte without its top bit.
 *
 * So n payload bytes take 1 + (n + 2) + ceil((n + 2) / 7) bytes on the line, always: nothing is
 * escaped. A receiver that starts listening in the middle of a frame, or that lost or won a byte,
 * is in step again at the next start byte; a frame cut short costs itself and not its follower.
 * Values are big-endian, signed ones in two's complement.
 *
 * The controller asks: each control step begins with a pulse on TRIGGER, at which the head
 * measures, and which it answers with one frame. So the age of a reading is known, and no clock has
 * to be met.
 *
 * What each way of going wrong leads to:
 *     bytes before a start byte     passed over
 *     a start byte inside a frame   the frame that it cuts off is FRAME_BAD, the new one begins
 *     wrong check sum               FRAME_BAD
 *     the count of the last good frame again: a head that repeats itself   FRAME_BAD
 *     a frame of another kind       passed over: it is meant for somebody else
 *     a payload value out of its range: the user of the payload says frame_refuse()
 * FRAME_BAD never changes what the last good frame said, and does not count as a sign of life; that
 * no good frame came for LINK_SILENCE_MS is link.h's affair. */
#ifndef FUZZY51_FRAME_H
#define FUZZY51_FRAME_H

#include <stdint.h>
#include "cc51.h"

enum frame_kind {
    FRAME_RADAR = 1,
    FRAME_GAP = 2,
    FRAME_FOLLOW = 3,
    FRAME_PARK = 4,
};

enum frame_result {
    FRAME_NONE, /* nothing to say yet */
    FRAME_GOOD, /* a whole frame: read its payload before the next frame_push */
    FRAME_BAD,  /* a frame was lost: wrong check sum, cut short, or a repeated one */
};

#define FRAME_PAYLOAD_MAX 14
#define FRAME_BODY_MAX    (FRAME_PAYLOAD_MAX + 2)

/* The bytes of one frame on the line, for a payload of `bytes`. */
#define FRAME_LINE_BYTES(bytes) (1 + ((bytes) + 2) + ((bytes) + 2 + 6) / 7)

/* The body of the frame that is coming in; the payload after FRAME_GOOD. */
extern __idata uint8_t frame_body[FRAME_BODY_MAX];

/* Frames of `kind` (1..7) with `payload_bytes` (1..FRAME_PAYLOAD_MAX) are awaited from now on, and
 * none has been seen. */
void frame_init(uint8_t kind, uint8_t payload_bytes);

/* One byte off the line. Returns one of enum frame_result. Under 150 mc. */
uint8_t frame_push(uint8_t byte);

/* The frame just found good holds a value that cannot be: counts it among the bad ones. */
void frame_refuse(void);

/* Bad frames since frame_init, 65535 at most. */
uint16_t frame_bad_count(void);

/* Big-endian values out of the payload, at byte `at`. */
uint16_t frame_u16(uint8_t at);
int32_t frame_i24(uint8_t at);

#endif
