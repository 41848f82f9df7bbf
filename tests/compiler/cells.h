/* SPDX-License-Identifier: MIT */
/* The cells of xdata by which chip and host exchange a step. A step takes at most 256 bytes. */
#ifndef FUZZY51_STEP_CELLS_H
#define FUZZY51_STEP_CELLS_H

#define STEP_IN  0x1000
#define STEP_GO  0xFFFE
#define STEP_OUT 0xFFFF

#endif
