/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/capped.h"
#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* The lateral surface; with `ends`, both end discs, as pieces of their own. Without them a thin
 * body can pass through. All pieces go round the same way: f_u x f_v points outward. */

static const imp_parameter parameters[] = {
    [CAPPED_RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius"),
    [CAPPED_HEIGHT] = IMP_ROW_POSITIVE("height", "length", "2", "extent along the z axis"),
    [CAPPED_CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "middle of the axis"),
    [CAPPED_ENDS] = IMP_ROW_BOOLEAN("ends", "false", "closed by a disc at either end"),
};

enum { BOTTOM = CAPPED_LATERAL + 1, TOP, PARTS };

static imp_status cylinder_fill(capped_pieces *pieces, const imp_value *values,
                                imp_create_error *why)
{
    (void)why;
    return capped_fill(pieces, values, PARTS);
}
IMP_CREATE_AND_RENEW(cylinder, capped_pieces)

static void cylinder_domain(const void *self, double lo[3], double hi[3])
{
    const capped *s = self;
    const bool lateral = s->part == CAPPED_LATERAL;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, lateral ? -0.5 : 0, lateral ? 0.5 : 1);
}

/* Where the axis ends. */
static imp_model end_of(const capped *s)
{
    const imp_model half = imp_scale(imp_num(s->part == TOP ? 0.5 : -0.5), s->height);
    return imp_shift(half, s->center[2]);
}

/* An end, with v from 0 to 1 outward at the bottom and inward at the top. */
static void end_formula(const capped *s, imp_model u, imp_model v, imp_model out[3])
{
    imp_model sin_u, cos_u;
    const imp_model ring = imp_scale(s->part == TOP ? imp_shift(imp_neg(v), 1) : v, s->radius);
    imp_sincos(u, &sin_u, &cos_u);
    out[0] = imp_shift(imp_mul(ring, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), s->center[1]);
    out[2] = end_of(s);
}

static void cylinder_formula(const void *self, imp_model u, imp_model v, imp_model t,
                             imp_model out[3])
{
    const capped *s = self;
    imp_model sin_u, cos_u;
    (void)t;
    if (s->part != CAPPED_LATERAL) {
        end_formula(s, u, v, out);
        return;
    }
    imp_sincos(u, &sin_u, &cos_u);
    out[0] = imp_shift(imp_scale(cos_u, s->radius), s->center[0]);
    out[1] = imp_shift(imp_scale(sin_u, s->radius), s->center[1]);
    out[2] = imp_shift(imp_scale(v, s->height), s->center[2]);
}
IMP_SURFACE_FORMULA(cylinder_formula)

/* From the axis, less the radius: the distance from the endless cylinder. From an end, the distance
 * from its plane. */
static imp_model cylinder_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const capped *s = self;
    (void)t;
    if (s->part != CAPPED_LATERAL) return imp_sub(z, end_of(s));
    const imp_model m[2] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1])};
    return beyond_radius(sum_of_squares(m, 2), s->radius);
}
IMP_DISTANCE_FORMULA(cylinder_gap)

static imp_status cylinder_symmetry(const void *self, imp_symmetry *symmetry)
{
    const capped *s = self;
    symmetry->kind = s->part == CAPPED_LATERAL ? IMP_SYMMETRY_ALONG_LINE : IMP_SYMMETRY_ACROSS_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    symmetry->axis[2] = 1;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static imp_status cylinder_write_formula(const void *self, const imp_text_sink *to)
{
    static const char *const text[PARTS] = {
        [CAPPED_LATERAL] = "u in [0, 2*pi]; v in [-1/2, 1/2]; center0 + radius*cos(u); center1 + "
                           "radius*sin(u); center2 + height*v",
        [BOTTOM] = "u in [0, 2*pi]; v in [0, 1]; center0 + v*radius*cos(u); center1 + "
                   "v*radius*sin(u); center2 - height/2",
        [TOP] = "u in [0, 2*pi]; v in [0, 1]; center0 + (1 - v)*radius*cos(u); center1 + (1 - "
                "v)*radius*sin(u); center2 + height/2"};
    imp_add_text(to, text[((const capped *)self)->part]);
    return IMP_STATUS_OK;
}

static const imp_surface_type cylinder = {
    IMP_SURFACE_FIELDS(cylinder, cylinder_formula),
    .renew = cylinder_renew,
    .piece_count = capped_piece_count,
    .piece = capped_piece,
    .distance = cylinder_gap_distance,
    .symmetry = cylinder_symmetry,
    .write_formula = cylinder_write_formula,
    .summary = "cylinder about the z axis: its lateral surface, with ends=true closed by discs",
    .equation =
        "center + (radius cos u, radius sin u, height v), u in [0,2pi], v in [-1/2,1/2]; ends: "
        "center + (v radius cos u, v radius sin u, -height/2), center + ((1-v) radius cos u, "
        "(1-v) radius sin u, height/2), v in [0,1]; pieces: 0 lateral surface, 1 lower end, 2 "
        "upper end; along another axis: ! rotate axis=0,1,0 angle=1.5707963267948966 (z to x)",
    .source = NULL,
    .example = "cylinder radius=0.5 height=3",
};

PUBLISH_SURFACE(cylinder);
