/* SPDX-License-Identifier: MIT */
/* Frames of the payloads of tests/bench/APP.c, as the sensor head sends them:
 *     line KIND PAYLOAD_BYTES FRAMES       on the host; writes FRAMES of them, taken from all over
 */
#include <stdio.h>
#include <stdlib.h>
#include "frames.h"
#include "step.h"
#include "head.h"

uint8_t frame_body[FRAME_BODY_MAX_BYTES];

int main(int count, char *words[])
{
    uint8_t line[HEAD_LINE_MAX] = {0};
    long frames;

    if (count != 4) {
        fputs("usage: line KIND PAYLOAD_BYTES FRAMES\n", stderr);
        return 2;
    }
    frames = atol(words[3]);
    for (long i = 0; i < frames; i++) {
        bench_payload((uint16_t)(i * bench_steps / frames));
        fwrite(line, 1,
               head_encode(atoi(words[1]), (int)(i % 16), frame_body, atoi(words[2]),
                           (int)(i % 256), line),
               stdout);
    }
    return 0;
}
