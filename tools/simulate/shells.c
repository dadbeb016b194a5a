/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/shells.h"

#include <stdlib.h>

#include "tools/simulate/edges.h"

/* --- Sets of patches with signs -----------------------------------------------------------------
 */

/* Union-find: each patch knows a patch of its set, and whether its orientation is that one's. */
typedef struct linked {
    size_t *up;
    double *sign; /* relative to `up` */
} linked;

/* The root of a patch's set; *sign: relative to the root. Shortens the path. */
static size_t find_root(linked *l, size_t i, double *sign)
{
    size_t root = i;
    double whole = 1;
    for (; l->up[root] != root; root = l->up[root]) whole *= l->sign[root];
    *sign = whole;
    while (i != root) {
        const size_t next = l->up[i];
        const double part = l->sign[i];
        l->up[i] = root, l->sign[i] = whole;
        whole *= part;
        i = next;
    }
    return root;
}

/* Two patches have orientations whose product is `sign`. False: they are known to have the other.
 */
static bool join(linked *l, size_t i, size_t j, double sign)
{
    double a, b;
    const size_t x = find_root(l, i, &a), y = find_root(l, j, &b);
    if (x == y) return a * b == sign;
    l->up[y] = x;
    l->sign[y] = a * b * sign;
    return true;
}

/* --- Seams ------------------------------------------------------------------------------------ */

/* Edges that run in opposite directions bound patches of the same orientation. */
static bool join_at_seam(linked *l, size_t i, size_t j, int direction)
{
    return join(l, i / 4, j / 4, -direction);
}

/* An edge without a partner must run along others, one after another: every point of it lies on
 * one. Of many edges only those without a partner are looked at. */
static bool join_along(linked *l, const edges *e, const size_t *partner, size_t i,
                       shape_verdict *verdict, vec *where)
{
    const bool all = e->count <= 4096;
    for (int k = 0; k <= e->steps; ++k) {
        int direction = 0;
        for (size_t j = 0; j < e->count && direction == 0; ++j) {
            if (j == i || !(all || partner[j] == SIZE_MAX) || edge_is_point(e, j)) continue;
            direction = edge_passes(e, i, k, j);
            /* At its ends an edge may meet others that lead away. */
            const bool inner = k > 0 && k < e->steps;
            if (direction != 0 && inner && !join_at_seam(l, i, j, direction))
                *verdict = SHAPE_ONE_SIDED;
        }
        if (direction == 0) *verdict = SHAPE_OPEN;
        *where = edge_points(e, i)[k];
        if (*verdict != SHAPE_FOUND) return false;
    }
    return true;
}

static shape_verdict join_all(linked *l, const edges *e, const size_t *partner, vec *where)
{
    shape_verdict verdict = SHAPE_FOUND;
    for (size_t i = 0; i < e->count; ++i) {
        const size_t j = partner[i];
        if (j == SEAM_SHARED || edge_is_point(e, i)) continue;
        if (j == SIZE_MAX) {
            if (!join_along(l, e, partner, i, &verdict, where)) return verdict;
            if (limits_reached(e->patches->limits) != IMP_REASON_NONE) return SHAPE_STOPPED;
        } else if (i < j && !join_at_seam(l, i, j, edge_compare(e, i, j))) {
            *where = edge_points(e, i)[e->steps / 2];
            return SHAPE_ONE_SIDED;
        }
    }
    return SHAPE_FOUND;
}

/* --- All -------------------------------------------------------------------------------------- */

/* Numbers the sets by their first patch, whose sign becomes 1. A root may come after it: it then
 * has its number and sign before its turn. */
static void number_shells(shells *s, linked *l, size_t count)
{
    for (size_t i = 0; i < count; ++i) s->of[i] = SIZE_MAX;
    for (size_t i = 0; i < count; ++i) {
        double sign;
        const size_t root = find_root(l, i, &sign);
        if (s->of[root] == SIZE_MAX) {
            s->of[root] = s->count++;
            s->sign[root] = sign;
        }
        if (i == root) continue;
        s->of[i] = s->of[root];
        s->sign[i] = sign * s->sign[root];
    }
}

static shape_verdict find(shells *s, linked *l, edges *e, const patches *p, vec *where,
                          imp_error *why)
{
    shape_verdict verdict = edges_read(e, p, why);
    if (verdict != SHAPE_FOUND) return verdict;
    size_t *partner = malloc((e->count + 1) * sizeof *partner);
    if (partner == NULL) return SHAPE_NO_MEMORY;
    verdict = edges_match(e, partner);
    if (verdict == SHAPE_FOUND) verdict = join_all(l, e, partner, where);
    if (verdict == SHAPE_FOUND) number_shells(s, l, p->count);
    free(partner);
    return verdict;
}

shape_verdict shells_find(shells *s, const patches *p, vec *where, imp_error *why)
{
    const size_t n = p->count + 1;
    linked l = {malloc(n * sizeof *l.up), malloc(n * sizeof *l.sign)};
    edges e = {0};
    *s = (shells){malloc(n * sizeof *s->of), malloc(n * sizeof *s->sign), 0};
    shape_verdict verdict = SHAPE_NO_MEMORY;
    if (l.up != NULL && l.sign != NULL && s->of != NULL && s->sign != NULL) {
        for (size_t i = 0; i < p->count; ++i) l.up[i] = i, l.sign[i] = 1;
        verdict = find(s, &l, &e, p, where, why);
    }
    edges_free(&e);
    free(l.up);
    free(l.sign);
    return verdict;
}

void shells_free(shells *s)
{
    free(s->of);
    free(s->sign);
    *s = (shells){0};
}
