/* SPDX-License-Identifier: MIT */
/* The classic safe distance: full brake when the gap is below v*t + v^2/(2a) + margin. v is the
 * closing speed: this car has no speedometer, so it knows no other. Once braking it goes on until
 * the gap is LAW_CLASSIC_RELEASE_MM more than safe. */
#include <stdbool.h>
#include "fixed.h"
#include "law.h"
#include "law_classic.h"
#include "target.h"

/* Factors for mul_hi_u16: n / 65536. */
#define DELAY_FACTOR ((uint16_t)(65536UL * LAW_CLASSIC_DELAY_MS / 1000U))
/* v^2/(2a) in two steps: (8v)^2 >> 16 is v^2/1024, and that times 1024/(2a). */
#define BRAKE_FACTOR   ((uint16_t)(65536UL * 512U / LAW_CLASSIC_DECEL_MMPS2))
#define SPEED_END_MMPS 8192U

static __bit is_braking;

uint16_t law_classic_safe_mm(uint16_t closing_mmps)
{
    uint16_t eightfold;

    if (closing_mmps >= SPEED_END_MMPS) {
        closing_mmps = SPEED_END_MMPS - 1U;
    }
    eightfold = (uint16_t)(closing_mmps << 3);
    return (uint16_t)(LAW_CLASSIC_MARGIN_MM + mul_hi_u16(closing_mmps, DELAY_FACTOR) +
                      mul_hi_u16(mul_hi_u16(eightfold, eightfold), BRAKE_FACTOR));
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return dist_mm < law_classic_safe_mm(speed->closing_mmps) ? 100 : 0;
}

__data struct law_answer law_answer;

/*@ assigns is_braking;
    ensures !is_braking; */
void law_restart(void)
{
    is_braking = false;
}

/*@ assigns is_braking;
    ensures law_answer.brake_pct == (is_braking ? 100 : 0);
    ensures dist_mm < LAW_CLASSIC_MARGIN_MM ==> is_braking;
    ensures \old(is_braking) && !is_braking && worth == TARGET_TRACKED ==>
                dist_mm > LAW_CLASSIC_MARGIN_MM + LAW_CLASSIC_RELEASE_MM; */
void law_step(uint8_t worth, uint16_t dist_mm)
{
    uint16_t safe_mm = law_classic_safe_mm(CLOSING_LAW.closing_mmps);

    if (dist_mm < safe_mm) {
        is_braking = true;
    } else if (worth != TARGET_TRACKED || dist_mm > (uint16_t)(safe_mm + LAW_CLASSIC_RELEASE_MM)) {
        is_braking = false;
    }
    law_answer.brake_pct = is_braking ? 100 : 0;
    law_answer.row = 0;
    law_answer.col = 0;
}
