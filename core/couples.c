/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "couples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"
#include "broad_phase.h"
#include "claims.h"
#include "scene_trees.h"
#include "status.h"

/* --- Who is there ----------------------------------------------------------------------- */

/* One surface of the scene, while couples are made. */
typedef struct entrant {
    tree *tree;
    size_t body, surface;
} entrant;

typedef struct line_up {
    imp_scene *scene;
    const imp_options *options;
    imp_stats *stats;
    entrant *entrants;
    swept_box *boxes;
    size_t count;
    couple_list *list;
} line_up;

static tree_kind kind_of(const imp_options *options)
{
    if (options->method == IMP_METHOD_MODELS) return TREE_MODELS;
    switch (options->rates) {
    case IMP_RATES_COLUMN:
        return TREE_RATES_COLUMN;
    case IMP_RATES_CONSTANT:
        return TREE_RATES_CONSTANT;
    default:
        return TREE_RATES_FULL;
    }
}

/* Enters one surface, if it exists at any of the query's times. */
static imp_code enter(line_up *all, size_t body, size_t index, imp_error *error)
{
    const imp_options *options = all->options;
    double lo[3], hi[3];
    imp_scene_domain(all->scene, body, index, lo, hi);
    const tree_plan plan = {.kind = kind_of(options),
                            .t_start = lo[2] > options->t_start ? lo[2] : options->t_start,
                            .t_end = hi[2] < options->t_end ? hi[2] : options->t_end,
                            .audit = options->audit ? claims_audit : NULL};
    if (plan.t_start > plan.t_end) return IMP_SUCCESS;
    lent_tree lent;
    const imp_code code = scene_tree(all->scene, body, index, &plan, &lent, error);
    if (code != IMP_SUCCESS) return code;
    if (lent.fresh) {
        all->stats->nodes += tree_node_count(lent.tree);
        all->stats->bytes += tree_bytes(lent.tree);
    }
    const node *root = tree_root(lent.tree);
    swept_box *box = &all->boxes[all->count];
    box->owner = all->count;
    memcpy(box->lo, root->lo, sizeof box->lo);
    memcpy(box->hi, root->hi, sizeof box->hi);
    all->entrants[all->count++] = (entrant){lent.tree, body, index};
    return IMP_SUCCESS;
}

static imp_code enter_all(line_up *all, imp_error *error)
{
    for (size_t b = 0; b < imp_scene_body_count(all->scene); ++b)
        for (size_t k = 0; k < imp_scene_surface_count(all->scene, b); ++k) {
            const imp_code code = enter(all, b, k, error);
            if (code != IMP_SUCCESS) return code;
        }
    return IMP_SUCCESS;
}

/* --- Who meets whom ----------------------------------------------------------------------- */

/* Keeps two surfaces that come near each other, smaller body first; false: no memory. */
static bool couple_up(void *context, size_t first, size_t second)
{
    line_up *all = context;
    couple_list *list = all->list;
    const entrant *a = &all->entrants[first], *b = &all->entrants[second];
    if (a->body == b->body || scene_ignores(all->scene, a->body, b->body)) return true;
    if (a->body > b->body) {
        const entrant *t = a;
        a = b;
        b = t;
    }
    couple *grown = array_reserve(list->couples, list->count, &list->capacity, sizeof *grown);
    if (grown == NULL) return false;
    list->couples = grown;
    list->couples[list->count++] =
        (couple){{a->tree, b->tree}, {a->body, b->body}, {a->surface, b->surface}, 0};
    return true;
}

/* The order of the sweep depends on the query's times only through the boxes; couples are put in
 * the order of the scene so that ties on the heap do not depend on it. */
static int couple_order(const void *p, const void *q)
{
    const couple *a = p, *b = q;
    const size_t ka[4] = {a->body[0], a->body[1], a->surface[0], a->surface[1]};
    const size_t kb[4] = {b->body[0], b->body[1], b->surface[0], b->surface[1]};
    for (int k = 0; k < 4; ++k)
        if (ka[k] != kb[k]) return ka[k] < kb[k] ? -1 : 1;
    return 0;
}

static imp_code line_up_run(line_up *all, double clearance, imp_error *error)
{
    couple_list *list = all->list;
    const imp_code code = enter_all(all, error);
    if (code != IMP_SUCCESS) return code;
    if (!broad_phase_visit(all->boxes, all->count, clearance, couple_up, all))
        return error_set_memory(error);
    if (list->count > 0) qsort(list->couples, list->count, sizeof *list->couples, couple_order);
    return IMP_SUCCESS;
}

imp_code couples_find(couple_list *list, imp_scene *scene, const imp_options *options,
                      double clearance, imp_stats *stats, imp_error *error)
{
    line_up all = {.scene = scene, .options = options, .stats = stats, .list = list};
    size_t most = 1; /* an array of none may be NULL */
    for (size_t b = 0; b < imp_scene_body_count(scene); ++b)
        most += imp_scene_surface_count(scene, b);
    list->count = 0;
    all.entrants = malloc(most * sizeof *all.entrants);
    all.boxes = malloc(most * sizeof *all.boxes);
    const imp_code code = all.entrants == NULL || all.boxes == NULL
                              ? error_set_memory(error)
                              : line_up_run(&all, clearance, error);
    free(all.entrants);
    free(all.boxes);
    return code;
}

void couples_clear(couple_list *list) { free(list->couples); }

/* --- Nobody ------------------------------------------------------------------------------- */

/* Whether any surface of body a and any of b exist at one time of the query. */
static bool have_time_in_common(const imp_scene *scene, size_t a, size_t b,
                                const imp_options *options)
{
    for (size_t k = 0; k < imp_scene_surface_count(scene, a); ++k)
        for (size_t l = 0; l < imp_scene_surface_count(scene, b); ++l) {
            double lo[2][3], hi[2][3];
            imp_scene_domain(scene, a, k, lo[0], hi[0]);
            imp_scene_domain(scene, b, l, lo[1], hi[1]);
            const double start = fmax(options->t_start, fmax(lo[0][2], lo[1][2]));
            const double end = fmin(options->t_end, fmin(hi[0][2], hi[1][2]));
            if (start <= end) return true;
        }
    return false;
}

imp_reason couples_reason_of_none(const imp_scene *scene, const imp_options *options)
{
    const size_t n = imp_scene_body_count(scene);
    imp_reason reason = IMP_REASON_NO_PAIRS;
    for (size_t a = 0; a < n; ++a)
        for (size_t b = a + 1; b < n; ++b) {
            if (scene_ignores(scene, a, b)) continue;
            if (have_time_in_common(scene, a, b, options)) return IMP_REASON_NONE;
            reason = IMP_REASON_NO_TIME;
        }
    return reason;
}
