/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/wide_search.h"

#include <string.h>

#include "core/witness/search.h"

enum { ROWS = 4, PLACES = ROWS * ROWS };

/* Where both surfaces nearly touch, a round of steps ends early, and another one goes on. */
enum { ROUNDS = 16 };

/* Most searches, each from another pair of points of the grid. */
enum { STARTS = 6 };
#define LESS 0.98

/* Relative to half of the domain; points across a seam are the same but for rounding. */
#define AT_EDGE (1 - 0x1p-30)
#define SAME (1 + 0x1p-20)

/* Parameters relative to the node: the middles of equal parts. */
static double place_of(int k) { return (2 * k + 1 - ROWS) / (double)ROWS; }

typedef struct grid {
    double y[PLACES][2];
    double p[PLACES][3];
    vec3 x[PLACES];
} grid;

static imp_code fill(const node *n, double t, grid *g, imp_error *error)
{
    const imp_region *r = &n->region;
    for (int k = 0; k < PLACES; ++k) {
        const int at[2] = {k % ROWS, k / ROWS};
        for (int j = 0; j < 2; ++j) {
            g->y[k][j] = r->d[j] > 0 ? place_of(at[j]) : 0;
            g->p[k][j] = r->c[j] + g->y[k][j] * r->d[j];
        }
        g->p[k][2] = t;
        const imp_code code = search_point(n->surface, g->p[k], &g->x[k], NULL, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

/* Descends until a round gains little. */
static imp_code descend(const node *const nodes[2], double t, double gamma, witness *found,
                        imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (int k = 0; k < ROUNDS && code == IMP_SUCCESS && found->gap_upper > gamma; ++k) {
        const double before = found->gap;
        code = witness_polish(nodes, t, found, error);
        if (!(found->gap < LESS * before)) break;
    }
    return code;
}

/* Where the search ends at an edge of the domain at which the surface closes, it goes on from the
 * edge across, which is as near. */
static imp_code cross_seams(const node *const nodes[2], double t, double gamma, witness *found,
                            imp_error *error)
{
    for (int k = 0; k < NEWTON_UNKNOWNS && found->gap_upper > gamma; ++k) {
        double y[NEWTON_UNKNOWNS];
        witness across;
        for (int j = 0; j < NEWTON_UNKNOWNS; ++j) {
            const imp_region *r = &nodes[j / 2]->region;
            const double p = j % 2 == 0 ? found->u[j / 2] : found->v[j / 2];
            y[j] = r->d[j % 2] > 0 ? (p - r->c[j % 2]) / r->d[j % 2] : 0;
        }
        if (!(fabs(y[k]) > AT_EDGE)) continue;
        y[k] = -y[k];
        imp_code code = witness_at(nodes, t, y, &across, error);
        if (code == IMP_SUCCESS && across.gap <= SAME * found->gap)
            code = descend(nodes, t, gamma, &across, error);
        if (code != IMP_SUCCESS) return code;
        if (across.gap < found->gap) *found = across;
    }
    return IMP_SUCCESS;
}

/* A pair of points of both grids. */
typedef struct start {
    double gap;   /* length */
    int place[2]; /* in each grid */
} start;

/* Inserts a start among the nearest, which are sorted and of which the last is dropped if there are
 * STARTS. */
static void insert(start *nearest, int *count, const start *s)
{
    int k = *count < STARTS ? (*count)++ : STARTS - 1;
    for (; k > 0 && s->gap < nearest[k - 1].gap; --k) nearest[k] = nearest[k - 1];
    nearest[k] = *s;
}

/* Finds the nearest pairs of points, and returns their number. */
static int find_starts(const grid of[2], start *nearest)
{
    int count = 0;
    for (int j = 0; j < PLACES; ++j)
        for (int k = 0; k < PLACES; ++k) {
            const start s = {vec3_norm(vec3_sub(of[1].x[k], of[0].x[j])), {j, k}};
            if (count < STARTS || s.gap < nearest[STARTS - 1].gap) insert(nearest, &count, &s);
        }
    return count;
}

static imp_code seek_from(const node *const nodes[2], double t, double gamma, const grid of[2],
                          const start *s, witness *found, imp_error *error)
{
    double y[NEWTON_UNKNOWNS];
    for (int side = 0; side < 2; ++side)
        memcpy(y + 2 * side, of[side].y[s->place[side]], sizeof of[side].y[0]);
    imp_code code = witness_at(nodes, t, y, found, error);
    if (code == IMP_SUCCESS) code = descend(nodes, t, gamma, found, error);
    if (code == IMP_SUCCESS) code = cross_seams(nodes, t, gamma, found, error);
    /* The way between points that are just near enough may be far from the normals. */
    return code == IMP_SUCCESS ? witness_polish(nodes, t, found, error) : code;
}

imp_code witness_seek_widely(const node *const nodes[2], double t, double gamma, witness *found,
                             imp_error *error)
{
    grid of[2];
    start nearest[STARTS];
    for (int side = 0; side < 2; ++side) {
        const imp_code code = fill(nodes[side], t, &of[side], error);
        if (code != IMP_SUCCESS) return code;
    }
    const int count = find_starts(of, nearest);
    imp_code code = seek_from(nodes, t, gamma, of, &nearest[0], found, error);
    for (int k = 1; k < count && code == IMP_SUCCESS && found->gap_upper > gamma; ++k) {
        witness other;
        code = seek_from(nodes, t, gamma, of, &nearest[k], &other, error);
        if (code == IMP_SUCCESS && other.gap < found->gap) *found = other;
    }
    return code;
}
