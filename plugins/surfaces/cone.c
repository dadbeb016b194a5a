/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/capped.h"
#include "plugins/common/cone_distance.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* The lateral surface, from the base circle at v = 0 to the apex, to which the edge v = 1
 * collapses. With height 0 it is a disc. With `ends`, the disc of the base is a second piece, which
 * goes round as the first does: both normals f_u x f_v point outward, or, with the apex below,
 * inward. */

static const imp_parameter parameters[] = {
    [CAPPED_RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius of the base"),
    [CAPPED_HEIGHT] = IMP_ROW_NUMBER(
        "height", "length", "1",
        "height of the apex above the base, along z; 0: a disc; negative: apex below"),
    [CAPPED_CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "centre of the base"),
    [CAPPED_ENDS] = IMP_ROW_BOOLEAN("ends", "false", "closed by a disc at its base"),
};

enum { BASE = CAPPED_LATERAL + 1, PARTS };

static imp_status cone_fill(capped_pieces *pieces, const imp_value *values, imp_create_error *why)
{
    (void)why;
    return capped_fill(pieces, values, PARTS);
}
IMP_CREATE_AND_RENEW(cone, capped_pieces)

static void cone_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, 0, 1);
}

static void cone_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const capped *s = self;
    const bool base = s->part == BASE;
    imp_model sin_u, cos_u, ring = imp_scale(base ? v : imp_shift(imp_neg(v), 1), s->radius);
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    out[0] = imp_shift(imp_mul(ring, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), s->center[1]);
    out[2] = base ? imp_num(s->center[2]) : imp_shift(imp_scale(v, s->height), s->center[2]);
}
IMP_SURFACE_FORMULA(cone_formula)

/* The distance from the cone without its base; from a disc or the base, from its plane. */
static imp_model cone_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const capped *s = self;
    (void)t;
    const imp_model m[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    return s->height == 0 || s->part == BASE ? m[2] : cone_distance(s->radius, s->height, m);
}
IMP_DISTANCE_FORMULA(cone_gap)

static imp_status cone_symmetry(const void *self, imp_symmetry *symmetry)
{
    const capped *s = self;
    symmetry->kind = IMP_SYMMETRY_ABOUT_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    symmetry->axis[2] = 1;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static imp_status cone_write_formula(const void *self, const imp_text_sink *to)
{
    static const char *const text[PARTS] = {
        [CAPPED_LATERAL] =
            "u in [0, 2*pi]; v in [0, 1]; center0 + (1 - v)*radius*cos(u); center1 + "
            "(1 - v)*radius*sin(u); center2 + height*v",
        [BASE] = "u in [0, 2*pi]; v in [0, 1]; center0 + v*radius*cos(u); center1 + "
                 "v*radius*sin(u); center2"};
    imp_add_text(to, text[((const capped *)self)->part]);
    return IMP_STATUS_OK;
}

static const imp_surface_type cone = {
    IMP_SURFACE_FIELDS(cone, cone_formula),
    .renew = cone_renew,
    .piece_count = capped_piece_count,
    .piece = capped_piece,
    .distance = cone_gap_distance,
    .symmetry = cone_symmetry,
    .write_formula = cone_write_formula,
    .summary = "cone about the z axis: its lateral surface up to the apex, with ends=true closed "
               "by a disc",
    .equation = "center + ((1-v) radius cos u, (1-v) radius sin u, height v), u in [0,2pi], "
                "v in [0,1]; end: center + (v radius cos u, v radius sin u, 0); pieces: 0 lateral "
                "surface, 1 end; along another axis: ! rotate axis=0,1,0 angle=1.5707963267948966 "
                "(z to x)",
    .source = NULL,
    .example = "cone radius=1 height=2",
};

PUBLISH_SURFACE(cone);
