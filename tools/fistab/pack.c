/* SPDX-License-Identifier: MIT */
/* Packs a table; pack.h says how it looks. */
#include "pack.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_ROWS = 8,
    BYTE_VALUES =
        256, /* limit of the blocks, of the shapes and of a page: the look-up's indices are bytes */
};

/* One row of a strip, as the differences between its cells. Two of them may overlap in the string
 * of shapes wherever the differences agree, since each run brings its own base. */
struct shape {
    size_t length;
    uint8_t difference[BYTE_VALUES];
};

struct run {
    size_t strip, shape;
    uint8_t first; /* the leftmost cell */
};

/* All that depends on the strip width. */
struct plan {
    const int *cells;
    size_t rows, cols, first_row, strip_cells, strips, blocks;
    struct run *runs;
    size_t run_count;
    size_t *strip_runs;  /* how many each strip has */
    size_t *strip_start; /* where they lie, in slots; a page is BYTE_VALUES slots */
    size_t slots;
    struct shape *shapes; /* different ones */
    size_t shape_count;
    uint8_t string[BYTE_VALUES]; /* of differences */
    size_t string_length;
    size_t place[BYTE_VALUES]; /* of each shape in it */
};

static bool same_cells(const struct plan *plan, size_t row_a, size_t row_b, size_t col,
                       size_t count)
{
    const int *a = plan->cells + row_a * plan->cols + col,
              *b = plan->cells + row_b * plan->cols + col;

    return memcmp(a, b, count * sizeof *a) == 0;
}

static size_t strip_width(const struct plan *plan, size_t strip)
{
    size_t left = plan->cols - strip * plan->strip_cells;

    return left < plan->strip_cells ? left : plan->strip_cells;
}

static bool begins_run(const struct plan *plan, size_t strip, size_t row)
{
    return row == plan->first_row ||
           !same_cells(plan, row, row - 1, strip * plan->strip_cells, strip_width(plan, strip));
}

/* The shape's number; BYTE_VALUES if there are too many. */
static size_t find_shape(struct plan *plan, const struct shape *shape)
{
    for (size_t i = 0; i < plan->shape_count; i++) {
        if (plan->shapes[i].length == shape->length &&
            memcmp(plan->shapes[i].difference, shape->difference, shape->length) == 0) {
            return i;
        }
    }
    if (plan->shape_count < BYTE_VALUES) {
        plan->shapes[plan->shape_count++] = *shape;
    } else {
        return BYTE_VALUES;
    }
    return plan->shape_count - 1;
}

/* Fills runs, strip_runs and shapes. Returns false if there are more shapes than places for them.
 */
static bool find_runs(struct plan *plan)
{
    plan->run_count = plan->shape_count = 0;
    for (size_t strip = 0; strip < plan->strips; strip++) {
        size_t before = plan->run_count;

        for (size_t row = plan->first_row; row < plan->rows; row++) {
            const int *cell = plan->cells + row * plan->cols + strip * plan->strip_cells;
            struct shape shape = {.length = strip_width(plan, strip) - 1};
            struct run *run = &plan->runs[plan->run_count];

            if (!begins_run(plan, strip, row)) {
                continue;
            }
            for (size_t i = 0; i < shape.length; i++) {
                shape.difference[i] = (uint8_t)(cell[i + 1] - cell[i]);
            }
            *run = (struct run){.strip = strip, .first = (uint8_t)cell[0]};
            run->shape = find_shape(plan, &shape);
            if (run->shape == BYTE_VALUES) {
                return false;
            }
            plan->run_count++;
        }
        plan->strip_runs[strip] = plan->run_count - before;
    }
    return true;
}

/* Of two different shapes, the shorter one, of the last strip, may lie inside the longer one. */
static bool contains(const struct shape *outer, const struct shape *inner)
{
    if (outer->length == inner->length) {
        return false;
    }
    for (size_t at = 0; at + inner->length <= outer->length; at++) {
        if (memcmp(outer->difference + at, inner->difference, inner->length) == 0) {
            return true;
        }
    }
    return false;
}

