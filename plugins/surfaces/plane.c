/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>

/* A parallelogram: the part of a plane that two edges span. */

enum { ORIGIN, EDGE_U, EDGE_V };

static const imp_parameter parameters[] = {
    [ORIGIN] = ROW_NEAR_VECTOR("origin", "length", "[0,0,0]", 0, "corner u = v = 0"),
    [EDGE_U] =
        ROW_NEAR_VECTOR("edge_u", "length", "[1,0,0]", 0, "from the origin to the corner u = 1"),
    [EDGE_V] = ROW_NEAR_VECTOR("edge_v", "length", "[0,1,0]", 0,
                               "from the origin to the corner v = 1; not parallel to edge_u"),
};

typedef struct plane_instance {
    linear surface;             /* first: what linear.h does with an instance */
    double normal[3], flatness; /* plane_gap */
} plane_instance;

static double greatest(const double x[3])
{
    return imp_larger(fabs(x[0]), imp_larger(fabs(x[1]), fabs(x[2])));
}

/* Are these directions parallel up to rounding: is every component of the cross product within the
 * bound of the three roundings of each of its products? */
static bool are_parallel(const double a[3], const double b[3])
{
    const double size_a = greatest(a), size_b = greatest(b);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double p = (a[j] / size_a) * (b[k] / size_b), q = (a[k] / size_a) * (b[j] / size_b);
        if (fabs(p - q) > 0x1p-51 * (fabs(p) + fabs(q))) return false;
    }
    return true;
}

static imp_status check_edges(const imp_value *values, imp_create_error *why)
{
    const double *u = values[EDGE_U].number, *v = values[EDGE_V].number;
    for (int edge = EDGE_U; edge <= EDGE_V; ++edge)
        if (greatest(values[edge].number) == 0)
            return imp_reject(why, edge, -1, "[0,0,0] spans nothing; must be any vector but 0");
    if (!are_parallel(u, v)) return IMP_STATUS_OK;
    return imp_reject(why, EDGE_V, -1,
                      "[%g,%g,%g] is parallel to edge_u [%g,%g,%g]; must be any other direction",
                      v[0], v[1], v[2], u[0], u[1], u[2]);
}

/* a times a power of two, so that its greatest component is from 1/2 to 1, and b alike; components
 * that underflow are negligible, as the normal need not be accurate. */
static void normal_across(const double a[3], const double b[3], double n[3])
{
    int of_a, of_b;
    frexp(greatest(a), &of_a);
    frexp(greatest(b), &of_b);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = ldexp(a[j], -of_a) * ldexp(b[k], -of_b) - ldexp(a[k], -of_a) * ldexp(b[j], -of_b);
    }
}

/* Lemma (length). |n| as computed is within 4 roundings, each quotient within one more: so each
 * component is at most 1 + 8 u times that of a unit vector, and (1 - 2^-48), rounded, takes off 30
 * u. */
static void set_normal(plane_instance *s, const double u[3], const double v[3])
{
    double n[3], along[2] = {0, 0}, size = 0;
    normal_across(u, v, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i) {
        s->normal[i] = length > 0x1p-400 ? n[i] / length * (1 - 0x1p-48) : 0;
        along[0] += s->normal[i] * u[i];
        along[1] += s->normal[i] * v[i];
        size += fabs(s->normal[i] * u[i]) + fabs(s->normal[i] * v[i]);
    }
    s->flatness = (fabs(along[0]) + fabs(along[1])) + 0x1p-48 * size + IMP_TINY;
}

static imp_status plane_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check_edges(values, why);
    if (status != IMP_STATUS_OK) return status;
    plane_instance *s = calloc(1, sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    linear *f = &s->surface;
    for (int i = 0; i < 3; ++i) {
        f->still[LINEAR_1][i] = values[ORIGIN].number[i];
        f->still[LINEAR_U][i] = values[EDGE_U].number[i];
        f->still[LINEAR_V][i] = values[EDGE_V].number[i];
    }
    linear_finish(f);
    set_normal(s, values[EDGE_U].number, values[EDGE_V].number);
    *self = s;
    return IMP_STATUS_OK;
}

/* n.(x - origin), the distance from the endless plane. Lemma. Let |n| <= 1 and y = origin + u
 * edge_u + v edge_v, u and v in [0, 1]. Then |x - y| >= |n.(x - origin) - n.(y - origin)|, and the
 * last is at most |n.edge_u| + |n.edge_v| <= flatness, in which 2^-48 is 32 u of the terms' size:
 * products and sums round 4 times, those of flatness itself 3. So n need not be accurate. */
static imp_model plane_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const plane_instance *s = self;
    const double *origin = s->surface.still[LINEAR_1];
    const imp_model n[3] = {imp_num(s->normal[0]), imp_num(s->normal[1]), imp_num(s->normal[2])};
    const imp_model m[3] = {imp_shift(x, -origin[0]), imp_shift(y, -origin[1]),
                            imp_shift(z, -origin[2])};
    (void)t;
    return imp_add(imp_dot3(m, n), imp_between(-s->flatness, s->flatness));
}
IMP_DISTANCE_FORMULA(plane_gap)

/* n.(x - origin) does not change where x turns about the line through origin along n, or moves
 * across it. */
static imp_status plane_symmetry(const void *self, imp_symmetry *symmetry)
{
    const plane_instance *s = self;
    symmetry->kind = IMP_SYMMETRY_ACROSS_LINE;
    memcpy(symmetry->center, s->surface.still[LINEAR_1], sizeof symmetry->center);
    memcpy(symmetry->axis, s->normal, sizeof symmetry->axis);
    return greatest(s->normal) > 0 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static void plane_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static const imp_surface_type plane = {
    IMP_SURFACE_FIELDS(plane, linear),
    .net = linear_net,
    .distance = plane_gap_distance,
    .symmetry = plane_symmetry,
    .summary = "parallelogram, the piece of a plane between two edges",
    .equation = "origin + u edge_u + v edge_v, u and v in [0,1]",
    .source = NULL,
    .example = "plane origin=-5,-5,0 edge_u=10,0,0 edge_v=0,10,0",
};

PUBLISH_SURFACE(plane);
