/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/surface/held.h"
#include "core/surface/slip.h"

/* --- Numbers ---------------------------------------------------------------------------------- */

static void difference(const double x[3], const double y[3], double to[3])
{
    for (int i = 0; i < 3; ++i) to[i] = x[i] - y[i];
}

/* The size of the product axis . (x - center) x (y - center). */
static double turn_from(const double center[3], const double axis[3], const double x[3],
                        const double y[3])
{
    double a[3], b[3], sum = 0;
    difference(x, center, a);
    difference(y, center, b);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += axis[i] * (a[j] * b[k] - a[k] * b[j]);
    }
    return sum;
}

static double distance_between(const double x[3], const double y[3])
{
    double apart[3];
    difference(x, y, apart);
    return sqrt(slip_dot(apart, apart));
}

/* --- A parameter along circles ---------------------------------------------------------------- */

/* Curves of one parameter of a surface at one time. */
typedef struct curve {
    surface of;  /* with some of its first maps */
    int along;   /* 0: u, 1: v */
    double p[3]; /* u, v, t */
    double lo, hi;
} curve;

static curve curve_of(const surface *s, size_t maps, int along, const double p[3])
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    curve c = {.of = *s, .along = along, .lo = lo[along], .hi = hi[along]};
    c.of.map_count = maps;
    memcpy(c.p, p, sizeof c.p);
    return c;
}

static imp_status curve_at(const curve *c, double w, double x[3])
{
    double p[3];
    memcpy(p, c->p, sizeof p);
    p[c->along] = w;
    return surface_eval(&c->of, 1, p, x, NULL);
}

/* The parameter along which rotations about an axis take points to each other; -1: none. */
static int orbit_of(const imp_symmetry *found)
{
    if (!symmetry_is_round(found)) return -1;
    if ((found->is_closed & IMP_SYMMETRY_ORBIT_U) != 0) return 0;
    return (found->is_closed & IMP_SYMMETRY_ORBIT_V) != 0 ? 1 : -1;
}

enum { SAMPLES = 64 };
#define FULL_TURN (6.2831853071795864 * (1 - 0x1p-30)) /* but for rounding */
#define ACROSS 0.381966 /* where, of the other parameter's range, the curve is: no middle */

/* A type need not say that the points that rotations take to each other fill their circles: the
 * angle along the curve, summed over its parts, is looked at. */
static bool goes_around(const surface *s, const imp_symmetry *line, int along)
{
    double lo[3], hi[3], x[2][3], turned = 0;
    surface_domain(s, lo, hi);
    const double p[3] = {lo[0] + ACROSS * (hi[0] - lo[0]), lo[1] + ACROSS * (hi[1] - lo[1]),
                         surface_held_moment(s)};
    const curve c = curve_of(s, 0, along, p);
    if (curve_at(&c, c.lo, x[0]) != IMP_STATUS_OK) return false;
    for (int k = 1; k <= SAMPLES; ++k) {
        const double w = k == SAMPLES ? c.hi : c.lo + (c.hi - c.lo) / SAMPLES * k;
        double a[3], b[3];
        if (curve_at(&c, w, x[k % 2]) != IMP_STATUS_OK) return false;
        difference(x[(k - 1) % 2], line->center, a);
        difference(x[k % 2], line->center, b);
        const double square = slip_dot(line->axis, line->axis);
        const double beside =
            slip_dot(a, b) - slip_dot(a, line->axis) * slip_dot(b, line->axis) / square;
        turned += atan2(
            turn_from(line->center, line->axis, x[(k - 1) % 2], x[k % 2]) / sqrt(square), beside);
    }
    return fabs(turned) >= FULL_TURN;
}

int surface_around_line(const surface *s, const imp_symmetry *line)
{
    imp_symmetry found;
    if (surface_symmetry(s, &found) != IMP_STATUS_OK) return -1;
    const int along = orbit_of(&found);
    for (int i = 0; i < 3; ++i)
        if (found.axis[i] != line->axis[i]) return -1;
    return along >= 0 && goes_around(s, line, along) ? along : -1;
}