/* How many differences at the end of `a` are the first ones of `b`; less than either's length. */
static size_t overlap(const struct shape *a, const struct shape *b)
{
    size_t most = (a->length < b->length ? a->length : b->length);

    for (size_t count = most > 0 ? most - 1 : 0; count > 0; count--) {
        const uint8_t *end = a->difference + a->length - count;

        if (*end == *b->difference && end[count - 1] == b->difference[count - 1] &&
            memcmp(end, b->difference, count) == 0) {
            return count;
        }
    }
    return 0;
}

static bool same_chain(const size_t *next, size_t from, size_t wanted)
{
    for (; from != BYTE_VALUES; from = next[from]) {
        if (from == wanted) {
            return true;
        }
    }
    return false;
}

/* Appends a shape of which `known` differences are already the string's end. */
static bool append(struct plan *plan, const struct shape *shape, size_t known)
{
    size_t count = shape->length - known;

    /* One more cell than differences must fit. */
    if (plan->string_length + count + 1 > BYTE_VALUES) {
        return false;
    }
    memcpy(plan->string + plan->string_length, shape->difference + known, count);
    plan->string_length += count;
    return true;
}

/* Lays all shapes into one string by joining, again and again, the two with the longest overlap: a
 * shortest common superstring, as near as greed comes to it (on the brake table a long search saves
 * 2 bytes more). Returns false if it gets longer than BYTE_VALUES cells. */
static bool join_shapes(struct plan *plan)
{
    size_t next[BYTE_VALUES], known[BYTE_VALUES];
    bool covered[BYTE_VALUES], follows[BYTE_VALUES];
    static uint8_t overlaps[BYTE_VALUES][BYTE_VALUES];
    size_t least_cells = plan->strip_cells - 1, most = 0;

    for (size_t i = 0; i < plan->shape_count; i++) {
        next[i] = BYTE_VALUES;
        known[i] = 0;
        covered[i] = follows[i] = false;
        for (size_t j = 0; j < plan->shape_count; j++) {
            covered[i] |= contains(&plan->shapes[j], &plan->shapes[i]);
        }
        least_cells += !covered[i];
    }
    /* At best each shape begins one cell behind the one before. */
    if (least_cells > BYTE_VALUES) {
        return false;
    }
    for (size_t i = 0; i < plan->shape_count; i++) {
        for (size_t j = 0; j < plan->shape_count; j++) {
            bool apart = i == j || covered[i] || covered[j];
            size_t count = apart ? 0 : overlap(&plan->shapes[i], &plan->shapes[j]);

            overlaps[i][j] = (uint8_t)count;
            if (count > most) {
                most = count;
            }
        }
    }
    for (size_t count = most; count > 0; count--) {
        for (size_t i = 0; i < plan->shape_count; i++) {
            for (size_t j = 0; j < plan->shape_count && next[i] == BYTE_VALUES; j++) {
                if (overlaps[i][j] == count && !follows[j] && !same_chain(next, j, i)) {
                    next[i] = j;
                    known[j] = count;
                    follows[j] = true;
                }
            }
        }
    }
    plan->string_length = 0;
    for (size_t i = 0; i < plan->shape_count; i++) {
        if (covered[i] || follows[i]) {
            continue;
        }
        for (size_t link = i; link != BYTE_VALUES; link = next[link]) {
            if (!append(plan, &plan->shapes[link], known[link])) {
                return false;
            }
        }
    }
    for (size_t i = 0; i < plan->shape_count; i++) {
        const struct shape *shape = &plan->shapes[i];

        plan->place[i] = 0;
        while (memcmp(plan->string + plan->place[i], shape->difference, shape->length) != 0) {
            plan->place[i]++;
        }
    }
    return true;
}

