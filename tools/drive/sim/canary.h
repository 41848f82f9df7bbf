/* Does this s51 keep time? Releases after 0.6.4 lost a timer tick with each interrupt, so an
 * unknown one has to measure pulses of known length before any result of it counts. */
#ifndef FUZZY51_CANARY_H
#define FUZZY51_CANARY_H

/* Accepts s51 0.6.4 at once, another one only if the canary passes. Returns EXIT_FINE, or
 * EXIT_USAGE after a message. */
int canary_check_version(void);

/* Runs the canary image and prints each figure. Returns EXIT_FINE when all are right, EXIT_USAGE
 * when one is not, or when s51 failed. */
int canary_run(void);

#endif
