/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: main.c
 * long: yes
 * defined: by eva_brake
 *
 * The brake's main loop, from reset on, whatever the machine delivers.
 *
 * theorem t9_on: from reset until the self-test is over the brake is fully on, with STOP
 * theorem t9_passed: the self-test ends without a lasting FAULT only if the check sum of all code is right
 * theorem t10_anew: begun anew because a bit of RAM turned over, it brakes at least FAULT_PCT, in FAULT
 * theorem t9_fails: a failed self-test ends in a lasting FAULT, with at least FAULT_PCT at the pin
 */
#include "bits.h"
#include "pins.h"
#include "identity.h"
#include "sensor.h"
#include "fixed.h"
#include CLOSING_C
#include "target.c"
#include "fault.c"
#include "warning.c"
#include "latch.c"
#include "brake.c"
#include "brake/main.c"
