/* Exact phases from a 16-bit timer with no reload of its own: what PWM and servo share. */
#ifndef FUZZY51_PHASE_H
#define FUZZY51_PHASE_H

/* From its overflow on the timer runs on, so that a late interrupt lengthens nothing; only while it
 * is stopped to be advanced does it lose time: from `clr` to `setb` below. */
#define PHASE_STOPPED_MC 7U

/* By what the timer is advanced for a phase of so many cycles, up to the next overflow. */
#define PHASE_RELOAD(phase_mc) ((uint16_t)(PHASE_STOPPED_MC - (phase_mc)))

/* Advances timer N (a digit, in quotes) by the bytes in two variables, named as in assembly. */
#define PHASE_ADVANCE(n, low, high)                                                                \
    __asm__("clr tr" n "\n mov a, tl" n "\n add a, " low "\n mov tl" n ", a\n mov a, th" n         \
            "\n addc a, " high "\n mov th" n ", a\n setb tr" n)

#endif
