/* SPDX-License-Identifier: MIT */
/* Reads a servo's pulses off a pin. */
#ifndef FUZZY51_SERVO_H
#define FUZZY51_SERVO_H

#include <stdbool.h>
#include <stdint.h>

enum { SERVO_MIN_NS = 500000, SERVO_MAX_NS = 2500000 };

struct servo {
    int64_t rise_ns, fall_ns; /* of the last pulse */
    double pulse_us;          /* of the last pulse that is one; 0: none yet */
    bool high;
};

void servo_init(struct servo *servo, bool level);

/* Times begin anew, with the pin at LEVEL; the last pulse still counts. */
void servo_restart(struct servo *servo, bool level);

/* How far a throttle is open that is closed at 1 ms, or without pulses, and full at 2 ms. */
double servo_throttle_pct(const struct servo *servo);

/* The pin goes to LEVEL at T_NS. Returns true when the pulse is another than the one before. */
bool servo_edge(struct servo *servo, int64_t t_ns, bool level);

#endif
