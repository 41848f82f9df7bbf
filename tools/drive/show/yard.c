/* SPDX-License-Identifier: MIT */
#include "yard.h"

#include <math.h>
#include <string.h>

enum { BELOW_ROWS = 2 }; /* room below Y = 0 */

static const double degree = M_PI / 180, margin = 1.25;
static const double place_m = 2; /* wide; as long as the car */

void yard_init(struct yard *yard, double x_m, double y_m, double length_m, int width)
{
    double high_m = margin * (y_m + length_m) / (YARD_ROWS - BELOW_ROWS);
    double wide_m = 4 * (margin * fabs(x_m) + length_m) / width;

    memset(yard->trail, ' ', sizeof yard->trail);
    yard->width = width;
    yard->row_m = fmax(high_m, wide_m);
    yard->length_m = length_m;
}

/* The character of PICTURE at a place, or NULL: outside. */
static char *at(const struct yard *yard, char picture[YARD_ROWS][YARD_WIDTH_MAX], double x_m,
                double y_m)
{
    long row = YARD_ROWS - 1 - BELOW_ROWS - lround(y_m / yard->row_m);
    long column = yard->width / 2 + lround(2 * x_m / yard->row_m);

    if (row < 0 || row >= YARD_ROWS || column < 0 || column >= yard->width) {
        return NULL;
    }
    return &picture[row][column];
}

static void put(const struct yard *yard, char picture[YARD_ROWS][YARD_WIDTH_MAX], double x_m,
                double y_m, char mark)
{
    char *place = at(yard, picture, x_m, y_m);

    if (place != NULL) {
        *place = mark;
    }
}

/* A line in that direction: one of - / | \ */
static char stroke(double angle_deg)
{
    return "-/|\\"[(int)(lround(angle_deg / 45) % 4 + 4) % 4];
}

void yard_draw(struct yard *yard, double x_m, double y_m, double heading_deg, double steer_deg,
               FILE *out)
{
    char picture[YARD_ROWS][YARD_WIDTH_MAX];
    double along_x = cos(heading_deg * degree), along_y = sin(heading_deg * degree);
    double step_m = yard->row_m / 4;

    put(yard, yard->trail, x_m, y_m, '.');
    memcpy(picture, yard->trail, sizeof picture);
    for (double side_m = 0; side_m <= yard->length_m; side_m += step_m) {
        put(yard, picture, -place_m / 2 - yard->row_m / 4, side_m, '[');
        /* cppcheck-suppress duplicateExpression ; place_m is 2 m by chance */
        put(yard, picture, place_m / 2 + yard->row_m / 4, side_m, ']');
    }
    for (double part_m = 0; part_m <= yard->length_m; part_m += step_m) {
        put(yard, picture, x_m + part_m * along_x, y_m + part_m * along_y, '#');
    }
    put(yard, picture, x_m, y_m, 'o');
    put(yard, picture, x_m + yard->length_m * along_x, y_m + yard->length_m * along_y,
        stroke(heading_deg + steer_deg));
    for (int row = 0; row < YARD_ROWS; row++) {
        fprintf(out, "%.*s\033[K\n", yard->width, picture[row]);
    }
}
