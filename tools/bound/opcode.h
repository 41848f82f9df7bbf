/* SPDX-License-Identifier: MIT */
/* The 8051's instructions: what bound must know to follow a program. */
#ifndef FUZZY51_OPCODE_H
#define FUZZY51_OPCODE_H

#include <stdbool.h>
#include <stdint.h>

enum course {
    COURSE_ON,     /* to the next instruction */
    COURSE_JUMP,   /* to the target */
    COURSE_BRANCH, /* to either */
    COURSE_CALL,   /* to the target, and on when that returns */
    COURSE_RETURN, /* ret, reti */
    COURSE_SWITCH, /* jmp @a+dptr */
    COURSE_NONE    /* 0xA5 is no instruction */
};

struct instruction {
    uint8_t bytes;  /* 1..3 */
    uint8_t cycles; /* machine cycles; a branch takes the same either way */
    enum course course;
    uint16_t target; /* of jump, branch and call */
    int8_t push;     /* what it leaves on the stack: 1, -1, 0; calls and returns aside */
    bool writes_sp;
};

/* The instruction at ADDRESS of CODE, 64 KB. */
struct instruction opcode_decode(const uint8_t *code, uint16_t address);

#endif
