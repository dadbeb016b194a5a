/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/closest.h"

#include <string.h>

#include "tools/simulate/eliminate.h"

enum { UNKNOWNS = EQUATIONS_MAX };

/* --- One step --------------------------------------------------------------------------------- */

/* Derivatives of |x_b - x_a|^2 / 2 by the unknowns (q_a, q_b). */
typedef struct newton {
    double gradient[UNKNOWNS], hessian[UNKNOWNS][UNKNOWNS];
    bool free[UNKNOWNS];
} newton;

static void form(const jet j[2], newton *n)
{
    const vec r = vec_sub(j[1].x, j[0].x);
    for (int a = 0; a < UNKNOWNS; ++a) {
        const double sign_a = a < 2 ? -1 : 1;
        n->gradient[a] = sign_a * vec_dot(j[a / 2].by[a % 2], r);
        for (int b = 0; b < UNKNOWNS; ++b) {
            const double sign = a / 2 == b / 2 ? 1 : -1;
            n->hessian[a][b] = sign * vec_dot(j[a / 2].by[a % 2], j[b / 2].by[b % 2]);
            if (a / 2 == b / 2)
                n->hessian[a][b] += sign_a * vec_dot(j[a / 2].second[a % 2 + b % 2], r);
        }
    }
}

/* An unknown at an end of its range from which the gradient pushes outward stays there. */
static void find_free(const chart c[2], const spot s[2], newton *n)
{
    for (int a = 0; a < UNKNOWNS; ++a) {
        double lo, hi;
        const double q = s[a / 2].q[a % 2], g = n->gradient[a];
        chart_range(&c[a / 2], &s[a / 2], a % 2, &lo, &hi);
        n->free[a] = !((q <= lo && g > 0) || (q >= hi && g < 0));
    }
}

/* Solves (H + damping diag) d = -g over the unknowns that are free. A pivot that is not positive
 * asks for more damping. */
static bool solve(const newton *n, double damping, double d[UNKNOWNS])
{
    double m[EQUATIONS_MAX][EQUATIONS_MAX + 1], least[UNKNOWNS];
    for (int i = 0; i < UNKNOWNS; ++i) {
        const double diagonal = n->hessian[i][i];
        const bool on = n->free[i] && diagonal != 0;
        for (int j = 0; j < UNKNOWNS; ++j) m[i][j] = on && n->free[j] ? n->hessian[i][j] : 0;
        m[i][UNKNOWNS] = on ? -n->gradient[i] : 0;
        m[i][i] = on ? diagonal + damping * fabs(diagonal) : 1;
        least[i] = 1e-13 * fabs(diagonal);
    }
    return eliminate_solve(UNKNOWNS, m, least, d);
}

/* The part of the step after which the first coordinate comes to an end of its range, at most 1,
 * and at most a quarter of a chart's width. */
static double allowed_part(const chart c[2], const spot s[2], const double d[UNKNOWNS])
{
    double part = 1;
    for (int a = 0; a < UNKNOWNS; ++a) {
        double lo, hi;
        const double q = s[a / 2].q[a % 2], size = fabs(d[a]);
        chart_range(&c[a / 2], &s[a / 2], a % 2, &lo, &hi);
        const double way =
            fmin(d[a] > 0 ? hi - q : q - lo, chart_width(&c[a / 2], &s[a / 2], a % 2) / 4);
        if (size > way) part = fmin(part, way / size);
    }
    return part;
}

/* Moves both points along the step. What comes within rounding of an end arrives there. */
static void move(const chart c[2], const spot from[2], const double d[UNKNOWNS], spot to[2])
{
    const double part = allowed_part(c, from, d), near = 1e-12;
    for (int k = 0; k < 2; ++k) {
        double q[2], p[2];
        for (int i = 0; i < 2; ++i) {
            double lo, hi;
            chart_range(&c[k], &from[k], i, &lo, &hi);
            const double slack = near * chart_width(&c[k], &from[k], i);
            q[i] = from[k].q[i] + part * d[2 * k + i];
            if (q[i] < lo + slack) q[i] = lo;
            if (q[i] > hi - slack) q[i] = hi;
        }
        chart_parameters(&c[k], &from[k], q, p);
        to[k] = chart_spot(&c[k], p);
    }
}

