/* SPDX-License-Identifier: MIT */
#include "search.h"

#include "hash.h"
#include "space.h"

#include <stdlib.h>
#include <string.h>

enum {
    QUIET_MC = 24, /* no slot ends nearer than that to a change of a pin */
    SP = 0x81,
    PCON = 0x87,
    PD = 0x02,
    PSW = 0xD0,
    BANK = 0x18
};

/* A stretch of the drive without a fault. */
struct slot {
    uint64_t until, end;         /* the chip is told to run until; the last instruction ended */
    struct mcs52_snapshot state; /* there */
    uint64_t edges;              /* hash of what its outputs did */
    int first_input;             /* the world's first one in it */
};

/* A chip, and what its outputs did in this slot. */
struct runner {
    struct mcs52 *chip;
    uint64_t edges;
    bool reset;
};

struct search {
    struct space *space;
    const struct fair *fair;
    const uint8_t *code;
    struct runner lead, work; /* without and with a fault */
    struct slot *slots;
    size_t slot_count, window_slots;
    int spots_of_ram[MCS52_RAM_BYTES]; /* the first of eight; -1: not looked at */
};

/* --- the chips ---------------------------------------------------------------------------- */

static void note_edge(void *user, uint64_t cycle, int port, int bit, bool level)
{
    struct runner *runner = user;

    (void)cycle;
    runner->edges = hash_mix(runner->edges, (uint64_t)(port << 4 | bit << 1 | level) + 1);
}

static void note_reset(void *user, uint64_t cycle)
{
    struct runner *runner = user;

    (void)cycle;
    runner->reset = true;
}

static void runner_init(struct runner *runner, const struct mcs52 *like, const struct board *board)
{
    const enum board_pin outputs[] = {PIN_PWM, PIN_STOP, PIN_TRIGGER};
    const struct mcs52_outside outside = {.user = runner, .edge = note_edge, .reset = note_reset};

    *runner = (struct runner){.chip = mcs52_create(MCS52_INTEL, &outside)};
    mcs52_copy(runner->chip, like);
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        mcs52_watch(runner->chip, (board->pins[outputs[i]] - 0x80) >> 4,
                    board->pins[outputs[i]] & 7);
    }
}

/* The runner goes on from STATE; the world does to its pins what it does without a fault, until
 * UNTIL, from input FIRST on. */
static void revive_with(const struct search *search, struct runner *runner,
                        const struct mcs52_snapshot *state, int first, uint64_t until)
{
    const struct fair *fair = search->fair;

    mcs52_revive(runner->chip, state);
    runner->reset = false;
    for (int i = first; i < fair->input_count && fair->inputs[i].cycle <= until; i++) {
        const struct fair_input *input = &fair->inputs[i];

        if (input->cycle > mcs52_cycles(runner->chip)) {
            mcs52_set_pin(runner->chip, input->cycle, input->port, input->bit, input->level);
        }
    }
}

/* Within SLOT; its outputs have done EDGES in it. */
static void revive(const struct search *search, struct runner *runner,
                   const struct mcs52_snapshot *state, const struct slot *slot, uint64_t edges)
{
    revive_with(search, runner, state, slot->first_input, slot->until);
    runner->edges = edges;
}

static void flip(struct mcs52 *chip, const struct spot *spot)
{
    uint8_t mask = (uint8_t)(1u << spot->bit);

    if (spot->where == IN_RAM) {
        mcs52_ram(chip)[spot->address] ^= mask;
    } else {
        mcs52_poke(chip, spot->address, mcs52_sfr(chip, spot->address) ^ mask);
    }
}

