/* SPDX-License-Identifier: MIT */
/* A lidar of the TF-Luna class on the controller's serial line, by Benewake's manual SJ-PM-TF-Luna
 * A03 and A05. It sends by itself, one frame of nine bytes each 1 / rate_hz:
 *
 *     59 59  distance in cm  strength  temperature  sum       (16 bits each, low byte first)
 *
 * distance  the mean of the ranges since the frame before, so half a period old when the frame
 *           begins
 * strength  1000 from a white car (90 %) at 4 m, 400 at 8 m: where the manual's two tables of the
 *           noise, by strength and by distance, meet. It is proportional to the reflectivity, which
 *           lets a black car (10 %) be seen from 4.3 m on. The manual promises 2.5 m for it.
 * noise     by the strength, the manual's table: 3 cm up to 200, 2 cm at 400, 1 cm at 1000, 5 mm
 *           from 2000 on
 * nothing   a strength below 100, and distance 0
 * near      Nearer than min_m the manual calls the distance unreliable. Here it grows again, as
 *           users of the sister TFmini have seen it.
 * blinded   strength 65535, and any distance */
#ifndef FUZZY51_DRIVE_TFLUNA_H
#define FUZZY51_DRIVE_TFLUNA_H

#include "sensor.h"

#include <stddef.h>

enum { TFLUNA_FRAME = 9, TFLUNA_WEAK = 100, TFLUNA_BLINDED = 65535 };

struct tfluna {
    struct sensing sensing;
    struct random chance; /* which frames are bad; apart, so that it does not change the noise */
    int64_t period_ns;
    int64_t due_ns;  /* the next frame's first byte */
    int64_t sent_ns; /* the last one's; 0: there was none */
};

void tfluna_init(struct tfluna *tfluna, const struct sensor_settings *settings, uint64_t seed);

/* Strength of what comes back from GAP_M, by the reflectivity of SENSOR; 0: nothing is there. */
double tfluna_strength(const struct sensor *sensor, double gap_m);

/* Standard deviation of the distance at that strength, m. */
double tfluna_noise_m(double strength);

/* Whether it sees a target at GAP_M when nothing is wrong. */
bool tfluna_is_seen(const struct tfluna *tfluna, double gap_m);

/* The frame that is due now, at due_ns, of a target at GAP_M that closes with CLOSING_MPS. Puts its
 * bytes into FRAME and returns their number, 0 for none; ANSWER says what they tell. Then the next
 * one is due. */
size_t tfluna_take(struct tfluna *tfluna, double gap_m, double closing_mps,
                   uint8_t frame[TFLUNA_FRAME], enum sensor_answer *answer);

#endif
