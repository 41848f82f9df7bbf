/* The tuned controller: a table with more gain on the closing speed, braking from the first reading
 * where that reading alone proves a speed, and ease.h for those who do not close. */
#include "law_tuned.h"
#include "brake.h"
#include "cell.h"
#include "ease.h"
#include "law.h"
#include "lut.h"

static uint8_t look_up(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    brake.row = cell_row(dist_mm);
    brake.col = cell_col(speed);
    return lut_at(brake.row, brake.col);
}

/* One reading ago the road was clear as far as the table goes, so the target came at least this
 * far. */
static uint8_t first_sight(uint16_t dist_mm)
{
    static __data struct closing_speed least;
    uint16_t came_mm = LAW_FAR_MM - dist_mm;
    uint8_t pct;

    least.closing_mmps =
        (uint16_t)(came_mm << 4); /* in 1/16 s; it was LAW_ENTER_CS, a little less */
    pct = look_up(dist_mm, &least);
    return pct < LAW_TUNED_FIRST_PCT ? pct : LAW_TUNED_FIRST_PCT;
}

uint8_t law_step(uint16_t dist_mm, uint8_t target)
{
    if (target != LAW_TRACKED) {
        ease_restart();
        if (target == LAW_ENTERED && dist_mm >= (uint16_t)(LAW_FAR_MM - LAW_TUNED_FIRST_MM)) {
            return first_sight(dist_mm);
        }
        if (target != LAW_NEW) {
            return 0;
        }
    }
    return ease_pct(look_up(dist_mm, &BRAKE_SPEED), dist_mm, &BRAKE_SPEED);
}

uint8_t law_pct(uint16_t dist_mm, const struct closing_speed __data *speed)
{
    return lut_at(cell_row(dist_mm), cell_col(speed));
}
