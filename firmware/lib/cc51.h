/* SDCC's 8051 keywords: themselves under SDCC, nothing elsewhere, so that host and chip read one
 * source. SDCC's own lint.h would also erase the plain words data, code, bit and at; do not use
 * those four as names, some SDCC versions know them. */
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
#define __interrupt(n)
#define __using(n)
#endif

#endif
