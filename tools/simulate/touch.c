/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/touch.h"

#include <string.h>

/* A point of a surface and its derivatives by u and v. */
typedef struct jet {
    vec x, by[2], second[3]; /* uu, uv, vv */
} jet;

/* One side of the search. */
typedef struct side {
    const imp_scene *scene;
    size_t body, surface;
    double t, lo[3], hi[3], p[2];
} side;

static imp_code point_at(const side *s, double u, double v, double t, vec *x, imp_error *error)
{
    const double p[3] = {u, v, t};
    return imp_scene_eval(s->scene, s->body, s->surface, 1, p, x->x, NULL, error);
}

/* Steps of differences, in parts of the domain: second derivatives lose 2^-52 / STEP^2 of the size.
 * Near an end, which may be a pole, they are half the way to it; at it, whole again. */
#define STEP 1e-4
#define AT_END 1e-7

static double difference(const side *s, int k)
{
    const double width = s->hi[k] - s->lo[k];
    const double way = fmin(s->p[k] - s->lo[k], s->hi[k] - s->p[k]);
    return way > AT_END * width ? fmin(STEP * width, way / 2) : STEP * width;
}

/* From nine points around one that keeps away from the domain's ends: the quadratic through
 * them. */
static imp_code jet_at(const side *s, jet *j, imp_error *error)
{
    double h[2], c[2];
    vec grid[3][3];
    for (int k = 0; k < 2; ++k) {
        h[k] = difference(s, k);
        c[k] = fmin(fmax(s->p[k], s->lo[k] + h[k]), s->hi[k] - h[k]);
    }
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            const imp_code code =
                point_at(s, c[0] + (a - 1) * h[0], c[1] + (b - 1) * h[1], s->t, &grid[a][b], error);
            if (code != IMP_SUCCESS) return code;
        }
    const double du = s->p[0] - c[0], dv = s->p[1] - c[1];
    for (int i = 0; i < 3; ++i) {
        const double mid = grid[1][1].x[i];
        const double uu =
            h[0] > 0 ? ((grid[2][1].x[i] - mid) - (mid - grid[0][1].x[i])) / (h[0] * h[0]) : 0;
        const double vv =
            h[1] > 0 ? ((grid[1][2].x[i] - mid) - (mid - grid[1][0].x[i])) / (h[1] * h[1]) : 0;
        const double uv =
            h[0] > 0 && h[1] > 0
                ? ((grid[2][2].x[i] - grid[2][0].x[i]) - (grid[0][2].x[i] - grid[0][0].x[i])) /
                      (4 * h[0] * h[1])
                : 0;
        const double u = h[0] > 0 ? (grid[2][1].x[i] - grid[0][1].x[i]) / (2 * h[0]) : 0;
        const double v = h[1] > 0 ? (grid[1][2].x[i] - grid[1][0].x[i]) / (2 * h[1]) : 0;
        j->by[0].x[i] = u + uu * du + uv * dv;
        j->by[1].x[i] = v + vv * dv + uv * du;
        j->second[0].x[i] = uu, j->second[1].x[i] = uv, j->second[2].x[i] = vv;
    }
    return point_at(s, s->p[0], s->p[1], s->t, &j->x, error);
}

enum { UNKNOWNS = 4, STEPS = 40 };

/* Gradient and Hessian of |x_b - x_a|^2 / 2 by (u_a, v_a, u_b, v_b). */
static void form_system(const jet j[2], double g[UNKNOWNS], double h[UNKNOWNS][UNKNOWNS])
{
    const vec r = vec_sub(j[1].x, j[0].x);
    for (int a = 0; a < UNKNOWNS; ++a) {
        const double sign_a = a < 2 ? -1 : 1;
        g[a] = sign_a * vec_dot(j[a / 2].by[a % 2], r);
        for (int b = 0; b < UNKNOWNS; ++b) {
            const double sign = a / 2 == b / 2 ? 1 : -1;
            h[a][b] = sign * vec_dot(j[a / 2].by[a % 2], j[b / 2].by[b % 2]);
            if (a / 2 == b / 2) h[a][b] += sign_a * vec_dot(j[a / 2].second[a % 2 + b % 2], r);
        }
    }
}

/* Solves (H + damping diag) d = -g over the unknowns that are free, by elimination without
 * exchange: a pivot that is not positive asks for more damping. */
static bool solve_system(const double g[UNKNOWNS], double h[UNKNOWNS][UNKNOWNS],
                         const bool free[UNKNOWNS], double damping, double d[UNKNOWNS])
{
    double m[UNKNOWNS][UNKNOWNS + 1];
    for (int i = 0; i < UNKNOWNS; ++i) {
        const bool on = free[i] && h[i][i] != 0;
        for (int j = 0; j < UNKNOWNS; ++j) m[i][j] = on && free[j] ? h[i][j] : 0;
        m[i][UNKNOWNS] = on ? -g[i] : 0;
        m[i][i] = on ? h[i][i] + damping * fabs(h[i][i]) : 1;
    }
    for (int i = 0; i < UNKNOWNS; ++i) {
        if (!(m[i][i] > 1e-13 * fabs(h[i][i]))) return false;
        for (int k = i + 1; k < UNKNOWNS; ++k) {
            const double factor = m[k][i] / m[i][i];
            for (int j = i; j <= UNKNOWNS; ++j) m[k][j] -= factor * m[i][j];
        }
    }
    for (int i = UNKNOWNS - 1; i >= 0; --i) {
        d[i] = m[i][UNKNOWNS];
        for (int j = i + 1; j < UNKNOWNS; ++j) d[i] -= m[i][j] * d[j];
        d[i] /= m[i][i];
    }
    return true;
}