/* Fills page after page with the strips that come nearest to filling it. */
static void fill_pages(struct plan *plan)
{
    bool placed[BYTE_VALUES] = {false};
    size_t left = plan->strips;

    plan->slots = 0;
    for (size_t page = 0; left > 0; page++) {
        /* last[sum]: the strip that brought a choice of strips to that sum; a choice uses strips in
         * ascending order, so that tracing back names each once. */
        size_t last[BYTE_VALUES + 1], sum, slot = page * BYTE_VALUES;

        for (sum = 0; sum <= BYTE_VALUES; sum++) {
            last[sum] = BYTE_VALUES;
        }
        for (size_t strip = 0; strip < plan->strips; strip++) {
            size_t runs = plan->strip_runs[strip];

            if (placed[strip]) {
                continue;
            }
            for (sum = BYTE_VALUES; sum >= runs; sum--) {
                if (last[sum] == BYTE_VALUES && (sum == runs || last[sum - runs] != BYTE_VALUES)) {
                    last[sum] = strip;
                }
            }
        }
        for (sum = BYTE_VALUES; last[sum] == BYTE_VALUES;) {
            sum--;
        }
        for (; sum > 0; left--) {
            size_t strip = last[sum];

            placed[strip] = true;
            plan->strip_start[strip] = slot;
            slot += plan->strip_runs[strip];
            sum -= plan->strip_runs[strip];
        }
        plan->slots = slot;
    }
}

static size_t plan_bytes(const struct plan *plan)
{
    return 2 * plan->strips * plan->blocks + plan->strips + 2 * plan->slots + plan->string_length +
           1;
}

/* Plans for one strip width. Returns false if that does not fit the look-up's byte indices, or
 * takes at least TOO_MANY bytes. */
static bool make_plan(struct plan *plan, size_t strip_cells, size_t too_many)
{
    plan->strip_cells = strip_cells;
    plan->strips = (plan->cols + strip_cells - 1) / strip_cells;
    if (!find_runs(plan)) {
        return false;
    }
    /* At best no page has a gap, and the longest shape holds all others. */
    plan->slots = plan->run_count;
    plan->string_length = strip_cells - 1;
    if (plan_bytes(plan) >= too_many || !join_shapes(plan)) {
        return false;
    }
    fill_pages(plan);
    return true;
}

static void write_bytes(struct pack *pack, const struct plan *plan)
{
    uint8_t *shapes = pack->bytes + pack->shapes_at;
    const struct run *run = plan->runs;

    for (size_t i = 0; i < plan->string_length; i++) {
        shapes[i + 1] = (uint8_t)(shapes[i] + plan->string[i]);
    }
    for (size_t strip = 0; strip < plan->strips; strip++) {
        size_t slot = plan->strip_start[strip];

        pack->bytes[pack->pages_at + strip] = (uint8_t)(slot / BYTE_VALUES);
        for (size_t i = 0; i < plan->strip_runs[strip]; i++, run++) {
            size_t place = plan->place[run->shape];

            pack->bytes[pack->starts_at + slot + i] = (uint8_t)(place - strip * plan->strip_cells);
            pack->bytes[pack->bases_at + slot + i] = (uint8_t)(run->first - shapes[place]);
        }
        for (size_t row = plan->first_row; row < plan->rows; row++) {
            size_t down = row - plan->first_row;
            size_t block = strip * plan->blocks + down / BLOCK_ROWS;

            if (down > 0) {
                slot += begins_run(plan, strip, row);
            }
            if (down % BLOCK_ROWS == 0) {
                pack->bytes[pack->runs_at + block] = (uint8_t)slot;
            } else if (begins_run(plan, strip, row)) {
                pack->bytes[block] |= (uint8_t)(1U << down % BLOCK_ROWS);
            }
        }
    }
}

static int plan_to_pack(struct pack *pack, const struct plan *plan)
{
    *pack = (struct pack){
        .strip_cells = plan->strip_cells,
        .first_row = plan->first_row,
        .strips = plan->strips,
        .blocks = plan->blocks,
        .count = plan_bytes(plan),
    };
    pack->runs_at = plan->strips * plan->blocks;
    pack->pages_at = 2 * pack->runs_at;
    pack->starts_at = pack->pages_at + plan->strips;
    pack->bases_at = pack->starts_at + plan->slots;
    pack->shapes_at = pack->bases_at + plan->slots;
    pack->bytes = calloc(pack->count, 1);
    if (pack->bytes == NULL) {
        return -1;
    }
    write_bytes(pack, plan);
    return 0;
}

