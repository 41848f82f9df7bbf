/* SPDX-License-Identifier: MIT */
/* Exact phases from a 16-bit timer that has no reload register. PWM and servo share this. */
#ifndef FUZZY51_PHASE_H
#define FUZZY51_PHASE_H

/* The timer goes on counting after its overflow, so a late interrupt does not make the phase
 * longer. The timer loses time only while it is stopped to be advanced: these cycles, from `clr` to
 * `setb` below. */
#define PHASE_STOPPED_MC 7U

/* What to add to the timer so that it overflows after a phase of so many cycles. */
#define PHASE_RELOAD(phase_mc) ((uint16_t)(PHASE_STOPPED_MC - (phase_mc)))

/* Adds two bytes to timer `n` (a digit, in quotes). The bytes are variables with their names in
 * assembly. */
#define PHASE_ADVANCE(n, low, high)                                                                \
    __asm__("clr tr" n "\n mov a, tl" n "\n add a, " low "\n mov tl" n ", a\n mov a, th" n         \
            "\n addc a, " high "\n mov th" n ", a\n setb tr" n)

#endif