/* Moves both points along the step, until one of them comes to an end of its domain. */
static void move(side s[2], const double d[UNKNOWNS])
{
    double part = 1;
    for (int a = 0; a < UNKNOWNS; ++a) {
        const side *one = &s[a / 2];
        const double at = one->p[a % 2], end = d[a] > 0 ? one->hi[a % 2] : one->lo[a % 2];
        if (fabs(d[a]) > fabs(end - at)) part = fmin(part, (end - at) / d[a]);
    }
    for (int a = 0; a < UNKNOWNS; ++a) {
        side *one = &s[a / 2];
        const int k = a % 2;
        const double end = d[a] > 0 ? one->hi[k] : one->lo[k];
        const bool arrives = part < 1 && fabs(d[a]) * part >= fabs(end - one->p[k]) * (1 - 1e-9);
        one->p[k] = arrives ? end : fmin(fmax(one->p[k] + part * d[a], one->lo[k]), one->hi[k]);
        const double slack = AT_END * (one->hi[k] - one->lo[k]);
        if (one->p[k] - one->lo[k] < slack) one->p[k] = one->lo[k];
        if (one->hi[k] - one->p[k] < slack) one->p[k] = one->hi[k];
    }
}

static imp_code jets_at(const side s[2], jet j[2], imp_error *error)
{
    const imp_code code = jet_at(&s[0], &j[0], error);
    return code == IMP_SUCCESS ? jet_at(&s[1], &j[1], error) : code;
}

/* An unknown at an end of its domain from which the gradient pushes outward stays there. */
static void find_free(const side s[2], const double g[UNKNOWNS], bool free[UNKNOWNS])
{
    for (int a = 0; a < UNKNOWNS; ++a) {
        const side *one = &s[a / 2];
        const int k = a % 2;
        free[a] = !((one->p[k] <= one->lo[k] && g[a] > 0) || (one->p[k] >= one->hi[k] && g[a] < 0));
    }
}

static double gap_of(const jet j[2]) { return vec_length(vec_sub(j[1].x, j[0].x)); }

/* 0: the step changes nothing, or less than 2^-50 of the domains. */
static double step_size(const side from[2], const side to[2])
{
    double most = 0;
    for (int a = 0; a < UNKNOWNS; ++a) {
        const side *x = &from[a / 2], *y = &to[a / 2];
        const double width = x->hi[a % 2] - x->lo[a % 2];
        if (width > 0) most = fmax(most, fabs(y->p[a % 2] - x->p[a % 2]) / width);
    }
    return most > 0x1p-50 ? most : 0;
}

/* Newton steps, with more damping where they do not succeed. Of all four unknowns: the distance
 * changes little where both points move alike, and much where they part, so every step is followed
 * by one search for the nearest point of the second surface alone (`nested`). */
static imp_code minimize(side s[2], jet j[2], bool nested, imp_error *error)
{
    double damping = 0, g[UNKNOWNS], h[UNKNOWNS][UNKNOWNS], d[UNKNOWNS];
    bool free[UNKNOWNS];
    imp_code code = jets_at(s, j, error);
    for (int n = 0; n < STEPS && code == IMP_SUCCESS && damping < 1e6; ++n) {
        form_system(j, g, h);
        find_free(s, g, free);
        if (!nested) free[0] = free[1] = false;
        if (solve_system(g, h, free, damping, d)) {
            side to[2] = {s[0], s[1]};
            jet there[2];
            move(to, d);
            const bool moved = step_size(s, to) > 0;
            if (!moved && damping == 0) break;
            code = nested ? minimize(to, there, false, error) : jets_at(to, there, error);
            if (code == IMP_SUCCESS && moved && gap_of(there) <= gap_of(j)) {
                memcpy(s, to, sizeof to);
                memcpy(j, there, sizeof there);
                damping = damping > 1e-9 ? damping / 10 : 0;
                continue;
            }
        }
        damping = damping > 0 ? 10 * damping : 1e-6;
    }
    return code;
}

/* Another name of the same place may lead on: the opposite end of a full turn, or a pole seen from
 * another side. From each of them the search goes on, and the nearest points count. */
static imp_code try_from(const side from[2], side best[2], jet j[2], imp_error *error)
{
    side s[2] = {from[0], from[1]};
    jet there[2];
    const imp_code code = minimize(s, there, true, error);
    if (code == IMP_SUCCESS && gap_of(there) < gap_of(j)) {
        memcpy(best, s, sizeof s);
        memcpy(j, there, sizeof there);
    }
    return code;
}