static bool same(const struct mcs52_snapshot *a, const struct mcs52_snapshot *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

/* --- the drive without a fault ------------------------------------------------------------ */

/* Whether a pin changes near CYCLE, by the world or by the chip, which stands QUIET_MC before. */
static bool is_busy(struct search *search, uint64_t cycle)
{
    struct runner *lead = &search->lead;
    uint64_t edges = lead->edges;

    for (int i = 0; i < search->fair->input_count; i++) {
        if (search->fair->inputs[i].cycle + QUIET_MC > cycle &&
            search->fair->inputs[i].cycle < cycle + QUIET_MC) {
            return true;
        }
    }
    mcs52_run(lead->chip, cycle + QUIET_MC);
    return lead->edges != edges;
}

/* The end of a slot that begins at START. */
static uint64_t slot_end(struct search *search, const struct mcs52_snapshot *start, uint64_t from)
{
    for (uint64_t until = from + SPACE_SLOT_MC;; until += QUIET_MC) {
        bool busy;

        revive_with(search, &search->lead, start, 0, until + QUIET_MC);
        mcs52_run(search->lead.chip, until - QUIET_MC);
        busy = is_busy(search, until);
        if (!busy) {
            return until;
        }
    }
}

/* Cuts the window and its tail into slots. Returns false when the replay is not the drive. */
static bool cut_slots(struct search *search, struct mcs52 *start, uint64_t window_mc)
{
    struct mcs52_snapshot state, known, now;
    uint64_t from = mcs52_cycles(start), end = from + window_mc;
    struct mcs52 *last;

    search->slots = calloc(window_mc / SPACE_SLOT_MC + SPACE_TAIL_SLOTS + 2, sizeof *search->slots);
    search->slot_count = search->window_slots = 0;
    mcs52_snapshot(start, &state);
    while (search->slot_count < search->window_slots + SPACE_TAIL_SLOTS || from < end) {
        struct slot *slot = &search->slots[search->slot_count++];

        slot->until = slot_end(search, &state, from);
        while (slot->first_input < search->fair->input_count &&
               search->fair->inputs[slot->first_input].cycle <= from) {
            slot->first_input++;
        }
        revive(search, &search->lead, &state, slot, 0);
        slot->end = mcs52_run(search->lead.chip, slot->until);
        slot->edges = search->lead.edges;
        mcs52_snapshot(search->lead.chip, &slot->state);
        state = slot->state;
        from = slot->until;
        search->window_slots = from <= end ? search->slot_count : search->window_slots;
    }
    last = fair_start_before(search->fair, end + window_mc);
    mcs52_snapshot(start, &state);
    revive_with(search, &search->lead, &state, 0, mcs52_cycles(last));
    mcs52_run(search->lead.chip, mcs52_cycles(last));
    mcs52_snapshot(search->lead.chip, &now);
    mcs52_snapshot(last, &known);
    return same(&now, &known);
}

/* --- classes ------------------------------------------------------------------------------ */

/* The chip's clock stands. */
static bool is_off(struct mcs52 *chip)
{
    return mcs52_is_asleep(chip) && (mcs52_sfr(chip, PCON) & PD);
}

/* In place of a snapshot of a chip whose clock stands for good: only its pins count. */
static void pins_of(const struct mcs52 *chip, struct mcs52_snapshot *state)
{
    memset(state, 0, sizeof *state);
    for (int pin = 0; pin < 32; pin++) {
        state->bytes[pin] = mcs52_pin(chip, pin / 8, pin % 8);
    }
}

/* WORK has come to the end of SLOT: the class of that, which is CLASS if it is a new one. */
static uint32_t settle(struct search *search, const struct slot *slot, uint32_t class)
{
    struct runner *work = &search->work;
    struct mcs52_snapshot state;

    if (is_off(work->chip)) {
        pins_of(work->chip, &state);
        return classes_leave(search->space->classes, class, &state, work->edges);
    }
    mcs52_snapshot(work->chip, &state);
    if (work->reset || work->edges != slot->edges) {
        return classes_leave(search->space->classes, class, &state, work->edges);
    }
    if (same(&state, &slot->state)) {
        classes_end(search->space->classes, class);
        return CLASS_NONE;
    }
    return classes_stay(search->space->classes, class, &state);
}

/* The same of a flip that nobody knows of yet. */
static uint32_t settle_new(struct search *search, const struct slot *slot,
                           const struct fault_case *first)
{
    uint32_t class = classes_add(search->space->classes, first);
    uint32_t one = settle(search, slot, class);

    if (one != class) {
        classes_forget(search->space->classes, class);
    }
    return one;
}

/* All classes of the slot before go on through SLOT. */
static void pass_slot(struct search *search, const struct slot *slot)
{
    struct classes *classes = search->space->classes;
    const struct mcs52_snapshot *state;
    uint32_t class;

    classes_turn(classes);
    for (size_t i = 0; (state = classes_old(classes, i, &class)) != NULL; i++) {
        revive(search, &search->work, state, slot, 0);
        mcs52_run(search->work.chip, slot->until);
        settle(search, slot, class);
    }
}

static void note_use(struct search *search, struct spot *spot, uint64_t cycle, uint32_t class)
{
    struct space *space = search->space;
    uint32_t index = (uint32_t)(spot - space->spots);

    if (space->use_count == space->use_capacity) {
        space->use_capacity = 2 * space->use_capacity + 1024;
        space->uses = realloc(space->uses, space->use_capacity * sizeof *space->uses);
        if (space->uses == NULL) {
            abort();
        }
    }
    space->uses[space->use_count++] =
        (struct use){.spot = index, .points = (uint32_t)(cycle - spot->waits_from), .class = class};
    for (uint32_t i = spot->samples; i > 0; i = space->samples[i - 1].next) {
        struct sample *sample = &space->samples[i - 1];

        if (sample->cycle > spot->waits_from && sample->cycle <= cycle) {
            sample->class = class;
        }
    }
    spot->waits_from = cycle;
}

/* --- every bit before one instruction ----------------------------------------------------- */

/* The drive without a fault around one instruction. */
struct step {
    const struct slot *slot;
    struct mcs52_snapshot before, after;
    uint64_t cycle, edges_before, edges_after;
};

/* The fault waits: after the instruction it is all that is different. */
static bool still_waits(struct search *search, const struct step *step, const struct spot *spot,
                        const struct mcs52_snapshot *state)
{
    struct mcs52_snapshot waits;
    struct runner *lead = &search->lead;

    if (search->work.edges != step->edges_after || search->work.reset ||
        is_off(search->work.chip)) {
        return false;
    }
    mcs52_revive(lead->chip, &step->after);
    flip(lead->chip, spot);
    mcs52_snapshot(lead->chip, &waits);
    return same(state, &waits);
}

static void try_spot(struct search *search, const struct step *step, struct spot *spot)
{
    struct runner *work = &search->work;
    struct mcs52_snapshot state;
    const struct fault_case first = {.where = spot->where,
                                     .kind = MCS52_FLIP,
                                     .address = spot->address,
                                     .bit = spot->bit,
                                     .cycle = step->cycle};
    uint32_t class = CLASS_NONE;

    revive(search, work, &step->before, step->slot, step->edges_before);
    flip(work->chip, spot);
    mcs52_step(work->chip);
    mcs52_snapshot(work->chip, &state);
    if (still_waits(search, step, spot, &state)) {
        return;
    }
    if (!same(&state, &step->after) || work->edges != step->edges_after || work->reset) {
        mcs52_run(work->chip, step->slot->until);
        class = settle_new(search, step->slot, &first);
    }
    note_use(search, spot, step->cycle, class);
}

static void try_byte(struct search *search, const struct step *step, uint8_t address,
                     bool tried[MCS52_RAM_BYTES])
{
    int spot = search->spots_of_ram[address];

    if (!tried[address] && spot >= 0) {
        tried[address] = true;
        for (int bit = 0; bit < 8; bit++) {
            try_spot(search, step, &search->space->spots[spot + bit]);
        }
    }
}

/* Each bit that the instruction could have to do with: a few bytes of RAM, all registers. */
static void try_all(struct search *search, const struct step *step, const uint8_t operands[2])
{
    struct space *space = search->space;
    struct mcs52 *work = search->work.chip;
    bool tried[MCS52_RAM_BYTES] = {false};
    uint8_t bank, stack, pointers[2];

    mcs52_revive(work, &step->before);
    bank = mcs52_sfr(work, PSW) & BANK;
    stack = mcs52_sfr(work, SP);
    memcpy(pointers, mcs52_ram(work) + bank, sizeof pointers);
    for (int i = 0; i < 8; i++) {
        try_byte(search, step, (uint8_t)(bank + i), tried);
    }
    for (int i = 0; i < 2; i++) {
        try_byte(search, step, operands[i], tried);
        try_byte(search, step, (uint8_t)(0x20 + (operands[i] >> 3)), tried);
        try_byte(search, step, pointers[i], tried);
    }
    for (int i = -1; i <= 2; i++) {
        try_byte(search, step, (uint8_t)(stack + i), tried);
    }
    for (uint32_t i = space->first_register_spot; i < space->spot_count; i++) {
        try_spot(search, step, &space->spots[i]);
    }
}

/* --- a window ----------------------------------------------------------------------------- */

static void search_slot(struct search *search, const struct mcs52_snapshot *start,
                        const struct slot *slot)
{
    struct runner *lead = &search->lead;
    struct step step = {.slot = slot, .after = *start};

    mcs52_revive(lead->chip, start);
    while (mcs52_cycles(lead->chip) < slot->end) {
        const uint8_t *operands = search->code + mcs52_pc(lead->chip) + 1;

        step.before = step.after;
        step.edges_before = step.edges_after;
        step.cycle = mcs52_cycles(lead->chip);
        revive(search, lead, &step.before, slot, step.edges_before);
        mcs52_step(lead->chip);
        mcs52_snapshot(lead->chip, &step.after);
        step.edges_after = lead->edges;
        try_all(search, &step, operands);
        mcs52_revive(lead->chip, &step.after);
    }
}

/* At the end of the window all flips that still wait become classes. */
static void end_window(struct search *search, const struct slot *slot)
{
    struct space *space = search->space;

    for (uint32_t i = 0; i < space->spot_count; i++) {
        struct spot *spot = &space->spots[i];
        const struct fault_case first = {.where = spot->where,
                                         .kind = MCS52_FLIP,
                                         .address = spot->address,
                                         .bit = spot->bit,
                                         .cycle = slot->end};

        if (spot->waits_from < slot->end) {
            revive(search, &search->work, &slot->state, slot, slot->edges);
            flip(search->work.chip, spot);
            note_use(search, spot, slot->end, settle_new(search, slot, &first));
        }
    }
}

bool search_window(struct search *search, struct mcs52 *start, uint64_t window_mc)
{
    struct space *space = search->space;
    struct mcs52_snapshot state;

    if (!cut_slots(search, start, window_mc)) {
        return false;
    }
    mcs52_snapshot(start, &state);
    for (uint32_t i = 0; i < space->spot_count; i++) {
        space->spots[i].waits_from = mcs52_cycles(start) - 1;
    }
    for (size_t n = 0; n < search->slot_count; n++) {
        pass_slot(search, &search->slots[n]);
        if (n < search->window_slots) {
            search_slot(search, &state, &search->slots[n]);
            state = search->slots[n].state;
        }
        if (n + 1 == search->window_slots) {
            end_window(search, &search->slots[n]);
        }
    }
    classes_turn(space->classes);
    classes_turn(space->classes);
    free(search->slots);
    return true;
}

struct search *search_create(struct space *space, const struct fair *fair,
                             const struct board *board, const uint8_t *code)
{
    struct search *search = calloc(1, sizeof *search);

    if (search == NULL) {
        abort();
    }
    *search = (struct search){.space = space, .fair = fair, .code = code};
    for (int address = 0; address < MCS52_RAM_BYTES; address++) {
        search->spots_of_ram[address] = -1;
    }
    for (uint32_t i = 0; i < space->first_register_spot; i += 8) {
        search->spots_of_ram[space->spots[i].address] = (int)i;
    }
    runner_init(&search->lead, fair->boots[0], board);
    runner_init(&search->work, fair->boots[0], board);
    return search;
}

void search_free(struct search *search)
{
    mcs52_destroy(search->lead.chip);
    mcs52_destroy(search->work.chip);
    free(search);
}
