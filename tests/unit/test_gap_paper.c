/* SPDX-License-Identifier: MIT */
/* The gap controller as published: the printed values of its specification, its table between the
 * nodes, and its integers against the laws in floating point. */
#define GAP_AS_PUBLISHED
#include <stddef.h>
#include "unity.h"

/* Files under test that want this controller's table. */
#include "lut.c"
#include "gap.c"

#ifndef __SDCC_mcs51
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#endif

void setUp(void)
{
    gap_init();
}

void tearDown(void)
{
}

static void situation(uint16_t gap_cm, uint16_t own_cmps, uint16_t lead_cmps, int16_t lead_cmps2)
{
    gap.gap_cm = gap_cm;
    gap.own_cmps = own_cmps;
    gap.lead_cmps = lead_cmps;
    gap.lead_cmps2 = lead_cmps2;
    gap_decide();
}

/* The table of spot values: gap and speeds in m and m/s; D, and u of the integer model, as printed;
 * u of the laws in floating point beside it. State 3 is a lead that brakes with 6 m/s2. */
static const struct spot {
    uint8_t state, gap_m, own_mps, lead_mps;
    uint16_t safe_mm;
    int16_t accel_cmps2, float_mmps2;
} spots[] = {
    {1, 30, 12, 0, 27800, -305, -3045},  {1, 30, 18, 0, 48200, -756, -7563},
    {3, 30, 18, 18, 21200, 240, 2445},   {1, 20, 10, 0, 22333, -430, -4262},
    {1, 10, 5, 0, 11583, -292, -2842},   {1, 6, 1, 0, 5983, -70, -640},
    {2, 30, 18, 10, 17533, 81, 866},     {2, 15, 20, 15, 11583, -113, -1074},
    {3, 25, 15, 12, 25250, -107, -1037}, {3, 20, 16, 6, 37733, -760, -7582},
    {3, 12, 10, 3, 21583, -568, -5606},  {1, 3, 4, 0, 9933, -440, -4337},
};

static void test_spot_values_are_the_printed_ones(void)
{
    uint8_t i;

    for (i = 0; i < sizeof spots / sizeof spots[0]; i++) {
        const struct spot *spot = &spots[i];

        situation((uint16_t)(spot->gap_m * 100U), (uint16_t)(spot->own_mps * 100U),
                  (uint16_t)(spot->lead_mps * 100U), spot->state == 3 ? -600 : 0);
        TEST_ASSERT_EQUAL_UINT8(spot->state - 1, gap.lead);
        TEST_ASSERT_EQUAL_UINT16(spot->safe_mm / 10, gap.safe_cm);
        TEST_ASSERT_EQUAL_INT16(spot->accel_cmps2, gap.accel_cmps2);
        TEST_ASSERT_INT16_WITHIN(82, spot->float_mmps2, (int16_t)(gap.accel_cmps2 * 10));
    }
}

/* (room, opening) scaled to the table, and what the table's system says, all in thousandths; the
 * table's steps and roundings leave 0.16 below at most. */
static const struct {
    int16_t room, opening, accel_mmps2;
} fuzzy_spots[] = {
    {-2000, -800, -7163}, {-1500, -500, -5690}, {-500, 100, -500}, {0, 0, 0},
    {300, -300, -1256},   {500, 500, 3439},     {2700, 250, 4462}, {3500, -100, 3593},
};

static void test_fuzzy_part_is_the_printed_one(void)
{
    uint8_t i;

    for (i = 0; i < sizeof fuzzy_spots / sizeof fuzzy_spots[0]; i++) {
        int16_t room_cm = (int16_t)(fuzzy_spots[i].room / 2);
        int16_t opening_cmps = (int16_t)(fuzzy_spots[i].opening * 5 / 2);
        int16_t mmps2;

        gap.safe_cm = 2000;
        gap.gap_cm = (uint16_t)(2000 + room_cm);
        gap.own_cmps = 2500;
        gap.lead_cmps = (uint16_t)(2500 + opening_cmps);
        mmps2 = (int16_t)(gap_fuzzy_cmps2() * 10);
        TEST_ASSERT_GREATER_OR_EQUAL_INT16(fuzzy_spots[i].accel_mmps2 - 220, mmps2);
        TEST_ASSERT_LESS_OR_EQUAL_INT16(fuzzy_spots[i].accel_mmps2 + 60, mmps2);
    }
}

