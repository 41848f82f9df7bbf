/* SPDX-License-Identifier: MIT */
/* What a TF-Luna sends and understands, by Benewake's manual SJ-PM-TF-Luna A05, appendix II; words
 * have 16 bits, low byte first:
 *
 *     reading   59 59  distance in cm  strength  temperature  sum
 *     command   5A  length  id  payload  sum                          (length: of all)
 *     reply     the same, with the id of its command
 *
 * A sum is the low byte of the sum of all bytes before it. */
#ifndef FUZZY51_TFLUNA_LUNA_H
#define FUZZY51_TFLUNA_LUNA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum luna_id {
    LUNA_VERSION = 0x01,    /* the reply: patch, minor, major */
    LUNA_RATE_HZ = 0x03,    /* 16 bits; the reply says the rate that it has now */
    LUNA_FORMAT = 0x05,     /* 1: readings as above */
    LUNA_BAUD = 0x06,       /* 32 bits; the line has this rate at once */
    LUNA_IS_SENDING = 0x07, /* 1: it sends readings by itself */
    LUNA_SAVE = 0x11,       /* keeps all this without power; the reply: 0 for success */
};

enum { LUNA_WEAK = 100, LUNA_BLINDED = 65535, LUNA_MOST = 32 };

struct luna_message {
    bool is_reading; /* or a reply */
    unsigned dist_cm, strength;
    double chip_c;
    uint8_t id, payload[LUNA_MOST];
    size_t payload_count;
};

/* Bytes as they come. */
struct luna_stream {
    uint8_t bytes[2 * LUNA_MOST];
    size_t count;
    unsigned long strays; /* bytes that belong to no message */
};

/* Puts the command with that payload into BYTES and returns its length. COUNT: at most 4. */
size_t luna_command(uint8_t bytes[LUNA_MOST], enum luna_id id, const uint8_t *payload,
                    size_t count);

/* Takes one more byte. */
void luna_push(struct luna_stream *stream, uint8_t byte);

/* Takes the oldest message out. False: there is no whole one. */
bool luna_next(struct luna_stream *stream, struct luna_message *message);

#endif