/* --- Searches --------------------------------------------------------------------------------- */

static double gap_of(const jet j[2]) { return vec_length(vec_sub(j[1].x, j[0].x)); }

/* The greatest cosine between the line of the points and a direction in which they may move: 0 at
 * the nearest points. */
static double slope_of(const newton *n, const jet j[2])
{
    const double gap = gap_of(j);
    double most = 0;
    for (int a = 0; a < UNKNOWNS; ++a) {
        const double length = gap * vec_length(j[a / 2].by[a % 2]);
        if (n->free[a] && length > 0) most = fmax(most, fabs(n->gradient[a]) / length);
    }
    return most;
}

/* Returns how much rounding changes points. */
static double rounding_of(const jet j[2])
{
    return 0x1p-51 * (vec_length(j[0].x) + vec_length(j[1].x));
}

/* Below this, cosines are rounding. */
static double slope_slack(const jet j[2]) { return fmin(1e-3, 1e-11 + rounding_of(j) / gap_of(j)); }

static void form_free(const closest *n, bool alone, newton *system)
{
    form(n->jet, system);
    find_free(n->chart, n->spot, system);
    if (alone) system->free[0] = system->free[1] = false;
}

/* Returns whether a step led to a smaller distance, or, as far as rounding tells, to the same one
 * at a place where the surfaces are more normal to it. */
static bool is_better(const closest *next, const closest *n, bool alone, double slope)
{
    newton system;
    const double was = gap_of(n->jet), is = gap_of(next->jet);
    if (is < was - rounding_of(n->jet)) return true;
    if (!(is <= was + rounding_of(n->jet))) return false;
    form_free(next, alone, &system);
    return slope_of(&system, next->jet) < slope / 2;
}

/* One step, then the second point to where it is nearest to the first. `alone`: the second point
 * only. */
static imp_code minimize(closest *n, bool alone, imp_error *why);

static imp_code take_step(closest *n, const double d[UNKNOWNS], bool alone, imp_error *why)
{
    spot to[2];
    move(n->chart, n->spot, d, to);
    imp_code code = IMP_SUCCESS;
    for (int k = alone ? 1 : 0; k < 2 && code == IMP_SUCCESS; ++k) {
        n->spot[k] = to[k];
        code = chart_jet(&n->chart[k], &to[k], &n->jet[k], why);
    }
    return code == IMP_SUCCESS && !alone ? minimize(n, true, why) : code;
}

/* Newton's method with damping where the distance would grow. */
static imp_code minimize(closest *n, bool alone, imp_error *why)
{
    const int steps = alone ? 8 : 40;
    double damping = 0, d[UNKNOWNS];
    for (int k = 0; k < steps && damping < 1e3; ++k) {
        newton system;
        closest next = *n;
        form_free(n, alone, &system);
        const double slope = slope_of(&system, n->jet);
        if (slope <= slope_slack(n->jet)) break;
        bool better = solve(&system, damping, d);
        if (better) {
            const imp_code code = take_step(&next, d, alone, why);
            if (code != IMP_SUCCESS) return code;
            better = is_better(&next, n, alone, slope);
        }
        if (better) *n = next;
        damping = better ? (damping > 1e-9 ? damping / 10 : 0) : fmax(10 * damping, 1e-6);
    }
    return IMP_SUCCESS;
}

imp_code closest_find(closest *out, const placed at[2], const imp_place place[2],
                      const double p[2][2], imp_error *why)
{
    for (int k = 0; k < 2; ++k) {
        imp_code code = chart_make(&out->chart[k], &at[k], place[k], why);
        if (code != IMP_SUCCESS) return code;
        out->spot[k] = chart_spot(&out->chart[k], p[k]);
        code = chart_jet(&out->chart[k], &out->spot[k], &out->jet[k], why);
        if (code != IMP_SUCCESS) return code;
    }
    return minimize(out, false, why);
}

