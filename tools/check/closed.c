/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/closed.h"

#include <impinge/formula.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/check/motions.h"
#include "tools/check/nearest.h"

enum { POINTS = 48, PARTS = 4096 };
#define NEAR 1e-6 /* of the surface's size: too near to be told from the surface */

/* At most the distance of x from the surface over the region; 0 where it has no bounds. */
static double apart_lower(const subject *s, const imp_region *region, const double x[3])
{
    double y[3], error[3], rate[3][BOX_DIMS], square = 0;
    box where = {.lo = {0}};
    memcpy(where.lo, region->lo, sizeof region->lo);
    memcpy(where.hi, region->hi, sizeof region->hi);
    if (subject_eval(s, 1, region->c, y, error) != IMP_STATUS_OK) return 0;
    if (subject_rate(s, &where, rate) != IMP_STATUS_OK) return 0;
    for (int i = 0; i < 3; ++i) {
        double reach = error[i];
        for (int j = 0; j < 3; ++j) reach += rate[i][j] * region->d[j];
        const double off = fabs(x[i] - y[i]) - reach;
        if (off > 0) square += off * off;
    }
    return sqrt(square) * (1 - 0x1p-40);
}

typedef struct part {
    double lo[2], hi[2];
} part;

/* Returns whether the whole surface at time t is surely farther than `least` from x. */
static bool is_off(const subject *s, const double x[3], double t, double least)
{
    static part parts[PARTS + 2];
    const box *d = &s->domain;
    size_t count = 1;
    parts[0] = (part){{d->lo[0], d->lo[1]}, {d->hi[0], d->hi[1]}};
    for (int k = 0; k < PARTS && count > 0; ++k) {
        const part p = parts[--count];
        const imp_region r =
            imp_region_between((double[3]){p.lo[0], p.lo[1], t}, (double[3]){p.hi[0], p.hi[1], t});
        if (apart_lower(s, &r, x) > least) continue;
        const int j = (p.hi[0] - p.lo[0]) * (d->hi[1] - d->lo[1]) >
                              (p.hi[1] - p.lo[1]) * (d->hi[0] - d->lo[0])
                          ? 0
                          : 1;
        if (!(p.lo[j] < r.c[j] && r.c[j] < p.hi[j])) return false;
        parts[count] = parts[count + 1] = p;
        parts[count].hi[j] = parts[count + 1].lo[j] = r.c[j];
        count += 2;
    }
    return count == 0;
}

static bool is_screw(const imp_symmetry *of)
{
    return of->kind == IMP_SYMMETRY_SCREW_RIGHT || of->kind == IMP_SYMMETRY_SCREW_LEFT;
}

/* Along the axis from the center, in leads. */
static double height_of(const imp_symmetry *of, const double x[3])
{
    double most = 0, dot = 0, square = 0;
    for (int i = 0; i < 3; ++i) most = fmax(most, fabs(of->axis[i]));
    for (int i = 0; i < 3; ++i) {
        dot += (x[i] - of->center[i]) / most * (of->axis[i] / most);
        square += (of->axis[i] / most) * (of->axis[i] / most);
    }
    return dot / square;
}

enum { HEIGHTS = 16 };

/* A screw motion that takes a point to some height between those of points of the surface. */
static motion draw_screw_within(const subject *s, uint64_t *random, const imp_symmetry *of,
                                const spot *at)
{
    double lo = height_of(of, at->x), hi = lo;
    const double from = lo, hand = of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    for (int k = 0; k < HEIGHTS; ++k) {
        spot other;
        draw_point(random, &s->domain, 3, other.p);
        other.p[2] = at->p[2];
        for (int j = 0; j < 2 && k < 4; ++j)
            other.p[j] = (k >> j & 1) != 0 ? s->domain.hi[j] : s->domain.lo[j];
        if (!spot_evaluate(s, &other)) continue;
        const double height = height_of(of, other.x);
        lo = fmin(lo, height);
        hi = fmax(hi, height);
    }
    motion m = motion_draw(random, of, 1);
    double turns = lo + random_between(random, 0.001, 0.999) * (hi - lo) - from;
    turns = fmin(fmax(turns, -IMP_SCREW_TURNS), IMP_SCREW_TURNS);
    m.angle = hand * turns * 2 * acos(-1);
    for (int i = 0; i < 3; ++i) m.shift[i] = turns * of->axis[i];
    return m;
}

