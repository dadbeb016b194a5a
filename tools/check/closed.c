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

enum { HEIGHTS = 32 };

/* Moves the point to a border of the domain, along u or v. */
static void go_to_border(const subject *s, uint64_t *random, double p[3])
{
    const uint64_t which = random_bits(random);
    const int j = (which & 1) != 0;
    p[j] = (which & 2) != 0 ? s->domain.hi[j] : s->domain.lo[j];
}

/* Heights of points of the surface at the time of `at`, from the least to the most that are found:
 * at corners, on borders and elsewhere. */
static void find_heights(const subject *s, uint64_t *random, const imp_symmetry *of, const spot *at,
                         double height[2])
{
    height[0] = height[1] = height_of(of, at->x);
    for (int k = 0; k < HEIGHTS; ++k) {
        spot other;
        draw_point(random, &s->domain, 3, other.p);
        other.p[2] = at->p[2];
        for (int j = 0; j < 2 && k < 4; ++j)
            other.p[j] = (k >> j & 1) != 0 ? s->domain.hi[j] : s->domain.lo[j];
        if (k >= 4 && k % 4 != 0) go_to_border(s, random, other.p);
        if (!spot_evaluate(s, &other)) continue;
        const double found = height_of(of, other.x);
        height[0] = fmin(height[0], found);
        height[1] = fmax(height[1], found);
    }
}

/* Where images of points should come to lie: anywhere; near where they come from, which are borders
 * of the domain, so that what is missing beyond them shows; near the ends of a thread. */
typedef enum aim { ANYWHERE, BESIDE_BORDERS, NEAR_ENDS, AIMS } aim;

static void set_turns(motion *m, const imp_symmetry *of, double turns)
{
    const double hand = of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    m->angle = hand * turns * 2 * acos(-1);
    for (int i = 0; i < 3; ++i) m->shift[i] = turns * of->axis[i];
}

/* Draws a motion of the symmetry that takes the point to where a closed surface is. False: there is
 * none. */
static bool draw_image(const subject *s, uint64_t *random, const imp_symmetry *of, const spot *at,
                       double size, aim to, motion *m)
{
    const double little = random_power(random, -16, -2), sign = random_bits(random) % 2 ? 1 : -1;
    *m = motion_draw(random, of, is_screw(of) ? 1 : size);
    if (!is_screw(of)) {
        memset(m->shift, 0, sizeof m->shift);
        if (to == BESIDE_BORDERS) m->angle = sign * little;
        return true;
    }
    double height[2];
    find_heights(s, random, of, at, height);
    const double from = height_of(of, at->x), length = height[1] - height[0];
    double turns = sign * little;
    if (to == NEAR_ENDS)
        turns = (sign > 0 ? height[1] - little * length : height[0] + little * length) - from;
    else if (to == ANYWHERE)
        turns = height[0] + random_between(random, 0.001, 0.999) * length - from;
    turns = fmin(fmax(turns, -IMP_SCREW_TURNS), IMP_SCREW_TURNS);
    set_turns(m, of, turns);
    return from + turns >= height[0] && from + turns <= height[1];
}

/* The nearest point of the surface that is found, from anywhere and beside one that is there. */
static void find_nearest(const subject *s, const double x[3], const spot *beside, spot *found)
{
    spot other = *beside;
    const bool has_one = spot_nearest(s, x, beside->p[2], found);
    spot_search(s, x, &other);
    if (!has_one || spot_apart_upper(&other, x) < spot_apart_upper(found, x)) *found = other;
}

static bool judge(const subject *s, uint64_t *random, const imp_symmetry *of, aim to)
{
    double middle[3], radius;
    spot at, found;
    motion m;
    draw_point(random, &s->domain, 3, at.p);
    if (to == BESIDE_BORDERS) go_to_border(s, random, at.p);
    if (!spot_evaluate(s, &at) || !spot_extent(s, at.p[2], middle, &radius)) return true;
    if (!draw_image(s, random, of, &at, radius, to, &m)) return true;
    double x[3] = {at.x[0], at.x[1], at.x[2]};
    motion_apply(&m, x);
    find_nearest(s, x, &at, &found);
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
    double middle[3], radius = 0;
    const bool is_nearly = (of->is_closed & IMP_SYMMETRY_NEARLY) != 0;
    if (is_nearly && !spot_extent(s, x.p[2], middle, &radius)) return true;
    const long double slack = 2 * IMP_NEARLY_SLACK * (long double)radius;
    if (!(off > 2 * (x.error + y.error) + rounding + slack)) return true;
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
    const bool is_whole = (of->is_closed & IMP_SYMMETRY_CLOSED) != 0;
    if ((of->kind != IMP_SYMMETRY_ABOUT_POINT || !is_whole) && !is_screw(of))
        rotations.kind = IMP_SYMMETRY_ABOUT_LINE;
    for (int k = 0; k < AIMS * POINTS; ++k)
        if (!judge(s, random, &rotations, (aim)(k % AIMS))) return false;
    return true;
}
