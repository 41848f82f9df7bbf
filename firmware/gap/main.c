/* SPDX-License-Identifier: MIT */
/* The gap controller: gap and speeds from the head -> safe distance, optimal and fuzzy law -> brake
 * and throttle. */
#include "frames.h"
#include "gap.h"

static const char __code HEADER[] = "seq,ms,gap_cm,safe_cm,accel_cmps2,brake_pct,state,fault\r\n";
static const char __code LINE[] = "%u,%o%m,%u,%u,%s%u,%u,%s,%u\r\n";
static const char __code *const __code STATES[] = {"WAITING", "CONTROL", "EMERGENCY", "FAULT"};

/* 50 ms */
const struct frames_app __code app = {FRAME_GAP, GAP_PAYLOAD_BYTES, 0, 5, HEADER, LINE};

void app_init(void)
{
    gap_init();
}

void app_item(void)
{
    /* unreached: its frames have no items */
}

bool app_read(void)
{
    return gap_read();
}

void app_decide(void)
{
    gap_decide();
}

void app_lose(void)
{
    gap_lose(FAULT_PCT);
}

void app_apply(void)
{
    hal_stop_set(gap.stop);
    hal_brake_set(gap.brake_pct);
    hal_servo_set(gap.throttle_us);
}

uint8_t app_report(void)
{
    union telemetry_value __idata *value = telemetry_values + FRAMES_VALUES_FROM;

    value[0].number = gap.gap_cm;
    value[1].number = gap.safe_cm;
    value[2].text = gap.accel_cmps2 < 0 ? "-" : "";
    value[3].number = (uint16_t)(gap.accel_cmps2 < 0 ? -gap.accel_cmps2 : gap.accel_cmps2);
    value[4].number = gap.brake_pct;
    value[5].text = STATES[gap.state];
    return FRAMES_VALUES_FROM + 6;
}

uint8_t app_lamp(void)
{
    return gap.state == GAP_WAITING ? LAMP_FLICKER : LAMP_OFF;
}

void main(void)
{
    frames_init();
    for (;;) {
        frames_round();
    }
}