static void test_lead_state_follows_speed_then_acceleration(void)
{
    situation(3000, 1000, 5, -600);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_STANDS, gap.lead);
    situation(3000, 1000, 6, -600);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    situation(3000, 1000, 6, -21);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_BRAKES, gap.lead);
    situation(3000, 1000, 6, -20);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
    situation(3000, 1000, 6, 100);
    TEST_ASSERT_EQUAL_UINT8(GAP_LEAD_DRIVES, gap.lead);
}

static void test_safe_distance_grows_with_own_speed_and_never_wraps(void)
{
    uint16_t own_cmps;
    uint16_t last_cm[3] = {0, 0, 0};

    for (own_cmps = 0; own_cmps <= GAP_SPEED_MAX_CMPS; own_cmps += 125) {
        uint8_t lead;

        for (lead = 0; lead < 3; lead++) {
            situation(10000, own_cmps, lead == 0 ? 0 : 2000, lead == 2 ? -600 : 0);
            TEST_ASSERT_GREATER_OR_EQUAL_UINT16(500, gap.safe_cm);
            TEST_ASSERT_GREATER_OR_EQUAL_UINT16(last_cm[lead], gap.safe_cm);
            last_cm[lead] = gap.safe_cm;
        }
    }
    TEST_ASSERT_EQUAL_UINT16(4500 + 20833 + 500, last_cm[0]);
}

static void test_brake_and_throttle_are_never_on_together(void)
{
    uint16_t gap_cm;

    for (gap_cm = 0; gap_cm <= 6000; gap_cm += 300) {
        uint16_t own_cmps;

        for (own_cmps = 0; own_cmps <= 3000; own_cmps += 300) {
            situation(gap_cm, own_cmps, 1000, 0);
            TEST_ASSERT_TRUE(gap.brake_pct == 0 || gap.throttle_us == GAP_THROTTLE_CLOSED_US);
            TEST_ASSERT_LESS_OR_EQUAL_UINT8(100, gap.brake_pct);
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(GAP_THROTTLE_FULL_US, gap.throttle_us);
            TEST_ASSERT_GREATER_OR_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
        }
    }
}

static void test_outputs_are_the_acceleration_to_half_a_percent(void)
{
    situation(3000, 1200, 0, 0); /* -305 cm/s2 is 38.1 % */
    TEST_ASSERT_EQUAL_UINT8(38, gap.brake_pct);
    situation(3000, 1800, 1800, -600); /* 240 cm/s2 is 30 % of the throttle's way */
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(1300, gap.throttle_us);
    situation(0, 5000, 0, 0);
    TEST_ASSERT_INT16_WITHIN(45, -800, gap.accel_cmps2); /* the table's own end is 7.16 m/s2 */
    TEST_ASSERT_EQUAL_UINT8((-gap.accel_cmps2 + 4) / 8, gap.brake_pct);
}

static void test_brake_holds_through_the_last_creep(void)
{
    situation(480, 29, 0, 0);
    TEST_ASSERT_LESS_OR_EQUAL_INT16(-GAP_HOLD_CMPS2, gap.accel_cmps2);
    situation(500, 0, 0,
              0); /* as far as it should be, on the mark: the law alone says next to nothing */
    TEST_ASSERT_EQUAL_INT16(-GAP_HOLD_CMPS2, gap.accel_cmps2);
}

static void expect_accel(int16_t accel_cmps2, uint16_t gap_cm, uint16_t own_cmps,
                         uint16_t lead_cmps)
{
    situation(gap_cm, own_cmps, lead_cmps, 0);
    TEST_ASSERT_EQUAL_INT16(accel_cmps2, gap.accel_cmps2);
}

/* What the law itself says here: 29, 30; 26, 31; 0; then 29 and, with less room, a brake. */
static void test_car_does_not_creep_up_to_one_that_stands(void)
{
    expect_accel(-GAP_HOLD_CMPS2, 616, 0, 0);
    expect_accel(30, 620, 0, 0);
    expect_accel(-GAP_HOLD_CMPS2, 696, 29, 0);
    expect_accel(31, 700, 29, 0);
    expect_accel(0, 604, GAP_CREEP_CMPS, 0);
    expect_accel(29, 592, 0, 6);
    expect_accel(0, 504, 0, 6);
    expect_accel(-GAP_HOLD_CMPS2, 500, 0, 6);
}

