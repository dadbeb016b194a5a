/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/facet.h"
#include "plugins/common/publish.h"

/* A parallelogram: the part of a plane that two edges span. */

enum { ORIGIN, EDGE_U, EDGE_V };

static const imp_parameter parameters[] = {
    [ORIGIN] = ROW_NEAR_VECTOR("origin", "length", "[0,0,0]", 0, "corner u = v = 0"),
    [EDGE_U] =
        ROW_NEAR_VECTOR("edge_u", "length", "[1,0,0]", 0, "from the origin to the corner u = 1"),
    [EDGE_V] = ROW_NEAR_VECTOR("edge_v", "length", "[0,1,0]", 0,
                               "from the origin to the corner v = 1; not parallel to edge_u"),
};

/* Are these directions parallel up to rounding: is every component of the cross product within the
 * bound of the three roundings of each of its products? */
static bool are_parallel(const double a[3], const double b[3])
{
    const double size_a = facet_greatest(a), size_b = facet_greatest(b);
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
        if (facet_greatest(values[edge].number) == 0)
            return imp_reject(why, edge, -1, "[0,0,0] spans nothing; must be any vector but 0");
    if (!are_parallel(u, v)) return IMP_STATUS_OK;
    return imp_reject(why, EDGE_V, -1,
                      "[%g,%g,%g] is parallel to edge_u [%g,%g,%g]; must be any other direction",
                      v[0], v[1], v[2], u[0], u[1], u[2]);
}

static imp_status plane_fill(facet *s, const imp_value *values, imp_create_error *why)
{
    imp_status status = check_edges(values, why);
    if (status != IMP_STATUS_OK) return status;
    facet_span(s, values[ORIGIN].number, values[EDGE_U].number, values[EDGE_V].number);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(plane, facet)

/* The distance from the endless plane. */
static imp_model plane_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)t;
    return facet_gap(self, x, y, z);
}
IMP_DISTANCE_FORMULA(plane_gap)

static void plane_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static const imp_surface_type plane = {
    IMP_SURFACE_FIELDS(plane, linear),
    .renew = plane_renew,
    .net = linear_net,
    .distance = plane_gap_distance,
    .symmetry = facet_symmetry,
    .summary = "parallelogram, the piece of a plane between two edges",
    .equation = "origin + u edge_u + v edge_v, u and v in [0,1]",
    .source = NULL,
    .formula = "u in [0, 1]; v in [0, 1]; origin0 + edge_u0*u + edge_v0*v; origin1 + edge_u1*u "
               "+ edge_v1*v; origin2 + edge_u2*u + edge_v2*v",
    .example = "plane origin=-5,-5,0 edge_u=10,0,0 edge_v=0,10,0",
};

PUBLISH_SURFACE(plane);
