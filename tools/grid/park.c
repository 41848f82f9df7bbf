/* SPDX-License-Identifier: MIT */
/* Runs the parking controller from the 3,780 starts of the study: x from -20 to 20 m and y from 2
 * to 30 m in steps of 2 m, heading from -90 to 240 degrees in steps of 30. The car drives at 5 m/s
 * in Euler steps of 20 ms. Prints one line of CSV a start: the end with the firmware's own
 * decision, in integers, and whether the same laws in floating point park the car, too. */
#include "cc51.h"
#include "park.h"
#include "lut_table.h"
#include "truck.h"

#include <math.h>
#include <stdio.h>

static const double step_s = 0.02, degree = M_PI / 180, given_up_m = 60;
enum { STEPS = 5000 };

static double firmware_rad(const struct truck *truck)
{
    /* Outside the range of its frame the controller refuses and keeps its steering angle. */
    if (fabs(truck->x_m) * 512 > PARK_X_MAX_512 || truck->y_m * 512 > PARK_Y_MAX_512) {
        return park.theta * 2 * M_PI / 65536;
    }
    park.x = (int16_t)lround(truck->x_m * 512);
    park.y = (int16_t)lround(truck->y_m * 512);
    park.heading = (uint16_t)lround(truck->heading_rad / (2 * M_PI) * 65536);
    park_steer();
    return park.theta * 2 * M_PI / 65536;
}

static double limited(double angle_rad)
{
    return fmin(fmax(angle_rad, -45 * degree), 45 * degree);
}

static double published_rad(const struct truck *truck)
{
    const double from_m = LUT_IN1_MIN_MILLI / 1000.0, span_m = (double)LUT_IN1_SPAN_MILLI / 1000.0;
    double phi = -atan2(truck->x_m, truck->y_m), delta = truck_turn_rad(truck);
    double far_law = limited(-3 * phi + 2 * remainder(delta - phi, 2 * M_PI));
    double near_law = limited(truck->x_m / 8 + delta);
    double w = fmin(fmax((hypot(truck->x_m, truck->y_m) - from_m) / span_m, 0), 1);

    return w * far_law + (1 - w) * near_law;
}

static bool parks(struct truck *truck, double (*steer_rad)(const struct truck *truck))
{
    for (int i = 0; i < STEPS && hypot(truck->x_m, truck->y_m) < given_up_m; i++) {
        if (truck_step(truck, steer_rad(truck), step_s)) {
            return truck_is_parked(truck);
        }
    }
    return false;
}

int main(void)
{
    puts("x_m,y_m,heading_deg,parked,end_x_m,end_turn_deg,parked_float");
    for (int x = -20; x <= 20; x += 2) {
        for (int y = 2; y <= 30; y += 2) {
            for (int heading = -90; heading <= 240; heading += 30) {
                struct truck truck = {x, y, heading * degree, 5, 4}, twin = truck;
                bool parked = parks(&truck, firmware_rad);
                bool parked_float = parks(&twin, published_rad);

                printf("%d,%d,%d,%d,%.3f,%.2f,%d\n", x, y, heading, parked, truck.x_m,
                       truck_turn_rad(&truck) / degree, parked_float);
            }
        }
    }
    return 0;
}
