/* SPDX-License-Identifier: MIT */
/* The text and the title line; see identity.h. */
#include "identity.h"
#include "hal.h"
#include "lut_table.h"
#include "telemetry.h"

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro)       TEXT_OF_VALUE(macro)

const char __code identity[] = IDENTITY " table=" TEXT_OF(LUT_CRC16);

static const char __code TITLE[] = "# %s reset=%s\r\n";
static const char __code *const __code RESETS[] = {"power-on", "watchdog", "pin"};

void identity_say(void)
{
    telemetry_values[0].text = identity;
    telemetry_values[1].text = RESETS[hal_reset_cause()];
    telemetry_say(TITLE);
}
