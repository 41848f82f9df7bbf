/* SPDX-License-Identifier: MIT */
/* Reads the value change dump that s51 writes while it runs: bytes in, changes out. */
#ifndef FUZZY51_VCD_H
#define FUZZY51_VCD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { VCD_MAX_VARS = 16, VCD_NAME_SIZE = 32, VCD_TOKEN_SIZE = 80 };

struct vcd_var {
    char id; /* the dump's own short name */
    char name[VCD_NAME_SIZE];
};

struct vcd_reader {
    struct vcd_var vars[VCD_MAX_VARS];
    int var_count;
    int64_t time_ns;  /* of the changes that follow */
    int64_t unit_ps;  /* one tick of the dump */
    bool in_body;     /* past $enddefinitions */
    bool in_dumpvars; /* the initial values are no changes */
    bool malformed;   /* something else than a dump was read */
    char keyword[16]; /* $keyword ... $end in progress */
    int words;        /* words seen in it */
    struct vcd_var declared;
    char token[VCD_TOKEN_SIZE];
    size_t token_length;
    uint32_t vector; /* of a b... token, until its id has been read */
    bool vector_pending;
};

/* A change: variable VAR (index into vars) has VALUE from TIME_NS on. s51 repeats variables that
 * did not change; telling them apart is the caller's part. */
typedef void vcd_change_fn(void *user, int64_t time_ns, int var, uint32_t value);

void vcd_init(struct vcd_reader *reader);

/* Takes SIZE bytes, wherever they may be cut, and calls CHANGE for each change in them. Returns
 * false once the bytes are no value change dump. */
bool vcd_feed(struct vcd_reader *reader, const char *bytes, size_t size, vcd_change_fn *change,
              void *user);

/* Index of the variable of that name, or -1. */
int vcd_var_index(const struct vcd_reader *reader, const char *name);

#endif
