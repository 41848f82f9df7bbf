/* SPDX-License-Identifier: MIT */
/* The text at its place; see identity.h. */
#include "identity.h"
#include "lut_table.h"

#define TEXT_OF_VALUE(value) #value
#define TEXT_OF(macro)       TEXT_OF_VALUE(macro)

const char __code __at(IDENTITY_AT) identity[] = IDENTITY " table=" TEXT_OF(LUT_CRC16);

/* The linker has put all other code behind a text of this length. */
_Static_assert(sizeof identity == IDENTITY_BYTES, "a check sum has four digits");
