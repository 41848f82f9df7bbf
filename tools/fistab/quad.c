/* SPDX-License-Identifier: MIT */
/* Gauss-Kronrod 7/15 with bisection. */
#include "quad.h"

#include <math.h>
#include <stdbool.h>

enum { DEPTH_MAX = 50, LOOK_BACK = 8 };

/* Below this share of what a part holds, a difference is rounding. */
#define ROUNDING 1e-13

struct path {
    const struct integrand *integrand;
    double density;              /* tolerance over length */
    double error[DEPTH_MAX + 1]; /* of the parts from the whole down to here, over length */
};

/* Nodes on the positive half of [-1, 1]; the odd ones are Gauss's seven (Piessens et al.,
 * QUADPACK). */
static const double node[8] = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691258380, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0,
};
static const double kronrod[8] = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714,
};
static const double gauss[4] = {
    0.129484966168869693270611432679082,
    0.279705391489276667901467771423780,
    0.381830050505118944950369775488975,
    0.417959183673469387755102040816327,
};

/* The rules of 15 and of 7 points, both over half the length of the part. */
static void measure(const struct integrand *g, double left, double right, struct moments *fine,
                    struct moments *coarse)
{
    double half = (right - left) / 2;
    double centre = left + half;

    *fine = *coarse = (struct moments){0, 0};
    for (int i = 0; i < 8; i++) {
        for (int side = -1; side <= (i == 7 ? -1 : 1); side += 2) {
            double x = centre + side * half * node[i];
            double y = g->f(x, g->context);
            double xy = y * (x - g->origin);

            fine->area += kronrod[i] * y;
            fine->moment += kronrod[i] * xy;
            if (i % 2 == 1) {
                coarse->area += gauss[i / 2] * y;
                coarse->moment += gauss[i / 2] * xy;
            }
        }
    }
}

/* Splitting makes the error over length smaller: by half at a kink, by much more where f is smooth.
 * If eight splits have not, a small error is the rounding of f. */
static bool is_rounding(const struct path *path, int depth, double area)
{
    /* cppcheck-suppress arrayIndexOutOfBoundsCond ; refine() ends at DEPTH_MAX, error[] has one
     * more */
    const double *error = &path->error[depth];

    return depth >= LOOK_BACK && error[0] > error[-LOOK_BACK] / 10 && error[0] < 1e-4 * area;
}

static struct moments refine(struct path *path, double left, double right, int depth)
{
    const struct integrand *g = path->integrand;
    struct moments fine, coarse, other;
    double *error = &path->error[depth];

    measure(g, left, right, &fine, &coarse);
    *error = fmax(fabs(fine.area - coarse.area), fabs(fine.moment - coarse.moment) / g->span);
    if (*error <= fmax(fmax(2 * path->density, g->noise), ROUNDING * fine.area) ||
        depth == DEPTH_MAX || *g->budget <= 0 || is_rounding(path, depth, fine.area)) {
        fine.area *= (right - left) / 2;
        fine.moment *= (right - left) / 2;
        return fine;
    }
    --*g->budget;
    fine = refine(path, left, left + (right - left) / 2, depth + 1);
    other = refine(path, left + (right - left) / 2, right, depth + 1);
    fine.area += other.area;
    fine.moment += other.moment;
    return fine;
}

struct moments quad(const struct integrand *integrand, double left, double right)
{
    struct path path = {.integrand = integrand, .density = integrand->tolerance / (right - left)};

    if (!(right > left)) {
        return (struct moments){0, 0};
    }
    return refine(&path, left, right, 0);
}
