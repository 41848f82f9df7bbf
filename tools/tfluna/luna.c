/* SPDX-License-Identifier: MIT */
#include "luna.h"

#include <string.h>

enum { READING_HEAD = 0x59, COMMAND_HEAD = 0x5A, READING_BYTES = 9, COMMAND_LEAST = 4 };

static uint8_t sum_of(const uint8_t *bytes, size_t count)
{
    unsigned sum = 0;

    for (size_t i = 0; i < count; i++) {
        sum += bytes[i];
    }
    return (uint8_t)sum;
}

static unsigned word_at(const uint8_t *bytes)
{
    return bytes[0] | (unsigned)bytes[1] << 8;
}

size_t luna_command(uint8_t bytes[LUNA_MOST], enum luna_id id, const uint8_t *payload, size_t count)
{
    size_t length = COMMAND_LEAST + count;

    bytes[0] = COMMAND_HEAD;
    bytes[1] = (uint8_t)length;
    bytes[2] = (uint8_t)id;
    memcpy(bytes + 3, payload, count);
    bytes[length - 1] = sum_of(bytes, length - 1);
    return length;
}

static void drop(struct luna_stream *stream, size_t count)
{
    stream->count -= count;
    memmove(stream->bytes, stream->bytes + count, stream->count);
}

void luna_push(struct luna_stream *stream, uint8_t byte)
{
    if (stream->count == sizeof stream->bytes) {
        drop(stream, 1);
        stream->strays++;
    }
    stream->bytes[stream->count++] = byte;
}

/* Length of the message that the oldest bytes are; 0: of none; more than there are: perhaps. */
static size_t length_of(const struct luna_stream *stream)
{
    const uint8_t *bytes = stream->bytes;
    size_t length = READING_BYTES;

    if (stream->count < 2) {
        return 2;
    }
    if (bytes[0] == COMMAND_HEAD) {
        length = bytes[1];
        if (length < COMMAND_LEAST || length > LUNA_MOST) {
            return 0;
        }
    } else if (bytes[0] != READING_HEAD || bytes[1] != READING_HEAD) {
        return 0;
    }
    if (stream->count >= length && bytes[length - 1] != sum_of(bytes, length - 1)) {
        return 0;
    }
    return length;
}

bool luna_next(struct luna_stream *stream, struct luna_message *message)
{
    const uint8_t *bytes = stream->bytes;
    size_t length;

    while (stream->count > 0 && (length = length_of(stream)) <= stream->count) {
        if (length == 0) {
            drop(stream, 1);
            stream->strays++;
            continue;
        }
        memset(message, 0, sizeof *message);
        message->is_reading = bytes[0] == READING_HEAD;
        if (message->is_reading) {
            message->dist_cm = word_at(bytes + 2);
            message->strength = word_at(bytes + 4);
            message->chip_c = word_at(bytes + 6) / 8.0 - 256;
        } else {
            message->id = bytes[2];
            message->payload_count = length - COMMAND_LEAST;
            memcpy(message->payload, bytes + 3, message->payload_count);
        }
        drop(stream, length);
        return true;
    }
    return false;
}