static void test_no_room_never_accelerates_and_much_room_never_brakes(void)
{
    uint16_t own_cmps;

    for (own_cmps = 0; own_cmps <= 5000; own_cmps += 250) {
        situation(100, own_cmps, own_cmps, 0);
        TEST_ASSERT_LESS_THAN_INT16(0, gap.accel_cmps2);
        situation(24999, own_cmps, own_cmps, 0);
        TEST_ASSERT_GREATER_THAN_INT16(0, gap.accel_cmps2);
    }
}

static void test_nobody_ahead_leaves_brake_and_throttle_alone(void)
{
    situation(GAP_MAX_CM, 3000, 0, 0);
    TEST_ASSERT_EQUAL_INT16(0, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
}

static void payload(uint16_t gap_cm, uint16_t own_cmps, uint16_t lead_cmps, int16_t lead_cmps2)
{
    frame_body[0] = (uint8_t)(gap_cm >> 8);
    frame_body[1] = (uint8_t)gap_cm;
    frame_body[2] = (uint8_t)(own_cmps >> 8);
    frame_body[3] = (uint8_t)own_cmps;
    frame_body[4] = (uint8_t)(lead_cmps >> 8);
    frame_body[5] = (uint8_t)lead_cmps;
    frame_body[6] = (uint8_t)((uint16_t)lead_cmps2 >> 8);
    frame_body[7] = (uint8_t)lead_cmps2;
    frame_body[8] = 0;
}

static void test_payload_out_of_range_is_refused_and_changes_nothing(void)
{
    payload(3000, 1200, 900, -600);
    TEST_ASSERT_TRUE(gap_read());
    payload(25001, 0, 0, 0);
    TEST_ASSERT_FALSE(gap_read());
    payload(0, 5001, 0, 0);
    TEST_ASSERT_FALSE(gap_read());
    payload(0, 0, 5001, 0);
    TEST_ASSERT_FALSE(gap_read());
    payload(0, 0, 0, 1501);
    TEST_ASSERT_FALSE(gap_read());
    payload(0, 0, 0, -1501);
    TEST_ASSERT_FALSE(gap_read());
    TEST_ASSERT_EQUAL_UINT16(3000, gap.gap_cm);
    TEST_ASSERT_EQUAL_UINT16(1200, gap.own_cmps);
    TEST_ASSERT_EQUAL_UINT16(900, gap.lead_cmps);
    TEST_ASSERT_EQUAL_INT16(-600, gap.lead_cmps2);
    payload(25000, 5000, 5000, 1500);
    TEST_ASSERT_TRUE(gap_read());
    payload(0, 0, 0, -1500);
    TEST_ASSERT_TRUE(gap_read());
}

static void test_car_waits_braked_and_a_lost_link_brakes(void)
{
    TEST_ASSERT_TRUE(gap.stop);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);
    gap_lose(60); /* nothing was up yet */
    TEST_ASSERT_TRUE(gap.stop);
    TEST_ASSERT_EQUAL_UINT8(100, gap.brake_pct);

    situation(20000, 1000, 1000, 0);
    TEST_ASSERT_FALSE(gap.stop);
    TEST_ASSERT_EQUAL_UINT8(GAP_CONTROL, gap.state);
    TEST_ASSERT_EQUAL_UINT8(0, gap.brake_pct);
    TEST_ASSERT_GREATER_THAN_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);

    gap_lose(60);
    TEST_ASSERT_EQUAL_UINT8(GAP_FAULT, gap.state);
    TEST_ASSERT_EQUAL_UINT8(60, gap.brake_pct);
    TEST_ASSERT_EQUAL_INT16(-480, gap.accel_cmps2);
    TEST_ASSERT_EQUAL_UINT16(GAP_THROTTLE_CLOSED_US, gap.throttle_us);
    TEST_ASSERT_FALSE(gap.stop);
}