/* --- The same point under the maps ------------------------------------------------------------ */

/* Where a point is sought: on a circle about a line, next to `to`. */
typedef struct search {
    curve on;
    double to[3], center[3], axis[3];
} search;

/* Sets the place of the point under the maps held, and the line under these maps at time t. */
static imp_status begin(const surface *s, held_maps held, const imp_symmetry *line,
                        const double p[3], search *q)
{
    curve bare = curve_of(s, 0, orbit_of(line), p);
    double of_line[6];
    q->on = curve_of(s, held.count, orbit_of(line), p);
    for (int i = 0; i < 3; ++i) {
        of_line[i] = line->center[i];
        of_line[3 + i] = line->center[i] + line->axis[i];
    }
    imp_status status = curve_at(&bare, p[bare.along], q->to);
    if (status == IMP_STATUS_OK)
        status = surface_move_outward(&q->on.of, 0, surface_held_moment(s), 1, q->to);
    if (status == IMP_STATUS_OK) status = surface_move_outward(&q->on.of, 0, p[2], 2, of_line);
    memcpy(q->center, of_line, sizeof q->center);
    difference(of_line + 3, of_line, q->axis);
    return status;
}

/* Samples of the curve, of which the first one is also behind the last. */
static double sample_at(const search *q, int k)
{
    const int in = (k + SAMPLES) % SAMPLES;
    return q->on.lo + (q->on.hi - q->on.lo) / SAMPLES * in;
}

static imp_status nearest_sample(const search *q, int *nearest)
{
    double least = INFINITY;
    *nearest = 0;
    for (int k = 0; k < SAMPLES; ++k) {
        double x[3];
        const imp_status status = curve_at(&q->on, sample_at(q, k), x);
        if (status != IMP_STATUS_OK) return status;
        if (distance_between(x, q->to) < least) least = distance_between(x, q->to), *nearest = k;
    }
    return IMP_STATUS_OK;
}

/* How far the point at w has still to turn, with a sign. */
static imp_status left_at(const search *q, double w, double *left)
{
    double x[3];
    const imp_status status = curve_at(&q->on, w, x);
    if (status == IMP_STATUS_OK) *left = turn_from(q->center, q->axis, x, q->to);
    return status;
}

/* Halves the range from w[0] to w[1], at whose ends the turns that are left have other signs, until
 * no number is between. */
static imp_status halve(const search *q, double w[2], bool rises)
{
    for (;;) {
        const double middle = 0.5 * w[0] + 0.5 * w[1];
        double left;
        if (!(w[0] < middle && middle < w[1])) return IMP_STATUS_OK;
        const imp_status status = left_at(q, middle, &left);
        if (status != IMP_STATUS_OK) return status;
        w[(left > 0) == rises] = middle;
    }
}

/* In the gap of a curve that is closed but for a slack, the nearer of its ends is taken. */
static imp_status take_nearer_end(const search *q, double *found)
{
    const double ends[2] = {q->on.lo, q->on.hi};
    double apart[2];
    for (int k = 0; k < 2; ++k) {
        double x[3];
        const imp_status status = curve_at(&q->on, ends[k], x);
        if (status != IMP_STATUS_OK) return status;
        apart[k] = distance_between(x, q->to);
    }
    *found = ends[apart[1] < apart[0]];
    return IMP_STATUS_OK;
}

/* Finds the parameter next to a sample: between it and one of its neighbours, on whose other side
 * the point is. */
static imp_status find_near(const search *q, int sample, double *found)
{
    double here;
    *found = sample_at(q, sample);
    imp_status status = left_at(q, *found, &here);
    for (int k = 0; k < 2 && status == IMP_STATUS_OK && here != 0; ++k) {
        const double lo = sample_at(q, sample - k), hi = lo + (q->on.hi - q->on.lo) / SAMPLES;
        double w[2] = {lo, hi < q->on.hi ? hi : q->on.hi}, left[2];
        status = left_at(q, w[0], &left[0]);
        if (status == IMP_STATUS_OK) status = left_at(q, w[1], &left[1]);
        if (status != IMP_STATUS_OK) return status;
        if ((left[0] > 0) == (left[1] > 0)) continue;
        status = halve(q, w, left[1] > 0);
        *found = w[0];
        return status;
    }
    return status == IMP_STATUS_OK && sample == 0 ? take_nearer_end(q, found) : status;
}

