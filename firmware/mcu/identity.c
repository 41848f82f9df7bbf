/* SPDX-License-Identifier: MIT */
/* The text; see identity.h. */
#include "identity.h"
#include "lut_table.h"

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro)       TEXT_OF_VALUE(macro)

const char __code identity[] = IDENTITY " table=" TEXT_OF(LUT_CRC16);
