/* SPDX-License-Identifier: MIT */
/* What the axes of the brake's table must be. Else the build stops here, with the reason. */
#ifndef FUZZY51_AXES_H
#define FUZZY51_AXES_H

#include "lut_table.h"

#if LUT_INPUTS != 2
#error the brake needs a table of two inputs: distance in m, closing speed in m/s
#endif
#if !defined(LUT_IN1_SPAN_MILLI) || !defined(LUT_IN2_SPAN_MILLI)
#error an end of an axis is not in whole mm or mm/s; round the Range of that input to 0.001
#endif
#if LUT_IN1_SPAN_MILLI > 65535 || LUT_IN2_SPAN_MILLI > 65535
#error an axis is too long: at most 65.535 m or m/s from end to end; is its unit m or m/s?
#endif
#if LUT_IN1_MIN_MILLI < 0 || LUT_IN1_SPAN_MILLI > 65534 - LUT_IN1_MIN_MILLI
#error the distance axis must lie within 0..65.534 m
#endif
#if LUT_IN2_MIN_MILLI < -65535 || LUT_IN2_SPAN_MILLI > 65535 - LUT_IN2_MIN_MILLI
#error the speed axis must lie within -65.535..65.535 m/s
#endif
#if LUT_LEVELS > 100
#error the table has more than 100 levels; the brake takes percent: use LEVELS=100 or less
#endif

#endif