enum { FINE_PARTS = 4096 };

/* Finds the parameter where the curve may run around so fast in places, or back, that the point is
 * not between the nearest samples: wherever the turn that is left changes its sign, until the point
 * there is within `off`, or else the nearest of these. */
static imp_status find_anywhere(const search *q, double off, double *found)
{
    double least = INFINITY, left[2];
    imp_status status = left_at(q, q->on.lo, &left[0]);
    for (int k = 0; k < FINE_PARTS && status == IMP_STATUS_OK && !(least <= off); ++k) {
        const double width = (q->on.hi - q->on.lo) / FINE_PARTS;
        double w[2] = {q->on.lo + width * k,
                       k + 1 < FINE_PARTS ? q->on.lo + width * (k + 1) : q->on.hi};
        double x[3];
        const double before = left[0];
        status = left_at(q, w[1], &left[1]);
        left[0] = left[1];
        if (status != IMP_STATUS_OK || (before > 0) == (left[1] > 0)) continue;
        status = halve(q, w, left[1] > 0);
        if (status == IMP_STATUS_OK) status = curve_at(&q->on, w[0], x);
        if (status == IMP_STATUS_OK && distance_between(x, q->to) < least)
            least = distance_between(x, q->to), *found = w[0];
    }
    return status;
}

/* How far the point at p is from `there`, and how far it may be. */
static imp_status compare(const surface *s, const double p[3], const double there[3], double slip,
                          double *apart, double *off)
{
    double x[3], error[3];
    const imp_status status = surface_eval(s, 1, p, x, error);
    if (status != IMP_STATUS_OK) return status;
    *apart = distance_between(x, there);
    *off = slip + 2 * (error[0] + error[1] + error[2]);
    return status;
}

/* Lemma. By that of slip_first_maps, P(t0) y and P(t) S y are within the slip, with a rotation S
 * about the line. S takes y to a point of its own circle, which is there (surface_around_line), or
 * to within the slack of one with the same other parameter: that is part of the slip. So the points
 * are within the slip under all maps, which has room for the rounding of the parameter
 * (surface_held_maps), and as computed within the errors of both evaluations besides. */
imp_status surface_held_place(const surface *s, held_maps held, size_t maps, double t,
                              const double x[3], double *u, double *v)
{
    imp_symmetry line;
    search q;
    int sample;
    double p[3] = {*u, *v, t}, there[3], apart = INFINITY, off = 0;
    imp_status status = surface_symmetry(s, &line);
    if (status != IMP_STATUS_OK) return status;
    if (orbit_of(&line) < 0) return SURFACE_NOT_CLOSED;
    memcpy(there, x, sizeof there);
    status = begin(s, held, &line, p, &q);
    if (status == IMP_STATUS_OK) status = surface_move_outward(s, maps, t, 1, there);
    if (status == IMP_STATUS_OK) status = nearest_sample(&q, &sample);
    if (status == IMP_STATUS_OK) status = find_near(&q, sample, &p[q.on.along]);
    if (status == IMP_STATUS_OK) status = compare(s, p, there, held.slip, &apart, &off);
    if (status == IMP_STATUS_OK && !(apart <= off)) {
        status = find_anywhere(&q, off, &p[q.on.along]);
        if (status == IMP_STATUS_OK) status = compare(s, p, there, held.slip, &apart, &off);
    }
    if (status != IMP_STATUS_OK) return status;
    *u = p[0], *v = p[1];
    return apart <= off ? IMP_STATUS_OK : SURFACE_NOT_CLOSED;
}
