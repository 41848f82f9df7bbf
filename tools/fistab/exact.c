/* SPDX-License-Identifier: MIT */
/* Defuzzification without samples. */
#include "exact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "quad.h"
#include "shape.h"

/* Far more than sets that people draw need: a kink costs about 40. */
enum { SPLITS_MAX = 200000 };

/* Between two neighbouring cuts. */
struct piece {
    double left, right;
    double at_left, at_right; /* mu just inside */
    bool straight;
    struct moments m; /* about the middle of the range */
};

/* A piece of one term: straight from left to right. */
struct line {
    double at_left, at_right;
};

struct work {
    const struct variable *output;
    const struct exact_term *term;
    size_t terms;
    double min, max, middle;
    bool straight; /* all terms are, and what the aggregation makes of them too */
    double *cut;
    size_t cuts;
    struct line *line; /* of each term, in the piece at hand */
    struct piece *piece;
    size_t pieces, room;
    struct integrand integrand; /* the aggregated set */
    bool failed;
};

/* --- values ---------------------------------------------------------------------------------- */

static double term_set(const struct exact_term *term, double x)
{
    double mu = set_degree(term->set, x);
    return term->negated ? 1 - mu : mu;
}

static double implied(const struct exact_term *term, double mu)
{
    return tnorm(term->imp_method, term->strength, mu);
}

static double aggregate_at(double x, const void *context)
{
    const struct work *w = context;
    double sum = 0;

    for (size_t i = 0; i < w->terms; i++) {
        sum = snorm(w->output->agg_method, sum, implied(&w->term[i], term_set(&w->term[i], x)));
    }
    return sum;
}

/* --- cuts ------------------------------------------------------------------------------------ */

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts X, drops what lies outside of [MIN, MAX] and all but one of equals; the ends are always
 * there. */
static size_t tidy(double *x, size_t count, double min, double max)
{
    size_t kept = 0;

    x[count++] = min;
    x[count++] = max;
    qsort(x, count, sizeof *x, by_value);
    for (size_t i = 0; i < count; i++) {
        if (x[i] >= min && x[i] <= max && (kept == 0 || x[i] > x[kept - 1])) {
            x[kept++] = x[i];
        }
    }
    return kept;
}

/* Where the set of TERM, which rises or falls all the way from LEFT to RIGHT, is equal to LEVEL. */
static double crossing(const struct exact_term *term, double level, double left, double right,
                       double at_left)
{
    for (int i = 0; i < 100; i++) {
        double middle = left + (right - left) / 2;
        if ((term_set(term, middle) > level) == (at_left > level)) {
            left = middle;
        } else {
            right = middle;
        }
    }
    return left;
}

/* Cuts where TERM's set crosses LEVEL. KINK has its KINKS kinks. */
static void cut_level(struct work *w, const struct exact_term *term, double level,
                      const double *kink, size_t kinks)
{
    for (size_t i = 0; i + 1 < kinks; i++) {
        double width = kink[i + 1] - kink[i];
        double left =
            kink[i] + 1e-9 * width; /* inside, as there may be a step at the kink itself */
        double right = kink[i + 1] - 1e-9 * width;
        double at_left = term_set(term, left);
        double at_right = term_set(term, right);

        if ((at_left > level) != (at_right > level)) {
            w->cut[w->cuts++] =
                shape_is_linear(term->set)
                    ? left + (right - left) * (level - at_left) / (at_right - at_left)
                    : crossing(term, level, left, right, at_left);
        }
    }
}

/* Cuts at the kinks of one term, and where its implication makes another kink: min where the set
 * meets the strength, two others where both together are 1. */
static void cut_term(struct work *w, const struct exact_term *term)
{
    double kink[SHAPE_KINKS_MAX + 2];
    size_t kinks = tidy(kink, shape_kinks(term->set, kink), w->min, w->max);

    for (size_t i = 0; i < kinks; i++) {
        w->cut[w->cuts++] = kink[i];
    }
    if (term->imp_method == TNORM_MIN || term->imp_method == TNORM_NILPOTENT_MINIMUM) {
        cut_level(w, term, term->strength, kink, kinks);
    }
    if (term->imp_method == TNORM_BOUNDED_DIFFERENCE ||
        term->imp_method == TNORM_NILPOTENT_MINIMUM) {
        cut_level(w, term, 1 - term->strength, kink, kinks);
    }
}

