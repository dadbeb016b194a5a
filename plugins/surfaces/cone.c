/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/capped.h"
#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

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

/* Lemma. Let points of space have cylindrical coordinates (q, phi, z), q >= 0, z from the base, and
 * let y = (h - z) sign h. Those of the cone lie on the line |h| q = r y, y >= 0, from which (q, y)
 * is
 *
 *   ||h| q - r y| / L >= ||h| q - r |y|| / L,   L = (h^2 + r^2)^(1/2),
 *
 * away, since q >= 0; points of space are no nearer. And
 *
 *   (h q)^2 - (r y)^2 = (|h| q - r |y|) (|h| q + r |y|),
 *
 * whose last factor is at most |h| Q + r Y where q <= Q, |y| <= Y: a bound without roots. */
static imp_model cone_beyond(const capped *s, const imp_model m[3])
{
    const double h = s->height, r = s->radius;
    const double slant = greatest_root_upper(
        &(imp_model){.hi = imp_round_up(imp_round_up(h * h) + imp_round_up(r * r))});
    const imp_model across = sum_of_squares(m, 2), y = imp_shift(imp_neg(m[2]), h);
    const imp_model sum = imp_sub(imp_mul(across, imp_sqr(imp_num(h))), imp_sqr(imp_scale(y, r)));
    const double along = imp_round_up(r * imp_interval_mag(imp_model_range(&y)));
    const double most = imp_sum_up(imp_round_up(fabs(h) * greatest_root_upper(&across)) + along);
    return imp_scale(sum, imp_larger(inverse_lower(imp_round_up(most * slant)), 0));
}

/* Lemma. Let e be a vector across the axis, |e| = 1 up to 4 u, f the same turned by a quarter, and
 * p = e.(x, y), s = f.(x, y). Then |e| q = (p^2 + s^2)^(1/2), which is from p to |p| + |s|, at most
 * 2 max(-p, 0) + |s| above p; and where p > 0
 *
 *   p + s^2 / (2 p) - s^4 / (8 p^3) <= |e| q <= p + s^2 / (2 p).
 *
 * On a line through the axis s is 0, and q exact up to the line's end at the axis. `beyond` is the
 * second bound of |e| q - p. */
static imp_model across_near(imp_model p, imp_model s, double beyond)
{
    const double most = imp_interval_mag(imp_model_range(&s)), least = p.lo;
    imp_model q = imp_add(p, imp_between(0, beyond));
    if (least > 0 && most <= least) {
        const double ratio = most / least, slack = 0.125 * ratio * ratio * ratio * most;
        const imp_model half = imp_scale(imp_div(imp_sqr(s), p), 0.5);
        q = imp_add(imp_add(p, half), imp_between(-imp_round_up(2 * slack), 0));
    }
    return imp_mul(q, imp_between(1 - 0x1p-50, 1 + 0x1p-50));
}

/* Like cone_beyond, by ||h| q - r y| / L itself, for points that stay on one side of the axis or
 * come to it on a line, up to rounding. False: they do not. */
static bool cone_near(const capped *s, const imp_model m[3], imp_model *gap)
{
    const double h = s->height, r = s->radius;
    const double size = sqrt(m[0].a * m[0].a + m[1].a * m[1].a),
                 e[2] = {m[0].a / size, m[1].a / size};
    if (!(size > 0x1p-300)) return false;
    const imp_model p = imp_add(imp_scale(m[0], e[0]), imp_scale(m[1], e[1]));
    const imp_model t = imp_sub(imp_scale(m[1], e[0]), imp_scale(m[0], e[1]));
    const imp_model y = h > 0 ? imp_shift(imp_neg(m[2]), h) : imp_shift(m[2], -h);
    const double most = imp_interval_mag(imp_model_range(&t));
    const double beyond = imp_sum_up(2 * imp_larger(-p.lo, 0) + most);
    if (!((p.lo > 0 && most <= p.lo) || beyond <= 0x1p-40 * size)) return false;
    const double slant = greatest_root_upper(
        &(imp_model){.hi = imp_round_up(imp_round_up(h * h) + imp_round_up(r * r))});
    const imp_model apart = imp_sub(imp_scale(across_near(p, t, beyond), fabs(h)), imp_scale(y, r));
    *gap = imp_scale(apart, imp_larger(inverse_lower(slant), 0));
    return true;
}

/* The distance from the endless double cone; from a disc or the base, from its plane. */
static imp_model cone_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const capped *s = self;
    (void)t;
    const imp_model m[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    imp_model gap;
    if (s->height == 0 || s->part == BASE) return m[2];
    return cone_near(s, m, &gap) ? gap : cone_beyond(s, m);
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
                "v in [0,1]; end: center + (v radius cos u, v radius sin u, 0)",
    .source = NULL,
    .example = "cone radius=1 height=2",
};

PUBLISH_SURFACE(cone);
