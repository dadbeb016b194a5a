/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/course.h"

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/course_line.h"
#include "core/surface/slip.h"

/* Maps are exact rotations and shifts here, so that the inverse of a turn is its transpose. */

size_t surface_inner_maps(const surface *s)
{
    size_t inner = s->map_count;
    while (inner > 0 && IMP_OFFERS(s->maps[inner - 1].type, rigid) &&
           map_turns_exactly(&s->maps[inner - 1]))
        --inner;
    return inner;
}

/* --- One pose as another sees it -------------------------------------------------------------- */

static imp_status pose_of(const surface *s, const imp_region *times, imp_pose *pose)
{
    const size_t inner = surface_inner_maps(s);
    if (s->map_count > inner) return surface_pose_of_maps(s, inner, s->map_count, times, pose);
    memset(pose, 0, sizeof *pose);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) pose->turn[i][j] = imp_num(i == j);
    for (int i = 0; i < 3; ++i) pose->shift[i] = imp_num(0);
    return IMP_STATUS_OK;
}

/* x = turn y + shift, y of b and x in a's coordinates, both before their maps. */
typedef struct relative {
    imp_model turn[3][3], shift[3];
} relative;

static void relate(const imp_pose *a, const imp_pose *b, relative *r)
{
    imp_model way[3];
    for (int k = 0; k < 3; ++k) way[k] = imp_sub(b->shift[k], a->shift[k]);
    for (int i = 0; i < 3; ++i) {
        const imp_model back[3] = {a->turn[0][i], a->turn[1][i], a->turn[2][i]};
        imp_model pivot[3];
        for (int j = 0; j < 3; ++j) {
            const imp_model column[3] = {b->turn[0][j], b->turn[1][j], b->turn[2][j]};
            r->turn[i][j] = imp_dot3(back, column);
            pivot[j] = imp_num(b->pivot[j]);
        }
        r->shift[i] =
            imp_shift(imp_sub(imp_dot3(back, way), imp_dot3(r->turn[i], pivot)), a->pivot[i]);
    }
}

static imp_status relate_at(const surface *a, const surface *b, const imp_region *times,
                            relative *r, bool *turns)
{
    imp_pose of_a, of_b;
    imp_status status = pose_of(a, times, &of_a);
    if (status == IMP_STATUS_OK) status = pose_of(b, times, &of_b);
    if (status != IMP_STATUS_OK) return status;
    *turns = pose_turns(&of_a) || pose_turns(&of_b);
    relate(&of_a, &of_b, r);
    return IMP_STATUS_OK;
}

/* Takes numbers for the turn, and for the shift if it `has_shift`, and adds what they are off by.
 * Roundings of turn y + shift: 3 of the sum of sizes, by which any computation of it is off. */
PAD_COVERS(16, 3 + 6);
static void take_numbers(const relative *r, const imp_model bare[3], bool has_shift,
                         surface_course *course)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const imp_interval shift = imp_model_range(&r->shift[i]);
        course->shift[i] = has_shift ? r->shift[i].a : 0;
        double off = has_shift ? imp_interval_radius_upper(shift, course->shift[i]) : 0;
        off += 16 * UNIT_ROUNDOFF * fabs(course->shift[i]);
        for (int j = 0; j < 3; ++j) {
            const imp_interval turn = imp_model_range(&r->turn[i][j]);
            const double most = imp_interval_mag(imp_interval_make(bare[j].lo, bare[j].hi));
            course->turn[i][j] = r->turn[i][j].a;
            off += most * (imp_interval_radius_upper(turn, course->turn[i][j]) +
                           16 * UNIT_ROUNDOFF * fabs(course->turn[i][j]));
        }
        sum += off * off;
    }
    course->off = padded_upper(sqrt(sum), 16) + ROOT_UNDERFLOW;
}

/* --- The line about which b turns ------------------------------------------------------------- */

/* The middles of its models. */
static rigid_numbers numbers_of(const relative *r)
{
    rigid_numbers m;
    for (int i = 0; i < 3; ++i) {
        m.shift[i] = r->shift[i].a;
        for (int j = 0; j < 3; ++j) m.turn[i][j] = r->turn[i][j].a;
    }
    return m;
}

