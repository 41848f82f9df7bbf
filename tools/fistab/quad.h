/* SPDX-License-Identifier: MIT */
/* Adaptive integration of a function and of its first moment. */
#ifndef FUZZY51_QUAD_H
#define FUZZY51_QUAD_H

struct moments {
    double area;   /* integral of f */
    double moment; /* integral of f(x) * (x - origin) */
};

struct integrand {
    double (*f)(double x, const void *context); /* not negative; need not be smooth */
    const void *context;
    double origin;
    double span;      /* size of the x - origin that count */
    double tolerance; /* of the area; of the moment: times span */
    double noise;     /* what f is not known better than */
    int *budget;      /* splits left; where none is, parts are taken as they are */
};

/* Integrates from LEFT to RIGHT, splitting until the tolerance is kept, or where no more digits are
 * to be had: f itself is rounded. */
struct moments quad(const struct integrand *integrand, double left, double right);

#endif
