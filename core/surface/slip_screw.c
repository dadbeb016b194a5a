/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/surface/slip.h"

/* Slips along a screw
 * ===================
 * A screw motion belongs to the symmetry only if it turns by as much as it advances, so that center
 * and axis (surface_slip.c) are not enough: the turn of a's motion is compared, too. All maps are
 * exact rotations and shifts here. */

/* a's motion as b sees it, both before their maps: y of a is at place + turn (y - middle). */
typedef struct screw_view {
    imp_model turn[3][3], place[3];
} screw_view;

/* The screw's line, and all that does not depend on time. */
typedef struct screw_line {
    const slip_input *q;
    double middle[3]; /* of a before its maps */
    double reach;     /* >= distance of a's points from it; length */
    imp_model unit[3];
    double per_length; /* about 2 pi / lead, of either sign; rad/length */
    screw_view then;
} screw_line;

/* --- What b sees ------------------------------------------------------------------------------ */

static imp_status pose_of(const surface *s, size_t maps, const imp_region *times, imp_pose *pose)
{
    if (maps > 0) return surface_pose_of_maps(s, 0, maps, times, pose);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) pose->turn[i][j] = imp_num(i == j);
        pose->shift[i] = imp_num(0);
        pose->pivot[i] = 0;
    }
    return IMP_STATUS_OK;
}

static imp_status see(const screw_line *s, const imp_region *times, screw_view *v)
{
    imp_pose a, b;
    imp_model way[3];
    imp_status status = pose_of(s->q->a, s->q->a_maps, times, &a);
    if (status == IMP_STATUS_OK) status = pose_of(s->q->b, s->q->b_maps, times, &b);
    if (status != IMP_STATUS_OK) return status;
    for (int k = 0; k < 3; ++k) way[k] = imp_sub(imp_num(s->middle[k]), imp_num(a.pivot[k]));
    imp_model at[3];
    for (int k = 0; k < 3; ++k)
        at[k] = imp_sub(imp_add(imp_dot3(a.turn[k], way), a.shift[k]), b.shift[k]);
    for (int i = 0; i < 3; ++i) {
        const imp_model back[3] = {b.turn[0][i], b.turn[1][i], b.turn[2][i]};
        v->place[i] = imp_shift(imp_dot3(back, at), b.pivot[i]);
        for (int j = 0; j < 3; ++j) {
            const imp_model column[3] = {a.turn[0][j], a.turn[1][j], a.turn[2][j]};
            v->turn[i][j] = imp_dot3(back, column);
        }
    }
    return IMP_STATUS_OK;
}

static imp_status draw_line(const slip_input *q, screw_line *s)
{
    imp_model square = imp_num(0), half[3];
    double dot = 0;
    s->q = q;
    for (int i = 0; i < 3; ++i) {
        s->middle[i] = 0.5 * q->bare[i].lo + 0.5 * q->bare[i].hi;
        half[i] = imp_sub(imp_between(q->bare[i].lo, q->bare[i].hi), imp_num(s->middle[i]));
        square = imp_add(square, imp_sqr(imp_num(q->found.axis[i])));
        dot += q->found.axis[i] * q->found.axis[i];
    }
    s->reach = surface_size_upper(half);
    const imp_model length = imp_sqrt(square);
    for (int i = 0; i < 3; ++i) s->unit[i] = imp_div(imp_num(q->found.axis[i]), length);
    const double sign = q->found.kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    s->per_length = sign * (2 * 3.14159265358979323846) / sqrt(dot);
    return see(s, &q->then, &s->then);
}

/* --- The screw motion that comes nearest ------------------------------------------------------ */

/* Returns an angle that is a polynomial in time: how far a has moved along the line asks for that
 * turn, nearly. Any angle is right. */
static imp_model angle_of(const screw_line *s, const screw_view *now, const imp_region *times)
{
    imp_model way[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(now->place[i], s->then.place[i]);
    const imp_model along = imp_dot3(s->unit, way);
    const double d = times->d[2];
    const double coef[3] = {along.a * s->per_length, d > 0 ? along.b[2] * s->per_length / d : 0,
                            d > 0 ? along.q[IMP_TT] * s->per_length / d / d : 0};
    return imp_poly(coef, 3, imp_shift(surface_time(times), -times->c[2]));
}

/* The rotation about the line: n n' + cos (1 - n n') + sin [n]. */
static void rotation_of(const screw_line *s, imp_model angle, imp_model turn[3][3])
{
    const imp_model *n = s->unit;
    imp_model sine, cosine;
    imp_sincos(angle, &sine, &cosine);
    const imp_model rest = imp_sub(imp_num(1), cosine);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        turn[i][i] = imp_add(imp_mul(imp_mul(n[i], n[i]), rest), cosine);
        const imp_model both = imp_mul(imp_mul(n[i], n[j]), rest), side = imp_mul(n[k], sine);
        turn[i][j] = imp_sub(both, side);
        turn[j][i] = imp_add(both, side);
    }
}

