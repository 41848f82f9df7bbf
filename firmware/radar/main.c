/* SPDX-License-Identifier: MIT */
/* The radar controller: beat frequencies -> safe distance, lane, table -> brake, throttle cut. */
#include "frames.h"
#include "radar.h"

static const char __code HEADER[] =
    "seq,ms,range_cm,closing_dkmh,own_dkmh,safe_cm,level,brake_pct,state,fault\r\n";
static const char __code LINE[] = "%u,%o%m,%u,%s%u,%u,%u,%u,%u,%s,%u\r\n";
static const char __code *const __code STATES[] = {"DRIVER", "HOLDING", "BRAKING", "FAULT"};

/* 100 ms, as the published system. */
const struct frames_app
    __code app = {FRAME_RADAR, RADAR_PAYLOAD_BYTES, RADAR_TARGET_BYTES, 10, HEADER, LINE};

void app_init(void)
{
    radar_init();
}

void app_item(void)
{
    radar_read_target();
}

bool app_read(void)
{
    return radar_read();
}

void app_decide(void)
{
    radar_decide();
}

void app_lose(void)
{
    radar_lose(FAULT_PCT);
}

void app_apply(void)
{
    hal_cut_set(radar_cuts_throttle());
    hal_brake_set(radar.brake_pct);
    hal_stop_set(false);
}

uint8_t app_report(void)
{
    union telemetry_value __idata *value = telemetry_values + FRAMES_VALUES_FROM;
    bool opens = radar.closing_dkmh < 0;

    value[0].number = radar.range_cm;
    value[1].text = opens ? "-" : "";
    value[2].number = (uint16_t)(opens ? -radar.closing_dkmh : radar.closing_dkmh);
    value[3].number = radar.own_dkmh;
    value[4].number = radar.safe_cm;
    value[5].number = radar.level;
    value[6].number = radar.brake_pct;
    value[7].text = STATES[radar.state];
    return FRAMES_VALUES_FROM + 8;
}

uint8_t app_lamp(void)
{
    return radar_cuts_throttle() ? LAMP_FLICKER : LAMP_OFF;
}

void main(void)
{
    frames_init();
    for (;;) {
        frames_round();
    }
}
