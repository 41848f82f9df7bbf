/* Parking backwards: two steering laws, blended by the distance from the place (tables/park.fis).
 *
 * The place is the origin, the car shall stand in it along +y, and drives only backwards. With phi
 * the angle of the line from the place to the rear axle against +y, and delta that of the car's
 * axis: FAR    -3 phi + 2 (delta - phi)      turn onto the line, and the line towards the y axis
 *     NEAR   X / 8 rad + delta             take the rest out of X
 *     theta = w FAR + (1 - w) NEAR         w(D) from the table; each law limited to +-45 degrees
 * Angles are in 65,536ths of a turn and wrap by themselves, lengths in 1/512 m. */
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
#define PARK_SERVO_SPAN_US 500U /* for PARK_THETA_MAX_TURN16 */

enum park_state {
    PARK_WAITING, /* for the first three good frames: the car stands */
    PARK_DRIVING,
    PARK_ARRIVED, /* Y <= 0: the car stands, for good */
    PARK_FAULT,   /* the link is lost: the car stands until it is up again */
};

struct park {
    int16_t x, y;     /* 1/512 m */
    uint16_t heading; /* 65,536ths of a turn */
    uint16_t dist_mm; /* to 10 mm */
    uint8_t weight;   /* w(D), 0..255 */
    int16_t theta_far, theta_near, theta;
    uint16_t servo_us;
    uint8_t state;
};

/* What the controller last read and decided. */
extern __idata struct park park;

/* The car stands, the wheel is straight. */
void park_init(void);

/* Steers from where park.x, park.y, park.heading say: sets dist_mm, weight and the three thetas.
 * Domain: |x| <= PARK_X_MAX_512, 0 <= y <= PARK_Y_MAX_512. About 3,500 mc. */
void park_steer(void);

/* Takes the payload of a good frame. Returns false, with everything as before, when a value is out
 * of range: |X| > PARK_X_MAX_512, Y < PARK_Y_MIN_512 or > PARK_Y_MAX_512. */
bool park_read(void);

/* One control step on what was read, while the link is up. */
void park_decide(void);

/* One control step while the link is lost. */
void park_lose(void);

/* Whether the car must stand: everywhere but in PARK_DRIVING. */
bool park_must_stand(void);

#endif