static imp_status find_line(const surface *a, const surface *b, const imp_region *times,
                            double moment, const relative *m0, imp_symmetry *line, bool *found)
{
    static const double parts[] = {0.31, -0.27, 0.11, 0.03, 0.007};
    const rigid_numbers then = numbers_of(m0);
    double best = SINE_LEAST;
    for (int k = 0; k < 5; ++k) {
        const double t = moment + parts[k] * (times->hi[2] - times->lo[2]);
        const imp_region at = slip_at_times(times, t, t);
        double center[3], axis[3];
        relative m1;
        bool turns;
        if (!(times->lo[2] <= t && t <= times->hi[2])) continue;
        const imp_status status = relate_at(a, b, &at, &m1, &turns);
        if (status != IMP_STATUS_OK) return status;
        const rigid_numbers now = numbers_of(&m1);
        const double sine = course_line_between(&then, &now, center, axis);
        if (!(sine > best)) continue;
        best = sine;
        memcpy(line->center, center, sizeof center);
        memcpy(line->axis, axis, sizeof axis);
    }
    line->kind = IMP_SYMMETRY_ALONG_LINE;
    *found = best > SINE_LEAST;
    return IMP_STATUS_OK;
}

/* Carries a point of b to a's coordinates, over the times. */
static imp_status carry_point(const surface *a, const surface *b, const double y[3],
                              const imp_region *times, imp_model x[3])
{
    carried at = {.off = 0};
    imp_pose pose;
    double d;
    imp_status status = IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) at.at[i] = imp_num(y[i]);
    for (size_t k = 0; k < b->map_count && status == IMP_STATUS_OK; ++k) {
        status = carried_pose(b, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_push(&pose, d, &at);
    }
    for (size_t k = a->map_count; k-- > 0 && status == IMP_STATUS_OK;) {
        status = carried_pose(a, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_pull(&pose, d, &at);
    }
    memcpy(x, at.at, sizeof at.at);
    return status;
}

/* Lemma. Let M(t) take points of b to a's coordinates, L be the line and n its unit vector. By the
 * lemma of slips (surface_slip.c), with a's symmetry that of L, M(t) y is within `slip` of S M(t0)
 * y, S = S(t) a rotation about L with a shift of s(t) n. Rotations about L keep n.x, so s(t) =
 * n.(M(t) y - M(t0) y) up to `slip`, whichever point y is: one near L is taken, whose models are
 * tightest. n = axis / |axis|, |axis|^2 within 2^-49 of 1. */
static imp_status follow_line(const surface *a, const surface *b, const imp_region *times,
                              double moment, double slip, surface_course *course)
{
    const imp_region at = slip_at_times(times, moment, moment);
    imp_model now[3], then[3], axis[3];
    double y[3];
    for (int j = 0; j < 3; ++j) {
        y[j] = 0;
        for (int i = 0; i < 3; ++i)
            y[j] += course->turn[i][j] * (course->center[i] - course->shift[i]);
    }
    imp_status status = carry_point(a, b, y, times, now);
    if (status == IMP_STATUS_OK) status = carry_point(a, b, y, &at, then);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        axis[i] = imp_num(course->axis[i]);
        now[i] = imp_sub(now[i], imp_between(then[i].lo, then[i].hi));
    }
    const double room = padded_upper(slip, 16);
    imp_model along = imp_add(imp_dot3(axis, now), imp_between(-room, room));
    along = imp_mul(along, imp_between(1 - 0x1p-48, 1 + 0x1p-48));
    for (int i = 0; i < 3; ++i) course->way[i] = imp_scale(along, course->axis[i]);
    return IMP_STATUS_OK;
}

/* Lemma. Let all maps be exact rotations and shifts: M(t) y = M(t) m + Q(t) (y - m), m the middle
 * of b's points; k a unit vector, and n(t) = Q(t)^T k. T, the smallest rotation that takes n(t0) to
 * n(t), moves y - m by at most `tilt`, and R = Q(t) T Q(t0)^T keeps k. With c near M(t0) m and S
 * the rotation R about the line through c along k,
 *
 *   M(t) y - S M(t0) y = (M(t) m - c) - R (M(t0) m - c) + Q(t) (1 - T) (y - m).
 *
 * Of the first two terms, k.(M(t) m - M(t0) m) is along k: the plane k.x = 0 is n(t).y = h(t) in
 * b's coordinates, and k.M(t) m = n(t).m - h(t), by how much the plane is below m. What is across
 * is no longer than the sum of |M(t) m - c| and |M(t0) m - c|. k = axis / |axis|, as in
 * follow_line. */
