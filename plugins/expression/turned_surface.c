/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/turned_surface.h"

#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <string.h>

/* --- The profile ------------------------------------------------------------------------------ */

/* The range of the parameter that is not around. */
typedef struct profile {
    const turned_surface *of;
    double lo, hi, around; /* and one value of the other one */
    double sign;           /* of R, mostly */
    double size;           /* the largest extent; length */
} profile;

/* Models of R, with the sign, and of Z, over a part. */
static void section_over(const profile *p, double from, double to, imp_model x[2])
{
    const int other = 1 - p->of->form.around;
    double lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0};
    imp_model variables[EXPRESSION_VARIABLES_MAX], out[3];
    lo[other] = from, hi[other] = to;
    lo[1 - other] = hi[1 - other] = p->around;
    const imp_region region = imp_region_between(lo, hi);
    for (int j = 0; j < EXPRESSION_VARIABLES_MAX; ++j)
        variables[j] = j < 2 ? imp_param(&region, j) : imp_num(0);
    expression_models(p->of->section, variables, out);
    x[0] = imp_scale(out[0], p->sign);
    x[1] = out[1];
}

/* The middles of R and Z at a part of the range, not rounded outward. */
static void section_at(const profile *p, double part, double at[2])
{
    const double w = part >= 1 ? p->hi : p->lo + part * (p->hi - p->lo);
    imp_model x[2];
    section_over(p, w, w, x);
    at[0] = x[0].a, at[1] = x[1].a;
}

static double most_of(imp_model x) { return imp_interval_mag(imp_model_range(&x)); }

/* How far points (R, Z) = (q, z) of a part are from the half line |h| q = r y, y >= 0 of a cone,
 * with the y of cone_distance, at most. Lemma. With A >= | |h| q - r y| a point with y >= 0 is
 * A / |h| from the half line's point as high, and A / r from its point as far from the axis. One
 * with y < 0 and q >= 0 has |h| q <= A + r y <= A, so that it is within A / |h| + |y| of the apex;
 * what q < 0 adds is counted in off_by_parts. */
static double cone_off(const round_profile *line, const imp_model x[2])
{
    const double h = fabs(line->apex);
    const imp_model below = imp_sub(imp_sub(imp_num(line->apex), x[1]), imp_num(-line->height));
    const imp_model y = line->apex > 0 ? below : imp_neg(below);
    const double apart = most_of(imp_sub(imp_scale(x[0], h), imp_scale(y, line->radius)));
    const double beside = imp_round_up(apart / imp_larger(h, line->radius));
    if (y.lo >= 0) return beside;
    return imp_larger(beside, imp_sum_up(imp_round_up(apart / h) - y.lo));
}

/* How far points of a part are from the line or circle, at most. Lemma. | |p - c| - r| is | |p -
 * c|^2 - r^2| over |p - c| + r >= r. */
static double part_off(const round_profile *of, const imp_model x[2])
{
    if (of->kind == ROUND_CYLINDER) return most_of(imp_shift(x[0], -of->radius));
    if (of->kind == ROUND_PLANE) return most_of(imp_shift(x[1], -of->height));
    if (of->kind == ROUND_CONE) return cone_off(of, x);
    const imp_model from[2] = {imp_shift(x[0], -of->ring), imp_shift(x[1], -of->height)};
    const imp_model beyond = imp_sub(sum_of_squares(from, 2), imp_sqr(imp_num(of->radius)));
    return imp_round_up(most_of(beyond) / of->radius);
}

/* Lemma. The surface's points have q = |R|. Where R < 0 for some, q is |R - |R|| <= 2 |R| from it,
 * and so is the distance from a line. Planes and circles about points of the axis are mirrored
 * there. */
