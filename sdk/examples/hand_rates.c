/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type with hand-written callbacks: eval and rate, without model arithmetic.
 *
 * A propeller blade, the strip between two helices that turns about the z axis:
 *
 *   w = v + speed t:   (u cos w, u sin w, pitch v),   0 <= u <= radius, 0 <= v <= turn
 *
 * Every bound is derived above its code. Notation: e = 2^-53, half a unit in the last place of 1; a
 * computed sum, product or quotient x is within e |x| of the exact one (or, near 0, within
 * IMP_TINY); sin and cos of libm are trusted to 4 units in the last place, 8 e |x|. */

#include <impinge/interval.h>
#include <impinge/plugin.h>

enum { RADIUS, TURN, PITCH, SPEED };

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW("radius", "length", "1", IMP_PARAMETER_MIN_OPEN, 0, 0, 0, 0, 1e100,
                       "from the axis to the tip"),
    [TURN] = IMP_ROW("turn", "rad", "1", IMP_PARAMETER_MIN_OPEN, 0, 0, 0, 0, 1e100,
                     "angle between the two ends of the blade"),
    [PITCH] = IMP_ROW_BETWEEN("pitch", "length/rad", "0.5", -1e100, 1e100, "rise along the axis"),
    [SPEED] = IMP_ROW_BETWEEN("speed", "rad/time", "0", -1e100, 1e100, "angular velocity"),
};

typedef struct blade {
    double radius, turn, pitch, speed;
} blade;

static imp_status blade_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    blade *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->radius = values[RADIUS].number[0];
    made->turn = values[TURN].number[0];
    made->pitch = values[PITCH].number[0];
    made->speed = values[SPEED].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static void blade_domain(const void *self, double lo[3], double hi[3])
{
    const blade *b = self;
    imp_set_domain(lo, hi, 0, b->radius, 0, b->turn);
}

/* One point and the absolute error of each coordinate.
 *
 * Lemma. The computed w is off by at most e (|speed t| + |w|), from a product and a sum, and where
 * it is off by dw, cos w and sin w are off by at most dw. With libm's error and that of the
 * product with u, x and y are off by at most
 *
 *   |u| (dw + 8 e) + e |u|   <=   |u| (dw + 9 e).
 *
 * z is one product: e |z|. The factor 2 in the code covers the rounding of the bounds themselves,
 * which are sums of positive numbers, and IMP_TINY what may underflow. */
static void eval_one(const blade *b, const double p[3], double x[3], double error[3])
{
    const double e = 0x1p-53;
    double turned = b->speed * p[2], w = p[1] + turned;
    double dw = e * (fabs(turned) + fabs(w));
    x[0] = p[0] * cos(w);
    x[1] = p[0] * sin(w);
    x[2] = b->pitch * p[1];
    error[0] = error[1] = 2 * fabs(p[0]) * (dw + 9 * e) + IMP_TINY;
    error[2] = 2 * e * fabs(x[2]) + IMP_TINY;
}

static imp_status blade_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < n; ++k) {
        double off[3];
        eval_one(self, p + 3 * k, x + 3 * k, off);
        for (size_t i = 0; error != NULL && i < 3; ++i) error[3 * k + i] = off[i];
        if (!(off[0] < INFINITY))
            status = IMP_STATUS_DOMAIN; /* speed t is too large for a double */
    }
    return status;
}

/* The rate matrix, by the rules of sdk/README.
 *
 *   x = u cos w: product. |dx/du| <= max |cos w| <= 1; |dx/dv| <= max |u| max |sin w| <= max |u|;
 *                the chain rule for w: |dx/dt| <= max |u| |speed|. y likewise.
 *   z = pitch v: |dz/dv| = |pitch|.
 *
 * max |u| is at an end of the region, and is exact; the product is rounded up. */
static imp_status blade_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const blade *b = self;
    double u = imp_larger(fabs(region->lo[0]), fabs(region->hi[0]));
    double moved = imp_round_up(u * fabs(b->speed));
    *rates = (imp_rate_matrix){{{1, u, moved}, {1, u, moved}, {0, fabs(b->pitch), 0}}};
    return moved < INFINITY ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* .include is NULL: the host makes inclusions from eval and rate. */
static const imp_surface_type type = {
    IMP_TYPE_FIELDS(imp_surface_type, "blade", blade, free),
    .domain = blade_domain,
    .eval = blade_eval,
    .rate = blade_rate,
    .summary = "propeller blade that turns",
    .equation = "w = v + speed t: (u cos w, u sin w, pitch v), u in [0,radius], v in [0,turn]",
    .source = NULL,
    .example = "blade speed=10",
};

IMPINGE_SURFACE_PLUGIN("blade", "1.0", "MIT", "The Impinge authors", type);
