/* SPDX-License-Identifier: MIT */
/* A yard from above, in a terminal: the place to park at the origin, the car, the way that its rear
 * axle has gone, its front wheels. */
#ifndef FUZZY51_YARD_H
#define FUZZY51_YARD_H

#include <stdio.h>

enum { YARD_ROWS = 18, YARD_WIDTH_MAX = 100 };

struct yard {
    char trail[YARD_ROWS][YARD_WIDTH_MAX];
    int width;
    double row_m; /* of a row; a column is half of that, as a character is half as wide as high */
    double length_m; /* of the car, between its axles */
};

/* An empty yard, WIDTH characters wide (YARD_WIDTH_MAX at most), with room for the place and for a
 * car of LENGTH_M between its axles that starts at X_M, Y_M. */
void yard_init(struct yard *yard, double x_m, double y_m, double length_m, int width);

/* The car's rear axle is at X_M, Y_M: draws YARD_ROWS lines. */
void yard_draw(struct yard *yard, double x_m, double y_m, double heading_deg, double steer_deg,
               FILE *out);

#endif