static double off_by_parts(const profile *p, const round_profile *of, int parts)
{
    const bool may_cross = of->kind == ROUND_PLANE || (of->kind == ROUND_CIRCLE && of->ring == 0);
    double most = 0, cross = 0;
    for (int k = 0; k < parts; ++k) {
        imp_model x[2];
        const double width = p->hi - p->lo;
        const double from = k == 0 ? p->lo : p->lo + width * k / parts;
        const double to = k == parts - 1 ? p->hi : p->lo + width * (k + 1) / parts;
        section_over(p, from, to, x);
        const double off = part_off(of, x);
        /* A NaN stays. */
        if (!(off <= most) && most >= 0) most = off;
        if (!(x[0].lo >= -cross) && cross >= 0) cross = -x[0].lo;
    }
    return may_cross ? most : imp_sum_up(most + 2 * cross);
}

/* Models of parts leave about 2^-34 of the size of a circle in doubt: what is as near is one. */
enum { PARTS_MOST = 512, PARTS_TIMES = 8 };
#define OFF_OF_CIRCLE 0x1p-30

/* More parts, as long as they show that it is nearer. */
static double off_of(const profile *p, const round_profile *of)
{
    double off = off_by_parts(p, of, 1);
    for (int parts = PARTS_TIMES; parts <= PARTS_MOST; parts *= PARTS_TIMES) {
        if (off <= ROUND_OFF_LEAST * p->size) return off;
        const double before = off;
        off = imp_smaller(off_by_parts(p, of, parts), before);
        if (!(off <= 0.25 * before)) return off;
    }
    return off;
}

/* The line through both ends, of any of the kinds. */
static round_profile line_of(const profile *p, round_kind kind)
{
    double end[2][2];
    section_at(p, 0, end[0]);
    section_at(p, 1, end[1]);
    const int base = end[0][0] >= end[1][0] ? 0 : 1;
    round_profile line = {.kind = kind, .radius = end[base][0], .height = end[base][1]};
    if (kind == ROUND_CONE)
        line.apex = -line.radius * ((end[1][1] - end[0][1]) / (end[1][0] - end[0][0]));
    const bool sane = kind == ROUND_PLANE || line.radius > 0;
    const bool rises = kind != ROUND_CONE || (fabs(line.apex) > 0 && fabs(line.apex) < INFINITY);
    line.off = sane && rises ? off_of(p, &line) : INFINITY;
    return line;
}

/* The circle through three points of the profile. */
static round_profile circle_of(const profile *p, double second_at, double third_at)
{
    double a[2], b[2], c[2];
    section_at(p, 0, a);
    section_at(p, second_at, b);
    section_at(p, third_at, c);
    const double x = b[0] - a[0], y = b[1] - a[1], v = c[0] - a[0], w = c[1] - a[1];
    const double first = x * x + y * y, second = v * v + w * w, twice = 2 * (x * w - y * v);
    const double across = (w * first - y * second) / twice,
                 along = (x * second - v * first) / twice;
    round_profile circle = {.kind = ROUND_CIRCLE, .ring = a[0] + across, .height = a[1] + along};
    circle.radius = sqrt(across * across + along * along);
    if (fabs(circle.ring) <= ROUND_OFF_LEAST * circle.radius) circle.ring = 0;
    circle.off = circle.radius > 0 && circle.radius < INFINITY ? off_of(p, &circle) : INFINITY;
    return circle;
}

static round_profile round_of(profile *p)
{
    imp_model x[2];
    double middle[2];
    p->sign = 1;
    section_at(p, 0.5, middle);
    if (middle[0] < 0) p->sign = -1;
    section_over(p, p->lo, p->hi, x);
    p->size = imp_larger(most_of(x[0]), x[1].hi - x[1].lo);
    round_profile best = {.kind = ROUND_NONE, .off = INFINITY};
    if (!(p->size > 0 && p->size < INFINITY && p->lo < p->hi)) return best;
    for (int k = 0; k < 5 && best.off > OFF_OF_CIRCLE * p->size; ++k) {
        static const round_kind lines[] = {ROUND_CYLINDER, ROUND_PLANE, ROUND_CONE};
        const round_profile tried = k < 3    ? line_of(p, lines[k])
                                    : k == 3 ? circle_of(p, 0.5, 1)
                                             : circle_of(p, 1. / 3, 2. / 3);
        if (tried.off < best.off) best = tried;
    }
    return best.off <= ROUND_OFF_MOST * p->size ? best : (round_profile){.kind = ROUND_NONE};
}

