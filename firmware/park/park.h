/* SPDX-License-Identifier: MIT */
/* Parking backwards: two steering laws, blended by the distance D to the parking place
 * (tables/park.fis).
 *
 * The place is the origin. There the car shall stand along +y; it only drives backwards. phi is the
 * angle from +y to the line from the place to the rear axle, delta the angle from +y to the car's
 * axis:
 *     FAR    -3 phi + 2 (delta - phi)      turns onto the line, and the line towards the y axis
 *     NEAR   X / 8 rad + delta             makes X small
 *     theta = w FAR + (1 - w) NEAR         w(D) from the table; each law limited to +-45 degrees
 * Angles (turn16) are in 65,536ths of a turn and wrap in 16 bits; places (512) are in 1/512 m. */
#ifndef FUZZY51_PARK_H
#define FUZZY51_PARK_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

#define PARK_X_MAX_512        20480 /* 40 m to each side */
#define PARK_Y_MAX_512        20480 /* 40 m */
#define PARK_Y_MIN_512        (-512)
#define PARK_THETA_MAX_TURN16 8192 /* 45 degrees */

/* Payload of FRAME_PARK: X (i16, 1/512 m), Y (i16, 1/512 m), heading psi of the car against +x
 * (u16, 65,536ths of a turn). */
#define PARK_PAYLOAD_BYTES 6

#define PARK_SERVO_MID_US  1500U
#define PARK_SERVO_SPAN_US 500U /* added at PARK_THETA_MAX_TURN16 */

/* A start is checked before the car moves: plan.h drives the way in thought, one step each frame,
 * up to 7.1 s. park_paper, as published, does not check: it drives from WAITING on, wherever it
 * ends.
 *
 *     WAITING    link up -> CHECKING; link lost: WAITING
 *     CHECKING   the way ends in the place -> DRIVING, beside it -> DEAD_ZONE; link lost -> FAULT
 *     DRIVING    Y <= 0 -> ARRIVED; link lost -> FAULT
 *     FAULT      link up -> DRIVING, or CHECKING from the beginning if that had not ended
 *     DEAD_ZONE  the way from where the driver has moved the car ends in the place -> READY
 *     READY      it ends beside it -> DEAD_ZONE
 * In every state but the last two, Y <= 0 -> ARRIVED. ARRIVED, DEAD_ZONE and READY end with the
 * next start: only then does the car drive. DEAD_ZONE and READY drive the way in thought again and
 * again, each time from where the car is then. So they are right once it has stood for 15 s. */
enum park_state {
    PARK_WAITING,  /* the link was never up: the car stands */
    PARK_CHECKING, /* the car stands */
    PARK_DRIVING,
    PARK_ARRIVED,   /* Y <= 0: the car stands until the next start */
    PARK_DEAD_ZONE, /* from here it would not park: the car stands. Drive forward, start again */
    PARK_READY,     /* out of the dead zone: the car stands until the next start */
    PARK_FAULT,     /* the link is lost: the car stands until the link is up again */
};

struct park {
    int16_t x, y;                         /* 1/512 m */
    uint16_t heading;                     /* 65,536ths of a turn */
    uint16_t dist_mm;                     /* right to 10 mm */
    uint8_t weight;                       /* w(D), 0..255 means 0..1 */
    int16_t theta_far, theta_near, theta; /* 65,536ths of a turn */
    uint16_t servo_us;                    /* 1000..2000 */
    uint8_t state;                        /* enum park_state */
};

/* What the controller last read and decided. */
extern __idata struct park park;

/*@ predicate park_is_valid =
        -PARK_X_MAX_512 <= park.x <= PARK_X_MAX_512 && PARK_Y_MIN_512 <= park.y <= PARK_Y_MAX_512 &&
        -PARK_THETA_MAX_TURN16 <= park.theta <= PARK_THETA_MAX_TURN16 &&
        1000 <= park.servo_us <= 2000 && park.state <= PARK_FAULT; */

/* Sets the state at start: the car stands, the wheels are straight. */
/*@ assigns park.theta, park.servo_us, park.state;
    ensures park.state == PARK_WAITING && park.servo_us == PARK_SERVO_MID_US && park.theta == 0; */
void park_init(void);

/* Steers: sets dist_mm, weight and the three thetas from x, y and heading. y must be 0 or positive.
 * About 3,500 mc. */
/*@ requires park_is_valid && park.y >= 0;
    assigns park.dist_mm, park.weight, park.theta_far, park.theta_near, park.theta;
    ensures park_is_valid; */
void park_steer(void);

/* Reads the payload of a good frame. Returns false, with nothing taken from the frame, if a value
 * is out of range: X not in -PARK_X_MAX_512..PARK_X_MAX_512, or Y not in
 * PARK_Y_MIN_512..PARK_Y_MAX_512. */
/*@ requires park_is_valid;
    assigns park.x, park.y, park.heading;
    ensures park_is_valid;
    ensures !\result ==> park == \old(park); */
bool park_read(void);

/* Makes one control step with what was read. Call it only while the link is up. */
/*@ requires park_is_valid;
    assigns park.state, park.x, park.y, park.heading, park.dist_mm, park.weight, park.theta_far,
            park.theta_near, park.theta, park.servo_us;
    ensures park.x == \old(park.x) && park.y == \old(park.y) && park.heading == \old(park.heading);
    ensures park_is_valid;
    ensures park.state != PARK_WAITING && park.state != PARK_FAULT;
    ensures lasts: \old(park.state) == PARK_ARRIVED ==> park.state == PARK_ARRIVED;
    ensures lasts: \old(park.state) == PARK_DEAD_ZONE || \old(park.state) == PARK_READY ==>
                park.state == PARK_DEAD_ZONE || park.state == PARK_READY;
    ensures ends_at_the_line: park.y <= 0 ==> park.state == PARK_ARRIVED ||
                park.state == PARK_DEAD_ZONE || park.state == PARK_READY; */
void park_decide(void);

/* Makes one control step while the link is lost: CHECKING and DRIVING become FAULT. */
/*@ assigns park.state;
    ensures park.state != PARK_DRIVING && park.state != PARK_CHECKING; */
void park_lose(void);

/* Returns whether the car must stand: in every state but DRIVING. */
/*@ assigns \nothing;
    ensures \result <==> park.state != PARK_DRIVING; */
bool park_must_stand(void);

#endif
