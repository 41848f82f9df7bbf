/* SPDX-License-Identifier: MIT */
#include "space.h"

#include "diag.h"
#include "random.h"
#include "search.h"

#include <stdlib.h>

enum { CLOCKS_PER_CYCLE = 12 };

static void add_spots(struct space *space, const struct arguments *arguments)
{
    for (unsigned k = 0; k < 512 * 8; k++) {
        enum where where = k < 256 * 8 ? IN_RAM : IN_SFR;
        unsigned address = k / 8 % 256;
        bool is_in = where == IN_RAM ? arguments->rams[address] : arguments->sfrs[address];

        if (k == 256 * 8) {
            space->first_register_spot = space->spot_count;
        }
        if (is_in) {
            space->spots[space->spot_count++] =
                (struct spot){.where = where, .address = (uint8_t)address, .bit = (uint8_t)(k % 8)};
        }
    }
}

/* Spreads the samples over the window that begins at FROM. */
static void draw_samples(struct space *space, struct random *random, long first, long count,
                         uint64_t from, uint64_t window_mc)
{
    for (uint32_t i = 0; i < space->spot_count; i++) {
        space->spots[i].samples = 0;
    }
    for (long i = first; i < first + count; i++) {
        struct sample *sample = &space->samples[i];
        uint32_t spot = (uint32_t)(random_uniform(random) * space->spot_count);

        *sample =
            (struct sample){.spot = spot,
                            .class = CLASS_UNKNOWN,
                            .cycle = from + (uint64_t)(random_uniform(random) * (double)window_mc),
                            .next = space->spots[spot].samples};
        space->spots[spot].samples = (uint32_t)i + 1;
    }
}

static void add_to_plan(struct space *space, struct plan *plan)
{
    classes_plan(space->classes, plan);
    for (long i = 0; i < space->sample_count; i++) {
        const struct sample *sample = &space->samples[i];
        const struct spot *spot = &space->spots[sample->spot];

        if (sample->class == CLASS_UNKNOWN) {
            continue; /* behind the window's last slot */
        }
        plan_add(plan, &(struct fault_case){.where = spot->where,
                                            .address = spot->address,
                                            .bit = spot->bit,
                                            .cycle = sample->cycle,
                                            .tag = SAMPLE_TAG + (uint32_t)i});
    }
    plan_sort(plan);
}

struct space *space_search(const struct fair *fair, const struct board *board,
                           const struct hexfile *hex, const struct arguments *arguments,
                           struct plan *plan)
{
    struct space *space = calloc(1, sizeof *space);
    struct search *search;
    double cycles_per_s = (double)board->clk_hz / CLOCKS_PER_CYCLE;
    uint64_t window_mc = (uint64_t)(cycles_per_s * (double)arguments->window_ms / 1000);
    struct random random;
    bool ok = true;

    random_seed(&random, (uint64_t)arguments->seed);
    space->classes = classes_create();
    space->samples =
        calloc((size_t)(arguments->sample * arguments->instants) + 1, sizeof *space->samples);
    add_spots(space, arguments);
    search = search_create(space, fair, board, hex->code);
    for (int i = 0; i < arguments->instants && ok; i++) {
        double t_s = (double)fair->boot_ns * 1e-9 + arguments->instants_s[i];
        struct mcs52 *start = fair_start_before(fair, (uint64_t)(t_s * cycles_per_s));

        draw_samples(space, &random, space->sample_count, arguments->sample, mcs52_cycles(start),
                     window_mc);
        space->sample_count += arguments->sample;
        ok = search_window(search, start, window_mc);
    }
    search_free(search);
    if (!ok) {
        diag_error(NULL, 0, "the replay of the drive differs from it; choose another instant");
        space_free(space);
        return NULL;
    }
    add_to_plan(space, plan);
    return space;
}

void space_free(struct space *space)
{
    classes_free(space->classes);
    free(space->uses);
    free(space->samples);
    free(space);
}

/* --- what came of it ---------------------------------------------------------------------- */

static enum verdict verdict_of(struct space *space, const struct plan *plan, const size_t *places,
                               uint32_t class)
{
    const struct fault_case *one;

    class = classes_root(space->classes, class);
    if (class == CLASS_NONE) {
        return VERDICT_NONE;
    }
    one = &plan->cases[places[class]];
    return one->done ? one->verdict : VERDICT_UNSAFE;
}

/* Where each class is in the plan. */
static size_t *places_of(const struct space *space, const struct plan *plan)
{
    size_t *places = calloc(classes_count(space->classes), sizeof *places);

    if (places == NULL) {
        abort();
    }
    for (size_t i = 0; i < plan->count; i++) {
        if (plan->cases[i].tag < SAMPLE_TAG) {
            places[plan->cases[i].tag] = i;
        }
    }
    return places;
}

static void print_spots(FILE *out, struct space *space, const struct plan *plan,
                        const size_t *places)
{
    uint64_t(*points)[VERDICTS] = calloc(space->spot_count, sizeof *points);

    if (points == NULL) {
        abort();
    }
    for (size_t i = 0; i < space->use_count; i++) {
        const struct use *use = &space->uses[i];

        points[use->spot][verdict_of(space, plan, places, use->class)] += use->points;
    }
    fprintf(out, "place,address,bit");
    for (int verdict = 0; verdict < VERDICTS; verdict++) {
        fprintf(out, ",%s", judge_verdict_name((enum verdict)verdict));
    }
    fputc('\n', out);
    for (uint32_t i = 0; i < space->spot_count; i++) {
        fprintf(out, "%s,0x%02X,%d", plan_where_name(space->spots[i].where),
                space->spots[i].address, space->spots[i].bit);
        for (int verdict = 0; verdict < VERDICTS; verdict++) {
            fprintf(out, ",%llu", (unsigned long long)points[i][verdict]);
        }
        fputc('\n', out);
    }
    free(points);
}

/* How many runs it took, and whether the samples came to what their class did. */
static void print_runs(struct space *space, const struct plan *plan, const size_t *places)
{
    size_t agree = 0, compared = 0;

    for (size_t i = 0; i < plan->count; i++) {
        const struct fault_case *one = &plan->cases[i];

        if (one->tag >= SAMPLE_TAG) {
            const struct sample *sample = &space->samples[one->tag - SAMPLE_TAG];

            compared++;
            agree += one->verdict == verdict_of(space, plan, places, sample->class);
        }
    }
    fprintf(stderr, "flip: %zu runs", plan->count - compared);
    if (compared > 0) {
        fprintf(stderr, "; of %zu flips by chance, run by themselves, %zu agree", compared, agree);
    }
    fputc('\n', stderr);
}

void space_print(FILE *out, struct space *space, const struct plan *plan)
{
    size_t *places = places_of(space, plan);

    print_spots(out, space, plan, places);
    print_runs(space, plan, places);
    free(places);
}
