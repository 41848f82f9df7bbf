/* SPDX-License-Identifier: MIT */
/* A fuzzy inference system, as a file in one of three formats describes it:
 *   .fis  of MATLAB's Fuzzy Logic Toolbox, and what Octave and fuzzylite write in its manner
 *   .fll  fuzzylite's own language
 *   .fcl  the Fuzzy Control Language of IEC 61131-7 */
#ifndef FUZZY51_FIS_H
#define FUZZY51_FIS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mf.h"
#include "norm.h"

/* Limits that keep an answer quick. A message that refuses a file beyond one names the limit. */
enum {
    FIS_BYTES_MAX = 16 << 20,
    FIS_VARIABLES_MAX = 64, /* inputs; outputs likewise */
    FIS_SETS_MAX = 1000,    /* of one variable */
    FIS_PARAMETERS_MAX = 2000,
    FIS_RULES_MAX = 20000,
    FIS_MIDPOINTS_MAX = 100000,
};
#define FIS_NUMBER_MAX 1e100 /* so that no product of a few numbers overflows */

enum fis_format { FORMAT_FIS, FORMAT_FLL, FORMAT_FCL };
enum fis_type { FIS_MAMDANI = 1, FIS_SUGENO };
enum fis_defuzz {
    DEFUZZ_CENTROID = 1,
    DEFUZZ_BISECTOR,
    DEFUZZ_MOM,
    DEFUZZ_LOM,
    DEFUZZ_SOM,
    DEFUZZ_WTAVER,
    DEFUZZ_WTSUM,
};

struct set {
    char *name;
    int line;
    enum mf_kind kind;
    double *parameter;
    size_t parameters;
    double height; /* 0..1, its degree where the function is 1; other than 1 only in FLL and FCL */
};

struct variable {
    char *name;
    int line; /* where the file begins to describe it; 0: the file does not */
    double min;
    double max;
    struct set *set;
    size_t sets;
    bool lock_range; /* a value outside the range counts as its nearer end */

    /* outputs only */
    enum fis_type type;
    enum snorm agg_method;
    int agg_line; /* where the file says so */
    enum fis_defuzz defuzz_method;
    size_t midpoints;     /* sampled in fuzzylite's manner at so many points; 0: in MATLAB's */
    double default_value; /* where no rule fires; NaN: the file gives none */
};

/* Rules that share their operators. A .fis has one block, the other formats any number. */
struct block {
    enum tnorm and_method;
    enum snorm or_method;
    enum tnorm imp_method;
    int and_line, or_line, imp_line; /* where the file says so */
};

/* Hedges change a degree: `very` squares it, for instance. A chain of them is packed in one number,
 * 4 bits each; the lowest 4 bits come first. 0: no hedge. */
typedef uint32_t hedges_t;
enum hedge { HEDGE_NOT = 1, HEDGE_VERY, HEDGE_EXTREMELY, HEDGE_SOMEWHAT, HEDGE_SELDOM };
enum { HEDGE_BITS = 4, HEDGES_MAX = 32 / HEDGE_BITS };

struct rule {
    int line;
    size_t block;
    int *term; /* inputs, then outputs: number of the set from 1, negative = not, 0 = not used */
    hedges_t *hedges; /* of each term. A chain with an odd number of `not` has a negative term. Of
                         an output they act on the rule's strength. */
    size_t inputs;    /* as many as the system's, once read */
    size_t outputs;
    double weight;
    bool is_or;
};

/* A method that the file leaves empty is 0. The reader takes care that no rule needs it then. */
struct fis {
    char *file;
    char *name;
    enum fis_format format;
    uint32_t crc32; /* of the file's bytes */
    struct block *block;
    size_t blocks;
    struct variable *input;
    size_t inputs;
    struct variable *output;
    size_t outputs;
    struct rule *rule;
    size_t rules;
};

/* Reads PATH; its name's ending tells the format, or else its content does. Returns EXIT_FINE, or
 * EXIT_INPUT after a message with file and line; then there is nothing to free. */
int fis_read(const char *path, struct fis *fis);

/* The same for LENGTH bytes of TEXT, which messages call FILE. */
int fis_parse(const char *file, const char *text, size_t length, struct fis *fis);

void fis_free(struct fis *fis);

/* The set that a rule's term means: of input or output INDEX. NULL where the term is 0. */
const struct set *fis_set(const struct variable *variable, int term);

/* Degree of membership of X in SET, 0..1. Not for the sets of a Sugeno output. */
double set_degree(const struct set *set, double x);

/* DEGREE after a chain of hedges. */
double hedges_apply(hedges_t hedges, double degree);

/* The degree of a rule's condition TERM with HEDGES, where the set itself has DEGREE. */
double condition_degree(int term, hedges_t hedges, double degree);

/* "very", "not" and so on. */
extern const char *const hedge_words[];

/* How many conditions a rule has. */
size_t rule_conditions(const struct rule *rule);

/* The words of a .fis file for the enums above, by value; the last one is NULL. */
extern const char *const fis_type_words[];
extern const char *const fis_defuzz_words[];

/* Makes room in an array of COUNT elements of ITEM bytes for element INDEX, from 0; new elements
 * are all zero bytes. False when memory is short; the array is as before. */
bool fis_grow(void **array, size_t *count, size_t index, size_t item);

#endif
