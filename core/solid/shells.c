/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/shells.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/base/union_find.h"
#include "core/solid/edges.h"
#include "core/solid/shared.h"

/* --- Seams ------------------------------------------------------------------------------------ */

typedef struct joining {
    union_find sets; /* of patches, with their orientations for signs */
    const edges *e;
    size_t *partner;
    imp_closure *closure;
    const limit_watch *watch;
    bool shares_edges; /* more than two patches share an edge */
} joining;

/* Keeps the first fault, at point k of edge i. */
static void note_fault(joining *j, imp_closure_verdict verdict, size_t i, int k)
{
    if (j->closure->verdict != IMP_CLOSURE_CLOSED) return;
    j->closure->verdict = verdict;
    j->closure->at = j->e->patches->patch[i / 4].place;
    memcpy(j->closure->where, edge_points(j->e, i)[k].x, sizeof j->closure->where);
}

/* Edges that run in opposite directions bound patches of the same orientation. */
static bool join_at_seam(joining *j, size_t i, size_t other, int direction)
{
    return union_find_join(&j->sets, i / 4, other / 4, -direction);
}

/* Joins the patches of the edges that run along point k of edge i. False: none does. In a body of
 * many edges only those without a partner are tried. */
static bool join_at_point(joining *j, size_t i, int k)
{
    const edges *e = j->e;
    const bool all = e->count <= 4096;
    for (size_t other = 0; other < e->count; ++other) {
        if (other == i || !(all || j->partner[other] == SEAM_NONE) || edge_is_point(e, other))
            continue;
        const int direction = edge_passes(e, i, k, other);
        if (direction == 0) continue;
        /* At its ends an edge may meet others that lead away. */
        const bool inner = k > 0 && k < e->steps;
        if (inner && !join_at_seam(j, i, other, direction))
            note_fault(j, IMP_CLOSURE_ONE_SIDED, i, k);
        return true;
    }
    return false;
}

/* An edge without a partner must run along others, one after another: every point of it lies on
 * one. */
static void join_along(joining *j, size_t i)
{
    for (int k = 0; k <= j->e->steps && j->closure->verdict == IMP_CLOSURE_CLOSED; ++k) {
        if (!limit_watch_goes_on(j->watch))
            j->closure->verdict = IMP_CLOSURE_STOPPED;
        else if (!join_at_point(j, i, k))
            note_fault(j, IMP_CLOSURE_OPEN, i, k);
    }
}

static void join_all(joining *j)
{
    const edges *e = j->e;
    for (size_t i = 0; i < e->count; ++i) {
        const size_t partner = j->partner[i];
        const int middle = e->steps / 2;
        j->shares_edges = j->shares_edges || partner == SEAM_EVEN || partner == SEAM_ODD;
        if (partner == SEAM_EVEN || edge_is_point(e, i)) continue;
        if (partner == SEAM_ODD)
            note_fault(j, IMP_CLOSURE_OPEN, i, middle);
        else if (partner == SEAM_NONE)
            join_along(j, i);
        else if (i < partner && !join_at_seam(j, i, partner, edge_compare(e, i, partner)))
            note_fault(j, IMP_CLOSURE_ONE_SIDED, i, middle);
    }
}

/* --- All -------------------------------------------------------------------------------------- */

/* Numbers the sets by their first patch, whose sign becomes 1. A root may come after it: it then
 * has its number and sign before its turn. */
static void number_shells(shells *s, union_find *sets, size_t count)
{
    s->count = 0;
    for (size_t i = 0; i < count; ++i) s->facing[i].shell = SIZE_MAX;
    for (size_t i = 0; i < count; ++i) {
        int sign;
        const size_t root = union_find_root(sets, i, &sign);
        imp_facing *first = &s->facing[root];
        if (first->shell == SIZE_MAX) *first = (imp_facing){s->count++, sign};
        if (i != root) s->facing[i] = (imp_facing){first->shell, sign * first->sign};
    }
}

imp_code solid_shells_within(shells *s, const patches *p, double slack, const limit_watch *watch,
                             imp_closure *closure, imp_error *error)
{
    const size_t n = p->count;
    edges e;
    joining j = {.e = &e, .closure = closure, .watch = watch};
    const bool has_sets = union_find_make(&j.sets, n);
    j.partner = malloc((4 * n + 1) * sizeof *j.partner);
    closure->verdict = IMP_CLOSURE_CLOSED;
    imp_code code = edges_read(&e, p, slack, error);
    if (!has_sets || j.partner == NULL) code = error_set_memory(error);
    if (code == IMP_SUCCESS && !e.bounded)
        closure->verdict = IMP_CLOSURE_UNBOUNDED;
    else if (code == IMP_SUCCESS && !edges_match(&e, j.partner, NULL))
        code = error_set_memory(error);
    if (code == IMP_SUCCESS && e.bounded) join_all(&j);
    if (code == IMP_SUCCESS) number_shells(s, &j.sets, n);
    bool cancel = true;
    if (code == IMP_SUCCESS && j.shares_edges && !edges_cancel(&e, j.partner, s->facing, &cancel))
        code = error_set_memory(error);
    s->slack = slack;
    s->shares_edges = j.shares_edges;
    s->is_doubtful = !cancel;
    edges_free(&e);
    union_find_clear(&j.sets);
    free(j.partner);
    return code;
}

size_t solid_shells_bytes(size_t count)
{
    const joining *j = NULL;
    const shells *s = NULL;
    return edges_bytes(count) + union_find_bytes(count) +
           count * (4 * sizeof *j->partner + sizeof *s->facing + sizeof *s->is_repeated) +
           solid_shared_bytes(count);
}

/* Leaves patches out where more than two share an edge, and some are copies. */
static imp_code find_within(shells *s, const patches *p, double slack, const limit_watch *watch,
                            imp_closure *closure, imp_error *error)
{
    const imp_code code = solid_shells_within(s, p, slack, watch, closure, error);
    if (code != IMP_SUCCESS || !s->shares_edges || closure->verdict == IMP_CLOSURE_STOPPED)
        return code;
    return solid_shells_shared(s, p, slack, watch, closure, error);
}

#define FINE_SLACK 1e-9 /* part of the body's size within which points are the same */

imp_code solid_shells_find(shells *s, const patches *p, double slack, const limit_watch *watch,
                           imp_closure *closure, imp_error *error)
{
    const double fine = FINE_SLACK * p->size;
    *s = (shells){.facing = calloc(p->count + 1, sizeof *s->facing),
                  .is_repeated = calloc(p->count + 1, sizeof *s->is_repeated)};
    if (s->facing == NULL || s->is_repeated == NULL) return error_set_memory(error);
    closure->verdict = p->bounded ? IMP_CLOSURE_EMPTY : IMP_CLOSURE_UNBOUNDED;
    if (!p->bounded || p->count == 0 || !(p->size > 0)) return IMP_SUCCESS;
    imp_code code = find_within(s, p, fine, watch, closure, error);
    if (code == IMP_SUCCESS && slack > fine &&
        (closure->verdict == IMP_CLOSURE_OPEN || closure->verdict == IMP_CLOSURE_ONE_SIDED))
        code = find_within(s, p, slack, watch, closure, error);
    closure->shells = closure->verdict == IMP_CLOSURE_CLOSED ? s->count : 0;
    return code;
}

void solid_shells_free(shells *s)
{
    free(s->facing);
    free(s->is_repeated);
    *s = (shells){0};
}