static imp_code look_around(side s[2], jet j[2], imp_error *error)
{
    enum { VIEWS = 8 };
    const side found[2] = {s[0], s[1]};
    imp_code code = IMP_SUCCESS;
    for (int a = 0; a < UNKNOWNS && code == IMP_SUCCESS; ++a) {
        const int k = a % 2;
        const side *one = &found[a / 2];
        if (one->p[k] != one->lo[k] && one->p[k] != one->hi[k]) continue;
        for (int view = 0; view <= VIEWS && code == IMP_SUCCESS; ++view) {
            side other[2] = {found[0], found[1]};
            double *p = other[a / 2].p;
            if (view == VIEWS)
                p[k] = p[k] == one->lo[k] ? one->hi[k] : one->lo[k];
            else
                p[1 - k] = one->lo[1 - k] + (one->hi[1 - k] - one->lo[1 - k]) * view / VIEWS;
            vec here, there;
            code = point_at(one, one->p[0], one->p[1], one->t, &here, error);
            if (code == IMP_SUCCESS) code = point_at(one, p[0], p[1], one->t, &there, error);
            if (code == IMP_SUCCESS && vec_length(vec_sub(here, there)) <= gap_of(j))
                code = try_from(other, s, j, error);
        }
    }
    return code;
}

/* The surface's normal, of unit length; 0 where it has none. */
static vec surface_normal(const jet *j)
{
    const vec n = vec_cross(j->by[0], j->by[1]);
    const double size = vec_length(j->by[0]) * vec_length(j->by[1]);
    return vec_length(n) > 1e-6 * size ? vec_unit(n) : (vec){{0, 0, 0}};
}

/* The greatest curvature along u or v; infinite where the surface has no normal. */
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

/* The direction between the nearest points; where one surface is much flatter than the other, its
 * own normal, which changes less with what the search left of the way. */
static vec normal_of(const jet j[2])
{
    const vec along = vec_unit(vec_sub(j[1].x, j[0].x));
    const vec n[2] = {surface_normal(&j[0]), surface_normal(&j[1])};
    const double bent[2] = {curvature(&j[0], n[0]), curvature(&j[1], n[1])};
    for (int k = 0; k < 2; ++k) {
        const double cosine = vec_dot(n[k], along);
        if (bent[k] < 0.1 * bent[1 - k] && fabs(cosine) > 0.9)
            return vec_scale(cosine > 0 ? 1 : -1, n[k]);
    }
    return along;
}

/* --- Motion beyond the rigid one -------------------------------------------------------------- */

/* By a central difference over some 1e-5 of the time asked about, within the times that exist. */
static imp_code drift_of(const searching *s, size_t body, const side *at, vec *drift,
                         imp_error *error)
{
    const actor *a = &s->setup->actors[body];
    *drift = (vec){{0, 0, 0}};
    if (!a->varies) return IMP_SUCCESS;
    side still = {.scene = s->setup->still, .body = body, .surface = at->surface};
    imp_scene_domain(still.scene, body, at->surface, still.lo, still.hi);
    const double h = 1e-5 * (s->setup->options.t_end - s->setup->options.t_start);
    const double from = fmax(at->t - h, still.lo[2]), to = fmin(at->t + h, still.hi[2]);
    vec x, y;
    if (!(to > from)) return IMP_SUCCESS;
    imp_code code = point_at(&still, at->p[0], at->p[1], from, &x, error);
    if (code == IMP_SUCCESS) code = point_at(&still, at->p[0], at->p[1], to, &y, error);
    if (code != IMP_SUCCESS) return code;
    *drift = vec_scale(1 / (to - from), vec_sub(y, x));
    if (!a->moves) return code;
    const mover_state now = mover_at(&s->movers[body], at->t);
    const mat3 axes = mover_axes(&now);
    *drift = mat3_apply(&axes, *drift);
    return code;
}

imp_code touching_find(searching *s, const meeting *m, const meeting *at, touching *out)
{
    side sides[2];
    jet j[2];
    for (int k = 0; k < 2; ++k) {
        sides[k] = (side){.scene = m->scene,
                          .body = (size_t)k,
                          .surface = at->side[k].surface,
                          .t = at->t,
                          .p = {at->side[k].u, at->side[k].v}};
        imp_scene_domain(m->scene, (size_t)k, sides[k].surface, sides[k].lo, sides[k].hi);
    }
    imp_code code = minimize(sides, j, true, &s->error);
    if (code == IMP_SUCCESS) code = look_around(sides, j, &s->error);
    if (code != IMP_SUCCESS) return code;
    out->point = vec_scale(0.5, vec_add(j[0].x, j[1].x));
    out->normal = normal_of(j);
    for (int k = 0; k < 2 && code == IMP_SUCCESS; ++k)
        code = drift_of(s, m->body[k], &sides[k], &out->drift[k], &s->error);
    return code;
}
