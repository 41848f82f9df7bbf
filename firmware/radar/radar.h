/* The collision avoidance of the millimetre-wave radar: from beat frequencies to a braking command.
 *
 * The driver keeps control until a target in the own lane is nearer than the safe distance S_F, at
 * most 100 m, and comes nearer; then the throttle is cut and the table of tables/radar.fis says how
 * hard to brake, until the closing speed is gone (V_R <= 0, not until S > S_F: that would let go in
 * the middle of it). */
#ifndef FUZZY51_RADAR_H
#define FUZZY51_RADAR_H

#include <stdbool.h>
#include <stdint.h>
#include "cc51.h"

/* Payload of FRAME_RADAR:
 *     0  i24  beat of the up sweep, Hz
 *     3  i24  beat of the down sweep, Hz
 *     6  i16  azimuth of the target, 65,536ths of a turn, positive to the left
 *     8  u16  own speed, tenths of km/h
 *    10  i16  curvature of the own lane, millionths of 1/m, positive to the left
 *    12  u8   enum radar_flags */
#define RADAR_PAYLOAD_BYTES 13

enum radar_flags {
    RADAR_TARGET = 1, /* there is one; without it beats and azimuth say nothing */
    RADAR_SIGNED = 2, /* the front end has I and Q: it knows a negative beat */
};

enum radar_state {
    RADAR_DRIVER,  /* the driver has control */
    RADAR_BRAKING, /* throttle cut, the table brakes */
    RADAR_FAULT,   /* no link: throttle cut, brake at FAULT_PCT or where it stood, whichever is more
                    */
};

struct radar {
    uint16_t range_cm;
    int16_t closing_dkmh; /* tenths of km/h, positive when approaching */
    uint16_t own_dkmh;
    int16_t azimuth;
    int16_t curvature_upm;
    uint8_t flags;
    uint16_t safe_cm;
    uint8_t row, col; /* of the table: closing speed and range as levels, 0..12 */
    uint8_t level;    /* the table's answer, 40 (J_A + 3) */
    uint8_t brake_pct;
    uint8_t state;
};

/* What the controller last read and decided. */
extern __idata struct radar radar;

/* No target, the driver has control. */
void radar_init(void);

/* Takes the payload of a good frame. Returns false, with everything as before, when a value is out
 * of range (see fmcw.h, safe.h, lane.h for theirs), when an unknown flag is set, when a front end
 * without a sign sends a negative beat, or when its sign matters (fmcw_sign_is_open). */
bool radar_read(void);

/* One control step on what was read, while the link is up. */
void radar_decide(void);

/* One control step while the link is lost: FAULT, never less brake than before, `fault_pct` at
 * least. */
void radar_lose(uint8_t fault_pct);

/* Whether the driver's throttle is cut. */
bool radar_cuts_throttle(void);

/* The rows and columns of the table: floor((12 V + 30) / 60) of the closing speed V in km/h, and
 * floor((12 S + 50) / 100) of the range S in m, limited to 0..12. */
uint8_t radar_row(int16_t closing_dkmh);
uint8_t radar_col(uint16_t range_cm);

#endif
