/* SPDX-License-Identifier: MIT */
/* The follower: gap, speeds and the next lane from the head -> table -> brake, throttle and the
 * wish for the next lane. */
#include "frames.h"
#include "follow.h"

static const char __code HEADER[] =
    "seq,ms,gap_mm,own_mmps,lead_mmps,command,change,brake_pct,state,fault\r\n";
static const char __code LINE[] = "%u,%o%m,%u,%u,%u,%s,%s,%u,%s,%u\r\n";
static const char __code *const __code STATES[] = {"WAITING", "CONTROL", "FAULT"};
static const char __code *const __code COMMANDS[] = {"-1", "-0.5", "0", "0.5", "1"};

/* 100 ms */
const struct frames_app __code app = {FRAME_FOLLOW, FOLLOW_PAYLOAD_BYTES, 0, 10, HEADER, LINE};

void app_init(void)
{
    follow_init();
}

void app_item(void)
{
    /* unreached: its frames have no items */
}

bool app_read(void)
{
    return follow_read();
}

void app_decide(void)
{
    follow_decide();
}

void app_lose(void)
{
    follow_lose(FAULT_PCT);
}

void app_apply(void)
{
    hal_stop_set(follow.stop);
    hal_brake_set(follow.brake_pct);
    hal_servo_set(follow.throttle_us);
    hal_lane_set(follow.asks_for_lane);
}

uint8_t app_report(void)
{
    union telemetry_value __idata *value = telemetry_values + FRAMES_VALUES_FROM;

    value[0].number = follow.gap_mm;
    value[1].number = follow.own_mmps;
    value[2].number = follow.lead_mmps;
    value[3].text = COMMANDS[(uint8_t)(follow.command_x2 + 2)];
    value[4].text = COMMANDS[(uint8_t)(follow.change_x2 + 2)];
    value[5].number = follow.brake_pct;
    value[6].text = STATES[follow.state];
    return FRAMES_VALUES_FROM + 7;
}

uint8_t app_lamp(void)
{
    return follow.state == FOLLOW_WAITING ? LAMP_FLICKER : LAMP_OFF;
}

void main(void)
{
    frames_init();
    for (;;) {
        frames_round();
    }
}
