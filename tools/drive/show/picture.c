/* SPDX-License-Identifier: MIT */
#include "picture.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

enum { BAR_LEFT = 24 }; /* characters before a bar */

static void repeat(const struct picture *picture, const char *text, int count)
{
    while (count-- > 0) {
        fputs(text, picture->out);
    }
}

void picture_text(struct picture *picture, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vfprintf(picture->out, format, arguments);
    va_end(arguments);
}

void picture_end(struct picture *picture)
{
    fputs("\033[K\n", picture->out);
    picture->lines++;
}

/* --- lines and roads ------------------------------------------------------------------------ */

void picture_bar(struct picture *picture, const char *name, double value, const char *unit,
                 double part)
{
    int width = picture->width - BAR_LEFT;
    int full = (int)(fmin(fmax(part, 0), 1) * width + 0.5);

    if (isnan(value)) {
        picture_text(picture, " %-8s %7s %-4s  ", name, "-", "");
    } else {
        picture_text(picture, " %-8s %7.2f %-4s  ", name, value, unit);
    }
    repeat(picture, picture->is_utf8 ? "\u2588" : "#", full);
    repeat(picture, picture->is_utf8 ? "\u2591" : ".", width - full);
    picture_end(picture);
}

void picture_rail(struct picture *picture)
{
    repeat(picture, picture->is_utf8 ? "\u2500" : "-", picture->width);
    picture_end(picture);
}

void picture_closed_lane(struct picture *picture, char character)
{
    const char text[] = {' ', character, '\0'};

    repeat(picture, text, picture->width / 2);
    picture_end(picture);
}

void picture_lane(struct picture *picture, bool has_own, double gap_m, double mark_m)
{
    static const char ego[] = "[##>", lead[] = "[##]";
    int lane = picture->width - (int)(sizeof ego + sizeof lead) + 1;
    int gap = isnan(gap_m) ? lane : (int)(gap_m / picture->view_m * lane);
    int mark = isnan(mark_m) ? -1 : (int)(mark_m / picture->view_m * lane);
    bool in_sight = !isnan(gap_m) && gap <= lane;

    gap = gap < 0 ? 0 : gap > lane ? lane : gap;
    picture_text(picture, "%s", has_own ? ego : "    ");
    for (int i = 0; i < gap; i++) {
        const char *dot = picture->is_utf8 ? "\u00b7" : ".";

        fputs(i == mark ? "|" : i % 4 == 3 ? dot : " ", picture->out);
    }
    picture_text(picture, "%s", in_sight ? lead : "");
    if (in_sight && mark >= gap + (int)sizeof lead && mark < lane) {
        picture_text(picture, "%*s", mark - gap - (int)sizeof lead + 2, "|");
    }
    picture_end(picture);
}

/* --- plans ---------------------------------------------------------------------------------- */

void plan_begin(struct picture *picture, int rows, double row_m, double column_m, int zero_row)
{
    if (picture->rows > 0) {
        return;
    }
    picture->rows = rows < PLAN_ROWS_MAX ? rows : PLAN_ROWS_MAX;
    picture->row_m = row_m;
    picture->column_m = column_m;
    picture->zero_row = zero_row;
    picture->zero_column = picture->width / 2;
    memset(picture->ground, ' ', sizeof picture->ground);
    memset(picture->now, ' ', sizeof picture->now);
}

static void put(const struct picture *picture, char plan[][PICTURE_WIDTH_MAX], double x_m,
                double y_m, char character)
{
    double row = picture->zero_row - y_m / picture->row_m;
    double column = picture->zero_column + x_m / picture->column_m;

    if (row > -0.5 && row < picture->rows - 0.5 && column > -0.5 && column < picture->width - 0.5) {
        plan[lround(row)][lround(column)] = character;
    }
}

void plan_mark(struct picture *picture, double x_m, double y_m, char character)
{
    put(picture, picture->ground, x_m, y_m, character);
    put(picture, picture->now, x_m, y_m, character);
}

void plan_put(struct picture *picture, double x_m, double y_m, char character)
{
    put(picture, picture->now, x_m, y_m, character);
}

void plan_draw(struct picture *picture)
{
    for (int row = 0; row < picture->rows; row++) {
        picture_text(picture, "%.*s", picture->width, picture->now[row]);
        picture_end(picture);
    }
    memcpy(picture->now, picture->ground, sizeof picture->now);
}
