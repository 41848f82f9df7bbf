/* SPDX-License-Identifier: MIT */
/* Without an argument, runs the parking controller from the 3,780 starts of the study: x from -20
 * to 20 m and y from 2 to 30 m in steps of 2 m, heading from -90 to 240 degrees in steps of 30. The
 * car drives at 5 m/s in Euler steps of 20 ms. Prints one line of CSV a start: the end with the
 * firmware's own decision, in integers, and whether the same laws in floating point park the car,
 * too.
 *
 * With a number N, from N starts at random: x and y up to 39 m, any heading. The controller checks
 * each start first. Prints for each whether it says that the start is in the dead zone; what comes
 * of the drive when it does not check (parked, beside, out_of_range, nowhere); and the way. */
#include "cc51.h"
#include "park.h"
#include "lut_table.h"
#include "plan.h"
#include "random.h"
#include "truck.h"

#include "diag.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double step_s = 0.02, degree = M_PI / 180, given_up_m = 60;
static const double place_m = 3;
static const struct truck any_truck = {
    .speed_mps = 5, .length_m = 4, .width_m = 2, .overhang_m = 0.9};
enum { STEPS = 5000 };

/* Outside this range the controller refuses the frame. */
static bool is_in_range(const struct truck *truck)
{
    return fabs(truck->x_m) * 512 <= PARK_X_MAX_512 && truck->y_m * 512 <= PARK_Y_MAX_512;
}

static void place(const struct truck *truck)
{
    park.x = (int16_t)lround(truck->x_m * 512);
    park.y = (int16_t)lround(truck->y_m * 512);
    park.heading = (uint16_t)lround(truck->heading_rad / (2 * M_PI) * 65536);
}

static double firmware_rad(const struct truck *truck)
{
    if (!is_in_range(truck)) {
        return park.theta * 2 * M_PI / 65536; /* it keeps its steering angle */
    }
    place(truck);
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
            return truck_is_aligned(truck);
        }
    }
    return false;
}

static bool is_told(const struct truck *truck)
{
    park_init();
    place(truck);
    do {
        park_decide();
    } while (park.state == PARK_CHECKING);
    return park.state == PARK_DEAD_ZONE;
}

static const char *end_of(struct truck *truck, double *way_m)
{
    for (int i = 0; i < STEPS; i++) {
        double used_s;

        if (!is_in_range(truck)) {
            return "out_of_range";
        }
        used_s = truck_drive(truck, firmware_rad(truck), step_s);
        *way_m += used_s * truck->speed_mps;
        if (truck->y_m <= 0) {
            return truck_fits(truck, place_m) ? "parked" : "beside";
        }
    }
    return "nowhere";
}

static void run_random(long count)
{
    struct random random;

    random_seed(&random, 1);
    puts("x_m,y_m,heading_deg,told,end,way_m");
    for (long i = 0; i < count; i++) {
        struct truck truck = any_truck;
        double x_m, y_m, way_m = 0;
        bool told;

        truck.x_m = x_m = -39 + 78 * random_uniform(&random);
        truck.y_m = y_m = 0.1 + 38.9 * random_uniform(&random);
        truck.heading_rad = 2 * M_PI * random_uniform(&random);
        told = is_told(&truck);
        printf("%.3f,%.3f,%.2f,%d,", x_m, y_m, truck.heading_rad / degree, told);
        printf("%s,", end_of(&truck, &way_m));
        printf("%.1f\n", way_m);
    }
}

static void run_grid(void)
{
    puts("x_m,y_m,heading_deg,parked,end_x_m,end_turn_deg,parked_float");
    for (int x = -20; x <= 20; x += 2) {
        for (int y = 2; y <= 30; y += 2) {
            for (int heading = -90; heading <= 240; heading += 30) {
                struct truck truck = any_truck, twin;
                bool parked, parked_float;

                truck.x_m = x;
                truck.y_m = y;
                truck.heading_rad = heading * degree;
                twin = truck;
                parked = parks(&truck, firmware_rad);
                parked_float = parks(&twin, published_rad);

                printf("%d,%d,%d,%d,%.3f,%.2f,%d\n", x, y, heading, parked, truck.x_m,
                       truck_turn_rad(&truck) / degree, parked_float);
            }
        }
    }
}

int main(int argc, char **argv)
{
    char *end = NULL;
    long count = argc == 2 ? strtol(argv[1], &end, 10) : 0;

    if (argc > 2 || (argc == 2 && (count < 1 || *end != '\0'))) {
        diag_error(NULL, 0, "give the number of random starts, or nothing for the study's grid");
        return EXIT_USAGE;
    }
    if (count > 0) {
        run_random(count);
    } else {
        run_grid();
    }
    return ferror(stdout) != 0 || fflush(stdout) != 0 ? EXIT_INPUT : EXIT_FINE;
}
