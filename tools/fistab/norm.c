/* SPDX-License-Identifier: MIT */
/* The names of the norms. */
#include "norm.h"

const struct norm_name tnorm_name[] = {
    [TNORM_NONE] = {"", "none", "NONE"},
    [TNORM_MIN] = {"min", "Minimum", "MIN"},
    [TNORM_PROD] = {"prod", "AlgebraicProduct", "PROD"},
    [TNORM_BOUNDED_DIFFERENCE] = {"bounded_difference", "BoundedDifference", "BDIF"},
    [TNORM_DRASTIC_PRODUCT] = {"drastic_product", "DrasticProduct", "DPROD"},
    [TNORM_EINSTEIN_PRODUCT] = {"einstein_product", "EinsteinProduct", "EPROD"},
    [TNORM_HAMACHER_PRODUCT] = {"hamacher_product", "HamacherProduct", "HPROD"},
    [TNORM_NILPOTENT_MINIMUM] = {"nilpotent_minimum", "NilpotentMinimum", "NMIN"},
    {NULL, NULL, NULL},
};

const struct norm_name snorm_name[] = {
    [SNORM_NONE] = {"", "none", "NONE"},
    [SNORM_MAX] = {"max", "Maximum", "MAX"},
    [SNORM_PROBOR] = {"probor", "AlgebraicSum", "ASUM"},
    [SNORM_SUM] = {"sum", "UnboundedSum", "SUM"},
    [SNORM_BOUNDED_SUM] = {"bounded_sum", "BoundedSum", "BSUM"},
    [SNORM_NORMALIZED_SUM] = {"normalized_sum", "NormalizedSum", "NSUM"},
    [SNORM_DRASTIC_SUM] = {"drastic_sum", "DrasticSum", "DSUM"},
    [SNORM_EINSTEIN_SUM] = {"einstein_sum", "EinsteinSum", "ESUM"},
    [SNORM_HAMACHER_SUM] = {"hamacher_sum", "HamacherSum", "HSUM"},
    [SNORM_NILPOTENT_MAXIMUM] = {"nilpotent_maximum", "NilpotentMaximum", "NMAX"},
    {NULL, NULL, NULL},
};
