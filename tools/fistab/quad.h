/* Adaptive integration of a function and of its first moment. */
#ifndef FUZZY51_QUAD_H
#define FUZZY51_QUAD_H

struct moments {
    double area;   /* integral of f */
    double moment; /* integral of f(x) * (x - origin) */
};

/* Integrates F from LEFT to RIGHT, splitting until the area is within TOLERANCE and the moment
 * within TOLERANCE * SPAN, SPAN being the size of the x - ORIGIN that count. F is not negative; it
 * need not be smooth. */
struct moments quad(double (*f)(double x, const void *context), const void *context, double left,
                    double right, double origin, double span, double tolerance);

#endif
