/* SPDX-License-Identifier: MIT */
/* What a world draws of a run in the terminal: lines of text, bars, a road, or a plan from above. A
 * picture is drawn over again for each frame; the ground of a plan stays. */
#ifndef FUZZY51_PICTURE_H
#define FUZZY51_PICTURE_H

#include <stdbool.h>
#include <stdio.h>

enum { PICTURE_WIDTH_MAX = 100, PLAN_ROWS_MAX = 18 };

struct picture {
    FILE *out;
    int width; /* characters in a line, PICTURE_WIDTH_MAX at most */
    bool is_utf8;
    double view_m; /* length of a road on the screen */
    int lines;     /* of this frame so far */

    /* The plan from above: x to the right, y up. */
    int rows;                  /* 0: plan_begin was not called yet */
    double row_m, column_m;    /* size of a character */
    int zero_row, zero_column; /* where x = y = 0 is */
    char ground[PLAN_ROWS_MAX][PICTURE_WIDTH_MAX], now[PLAN_ROWS_MAX][PICTURE_WIDTH_MAX];
};

/* Adds to the line; `picture_end` ends it. */
void picture_text(struct picture *picture, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void picture_end(struct picture *picture);

/* A line " NAME  VALUE UNIT  ####....", in which PART (0..1) of the bar is full. */
void picture_bar(struct picture *picture, const char *name, double value, const char *unit,
                 double part);

/* A line across, the side of a road. */
void picture_rail(struct picture *picture);

/* A lane: the own car if HAS_OWN, the open road, the car ahead GAP_M further (NAN: none), and a
 * mark MARK_M ahead of the own car (NAN: none). */
void picture_lane(struct picture *picture, bool has_own, double gap_m, double mark_m);

/* A lane full of CHARACTER. */
void picture_closed_lane(struct picture *picture, char character);

/* An empty plan of ROWS lines, unless there is one already. */
void plan_begin(struct picture *picture, int rows, double row_m, double column_m, int zero_row);

/* CHARACTER at X_M, Y_M: for ever (on the ground), or for this frame. */
void plan_mark(struct picture *picture, double x_m, double y_m, char character);
void plan_put(struct picture *picture, double x_m, double y_m, char character);

/* Draws the plan. */
void plan_draw(struct picture *picture);

#endif