static void test_lost_link_never_lowers_the_brake(void)
{
    situation(1000, 2000, 0, 0);
    TEST_ASSERT_GREATER_THAN_UINT8(80, gap.brake_pct);
    gap_lose(60);
    TEST_ASSERT_GREATER_THAN_UINT8(80, gap.brake_pct);
    gap_lose(0);
    TEST_ASSERT_GREATER_THAN_UINT8(80, gap.brake_pct);
}

static void test_a_node_is_met_exactly(void)
{
    uint8_t row, col;

    for (row = 0; row < LUT_IN1_CELLS; row++) {
        for (col = 0; col < LUT_IN2_CELLS; col++) {
            TEST_ASSERT_EQUAL_UINT8(lut_at(row, col), lut_between((uint16_t)((uint16_t)row << 8),
                                                                  (uint16_t)((uint16_t)col << 8)));
        }
    }
}

/* 256 * 256 times the plane through the four nodes around. */
static uint32_t plane(uint16_t row_q8, uint16_t col_q8)
{
    uint8_t row = (uint8_t)(row_q8 >> 8), col = (uint8_t)(col_q8 >> 8);
    uint32_t down = row_q8 & 255, right = col_q8 & 255;

    return (256 - down) *
               ((256 - right) * lut_at(row, col) + right * lut_at(row, (uint8_t)(col + 1))) +
           down * ((256 - right) * lut_at((uint8_t)(row + 1), col) +
                   right * lut_at((uint8_t)(row + 1), (uint8_t)(col + 1)));
}

static void test_between_nodes_it_is_the_plane_less_two_levels_at_most(void)
{
    uint16_t row_q8, col_q8;

    /* Steps that share no factor with a cell. */
    for (row_q8 = 0; row_q8 < LUT_IN1_CELLS * 256U; row_q8 += 397) {
        for (col_q8 = 0; col_q8 < LUT_IN2_CELLS * 256U; col_q8 += 211) {
            uint32_t level = lut_between(row_q8, col_q8);
            uint32_t wanted = plane(row_q8, col_q8);

            TEST_ASSERT_TRUE(level << 16 <= wanted);
            TEST_ASSERT_TRUE((level + 2) << 16 > wanted);
        }
    }
}

static void test_last_position_stays_inside(void)
{
    uint8_t corner = lut_at(LUT_IN1_CELLS, LUT_IN2_CELLS);

    TEST_ASSERT_UINT8_WITHIN(2, corner,
                             lut_between(LUT_IN1_CELLS * 256U - 1U, LUT_IN2_CELLS * 256U - 1U));
}

static void test_check_sum_is_the_headers(void)
{
    uint16_t crc = LUT_CRC16_START, offset = 0;

    while (offset != LUT_BYTES) {
        uint16_t left = LUT_BYTES - offset;
        uint8_t count = left < 100 ? (uint8_t)left : 100;

        crc = lut_crc16(crc, offset, count);
        offset += count;
    }
    TEST_ASSERT_EQUAL_HEX16(LUT_CRC16, crc);
}

#ifndef __SDCC_mcs51

/* Unity is built without doubles. */
static void assert_from_to(double low, double high, double actual, int line)
{
    char text[100];

    snprintf(text, sizeof text, "%.4f is not from %.4f to %.4f", actual, low, high);
    UNITY_TEST_ASSERT(actual >= low && actual <= high, (UNITY_LINE_TYPE)line, text);
}
#define WITHIN(delta, expected, actual)                                                            \
    assert_from_to((expected) - (delta), (expected) + (delta), actual, __LINE__)

