/* SPDX-License-Identifier: MIT */
/* Does this s51 keep time? Releases after 0.6.4 lose a timer tick with each interrupt, so an
 * unknown one first has to do what the firmware needs, with the timers that the firmware uses:
 * measure an echo to half a millimetre, keep the PWM's period to 0.1 %, send serial bytes, run
 * twice alike. */
#ifndef FUZZY51_CANARY_H
#define FUZZY51_CANARY_H

/* Accepts a version that s51_is_known at once, another one only if the canary passes. Returns
 * EXIT_FINE, or EXIT_USAGE after a message. */
int canary_check_version(void);

/* Runs the canary image and prints each figure. Returns EXIT_FINE when all are right, EXIT_USAGE
 * when one is not, or when s51 failed. */
int canary_run(void);

#endif