static bool judge(const subject *s, uint64_t *random, const imp_symmetry *of)
{
    double middle[3], radius;
    spot at, found;
    draw_point(random, &s->domain, 3, at.p);
    if (!spot_evaluate(s, &at) || !spot_extent(s, at.p[2], middle, &radius)) return true;
    motion m =
        is_screw(of) ? draw_screw_within(s, random, of, &at) : motion_draw(random, of, radius);
    if (!is_screw(of)) memset(m.shift, 0, sizeof m.shift);
    double x[3] = {at.x[0], at.x[1], at.x[2]};
    motion_apply(&m, x);
    if (!spot_nearest(s, x, at.p[2], &found)) return true;
    const double apart = (double)spot_apart_upper(&found, x);
    ++s->answer->tests;
    if (!(apart > NEAR * radius + 2 * at.error) || !is_off(s, x, at.p[2], 0.5 * apart)) return true;
    return answer_fail_for(
        s->answer, FAULT_ERROR,
        "symmetry says is_closed, but %s takes the surface's point at %s to (%.17g, "
        "%.17g, %.17g), which is more than %.6g from the surface",
        motion_text(&m).text, subject_point_text(3, at.p).text, x[0], x[1], x[2], 0.5 * apart);
}

/* --- Orbits ----------------------------------------------------------------------------------- */

/* Where a point is beside the center: along the axis, and from the center; length. */
static void place_of(const imp_symmetry *of, const double x[3], long double place[2])
{
    long double along = 0, length = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
        const long double w = (long double)x[i] - of->center[i];
        along += w * of->axis[i];
        length += (long double)of->axis[i] * of->axis[i];
        square += w * w;
    }
    place[0] = length > 0 ? along / sqrtl(length) : 0;
    place[1] = sqrtl(square);
}

/* Compares two points of one orbit: `varies` says along which parameters. */
static bool judge_orbit(const subject *s, uint64_t *random, const imp_symmetry *of,
                        const bool varies[2], bool has_axis, const char *flag)
{
    spot x, y;
    long double at[2], was[2];
    draw_point(random, &s->domain, 3, x.p);
    draw_point(random, &s->domain, 3, y.p);
    for (int j = 0; j < 3; ++j)
        if (j == 2 || !varies[j]) y.p[j] = x.p[j];
    if (!spot_evaluate(s, &x) || !spot_evaluate(s, &y)) return true;
    place_of(of, x.x, at);
    place_of(of, y.x, was);
    ++s->answer->tests;
    const long double off = fabsl(at[1] - was[1]) + (has_axis ? fabsl(at[0] - was[0]) : 0);
    const long double rounding = 0x1p-48L * (at[1] + was[1]);
    if (!(off > 2 * (x.error + y.error) + rounding)) return true;
    return answer_fail_for(s->answer, FAULT_ERROR,
                           "symmetry says %s, but no rotation takes the surface's point at %s to "
                           "that at %s: they are %.6Lg apart along the axis or from the center",
                           flag, subject_point_text(3, x.p).text, subject_point_text(3, y.p).text,
                           off);
}

bool orbit_check(const subject *s, uint64_t *random, const imp_symmetry *of)
{
    static const struct {
        uint32_t flag;
        bool varies[2], has_axis;
        const char *name;
    } claims[] = {{IMP_SYMMETRY_ORBIT_U, {true, false}, true, "IMP_SYMMETRY_ORBIT_U"},
                  {IMP_SYMMETRY_ORBIT_V, {false, true}, true, "IMP_SYMMETRY_ORBIT_V"},
                  {IMP_SYMMETRY_ORBIT_ALL, {true, true}, false, "IMP_SYMMETRY_ORBIT_ALL"}};
    for (size_t c = 0; c < sizeof claims / sizeof *claims; ++c)
        for (int k = 0; k < POINTS && (of->is_closed & claims[c].flag) != 0; ++k)
            if (!judge_orbit(s, random, of, claims[c].varies, claims[c].has_axis, claims[c].name))
                return false;
    return true;
}

bool closed_check(const subject *s, uint64_t *random, const imp_symmetry *of)
{
    imp_symmetry rotations = *of;
    if (of->kind != IMP_SYMMETRY_ABOUT_POINT && !is_screw(of))
        rotations.kind = IMP_SYMMETRY_ABOUT_LINE;
    for (int k = 0; k < POINTS; ++k)
        if (!judge(s, random, &rotations)) return false;
    return true;
}