static double clamped(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* A triangle of the tables/gap.fis, by its peak and the feet beside it. */
static double triangle(double x, double a, double b, double c)
{
    if (x <= a || x >= c) {
        return 0;
    }
    return x <= b ? (x - a) / (b - a) : (c - x) / (c - b);
}

/* The system of tables/gap.fis written down a second time: min, max, centroid of 101 samples. */
static double fuzzy_mps2(double room, double opening)
{
    static const double rooms[7] = {-3, -2, -1, 0, 2, 4, 6};
    static const int rules[5][5] = {
        {0, 0, 1, 2, 3}, {0, 1, 2, 3, 4}, {1, 2, 3, 4, 4}, {2, 3, 4, 5, 5}, {3, 4, 5, 6, 6}};
    double strength[7] = {0}, moment = 0, area = 0;

    room = clamped(room, -2, 4);
    opening = clamped(opening, -0.8, 0.8);
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            double both = fmin(triangle(room, rooms[i], rooms[i + 1], rooms[i + 2]),
                               triangle(opening, 0.4 * (j - 3), 0.4 * (j - 2), 0.4 * (j - 1)));
            strength[rules[i][j]] = fmax(strength[rules[i][j]], both);
        }
    }
    for (int sample = 0; sample <= 100; sample++) {
        double y = -8 + 0.16 * sample, mu = 0;

        for (int set = 0; set < 7; set++) {
            double peak = 8.0 / 3 * (set - 3);
            mu = fmax(mu, fmin(strength[set], triangle(y, peak - 8.0 / 3, peak, peak + 8.0 / 3)));
        }
        moment += mu * y;
        area += mu;
    }
    return moment / area;
}

/* The laws, in metres and seconds. */
static double accel_mps2(double gap_m, double own_mps, double lead_mps, double lead_mps2)
{
    double v = own_mps, safe_m, h, lq;

    if (lead_mps > 0.05 && lead_mps2 >= -0.2) {
        v = fmax(own_mps - lead_mps, 0);
    }
    safe_m = v * 0.9 + v * v / 12;
    if (lead_mps > 0.05 && lead_mps2 < -0.2) {
        safe_m = fmax(0, safe_m - lead_mps * lead_mps / 12);
    }
    safe_m += 5;
    h = 0.9 + v / 6;
    lq = clamped(-0.3 * (safe_m - gap_m) - (own_mps - lead_mps) / h, -8, 8);
    return clamped(0.5 * lq + 0.5 * fuzzy_mps2(0.2 * (gap_m - safe_m), 0.04 * (lead_mps - own_mps)),
                   -8, 8);
}

static void test_floating_point_laws_give_the_printed_values(void)
{
    for (size_t i = 0; i < sizeof spots / sizeof spots[0]; i++) {
        WITHIN(0.0006, spots[i].float_mmps2 / 1000.0,
               accel_mps2(spots[i].gap_m, spots[i].own_mps, spots[i].lead_mps,
                          spots[i].state == 3 ? -6 : 0));
    }
    for (size_t i = 0; i < sizeof fuzzy_spots / sizeof fuzzy_spots[0]; i++) {
        WITHIN(0.0006, fuzzy_spots[i].accel_mmps2 / 1000.0,
               fuzzy_mps2(fuzzy_spots[i].room / 1000.0, fuzzy_spots[i].opening / 1000.0));
    }
}

static void test_integers_are_the_laws_to_0_17_mps2(void)
{
    double worst = 0, squares = 0, bias = 0;
    int count = 0;

    srand(51);
    for (; count < 40000; count++) {
        uint16_t gap_cm = (uint16_t)(rand() % 8000), own_cmps = (uint16_t)(30 + rand() % 2970);
        uint16_t lead_cmps = (uint16_t)(rand() % 4 == 0 ? 0 : rand() % 3000);
        int16_t lead_cmps2 = (int16_t)(rand() % 1200 - 600);
        double error;

        situation(gap_cm, own_cmps, lead_cmps, lead_cmps2);
        error = gap.accel_cmps2 / 100.0 -
                accel_mps2(gap_cm / 100.0, own_cmps / 100.0, lead_cmps / 100.0, lead_cmps2 / 100.0);
        worst = fmax(worst, fabs(error));
        squares += error * error;
        bias += error;
    }
    printf("integer against floating point: worst %.3f, rms %.3f, mean %.3f m/s2\n", worst,
           sqrt(squares / count), bias / count);
    assert_from_to(0, 0.17, worst, __LINE__);
    assert_from_to(0, 0.06, sqrt(squares / count), __LINE__);
}

/* The published cases in closed loop: the car follows the command with a lag of 0.2 s, control
 * every 0.05 s, Euler steps of 0.01 s. */
struct run {
    double gap_m, end_s, least_mps2, least_s, first_mps2, at_0_4_mps2, last_mps2, fastest_mps;
    double apart_s; /* when the relative speed was largest */
};

