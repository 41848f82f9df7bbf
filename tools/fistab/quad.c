/* Gauss-Kronrod 7/15 with bisection. */
#include "quad.h"

#include <math.h>

enum { DEPTH_MAX = 50, SPLITS_MAX = 20000 };

/* Below this share of what a part holds, a difference is rounding. */
#define ROUNDING 1e-13

struct integral {
    double (*f)(double, const void *);
    const void *context;
    double origin;
    double span;
    double density; /* tolerance over length */
    int splits;
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

static struct moments refine(struct integral *q, double left, double right, int depth)
{
    double half = (right - left) / 2;
    double centre = left + half;
    struct moments fine = {0, 0};
    struct moments coarse = {0, 0};
    struct moments other;
    double allowed;

    for (int i = 0; i < 8; i++) {
        for (int side = -1; side <= (i == 7 ? -1 : 1); side += 2) {
            double x = centre + side * half * node[i];
            double y = q->f(x, q->context);
            double xy = y * (x - q->origin);

            fine.area += kronrod[i] * y;
            fine.moment += kronrod[i] * xy;
            if (i % 2 == 1) {
                coarse.area += gauss[i / 2] * y;
                coarse.moment += gauss[i / 2] * xy;
            }
        }
    }
    allowed = fmax(2 * q->density, ROUNDING * fine.area);
    if (depth == DEPTH_MAX || q->splits == SPLITS_MAX ||
        (fabs(fine.area - coarse.area) <= allowed &&
         fabs(fine.moment - coarse.moment) <= allowed * q->span)) {
        fine.area *= half;
        fine.moment *= half;
        return fine;
    }
    q->splits++;
    fine = refine(q, left, centre, depth + 1);
    other = refine(q, centre, right, depth + 1);
    fine.area += other.area;
    fine.moment += other.moment;
    return fine;
}

struct moments quad(double (*f)(double x, const void *context), const void *context, double left,
                    double right, double origin, double span, double tolerance)
{
    struct integral q = {f, context, origin, span, tolerance / (right - left), 0};

    if (!(right > left))
        return (struct moments){0, 0};
    return refine(&q, left, right, 0);
}