double closest_gap(const closest *n) { return gap_of(n->jet); }

imp_code closest_project(const chart *c, double p[2], vec x, vec *found, imp_error *why)
{
    closest n = {.chart = {*c, *c}, .jet = {{.x = x}}};
    n.spot[0] = n.spot[1] = chart_spot(c, p);
    imp_code code = chart_jet(c, &n.spot[1], &n.jet[1], why);
    if (code == IMP_SUCCESS) code = minimize(&n, true, why);
    memcpy(p, n.spot[1].p, sizeof n.spot[1].p);
    *found = n.jet[1].x;
    return code;
}

/* --- The normal ------------------------------------------------------------------------------- */

/* Returns the surface's normal, of unit length; 0 where it has none. */
static vec surface_normal(const jet *j)
{
    const vec n = vec_cross(j->by[0], j->by[1]);
    const double size = vec_length(j->by[0]) * vec_length(j->by[1]);
    return vec_length(n) > 1e-6 * size ? vec_unit(n) : (vec){{0, 0, 0}};
}

/* Returns the greatest curvature along the coordinates; infinite where the surface has no normal.
 * */
static double curvature(const jet *j, vec normal)
{
    double most = 0;
    if (!(vec_length(normal) > 0)) return INFINITY;
    for (int k = 0; k < 2; ++k) {
        const double square = vec_dot(j->by[k], j->by[k]);
        const double bend = fabs(vec_dot(j->second[2 * k], normal));
        if (square > 0) most = fmax(most, bend / square);
    }
    return most;
}

/* Returns whether the point is inside of its patch, where another patch cannot be nearer by an
 * edge. */
static bool is_inside(const closest *n, int k)
{
    for (int i = 0; i < 2; ++i) {
        double lo, hi;
        chart_range(&n->chart[k], &n->spot[k], i, &lo, &hi);
        if (n->spot[k].q[i] <= lo || n->spot[k].q[i] >= hi) return false;
    }
    return true;
}

/* Returns the length of the patch, about. */
static double patch_size(const closest *n, int k)
{
    double size = 0;
    for (int i = 0; i < 2; ++i)
        size += vec_length(n->jet[k].by[i]) * chart_width(&n->chart[k], &n->spot[k], i);
    return size;
}

vec closest_normal(const closest *n)
{
    const vec along = vec_unit(vec_sub(n->jet[1].x, n->jet[0].x));
    const vec normal[2] = {surface_normal(&n->jet[0]), surface_normal(&n->jet[1])};
    const double bent[2] = {curvature(&n->jet[0], normal[0]), curvature(&n->jet[1], normal[1])};
    for (int k = 0; k < 2; ++k) {
        const double cosine = vec_dot(normal[k], along), other = bent[1 - k];
        const bool flat = bent[k] * patch_size(n, k) < 1e-6 || bent[k] < 0.1 * other;
        if (flat && is_inside(n, k) && fabs(cosine) > 0.9)
            return vec_scale(cosine > 0 ? 1 : -1, normal[k]);
    }
    return along;
}

/* Returns the least curvature: of the second fundamental form with the first as metric. */
static double least_curvature(const jet *j, vec normal)
{
    const double e = vec_dot(j->by[0], j->by[0]), f = vec_dot(j->by[0], j->by[1]);
    const double g = vec_dot(j->by[1], j->by[1]), area = e * g - f * f;
    const double l = vec_dot(j->second[0], normal), m = vec_dot(j->second[1], normal);
    const double k = vec_dot(j->second[2], normal);
    if (!(area > 0)) return 0;
    const double gauss = (l * k - m * m) / area, mean = (e * k - 2 * f * m + g * l) / (2 * area);
    return gauss > 0 ? fabs(mean) - sqrt(fmax(0, mean * mean - gauss)) : 0;
}

bool closest_is_round(const closest *n, int k, double sag)
{
    const vec normal = surface_normal(&n->jet[k]);
    const double way = patch_size(n, k) / 16;
    return is_inside(n, k) && least_curvature(&n->jet[k], normal) * way * way / 2 > sag;
}
