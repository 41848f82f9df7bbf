/* SPDX-License-Identifier: MIT */
/* Writes the report's scenarios: the grids of public test protocols, scaled to a model car, each
 * with the outcome that physics allows (plant/best_driver.h).
 *
 * Scale: 1:10 after Froude. Lengths are divided by 10, speeds and times by sqrt(10); accelerations
 * stay. So 50 km/h become 4.39 m/s, and the sensor's 5 m stand for 50 m. */
#ifndef FUZZY51_PROTOCOLS_H
#define FUZZY51_PROTOCOLS_H

/* Writes them as files FOLDER/NAME.scn; makes the folder. MAP: how fine the avoidance map is, one
 * of "coarse", "normal" and "fine". Returns EXIT_FINE, EXIT_INPUT after a message when a file
 * cannot be written, EXIT_USAGE after a message for another MAP. */
int protocols_write(const char *folder, const char *map);

#endif
