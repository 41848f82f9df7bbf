/* SPDX-License-Identifier: MIT */
/* The warning. */
#include "warning.h"
#include "target.h"

static uint8_t left_readings; /* until it ends; 0: it is off */

/*@ assigns left_readings;
    ensures left_readings == 0; */
void warning_init(void)
{
    left_readings = 0;
}

/*@ assigns left_readings;
    ensures left_readings <= WARNING_CALM_READINGS;
    ensures \result <==> left_readings != 0;
    ensures !has_reason && target_worth == TARGET_NONE ==> !\result;
    ensures !has_reason ==> left_readings == 0 || left_readings == \old(left_readings) - 1; */
bool warning_take(bool has_reason)
{
    if (has_reason) {
        left_readings = WARNING_CALM_READINGS;
        /* unreached: the second part holds only after a bit of RAM has turned over */
    } else if (target_worth == TARGET_NONE || left_readings > WARNING_CALM_READINGS) {
        left_readings = 0;
    } else if (left_readings != 0) {
        left_readings--;
    }
    return left_readings != 0;
}
