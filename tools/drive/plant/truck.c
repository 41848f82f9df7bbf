/* SPDX-License-Identifier: MIT */
#include "truck.h"

#include <math.h>

static const double aligned_m = 0.4, aligned_rad = 2 * M_PI / 180;

/* Where a truck is after T_S on its circle. */
static struct truck after(const struct truck *truck, double turn_radps, double t_s)
{
    double v = truck->speed_mps, from = truck->heading_rad, to = from + turn_radps * t_s;
    struct truck moved = *truck;

    moved.heading_rad = to;
    if (fabs(turn_radps * t_s) < 1e-9) {
        moved.x_m -= v * t_s * cos(from);
        moved.y_m -= v * t_s * sin(from);
    } else {
        moved.x_m -= v / turn_radps * (sin(to) - sin(from));
        moved.y_m += v / turn_radps * (cos(to) - cos(from));
    }
    return moved;
}

double truck_drive(struct truck *truck, double steer_rad, double dt_s)
{
    double turn_radps = -truck->speed_mps / truck->length_m * tan(steer_rad);
    struct truck end = after(truck, turn_radps, dt_s);
    double low = 0, high = dt_s;

    if (end.y_m > 0) {
        *truck = end;
        return dt_s;
    }
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);

        if (after(truck, turn_radps, middle).y_m > 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *truck = after(truck, turn_radps, high);
    truck->y_m = 0;
    return high;
}

bool truck_step(struct truck *truck, double steer_rad, double dt_s)
{
    double dx = -truck->speed_mps * cos(truck->heading_rad) * dt_s;
    double dy = -truck->speed_mps * sin(truck->heading_rad) * dt_s;
    double turn = -truck->speed_mps / truck->length_m * tan(steer_rad) * dt_s;
    bool arrives = truck->y_m + dy <= 0;
    double part = arrives && dy < 0 ? truck->y_m / -dy : 1;

    truck->x_m += dx * part;
    truck->y_m = arrives ? 0 : truck->y_m + dy;
    truck->heading_rad += turn * part;
    return arrives;
}

double truck_turn_rad(const struct truck *truck)
{
    return remainder(truck->heading_rad - M_PI / 2, 2 * M_PI);
}

bool truck_is_aligned(const struct truck *truck)
{
    return fabs(truck->x_m) < aligned_m && fabs(truck_turn_rad(truck)) < aligned_rad;
}

/* A corner of the outline, 0..3. */
static void corner(const struct truck *truck, int which, double *x_m, double *y_m)
{
    double ahead_m = which < 2 ? truck->length_m + truck->overhang_m : -truck->overhang_m;
    double left_m = (which % 2 ? 0.5 : -0.5) * truck->width_m;
    double along_x = cos(truck->heading_rad), along_y = sin(truck->heading_rad);

    *x_m = truck->x_m + ahead_m * along_x - left_m * along_y;
    *y_m = truck->y_m + ahead_m * along_y + left_m * along_x;
}

bool truck_fits(const struct truck *truck, double place_m)
{
    for (int i = 0; i < 4; i++) {
        double x_m, y_m;

        corner(truck, i, &x_m, &y_m);
        if (fabs(x_m) > place_m / 2) {
            return false;
        }
    }
    return sin(truck->heading_rad) > 0;
}

bool truck_touches(const struct truck *truck, const struct lot *lot)
{
    for (int i = 0; i < 4; i++) {
        double x_m, y_m;

        corner(truck, i, &x_m, &y_m);
        if (x_m <= lot->west_m || x_m >= lot->east_m || y_m <= lot->south_m ||
            y_m >= lot->north_m) {
            return true;
        }
    }
    return false;
}
