/* SPDX-License-Identifier: MIT */
/* The parking controller: place and heading -> two steering laws, blended -> servo and stop. */
#include "frames.h"
#include "park.h"

static const char __code HEADER[] =
    "seq,ms,x_512,y_512,heading,dist_mm,weight,servo_us,state,fault\r\n";
static const char __code LINE[] = "%u,%o%m,%s%u,%u,%u,%u,%u,%u,%s,%u\r\n";
static const char __code *const
    __code STATES[] = {"WAITING", "CHECKING", "DRIVING", "ARRIVED", "DEAD_ZONE", "READY", "FAULT"};

/* Said once, in the place of a line of telemetry. */
static const char __code WAY_OUT[] = "# dead zone: drive forward, then start again\r\n";
static bool is_way_out_said;

#define LAMP_DEAD_ZONE 5U /* blinks; 2 to 4 are the self-test's */

/* 20 ms, as the servo. */
const struct frames_app __code app = {FRAME_PARK, PARK_PAYLOAD_BYTES, 0, 2, HEADER, LINE};

void app_init(void)
{
    park_init();
}

void app_item(void)
{
    /* unreached: its frames have no items */
}

bool app_read(void)
{
    return park_read();
}

void app_decide(void)
{
    park_decide();
}

void app_lose(void)
{
    park_lose();
}

void app_apply(void)
{
    hal_stop_set(park_must_stand());
    hal_brake_set(park_must_stand() ? 100 : 0);
    hal_servo_set(park.servo_us);
    if (park.state == PARK_DEAD_ZONE && !is_way_out_said && !telemetry_is_busy()) {
        telemetry_say(WAY_OUT);
        is_way_out_said = true;
    }
}

uint8_t app_report(void)
{
    union telemetry_value __idata *value = telemetry_values + FRAMES_VALUES_FROM;

    value[0].text = park.x < 0 ? "-" : "";
    value[1].number = (uint16_t)(park.x < 0 ? -park.x : park.x);
    value[2].number = (uint16_t)(park.y < 0 ? 0 : park.y);
    value[3].number = park.heading;
    value[4].number = park.dist_mm;
    value[5].number = park.weight;
    value[6].number = park.servo_us;
    value[7].text = STATES[park.state];
    return FRAMES_VALUES_FROM + 8;
}

uint8_t app_lamp(void)
{
    switch (park.state) {
    case PARK_WAITING:
    case PARK_CHECKING:
        return LAMP_FLICKER;
    case PARK_DEAD_ZONE:
        return LAMP_DEAD_ZONE;
    case PARK_READY:
        return LAMP_ON;
    default:
        return LAMP_OFF;
    }
}

void main(void)
{
    frames_init();
    for (;;) {
        frames_round();
    }
}
