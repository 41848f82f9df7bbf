/* SPDX-License-Identifier: MIT */
/* SDCC's words for the memories and interrupts of the 8051. SDCC sees them as they are; for every
 * other compiler they are erased, so that the host and the chip read one source. SDCC's own lint.h
 * would erase the plain words data, code, bit and at as well. Some versions of SDCC know these four
 * as keywords: do not use them as names. */
#ifndef FUZZY51_CC51_H
#define FUZZY51_CC51_H

#ifndef __SDCC_mcs51
#define __code
#define __data
#define __idata
#define __xdata
#define __bit _Bool
#define __critical
#define __reentrant
#define __naked
#define __interrupt(n)
#define __using(n)
#endif

#endif