/* --- pieces ---------------------------------------------------------------------------------- */

static struct piece *new_piece(struct work *w, double left, double right)
{
    struct piece *piece;

    if (w->pieces == w->room) {
        size_t room = w->room == 0 ? 64 : 2 * w->room;
        struct piece *bigger = realloc(w->piece, room * sizeof *bigger);
        if (bigger == NULL) {
            w->failed = true;
            return NULL;
        }
        w->piece = bigger;
        w->room = room;
    }
    piece = &w->piece[w->pieces++];
    memset(piece, 0, sizeof *piece);
    piece->left = left;
    piece->right = right;
    return piece;
}

static void straight_piece(struct work *w, double left, double right, double at_left,
                           double at_right)
{
    struct piece *piece = new_piece(w, left, right);
    double width = right - left;

    if (piece == NULL) {
        return;
    }
    piece->straight = true;
    piece->at_left = at_left;
    piece->at_right = at_right;
    piece->m.area = width * (at_left + at_right) / 2;
    /* about the piece's own middle first, so that a far origin costs no digits */
    piece->m.moment = piece->m.area * ((left + right) / 2 - w->middle) +
                      width * width * (at_right - at_left) / 12;
}

/* The straight line that TERM is between LEFT and RIGHT, from two points inside: at the ends it may
 * jump. */
static struct line line_of(const struct exact_term *term, double left, double right)
{
    double quarter = (right - left) / 4;
    double y1 = implied(term, term_set(term, left + quarter));
    double y2 = implied(term, term_set(term, right - quarter));
    double rise = (y2 - y1) / 2;
    struct line line = {fmin(fmax(y1 - rise, 0), 1), fmin(fmax(y2 + rise, 0), 1)};

    return line;
}

/* The largest of the lines, walked from left to right: from the one on top to the first that
 * overtakes. */
static void walk_envelope(struct work *w, double left, double right)
{
    double at = 0; /* 0 at LEFT .. 1 at RIGHT */
    size_t top = 0;

    for (size_t i = 1; i < w->terms; i++) {
        if (w->line[i].at_left > w->line[top].at_left ||
            (w->line[i].at_left == w->line[top].at_left &&
             w->line[i].at_right > w->line[top].at_right)) {
            top = i;
        }
    }
    while (at < 1) {
        double rise = w->line[top].at_right - w->line[top].at_left;
        double next = 1;
        size_t follower = top;

        for (size_t i = 0; i < w->terms; i++) {
            double gain = w->line[i].at_right - w->line[i].at_left - rise;
            double meets = gain > 0 ? (w->line[top].at_left - w->line[i].at_left) / gain : 1;
            if (meets < next && w->line[i].at_right > w->line[top].at_right) {
                next = fmax(meets, at);
                follower = i;
            }
        }
        straight_piece(w, left + (right - left) * at,
                       next == 1 ? right : left + (right - left) * next,
                       w->line[top].at_left + rise * at, w->line[top].at_left + rise * next);
        at = next;
        top = follower;
    }
}

static void linear_pieces(struct work *w, double left, double right)
{
    double at_left = 0;
    double at_right = 0;

    for (size_t i = 0; i < w->terms; i++) {
        w->line[i] = line_of(&w->term[i], left, right);
        at_left += w->line[i].at_left;
        at_right += w->line[i].at_right;
    }
    if (w->output->agg_method == SNORM_SUM || w->terms == 1) {
        straight_piece(w, left, right, at_left, at_right);
    } else {
        walk_envelope(w, left, right);
    }
}

static void curved_piece(struct work *w, double left, double right)
{
    struct piece *piece = new_piece(w, left, right);
    double inside = 1e-12 * (right - left);

    if (piece == NULL) {
        return;
    }
    piece->at_left = aggregate_at(left + inside, w);
    piece->at_right = aggregate_at(right - inside, w);
    piece->m = quad(&w->integrand, left, right);
}

