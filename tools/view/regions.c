/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/regions.h"

#include <stdlib.h>

enum { STEPS = 64 };

static bool overlaps(const double at[2], const double with[2])
{
    return at[0] < with[1] && with[0] < at[1];
}

static void take_patch(const mesh *m, const mesh_patch *p, const struct imp_pending_side *side,
                       double tested, double *pairs)
{
    const double *u = mesh_u(m, p), *v = mesh_v(m, p);
    for (size_t i = 0; i + 1 < p->nu; ++i)
        for (size_t j = 0; j + 1 < p->nv && overlaps(u + i, side->u); ++j)
            if (overlaps(v + j, side->v)) pairs[p->first_cell + i * (p->nv - 1) + j] = tested;
}

/* The cells that the side covers are not proved clear before the pairs tested now. */
static void take_side(const film *f, const struct imp_pending_side *side, double tested, regions *r)
{
    for (size_t k = 0; k < f->count; ++k) {
        const mesh *m = f->tracks[k].mesh;
        if (side->body != m->body || side->surface != m->surface) continue;
        for (size_t i = 0; i < m->cell_count && side->piece == SIZE_MAX && r->whole[k] != tested;
             ++i)
            r->pairs[k][i] = tested;
        if (side->piece == SIZE_MAX)
            r->whole[k] = tested; /* perhaps all of it, noted once a step */
        if (side->piece < m->patch_count)
            take_patch(m, &m->patches[side->piece], side, tested, r->pairs[k]);
    }
}

static void take_step(const subject *what, const film *f, const imp_query *query, double tested,
                      regions *r)
{
    imp_pending left;
    for (size_t k = 0; imp_query_pending(query, k, &left); ++k) {
        if (left.t_lower >= what->contact.t) continue;
        take_side(f, &left.a, tested, r);
        take_side(f, &left.b, tested, r);
    }
}

static imp_code run(const subject *what, const film *f, imp_query *query, regions *r,
                    imp_error *error)
{
    const uint64_t total = imp_query_result(what->query).stats.pairs;
    r->total = (double)total;
    for (imp_result now = {.reason = IMP_REASON_RUNNING}; now.reason == IMP_REASON_RUNNING;) {
        const imp_code code = imp_query_step(query, total / STEPS + 1, error);
        if (code != IMP_SUCCESS) return code;
        now = imp_query_result(query);
        take_step(what, f, query, (double)now.stats.pairs, r);
    }
    return IMP_SUCCESS;
}

imp_code regions_measure(const subject *what, const film *f, regions *r, imp_error *error)
{
    *r = (regions){.pairs = calloc(f->count + 1, sizeof *r->pairs),
                   .whole = calloc(f->count + 1, sizeof *r->whole)};
    if (r->pairs == NULL || r->whole == NULL) return mesh_no_memory(error);
    for (size_t k = 0; k < f->count; ++k) {
        r->pairs[r->count++] = calloc(f->tracks[k].mesh->cell_count, sizeof **r->pairs);
        if (r->pairs[k] == NULL) return mesh_no_memory(error);
    }
    imp_options options = what->options;
    options.t_end = imp_query_result(what->query).t_end; /* the same search once more */
    options.max_seconds = allowance_left(&what->allowance, 0.5);
    imp_query *query = imp_query_new(what->scene, &options, error);
    if (query == NULL) return error->code;
    const imp_code code = run(what, f, query, r, error);
    imp_query_free(query);
    return code;
}

void regions_free(regions *r)
{
    for (size_t k = 0; k < r->count; ++k) free(r->pairs[k]);
    free(r->pairs);
    free(r->whole);
    *r = (regions){0};
}