static void plan_free(struct plan *plan)
{
    free(plan->runs);
    free(plan->strip_runs);
    free(plan->strip_start);
    free(plan->shapes);
}

int pack_table(struct pack *pack, const int *cells, size_t rows, size_t cols,
               char why[PACK_WHY_BYTES])
{
    struct plan plan = {.cells = cells, .rows = rows, .cols = cols};
    size_t best_width = 0, best_bytes = SIZE_MAX;
    int status = -1;

    if (rows > BYTE_VALUES || cols > BYTE_VALUES) {
        snprintf(why, PACK_WHY_BYTES,
                 "%zu by %zu cells are more than the 256 by 256 that a byte can index", rows, cols);
        return -1;
    }
    while (plan.first_row + 1 < rows && same_cells(&plan, plan.first_row + 1, 0, 0, cols)) {
        plan.first_row++;
    }
    plan.first_row -= plan.first_row % BLOCK_ROWS;
    plan.blocks = (rows - plan.first_row + BLOCK_ROWS - 1) / BLOCK_ROWS;
    plan.runs = calloc(rows * cols, sizeof *plan.runs);
    plan.strip_runs = calloc(cols, sizeof *plan.strip_runs);
    plan.strip_start = calloc(cols, sizeof *plan.strip_start);
    plan.shapes = calloc(BYTE_VALUES, sizeof *plan.shapes);
    if (plan.runs == NULL || plan.strip_runs == NULL || plan.strip_start == NULL ||
        plan.shapes == NULL) {
        snprintf(why, PACK_WHY_BYTES, "out of memory");
        goto done;
    }
    /* One column wide it always fits: such a shape is a lone zero. */
    for (size_t width = 1; width <= cols; width++) {
        if (make_plan(&plan, width, best_bytes) && plan_bytes(&plan) < best_bytes) {
            best_width = width;
            best_bytes = plan_bytes(&plan);
        }
    }
    if (best_bytes >= rows * cols) {
        snprintf(why, PACK_WHY_BYTES, "it would take %zu bytes, the plain table %zu", best_bytes,
                 rows * cols);
        goto done;
    }
    make_plan(&plan, best_width, SIZE_MAX);
    status = plan_to_pack(pack, &plan);
    if (status != 0) {
        snprintf(why, PACK_WHY_BYTES, "out of memory");
        goto done;
    }
    for (size_t i = 0; i < rows * cols; i++) {
        if (pack_at(pack, i / cols, i % cols) == cells[i]) {
            continue;
        }
        snprintf(why, PACK_WHY_BYTES, "cell %zu came back wrong: a fault in fistab", i);
        pack_free(pack);
        status = -1;
        goto done;
    }
done:
    plan_free(&plan);
    return status;
}

uint8_t pack_at(const struct pack *pack, size_t row, size_t col)
{
    size_t strip = col / pack->strip_cells;
    size_t down = row < pack->first_row ? 0 : row - pack->first_row;
    size_t block = strip * pack->blocks + down / BLOCK_ROWS;
    size_t run = (size_t)pack->bytes[pack->pages_at + strip] * BYTE_VALUES +
                 pack->bytes[pack->runs_at + block];
    uint8_t place;

    for (size_t i = 0; i <= down % BLOCK_ROWS; i++) {
        run += pack->bytes[block] >> i & 1;
    }
    place = (uint8_t)(pack->bytes[pack->starts_at + run] + col);
    return (uint8_t)(pack->bytes[pack->bases_at + run] + pack->bytes[pack->shapes_at + place]);
}

void pack_free(struct pack *pack)
{
    free(pack->bytes);
    pack->bytes = NULL;
}
