/* SPDX-License-Identifier: MIT */
/* controller: brake
 * proves: range_tfluna.c
 *
 * The TF-Luna's frames: each function keeps its contract, whatever bytes come. */
#define SENSOR_tfluna
/* The interrupt changes range_came, which range_take reads once, and no byte that range_take reads. */
#define volatile
#include "bits.h"
#include "fixed.h"
#include "range_tfluna.c"
