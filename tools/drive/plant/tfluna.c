/* SPDX-License-Identifier: MIT */
#include "tfluna.h"

#include <math.h>
#include <string.h>

static const double white_pct = 90;
static const int chip_c = 25,
                 warmest_cm = 900; /* the distance limit that it has from the factory */

double tfluna_strength(const struct sensor *sensor, double gap_m)
{
    /* A power of the distance, through 1000 at 4 m and 400 at 8 m. */
    const double power = log(1000.0 / 400) / log(8.0 / 4);

    if (isinf(gap_m)) {
        return 0;
    }
    return fmin(1000 * pow(fmax(gap_m, 0.01) / 4, -power) * sensor->reflectivity_pct / white_pct,
                TFLUNA_BLINDED - 1);
}

double tfluna_noise_m(double strength)
{
    static const struct {
        double strength, noise_m;
    } table[] = {{200, 0.03}, {400, 0.02}, {1000, 0.01}, {2000, 0.005}};
    const int count = sizeof table / sizeof table[0];
    int i = 0;

    while (i < count && table[i].strength <= strength) {
        i++;
    }
    if (i == 0 || i == count) {
        return table[i == 0 ? 0 : count - 1].noise_m;
    }
    return table[i - 1].noise_m + (table[i].noise_m - table[i - 1].noise_m) *
                                      (strength - table[i - 1].strength) /
                                      (table[i].strength - table[i - 1].strength);
}

static double strength_now(const struct sensing *sensing, double gap_m)
{
    return sensing->strength_scale * tfluna_strength(&sensing->sensor, gap_m);
}

static struct sight look(const struct sensing *sensing, double gap_m)
{
    const struct sensor *sensor = &sensing->sensor;
    double strength = strength_now(sensing, gap_m), noise_m = sensor_noise_m(sensor);
    double min_m = sensor_min_m(sensor);

    return (struct sight){.is_seen = strength >= TFLUNA_WEAK && gap_m <= sensor_max_m(sensor),
                          .dist_m = gap_m < min_m ? 2 * min_m - gap_m : gap_m,
                          .noise_m = noise_m < 0 ? tfluna_noise_m(strength) : noise_m};
}

void tfluna_init(struct tfluna *tfluna, const struct sensor_settings *settings, uint64_t seed)
{
    memset(tfluna, 0, sizeof *tfluna);
    sensing_init(&tfluna->sensing, settings, look, warmest_cm / 100.0, seed);
    random_seed(&tfluna->chance, seed ^ 0x4C554E41u);
    tfluna->period_ns = (int64_t)llround(1e9 / settings->sensor.rate_hz);
    tfluna->due_ns = (int64_t)llround(settings->sensor.start_up_s * 1e9 +
                                      random_uniform(&tfluna->chance) * (double)tfluna->period_ns);
}

bool tfluna_is_seen(const struct tfluna *tfluna, double gap_m)
{
    const struct sensor *sensor = &tfluna->sensing.sensor;

    return tfluna_strength(sensor, gap_m) >= TFLUNA_WEAK && gap_m <= sensor_max_m(sensor);
}

/* --- frames ------------------------------------------------------------------------------- */

static void put_16(uint8_t *at, unsigned value)
{
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
}

static void encode(uint8_t frame[TFLUNA_FRAME], unsigned dist_cm, unsigned strength)
{
    frame[0] = frame[1] = 0x59;
    put_16(frame + 2, dist_cm);
    put_16(frame + 4, strength);
    put_16(frame + 6, (unsigned)(chip_c + 256) * 8);
    frame[8] = 0;
    for (int i = 0; i < TFLUNA_FRAME - 1; i++) {
        frame[8] = (uint8_t)(frame[8] + frame[i]);
    }
}

/* The fault of that kind whose time it is and that strikes this frame, by its share. */
static bool strikes(struct tfluna *tfluna, enum fault_kind kind, double t_s)
{
    bool found = false;

    for (int i = 0; i < SENSOR_FAULTS; i++) {
        const struct fault *fault = &tfluna->sensing.faults[i];

        if (sensing_fault_acts(&tfluna->sensing, i, t_s) && fault->kind == (int)kind) {
            found |= kind == FAULT_BLIND || random_uniform(&tfluna->chance) < fault->share;
        }
    }
    return found;
}

/* How much rain leaves of the strength. */
static double rain_scale(const struct tfluna *tfluna, double t_s)
{
    double scale = 1;

    for (int i = 0; i < SENSOR_FAULTS; i++) {
        const struct fault *fault = &tfluna->sensing.faults[i];

        if (sensing_fault_acts(&tfluna->sensing, i, t_s) && fault->kind == FAULT_RAIN) {
            scale *= fault->scale;
        }
    }
    return scale;
}

/* Puts a good frame of the reading into FRAME. */
static void tell(struct tfluna *tfluna, const struct reading *reading, double gap_m,
                 uint8_t frame[TFLUNA_FRAME])
{
    double strength = strength_now(&tfluna->sensing, gap_m);

    if (reading->kind == READ_TARGET) {
        encode(frame, (unsigned)lround(fmin(reading->dist_m * 100, 65535)),
               (unsigned)lround(fmax(strength, TFLUNA_WEAK)));
    } else {
        encode(frame, 0, (unsigned)floor(fmin(strength, TFLUNA_WEAK - 1)));
    }
}

size_t tfluna_take(struct tfluna *tfluna, double gap_m, double closing_mps,
                   uint8_t frame[TFLUNA_FRAME], enum sensor_answer *answer)
{
    struct sensing *sensing = &tfluna->sensing;
    int64_t t_ns = tfluna->due_ns;
    double t_s = (double)t_ns * 1e-9;
    double mean_m = gap_m + closing_mps * (double)tfluna->period_ns * 1e-9 / 2;
    struct reading reading;
    bool level;

    tfluna->due_ns += tfluna->period_ns;
    *answer = tfluna_is_seen(tfluna, mean_m) ? SENSOR_MISSING : SENSOR_NONE;
    sensing->strength_scale = rain_scale(tfluna, t_s);
    reading = sensing_read(sensing, t_ns, mean_m);
    if (reading.kind == READ_SILENT || sensing_is_silenced(sensing, t_s, &level)) {
        return 0;
    }
    tfluna->sent_ns = t_ns;
    if (strikes(tfluna, FAULT_BLIND, t_s)) {
        encode(frame, (unsigned)(random_uniform(&tfluna->chance) * warmest_cm), TFLUNA_BLINDED);
        return TFLUNA_FRAME;
    }
    tell(tfluna, &reading, mean_m, frame);
    if (strikes(tfluna, FAULT_SUM, t_s)) {
        frame[TFLUNA_FRAME - 1] =
            (uint8_t)(frame[TFLUNA_FRAME - 1] + 1 + (int)(random_uniform(&tfluna->chance) * 255));
        return TFLUNA_FRAME;
    }
    if (strikes(tfluna, FAULT_TORN, t_s)) {
        size_t lost = (size_t)(random_uniform(&tfluna->chance) * TFLUNA_FRAME);

        memmove(frame + lost, frame + lost + 1, TFLUNA_FRAME - 1 - lost);
        return TFLUNA_FRAME - 1;
    }
    sensing_note(sensing, &reading);
    if (reading.kind == READ_TARGET) {
        *answer = SENSOR_TARGET;
    }
    return TFLUNA_FRAME;
}
