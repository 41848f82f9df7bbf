/* Keeping a gap: the safe distance to the car in front, and from it an acceleration, half by an
 * optimal (LQ) law and half by the fuzzy table of tables/gap.fis. After Bi and Li; both cars brake
 * with A = 6 m/s2 at most, the brake takes effect tau = 0.9 s late, 5 m stay when all stand.
 *
 *     lead                 safe distance D                                h = dD/dv
 *     stands (<= 5 cm/s)   v tau + v^2/(2A) + 5 m                         tau + v/A
 *     drives               c tau + c^2/(2A) + 5 m, c = closing speed      tau + c/A
 *     brakes (> 20 cm/s2)  max(0, v tau + v^2/(2A) - lead^2/(2A)) + 5 m   tau + v/A
 *
 *     u_LQ    = -0.3 (D - gap) - (v - lead)/h, to +-8 m/s2
 *     u_fuzzy = table(0.2 (gap - D), 0.04 (lead - v))
 *     u       = (u_LQ + u_fuzzy) / 2
 *
 * Lengths are in cm, speeds in cm/s, accelerations in cm/s2, positive to go faster. Roundings are
 * part of the specification and all in the same direction, to brake up to 0.17 m/s2 harder. */
#ifndef FUZZY51_GAP_H
#define FUZZY51_GAP_H

#include <stdbool.h>
#include <stdint.h>

/* Payload of FRAME_GAP: gap (u16, cm), own speed (u16, cm/s), lead's speed (u16, cm/s), lead's
 * acceleration (i16, cm/s2). */
#define GAP_PAYLOAD_BYTES  8
#define GAP_MAX_CM         25000U /* and more, or no car ahead: neither brake nor throttle */
#define GAP_SPEED_MAX_CMPS 5000U
#define GAP_LEAD_MAX_CMPS2 1500 /* to both sides */

#define GAP_ACCEL_MAX_CMPS2 800

/* Below this own speed a brake that is on holds at least so hard, to a standstill. */
#define GAP_CREEP_CMPS 30U
#define GAP_HOLD_CMPS2 30

/* The throttle is a servo pulse of so many us, from closed to 8 m/s2; the brake is 100 % at 8 m/s2.
 */
#define GAP_THROTTLE_CLOSED_US 1000U
#define GAP_THROTTLE_FULL_US   2000U

enum gap_lead { GAP_LEAD_STANDS, GAP_LEAD_DRIVES, GAP_LEAD_BRAKES };

enum gap_state {
    GAP_WAITING, /* no three good frames yet: full brake, the car does not roll */
    GAP_CONTROL,
    GAP_FAULT, /* the link is lost: throttle closed, brake as it was or more, until it is up again
                */
};

struct gap {
    uint16_t gap_cm, own_cmps, lead_cmps; /* as last read */
    int16_t lead_cmps2;
    uint16_t safe_cm; /* D */
    int16_t accel_cmps2;
    uint8_t brake_pct;
    bool stop; /* the stop line: until the link is up for the first time */
    uint16_t throttle_us;
    uint8_t lead;  /* enum gap_lead */
    uint8_t state; /* enum gap_state */
};

/* What the controller last read and decided. */
extern struct gap gap;

/* Full brake, throttle closed, waiting. */
void gap_init(void);

/* Takes the payload of a good frame. Returns false, with everything as before, when a value is out
 * of range: gap > GAP_MAX_CM, a speed > GAP_SPEED_MAX_CMPS, the lead's acceleration beyond
 * GAP_LEAD_MAX_CMPS2. */
bool gap_read(void);

/* One control step on what was read, while the link is up; made for one in 50 ms. Under 2,800 mc
 * with gap_read. */
void gap_decide(void);

/* One control step while the link is lost: never less brake than before, `fault_pct` at least. */
void gap_lose(uint8_t fault_pct);

/* The parts of gap_decide, on what was read. D, 500..25833 cm; the LQ law with safe_cm set, and the
 * table with safe_cm set, both to +-800 cm/s2. */
uint16_t gap_safe_cm(void);
int16_t gap_lq_cmps2(void);
int16_t gap_fuzzy_cmps2(void);

#endif