static imp_status find_slide(slip_input *q, const imp_region *times, const relative *m0,
                             surface_course *course)
{
    const surface *a = q->b, *b = q->a;
    imp_model now[3], then[3], rise;
    double middle[3], tilt;
    memset(q->found.center, 0, sizeof q->found.center);
    q->found.kind = IMP_SYMMETRY_ACROSS_LINE;
    imp_status status = slip_follow_plane(q, times, &rise, &tilt);
    if (status != IMP_STATUS_OK || !(tilt < INFINITY)) return status;
    for (int i = 0; i < 3; ++i) middle[i] = 0.5 * q->bare[i].lo + 0.5 * q->bare[i].hi;
    status = carry_point(a, b, middle, times, now);
    if (status == IMP_STATUS_OK) status = carry_point(a, b, middle, &q->then, then);
    if (status != IMP_STATUS_OK) return status;
    course->spins = true;
    memcpy(course->axis, q->found.axis, sizeof course->axis);
    take_numbers(m0, q->bare, true, course);
    course->off = sum_upper(course->off, tilt);
    for (int i = 0; i < 3; ++i) {
        course->center[i] = then[i].a;
        now[i] = imp_shift(now[i], -course->center[i]);
        then[i] = imp_shift(then[i], -course->center[i]);
        const imp_model along = imp_scale(imp_neg(rise), course->axis[i]);
        course->way[i] = imp_mul(along, imp_between(1 - 0x1p-48, 1 + 0x1p-48));
    }
    course->wander = sum_upper(surface_size_upper(now), surface_size_upper(then));
    course->is_known = course->off < INFINITY && course->wander < INFINITY;
    return IMP_STATUS_OK;
}

static imp_status find_spin(const surface *a, const surface *b, const imp_model bare[3],
                            const imp_region *times, double moment, surface_course *course)
{
    const imp_region at = slip_at_times(times, moment, moment);
    slip_input q = {
        .a = b, .b = a, .a_maps = b->map_count, .b_maps = a->map_count, .then = at, .bare = bare};
    relative m0;
    bool turns, found;
    double slip;
    imp_status status = relate_at(a, b, &at, &m0, &turns);
    if (status == IMP_STATUS_OK) status = find_line(a, b, times, moment, &m0, &q.found, &found);
    if (status != IMP_STATUS_OK || !found || !symmetry_is_sane(&q.found)) return status;
    status = slip_find(&q, times, &slip);
    if (status != IMP_STATUS_OK) return status;
    if (!(slip < INFINITY)) return find_slide(&q, times, &m0, course);
    course->spins = true;
    memcpy(course->center, q.found.center, sizeof q.found.center);
    memcpy(course->axis, q.found.axis, sizeof q.found.axis);
    take_numbers(&m0, bare, true, course);
    status = follow_line(a, b, times, moment, slip, course);
    course->off = sum_upper(course->off, slip);
    course->is_known = status == IMP_STATUS_OK && course->off < INFINITY;
    return status;
}

imp_status surface_course_of(const surface *a, const surface *b, const imp_model bare[3],
                             const imp_region *times, double moment, surface_course *course)
{
    relative m;
    bool turns;
    *course = (surface_course){.off = INFINITY};
    const bool may_spin = carried_exactly(a) && carried_exactly(b);
    imp_status status = relate_at(a, b, times, &m, &turns);
    if (status == IMP_STATUS_OK && !turns) {
        take_numbers(&m, bare, false, course);
        memcpy(course->way, m.shift, sizeof m.shift);
        course->is_known = course->off < INFINITY;
    } else if (may_spin && (status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED)) {
        status = find_spin(a, b, bare, times, moment, course);
    }
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_line_of(const surface *s, const surface_course *course, double center[3],
                           double axis[3], bool *has)
{
    imp_symmetry found;
    *has = false;
    if (!surface_has_symmetry(s)) return IMP_STATUS_OK;
    const imp_status status = surface_symmetry(s, &found);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    if (symmetry_is_screw(&found)) return IMP_STATUS_OK;
    const bool is_ball = found.kind == IMP_SYMMETRY_ABOUT_POINT;
    const double z[3] = {0, 0, 1};
    const double *way = !is_ball ? found.axis : course->spins ? course->axis : z;
    const double length = sqrt(slip_dot(way, way));
    for (int i = 0; i < 3; ++i) axis[i] = way[i] / length;
    memcpy(center, found.center, sizeof found.center);
    *has = true;
    return IMP_STATUS_OK;
}