static struct run run(int number, bool integer)
{
    double own_mps = number == 1 ? 12 : 18, lead_mps = number == 3 ? 18 : 0;
    double gap_m = 30, a_mps2 = 0, u_mps2 = 0, apart_mps = -1;
    struct run r = {.gap_m = 0};

    for (int step = 0; step < 2000 && gap_m > 0 && (own_mps > 0 || lead_mps > 0); step++) {
        if (step % 5 == 0) {
            double lead_mps2 = number == 3 && lead_mps > 0 ? -6 : 0;

            if (integer) {
                situation((uint16_t)lround(gap_m * 100), (uint16_t)lround(own_mps * 100),
                          (uint16_t)lround(lead_mps * 100), (int16_t)lround(lead_mps2 * 100));
                u_mps2 = gap.accel_cmps2 / 100.0;
            } else {
                u_mps2 = accel_mps2(gap_m, own_mps, lead_mps, lead_mps2);
                if (own_mps < 0.3 && u_mps2 < 0) {
                    u_mps2 = fmin(u_mps2, -0.3);
                }
            }
            if (step == 0) {
                r.first_mps2 = u_mps2;
            }
        }
        if (own_mps - lead_mps > apart_mps) {
            apart_mps = own_mps - lead_mps;
            r.apart_s = step * 0.01;
        }
        a_mps2 += (u_mps2 - a_mps2) * 0.01 / 0.2;
        if (step == 40) {
            r.at_0_4_mps2 = a_mps2;
        }
        if (a_mps2 < r.least_mps2) {
            r.least_mps2 = a_mps2;
            r.least_s = step * 0.01;
        }
        own_mps = fmax(0, own_mps + a_mps2 * 0.01);
        r.fastest_mps = fmax(r.fastest_mps, own_mps);
        if (number == 3) {
            lead_mps = fmax(0, lead_mps - 0.06);
        }
        gap_m += (lead_mps - own_mps) * 0.01;
        r.end_s = (step + 1) * 0.01;
        r.last_mps2 = u_mps2;
    }
    r.gap_m = gap_m;
    return r;
}

static const double paper_m[3] = {5, 2, 4}, reference_m[3] = {4.67, 2.55, 3.69},
                    integer_m[3] = {4.71, 2.61, 3.80}, reference_s[3] = {5.47, 3.72, 5.86};

static void test_published_cases_end_where_they_should(void)
{
    for (int i = 0; i < 3; i++) {
        struct run real = run(i + 1, false), integer = run(i + 1, true);

        printf("case %d: integer %.2f m %.2f s, floating point %.2f m %.2f s\n", i + 1,
               integer.gap_m, integer.end_s, real.gap_m, real.end_s);
        WITHIN(1, paper_m[i], integer.gap_m);
        WITHIN(0.25, real.gap_m, integer.gap_m);
        WITHIN(0.01, reference_m[i], real.gap_m);
        WITHIN(0.015, integer_m[i], integer.gap_m);
        WITHIN(0.1, reference_s[i], real.end_s);
    }
}

static void test_published_cases_have_the_stated_shapes(void)
{
    struct run first = run(1, true), second = run(2, true), third = run(3, true);

    WITHIN(0.06, -3.05, first.at_0_4_mps2);
    WITHIN(0.05, -3.61, first.least_mps2);
    WITHIN(0.05, 0.9, first.least_s);
    assert_from_to(-0.5, 0, first.last_mps2, __LINE__);

    WITHIN(0.05, -7.51, second.least_mps2);
    WITHIN(0.05, 1.05, second.least_s);

    WITHIN(0.06, 2.45, third.first_mps2);
    WITHIN(0.05, 18.35, third.fastest_mps);
    WITHIN(0.011, 3.0, third.apart_s);
    WITHIN(0.05, -5.05, third.least_mps2);
    WITHIN(0.05, 3.05, third.least_s);
}

/* Every reciprocal in gap.c, over all that it can be asked. */
static void test_reciprocals_are_exact_divisions(void)
{
    for (uint32_t n = 0; n <= UINT16_MAX; n++) {
        TEST_ASSERT_EQUAL_UINT16(n / 10, mul_hi_u16((uint16_t)n, 52429U) >> 3);
        TEST_ASSERT_EQUAL_UINT16(n / 6, mul_hi_u16((uint16_t)n, 43691U) >> 2);
    }
}

