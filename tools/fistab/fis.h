/* A fuzzy inference system as a .fis file describes it, and the reader of such files. */
#ifndef FUZZY51_FIS_H
#define FUZZY51_FIS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mf.h"

/* Limits that keep an answer quick; a file beyond one is refused with a message that names it. */
enum {
    FIS_BYTES_MAX = 16 << 20,
    FIS_VARIABLES_MAX = 64, /* inputs; outputs likewise */
    FIS_SETS_MAX = 1000,    /* of one variable */
    FIS_PARAMETERS_MAX = 2000,
    FIS_RULES_MAX = 20000,
};
#define FIS_NUMBER_MAX 1e100 /* so that no product of a few of them overflows */

enum fis_type { FIS_MAMDANI = 1, FIS_SUGENO };
enum fis_and { AND_MIN = 1, AND_PROD };
enum fis_or { OR_MAX = 1, OR_PROBOR };
enum fis_imp { IMP_MIN = 1, IMP_PROD };
enum fis_agg { AGG_MAX = 1, AGG_SUM, AGG_PROBOR };
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
};

struct variable {
    char *name;
    int line; /* of its section's head; 0: the file has no such section */
    double min;
    double max;
    struct set *set;
    size_t sets;
};

struct rule {
    int line;
    int *term; /* inputs, then outputs: number of the set from 1, negative = not, 0 = not used */
    size_t inputs; /* as many as the system's, once read */
    size_t outputs;
    double weight;
    bool is_or;
};

/* A method that the file sets to '' is 0; the reader takes care that no rule needs it then. */
struct fis {
    char *file;
    char *name;
    uint32_t crc32; /* of the file's bytes */
    enum fis_type type;
    enum fis_and and_method;
    enum fis_or or_method;
    enum fis_imp imp_method;
    enum fis_agg agg_method;
    enum fis_defuzz defuzz_method;
    struct variable *input;
    size_t inputs;
    struct variable *output;
    size_t outputs;
    struct rule *rule;
    size_t rules;
};

/* Reads PATH. Returns EXIT_FINE, or EXIT_INPUT after a message with file and line; then there is
 * nothing to free. */
int fis_read(const char *path, struct fis *fis);

/* The same for LENGTH bytes of TEXT, which messages call FILE. */
int fis_parse(const char *file, const char *text, size_t length, struct fis *fis);

void fis_free(struct fis *fis);

/* The set that a rule's term means: of input or output INDEX. NULL where the term is 0. */
const struct set *fis_set(const struct variable *variable, int term);

/* The words of the file for each of the enums above, by its value; the last one is NULL. */
extern const char *const fis_type_words[];
extern const char *const fis_and_words[];
extern const char *const fis_or_words[];
extern const char *const fis_imp_words[];
extern const char *const fis_agg_words[];
extern const char *const fis_defuzz_words[];

#endif
