/* SPDX-License-Identifier: MIT */
/* How a scenario file is described: sections, and the keys of each. A section's table stands beside
 * the code that uses its values: what all controllers share in sections.c, the sensors' in plant,
 * the rest in each world. The reader, `drive keys` and docs/drive.md all follow these tables. */
#ifndef FUZZY51_KEYS_H
#define FUZZY51_KEYS_H

#include <stdbool.h>
#include <stddef.h>

enum { KEYS_MAX = 16, SECTION_COPIES = 4, SECTION_COPIES_MAX = 8, SCENARIO_TEXT = 128 };

/* The value of a number that the file leaves out, where no number can stand for it. */
#define SCENARIO_UNSET (-1.0)

enum value_kind {
    VALUE_NUMBER, /* double */
    VALUE_COUNT,  /* double that holds a whole number */
    VALUE_CHOICE, /* int: the index of the word in `choices` */
    VALUE_TEXT,   /* char[SCENARIO_TEXT] */
    VALUE_PROFILE /* struct profile */
};

struct key {
    const char *name;    /* ends in its unit, as in speed_mps */
    const char *meaning; /* in a few words */
    enum value_kind kind;
    size_t at;           /* of the value, in the section's struct */
    double low, high;    /* range of a number */
    const char *choices; /* "one two three" */
    double initial;      /* number, or index of the choice, that a file gets which leaves it out */
    const char *text;    /* the same of a text */
    const char *unset;   /* what it means that the key is left out, where initial does not say it */
    const char *kinds; /* values of the section's key `kind` that this key belongs to; NULL: all */
    bool required;
};

struct section_check;

struct section {
    const char *name; /* as in [name] */
    const char *meaning;
    const struct key *keys;
    int key_count;
    size_t size; /* of the struct that holds the values */

    /* Complains about values that do not go together; NULL: all do. */
    void (*check)(struct section_check *check, const void *values);
};

/* For a struct section: its keys, from an array. */
#define SECTION_KEYS(array) .keys = (array), .key_count = sizeof(array) / sizeof(array)[0]

/* A section as one kind of controller uses it. */
struct section_use {
    const struct section *section;
    size_t at;        /* of the values, in struct scenario */
    int copies;       /* how many there may be: [name], [name2], ...; 0 means 1 */
    bool required;    /* [name] must be there */
    const char *only; /* the keys that have an effect here, as "one two"; NULL: all */
};

/* Gives all values of one section their initial ones. */
void section_defaults(const struct section *section, void *values);

/* For a section's check: the line in which KEY was given; 0: it was not. */
int section_line(const struct section_check *check, const char *key);

/* For a section's check: the values of the first section NAME of the same scenario, which its world
 * must have. */
const void *section_values(const struct section_check *check, const char *name);

/* For a section's check: complains, at the line of KEY. KEY NULL: about the section as a whole. */
void section_complain(struct section_check *check, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Index of WORD in a list of words separated by blanks, or -1. */
int word_index(const char *words, const char *word);

/* The INDEX-th of such words; a static buffer, "" when there are fewer. */
const char *word_at(const char *words, int index);

#endif