static void make_pieces(struct work *w)
{
    w->pieces = 0;
    for (size_t i = 0; i + 1 < w->cuts && !w->failed; i++) {
        if (w->straight) {
            linear_pieces(w, w->cut[i], w->cut[i + 1]);
        } else {
            curved_piece(w, w->cut[i], w->cut[i + 1]);
        }
    }
}

static struct moments total(const struct work *w)
{
    struct moments sum = {0, 0};

    for (size_t i = 0; i < w->pieces; i++) {
        sum.area += w->piece[i].m.area;
        sum.moment += w->piece[i].m.moment;
    }
    return sum;
}

/* --- methods --------------------------------------------------------------------------------- */

/* Where, from the left of PIECE, the area is AREA. */
static double share(const struct work *w, const struct piece *piece, double area)
{
    double left = piece->left;
    double right = piece->right;

    if (piece->straight) {
        double slope = (piece->at_right - piece->at_left) / (right - left);
        double root = sqrt(fmax(piece->at_left * piece->at_left + 2 * slope * area, 0));
        /* area = at_left*t + slope*t^2/2, solved so that a small slope costs no digits */
        return root + piece->at_left > 0 ? fmin(left + 2 * area / (root + piece->at_left), right)
                                         : left;
    }
    for (int i = 0; i < 60; i++) {
        double middle = left + (right - left) / 2;
        double part = quad(&w->integrand, left, middle).area;

        if (part < area) {
            area -= part;
            left = middle;
        } else {
            right = middle;
        }
    }
    return left;
}

static double bisector(const struct work *w, double area)
{
    double wanted = area / 2;
    double sum = 0;

    for (size_t i = 0; i < w->pieces; i++) {
        double part = w->piece[i].m.area;
        if (sum + part >= wanted && part > 0) {
            return share(w, &w->piece[i], wanted - sum);
        }
        sum += part;
    }
    return w->max;
}

/* The set of points where mu is largest: stretches and single points, as they come from the left.
 */
struct summit {
    double height;
    double length, moment; /* of the stretches */
    double sum, last;      /* of the single points */
    size_t points;
    double smallest, largest; /* by absolute value */
    bool any;
};

static void add_extreme(struct summit *s, double x)
{
    if (!s->any || fabs(x) < fabs(s->smallest)) {
        s->smallest = x;
    }
    if (!s->any || fabs(x) > fabs(s->largest)) {
        s->largest = x;
    }
    s->any = true;
}

static void add_point(struct summit *s, double x, double same)
{
    add_extreme(s, x);
    if (s->points > 0 && x - s->last <= same) {
        return; /* the end of one piece and the start of the next */
    }
    s->sum += x;
    s->last = x;
    s->points++;
}

static void add_stretch(struct summit *s, double left, double right)
{
    s->length += right - left;
    s->moment += (right - left) * (left + right) / 2;
    add_extreme(s, left);
    if (left < 0 && right > 0) {
        add_extreme(s, 0);
    }
    add_extreme(s, right);
}

enum { LOOKS = 64 };

/* The top of a curved piece that no end of it shows: with sum and probor, two slopes may make one.
 */
static double inner_top(const struct work *w, const struct piece *piece, double *at)
{
    double step = (piece->right - piece->left) / LOOKS;
    double y[LOOKS + 1];
    int best = 0;

    y[0] = piece->at_left;
    y[LOOKS] = piece->at_right;
    for (int i = 1; i < LOOKS; i++) {
        y[i] = aggregate_at(piece->left + i * step, w);
    }
    for (int i = 1; i <= LOOKS; i++) {
        if (y[i] > y[best]) {
            best = i;
        }
    }
    if (best == 0 || best == LOOKS || y[best + 1] == y[best]) {
        return -1;
    }
    *at = shape_peak(aggregate_at, w, piece->left + (best - 1) * step,
                     piece->left + (best + 1) * step);
    return aggregate_at(*at, w);
}

static bool is_level(const struct work *w, const struct piece *piece, double floor)
{
    if (piece->at_left < floor || piece->at_right < floor) {
        return false;
    }
    for (int i = 1; !piece->straight && i < 8; i++) {
        if (aggregate_at(piece->left + (piece->right - piece->left) * i / 8, w) < floor) {
            return false;
        }
    }
    return true;
}