static void test_safe_distance_is_exact_for_every_speed(void)
{
    for (int lead_cmps = 0; lead_cmps <= 5000; lead_cmps += 7) {
        for (int own_cmps = 0; own_cmps <= 5000; own_cmps++) {
            int braking = (own_cmps * own_cmps - lead_cmps * lead_cmps) / 1200;
            int thinking = own_cmps * 9 / 10;

            gap.own_cmps = (uint16_t)own_cmps;
            gap.lead_cmps = (uint16_t)lead_cmps;
            gap.lead = GAP_LEAD_BRAKES;
            if (gap_safe_cm() != 500 + (thinking + braking > 0 ? thinking + braking : 0)) {
                TEST_FAIL_MESSAGE("a braking lead");
            }
        }
    }
    for (int own_cmps = 0; own_cmps <= 5000; own_cmps++) {
        gap.own_cmps = (uint16_t)own_cmps;
        gap.lead = GAP_LEAD_STANDS;
        if (gap_safe_cm() != 500 + own_cmps * 9 / 10 + own_cmps * own_cmps / 1200) {
            TEST_FAIL_MESSAGE("a standing lead");
        }
    }
}

static void test_lq_law_is_exact_for_every_speed_difference(void)
{
    for (int own_cmps = 0; own_cmps <= 5000; own_cmps += 3) {
        for (int lead_cmps = 0; lead_cmps <= 5000; lead_cmps += 11) {
            int error_cm = (own_cmps * 7 + lead_cmps * 13) % 2400 - 1200;
            int pull = 77 * error_cm;
            int expected;

            pull = pull >= 0 ? pull / 256 : -((-pull + 255) / 256);
            expected = -pull - (own_cmps - lead_cmps) * 100 / (90 + own_cmps / 6);
            expected = expected < -800 ? -800 : expected > 800 ? 800 : expected;
            gap.own_cmps = (uint16_t)own_cmps;
            gap.lead_cmps = (uint16_t)lead_cmps;
            gap.lead = GAP_LEAD_BRAKES;
            gap.safe_cm = 2000;
            gap.gap_cm = (uint16_t)(2000 - error_cm);
            TEST_ASSERT_EQUAL_INT(expected, gap_lq_cmps2());
        }
    }
}

#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_spot_values_are_the_printed_ones);
    RUN_TEST(test_fuzzy_part_is_the_printed_one);
    RUN_TEST(test_lead_state_follows_speed_then_acceleration);
    RUN_TEST(test_safe_distance_grows_with_own_speed_and_never_wraps);
    RUN_TEST(test_brake_and_throttle_are_never_on_together);
    RUN_TEST(test_outputs_are_the_acceleration_to_half_a_percent);
    RUN_TEST(test_brake_holds_through_the_last_creep);
    RUN_TEST(test_car_does_not_creep_up_to_one_that_stands);
    RUN_TEST(test_no_room_never_accelerates_and_much_room_never_brakes);
    RUN_TEST(test_nobody_ahead_leaves_brake_and_throttle_alone);
    RUN_TEST(test_payload_out_of_range_is_refused_and_changes_nothing);
    RUN_TEST(test_car_waits_braked_and_a_lost_link_brakes);
    RUN_TEST(test_lost_link_never_lowers_the_brake);
    RUN_TEST(test_a_node_is_met_exactly);
    RUN_TEST(test_between_nodes_it_is_the_plane_less_two_levels_at_most);
    RUN_TEST(test_last_position_stays_inside);
    RUN_TEST(test_check_sum_is_the_headers);
#ifndef __SDCC_mcs51
    RUN_TEST(test_floating_point_laws_give_the_printed_values);
    RUN_TEST(test_integers_are_the_laws_to_0_17_mps2);
    RUN_TEST(test_published_cases_end_where_they_should);
    RUN_TEST(test_published_cases_have_the_stated_shapes);
    RUN_TEST(test_reciprocals_are_exact_divisions);
    RUN_TEST(test_safe_distance_is_exact_for_every_speed);
    RUN_TEST(test_lq_law_is_exact_for_every_speed_difference);
#endif
    return UNITY_END();
}
