/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/round.h"

#include <math.h>
#include <string.h>

enum { ALONG_U = 5, ALONG_V = 3, NORMALS = ALONG_U * ALONG_V, UNKNOWNS = 6 };

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double r[3])
{
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        r[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* Lines along normals: p + s n, |n| = 1, moved and scaled so that |p| <= 1 about the mean of p. */
typedef struct normals {
    double p[NORMALS][3], n[NORMALS][3], mean[3], scale;
    int count;
} normals;

static void take_normal(memory *known, const place *of, const box3 *where, normals *all)
{
    const kept *k = look_jets(known, of, where);
    double u[3], v[3], *p = all->p[all->count], *n = all->n[all->count];
    if (k->result != ENCLOSED) return;
    for (int i = 0; i < 3; ++i) {
        p[i] = ld_interval_mid(k->centre[i].v);
        u[i] = ld_interval_mid(k->centre[i].d[U]), v[i] = ld_interval_mid(k->centre[i].d[V]);
    }
    cross(u, v, n);
    const double length = sqrt(dot(n, n));
    if (!(length > 0 && length < INFINITY && dot(p, p) < INFINITY)) return;
    for (int i = 0; i < 3; ++i) n[i] /= length;
    all->count += 1;
}

static bool take_normals(memory *known, const place *of, double t, normals *all)
{
    box3 whole, where = {{0, 0, t}, {0, 0, t}};
    piece_box(of, &whole);
    memset(all, 0, sizeof *all);
    for (int k = 0; k < NORMALS; ++k) {
        const double share[2] = {(k / ALONG_V + 0.4) / ALONG_U, (k % ALONG_V + 0.4) / ALONG_V};
        for (int j = 0; j < 2; ++j)
            where.lo[j] = where.hi[j] = whole.lo[j] + (whole.hi[j] - whole.lo[j]) * share[j];
        take_normal(known, of, &where, all);
    }
    for (int k = 0; k < all->count; ++k)
        for (int i = 0; i < 3; ++i) all->mean[i] += all->p[k][i] / all->count;
    for (int k = 0; k < all->count; ++k) {
        for (int i = 0; i < 3; ++i) all->p[k][i] -= all->mean[i];
        all->scale = fmax(all->scale, sqrt(dot(all->p[k], all->p[k])));
    }
    for (int k = 0; k < all->count && all->scale > 0; ++k)
        for (int i = 0; i < 3; ++i) all->p[k][i] /= all->scale;
    return all->count >= UNKNOWNS && all->scale > 0;
}

/* Solves m x = b by elimination, b becomes x; false: m is singular, nearly. */
static bool solve(int size, double m[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS])
{
    for (int k = 0; k < size; ++k) {
        int best = k;
        for (int i = k + 1; i < size; ++i)
            if (fabs(m[i][k]) > fabs(m[best][k])) best = i;
        if (!(fabs(m[best][k]) > 1e-14)) return false;
        for (int j = 0; j < size; ++j) {
            const double upper = m[k][j];
            m[k][j] = m[best][j], m[best][j] = upper;
        }
        const double other = b[k];
        b[k] = b[best], b[best] = other;
        for (int i = 0; i < size; ++i) {
            const double times = i != k ? m[i][k] / m[k][k] : 0;
            for (int j = k; j < size; ++j) m[i][j] -= times * m[k][j];
            b[i] -= times * b[k];
        }
    }
    for (int k = 0; k < size; ++k) b[k] /= m[k][k];
    return true;
}

/* A centre that moves by no more, for a surface of size 1, is at rest. */
#define RESTING 1e-3

/* A mean square of distances below this, for a surface of size 1, is rounding. */
#define NEAR 1e-16

/* The point nearest to all lines, by least squares. */
static bool find_point(const normals *all, double c[3])
{
    double m[UNKNOWNS][UNKNOWNS] = {{0}}, b[UNKNOWNS] = {0}, sum = 0;
    for (int k = 0; k < all->count; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double across = (i == j) - all->n[k][i] * all->n[k][j];
                m[i][j] += across;
                b[i] += across * all->p[k][j];
            }
    if (!solve(3, m, b)) return false;
    for (int k = 0; k < all->count; ++k) {
        double from[3];
        for (int i = 0; i < 3; ++i) from[i] = b[i] - all->p[k][i];
        const double along = dot(from, all->n[k]);
        sum += dot(from, from) - along * along;
    }
    memcpy(c, b, 3 * sizeof *c);
    return sum <= NEAR * all->count;
}

/* The line that meets all lines. In Pluecker's coordinates, direction d and moment m = c x d, it
 * meets one if d.(p x n) + m.n = 0: the least eigenvector of a matrix. Normals of a cylinder leave
 * open how much of d is in m. */
static bool find_line(const normals *all, double c[3], double d[3])
{
    double g[UNKNOWNS][UNKNOWNS] = {{0}}, x[UNKNOWNS] = {1, 0.7, 0.4, 0.3, 0.6, 0.8};
    for (int k = 0; k < all->count; ++k) {
        double q[UNKNOWNS];
        cross(all->p[k], all->n[k], q);
        memcpy(q + 3, all->n[k], 3 * sizeof *q);
        for (int i = 0; i < UNKNOWNS; ++i)
            for (int j = 0; j < UNKNOWNS; ++j) g[i][j] += q[i] * q[j];
    }
    for (int step = 0; step < 2; ++step) {
        double m[UNKNOWNS][UNKNOWNS];
        memcpy(m, g, sizeof m);
        for (int i = 0; i < UNKNOWNS; ++i) m[i][i] += 1e-12;
        if (!solve(UNKNOWNS, m, x)) return false;
        const double length = sqrt(dot(x, x) + dot(x + 3, x + 3));
        for (int i = 0; i < UNKNOWNS; ++i) x[i] /= length;
    }
    double sum = 0;
    for (int i = 0; i < UNKNOWNS; ++i)
        for (int j = 0; j < UNKNOWNS; ++j) sum += x[i] * g[i][j] * x[j];
    const double length = sqrt(dot(x, x));
    if (!(length > 1e-3) || !(sum <= NEAR * all->count)) return false;
    cross(x, x + 3, c);
    for (int i = 0; i < 3; ++i) d[i] = x[i] / length, c[i] /= length * length;
    return true;
}

/* Whether the normals are those of a plane, which all lines along them meet at infinity. */
static bool are_parallel(const normals *all)
{
    double sum = 0, turn[3];
    for (int k = 1; k < all->count; ++k) {
        cross(all->n[0], all->n[k], turn);
        sum += dot(turn, turn);
    }
    return sum <= NEAR * all->count;
}

bool centre_guess(memory *known, const place *of, double t, centre *found)
{
    normals all;
    memset(found, 0, sizeof *found);
    if (!take_normals(known, of, t, &all) || are_parallel(&all)) return false;
    found->is_line = !find_point(&all, found->c);
    if (found->is_line && !find_line(&all, found->c, found->d)) return false;
    for (int i = 0; i < 3; ++i) found->c[i] = found->c[i] * all.scale + all.mean[i];
    found->size = all.scale;
    return true;
}

/* Whether two centres are nearer than `most`, and their lines turn by less than `turned`. */
static bool are_near(const centre *a, const centre *b, double most, double turned)
{
    double from[3], across[3], turn[3];
    for (int i = 0; i < 3; ++i) from[i] = b->c[i] - a->c[i];
    cross(from, a->d, across);
    cross(a->d, b->d, turn);
    const double *off = a->is_line ? across : from;
    return a->is_line == b->is_line && sqrt(dot(off, off)) < most && sqrt(dot(turn, turn)) < turned;
}

bool centre_is_shared(const centre *a, const centre *b)
{
    return are_near(a, b, 0.25 * fmax(a->size, b->size), 0.1);
}

bool centre_rests(memory *known, const place *of, const double t[2], const centre *at)
{
    for (int end = 0; end < 2; ++end) {
        centre there;
        if (!centre_guess(known, of, t[end], &there)) return false;
        if (!are_near(at, &there, RESTING * at->size, RESTING)) return false;
    }
    return true;
}

/* Points of a box that are looked at along u, v and t. */
enum { SEEN_U = 4, SEEN_V = 2, SEEN_T = 5, SEEN = SEEN_U * SEEN_V * SEEN_T };

/* Steps in which a direction is sought that is within a right angle of all that are seen. */
enum { ROUNDS = 100 };

/* The direction in which a point of a box is seen from a centre, across its line; false: none. */
static bool see(memory *known, const place *of, const box3 *where, const double share[VARIABLES],
                const centre *from, double n[3])
{
    box3 at = *where;
    for (int j = 0; j < VARIABLES; ++j)
        at.lo[j] = at.hi[j] = where->lo[j] + (where->hi[j] - where->lo[j]) * share[j];
    const kept *k = look_jets(known, of, &at);
    if (k->result != ENCLOSED) return false;
    for (int i = 0; i < 3; ++i) n[i] = ld_interval_mid(k->centre[i].v) - from->c[i];
    const double along = from->is_line ? dot(n, from->d) / dot(from->d, from->d) : 0;
    for (int i = 0; i < 3; ++i) n[i] -= along * from->d[i];
    const double length = sqrt(dot(n, n));
    for (int i = 0; i < 3; ++i) n[i] /= length;
    return length > 0 && length < INFINITY;
}

bool centre_is_amid(memory *known, const centre *from, const place *of, const box3 *where)
{
    double n[SEEN][3], sum[3] = {0};
    int count = 0, worst = 0;
    for (int k = 0; k < SEEN; ++k) {
        const double share[VARIABLES] = {(k % SEEN_U + 0.4) / SEEN_U,
                                         (k / SEEN_U % SEEN_V + 0.4) / SEEN_V,
                                         (double)(k / (SEEN_U * SEEN_V)) / (SEEN_T - 1)};
        if (!see(known, of, where, share, from, n[count])) continue;
        for (int i = 0; i < 3; ++i) sum[i] += n[count][i];
        count += 1;
    }
    for (int round = 0; round < ROUNDS && count > 0; ++round) { /* Rosenblatt's perceptron */
        for (int k = 0; k < count; ++k)
            if (dot(n[k], sum) < dot(n[worst], sum)) worst = k;
        if (dot(n[worst], sum) > 0) return false;
        for (int i = 0; i < 3; ++i) sum[i] += n[worst][i];
    }
    return count > 0;
}