/* --- The slip --------------------------------------------------------------------------------- */

/* Lemma. Let M(t) take points y of a before its maps to b before its maps, all maps being exact
 * rotations and shifts: M(t) y = p(t) + Q(t) (y - m). Let S be the screw motion of b's symmetry
 * about the line through c along n by any angle A(t), |A| <= 2 pi IMP_SCREW_TURNS, R its rotation.
 * b's type claims the same of S z as of z. M(t) y = S z for z = S^-1 M(t) y, and as S keeps
 * lengths
 *
 *   |z - M(t0) y| = |M(t) y - S M(t0) y| = |e(t) + D(t) (y - m)| <= |e| + |D| |y - m|,
 *   e = c + R (p(t0) - c) + A / (2 pi) axis - p(t),   D = R Q(t0) - Q(t);
 *
 * so what the type claims of all points within that of M(t0) y holds for M(t) y. |D| is at most the
 * root of the sum of squares of its entries. A left-handed screw turns by -A. Roundings, of numbers
 * >= 0: of `tilt` a square and eight sums, which the root halves, and the root; product, sum. */
PAD_COVERS(16, (1 + 8 + 1) / 2 + 1);
PAD_COVERS(16, 2);
static double slip_upper(const screw_line *s, const screw_view *now, const imp_region *times)
{
    const imp_symmetry *of = &s->q->found;
    const imp_model angle = angle_of(s, now, times);
    const double hand = of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    const imp_model turns = imp_scale(imp_div(angle, imp_scale(imp_const_pi(), 2)), hand);
    imp_model turn[3][3], from[3], off[3];
    double square = 0;
    if (!(imp_interval_mag(imp_model_range(&turns)) <= IMP_SCREW_TURNS)) return INFINITY;
    rotation_of(s, angle, turn);
    for (int i = 0; i < 3; ++i) from[i] = imp_shift(s->then.place[i], -of->center[i]);
    for (int i = 0; i < 3; ++i) {
        const imp_model way = imp_sub(now->place[i], imp_scale(turns, of->axis[i]));
        off[i] = imp_sub(imp_shift(imp_dot3(turn[i], from), of->center[i]), way);
        for (int j = 0; j < 3; ++j) {
            const imp_model column[3] = {s->then.turn[0][j], s->then.turn[1][j],
                                         s->then.turn[2][j]};
            const imp_model entry = imp_sub(imp_dot3(turn[i], column), now->turn[i][j]);
            const double most = imp_interval_mag(imp_model_range(&entry));
            square += most * most;
        }
    }
    const double tilt = padded_upper(sqrt(square), 16) + ROOT_UNDERFLOW;
    return padded_upper(surface_size_upper(off) + tilt * s->reach, 16);
}

/* The models' remainders of third order are what is left of a screw motion: an eighth for each
 * halving of the times. */
enum { HALVINGS = 12 };

/* Raises *slip to a bound over these times; INFINITY: given up. */
static imp_status slip_over(const screw_line *s, const imp_region *times, double enough,
                            int halvings, double *slip)
{
    screw_view now;
    const imp_status status = see(s, times, &now);
    double found = status == IMP_STATUS_OK ? slip_upper(s, &now, times) : INFINITY;
    const double middle = times->c[2];
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
    if (!(found > enough)) {
        if (!(found <= *slip)) *slip = found >= 0 ? found : INFINITY;
        return IMP_STATUS_OK;
    }
    if (halvings == 0 || !(times->lo[2] < middle && middle < times->hi[2]))
        return *slip = INFINITY, IMP_STATUS_OK;
    const imp_region half[2] = {slip_at_times(times, times->lo[2], middle),
                                slip_at_times(times, middle, times->hi[2])};
    imp_status both = IMP_STATUS_OK;
    for (int k = 0; k < 2 && both == IMP_STATUS_OK && *slip < INFINITY; ++k)
        both = slip_over(s, &half[k], enough, halvings - 1, slip);
    return both;
}

imp_status slip_find_screw(const slip_input *q, const imp_region *times, double enough,
                           double *slip)
{
    screw_line s;
    *slip = INFINITY;
    if (!carried_exactly(q->a) || !carried_exactly(q->b)) return IMP_STATUS_OK;
    imp_status status = draw_line(q, &s);
    double found = 0;
    const double ends[3] = {times->lo[2], times->hi[2], times->c[2]};
    for (int k = 0; k < 3 && status == IMP_STATUS_OK && found < INFINITY; ++k) {
        const imp_region end = slip_at_times(times, ends[k], ends[k]);
        status = slip_over(&s, &end, enough, 0, &found);
    }
    if (status == IMP_STATUS_OK && found < INFINITY)
        status = slip_over(&s, times, enough, HALVINGS, &found);
    if (status == IMP_STATUS_OK) *slip = found;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}