static double of_maximum(const struct work *w, enum fis_defuzz method)
{
    bool inner = !w->straight && w->output->agg_method != SNORM_MAX;
    struct summit s = {0};
    double same = 1e-11 * (w->max - w->min);
    double floor;
    double at;

    for (size_t i = 0; i < w->pieces; i++) {
        s.height = fmax(s.height, fmax(w->piece[i].at_left, w->piece[i].at_right));
        if (inner) {
            s.height = fmax(s.height, inner_top(w, &w->piece[i], &at));
        }
    }
    floor = s.height * (1 - 1e-11);
    for (size_t i = 0; i < w->pieces; i++) {
        const struct piece *piece = &w->piece[i];

        if (is_level(w, piece, floor)) {
            add_stretch(&s, piece->left, piece->right);
            continue;
        }
        if (piece->at_left >= floor) {
            add_point(&s, piece->left, same);
        }
        if (inner && inner_top(w, piece, &at) >= floor) {
            add_point(&s, at, same);
        }
        if (piece->at_right >= floor) {
            add_point(&s, piece->right, same);
        }
    }
    if (method == DEFUZZ_SOM) {
        return s.smallest;
    }
    if (method == DEFUZZ_LOM) {
        return s.largest;
    }
    return s.length > 0 ? s.moment / s.length : s.sum / (double)s.points;
}

/* --- all together ---------------------------------------------------------------------------- */

static bool prepare(struct work *w)
{
    size_t room = 2;

    w->straight =
        w->output->agg_method == SNORM_MAX || w->output->agg_method == SNORM_SUM || w->terms == 1;
    for (size_t i = 0; i < w->terms; i++) {
        const struct exact_term *term = &w->term[i];

        w->straight = w->straight && shape_is_linear(term->set) &&
                      (term->imp_method == TNORM_MIN || term->imp_method == TNORM_PROD);
        room += 3 * (term->set->parameters / 2 + 40);
    }
    w->cut = malloc((room + 2) * sizeof *w->cut);
    w->line = malloc(w->terms * sizeof *w->line);
    return w->cut != NULL && w->line != NULL;
}

/* A difference of numbers near 1 is known to the last bit of 1 only, however small it is. */
static bool loses_digits(const struct exact_term *term, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (term[i].negated || term[i].set->kind == MF_DSIGMF) {
            return true;
        }
    }
    return false;
}

bool exact_defuzz(const struct variable *output, const struct exact_term *term, size_t count,
                  double *y)
{
    struct work w = {
        .output = output, .term = term, .terms = count, .min = output->min, .max = output->max};
    struct moments sum = {0, 0};
    int budget = SPLITS_MAX;

    w.middle = w.min + (w.max - w.min) / 2;
    w.integrand = (struct integrand){.f = aggregate_at,
                                     .context = &w,
                                     .origin = w.middle,
                                     .span = (w.max - w.min) / 2,
                                     .noise = loses_digits(term, count) ? 4e-16 : 0,
                                     .budget = &budget};
    if (prepare(&w)) {
        for (size_t i = 0; i < count; i++) {
            cut_term(&w, &term[i]);
        }
        w.cuts = tidy(w.cut, w.cuts, w.min, w.max);
        /* A curved set: a first look for the size of the area, then the same to a share of it. */
        w.integrand.tolerance = 1e-4 * (w.max - w.min);
        make_pieces(&w);
        sum = total(&w);
        if (!w.straight && sum.area > 0) {
            w.integrand.tolerance = 1e-11 * sum.area / (double)w.cuts;
            make_pieces(&w);
            sum = total(&w);
        }
    }
    if (sum.area > 0) {
        if (output->defuzz_method == DEFUZZ_CENTROID) {
            *y = w.middle + sum.moment / sum.area;
        } else if (output->defuzz_method == DEFUZZ_BISECTOR) {
            *y = bisector(&w, sum.area);
        } else {
            *y = of_maximum(&w, output->defuzz_method);
        }
        *y = fmin(fmax(*y, w.min), w.max);
    }
    free(w.cut);
    free(w.line);
    free(w.piece);
    return sum.area > 0;
}
