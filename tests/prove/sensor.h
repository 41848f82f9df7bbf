/* SPDX-License-Identifier: MIT */
/* The files of the brake that are the sensor's own: of the TF-Luna with SENSOR_tfluna, else of the HC-SR04. */
#ifndef FUZZY51_PROVE_SENSOR_H
#define FUZZY51_PROVE_SENSOR_H

#ifdef SENSOR_tfluna
#define RANGE_C   "range_tfluna.c"
#define CLOSING_C "closing_tfluna.c"
#else
#define RANGE_C   "range.c"
#define CLOSING_C "closing.c"
#endif

#endif