/* --- Around the axis -------------------------------------------------------------------------- */

/* Whether phi, which another parameter does not change, is known to be continuous: its rate is
 * finite. */
static bool is_continuous(const turned_surface *s, const double lo[2], const double hi[2])
{
    const int j = s->form.around;
    double from[3] = {lo[0], lo[1], 0}, to[3] = {lo[0], lo[1], 0};
    imp_model variables[EXPRESSION_VARIABLES_MAX], out[3];
    to[j] = hi[j];
    const imp_region region = imp_region_between(from, to);
    for (int k = 0; k < EXPRESSION_VARIABLES_MAX; ++k)
        variables[k] = k < 2 ? imp_param(&region, k) : imp_num(0);
    expression_models(s->section, variables, out);
    return out[2].rate[j] < INFINITY && out[2].lo > -INFINITY && out[2].hi < INFINITY;
}

/* >= 0, and no more than how far the angle turns from one end to the other; 0: nothing is known. */
static double turned_lower(const turned_surface *s, const double lo[2], const double hi[2])
{
    double at[EXPRESSION_VARIABLES_MAX] = {lo[0], lo[1]}, x[2][3], error[2][3];
    for (int k = 0; k < 2; ++k) {
        if (k == 1) at[s->form.around] = hi[s->form.around];
        if (expression_point(s->section, at, x[k], error[k]) != IMP_STATUS_OK) return 0;
    }
    const double errors = imp_sum_up(error[0][2] + error[1][2]);
    const double turned = imp_sum_down(imp_sum_down(fabs(x[1][2] - x[0][2])) - errors);
    return turned > 0 ? turned : 0;
}

/* Lemma. phi is continuous: it has each value between those at both ends. So with ends a whole turn
 * apart, points of one value of the other parameter fill their circle; with a turn less e, a point
 * of the circle is within e R of one of them, e R <= 2^-38 R, below IMP_NEARLY_SLACK times 2 R. */
static uint32_t closed_of(const turned_surface *s, const double lo[2], const double hi[2])
{
    const uint32_t orbit = s->form.around == 0 ? IMP_SYMMETRY_ORBIT_U : IMP_SYMMETRY_ORBIT_V;
    const double turned = is_continuous(s, lo, hi) ? turned_lower(s, lo, hi) : 0;
    if (turned >= IMP_TWO_PI_UPPER) return orbit | IMP_SYMMETRY_CLOSED;
    if (turned < IMP_TWO_PI_UPPER * (1 - 0x1p-42)) return orbit;
    return orbit | IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_NEARLY;
}

void turned_surface_begin(turned_surface *s, const double lo[2], const double hi[2])
{
    const int around = s->form.around;
    profile p = {.of = s, .lo = lo[1 - around], .hi = hi[1 - around], .around = lo[around]};
    s->is_closed = closed_of(s, lo, hi);
    s->round = round_of(&p);
}

/* --- Callbacks -------------------------------------------------------------------------------- */

imp_model turned_surface_gap(const turned_surface *s, const imp_model x[3])
{
    const int k = s->form.along, i = (k + 1) % 3, j = (k + 2) % 3;
    const imp_model m[3] = {imp_shift(x[i], -s->form.center[i]),
                            imp_shift(x[j], -s->form.center[j]), x[k]};
    return round_profile_distance(&s->round, m);
}

imp_status turned_surface_symmetry(const turned_surface *s, imp_symmetry *symmetry)
{
    round_profile_symmetry(&s->round, symmetry);
    symmetry->is_closed = s->is_closed;
    memset(symmetry->axis, 0, sizeof symmetry->axis);
    symmetry->axis[s->form.along] = 1;
    memcpy(symmetry->center, s->form.center, sizeof symmetry->center);
    return IMP_STATUS_OK;
}
