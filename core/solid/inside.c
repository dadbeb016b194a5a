/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/inside.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/scene/scene_trees.h"
#include "core/solid/components.h"
#include "core/solid/solid_internal.h"
#include "core/surface/region.h"

/* Lemma. Let no point of body b be nearer than gamma_clear to a point of the solid a at time t. The
 * ribbons that close a's seams are no farther from a than half of their width, which is at most
 * twice gamma_clear, so that b does not meet them either. Then each connected part of b is wholly
 * inside or wholly outside of a, as the winding number is constant along a path that avoids the
 * surface. So it is if two patches of b have points nearer to each other than gamma_clear: the
 * segment between these does not meet a. */

struct inside_search {
    inside_plan plan;
    size_t bodies;
    double t;         /* of the solids */
    bool *is_counted; /* by body: whether its solid is among `kept` */
    size_t kept;      /* bytes of all solids */
    size_t counted;   /* bytes that callers know of */
    solid **solids;   /* by body; NULL: not made yet, or it has nothing at that time */
};

inside_search *inside_new(const inside_plan *plan)
{
    inside_search *s = calloc(1, sizeof *s);
    if (s == NULL) return NULL;
    *s = (inside_search){.plan = *plan, .bodies = scene_body_count(plan->scene), .t = NAN};
    s->solids = calloc(s->bodies + 1, sizeof *s->solids);
    s->is_counted = calloc(s->bodies + 1, sizeof *s->is_counted);
    if (s->solids != NULL && s->is_counted != NULL) return s;
    free(s->solids);
    free(s->is_counted);
    free(s);
    return NULL;
}

static void forget_solids(inside_search *s)
{
    for (size_t k = 0; k < s->bodies; ++k) {
        solid_free(s->solids[k]);
        s->solids[k] = NULL;
    }
}

void inside_free(inside_search *s)
{
    if (s == NULL) return;
    forget_solids(s);
    free(s->solids);
    free(s->is_counted);
    free(s);
}

/* --- Boxes ------------------------------------------------------------------------------------ */

/* Bounds all pieces of a surface at time t by its hierarchy, since there may be many. */
static imp_code include_pieces(const inside_search *s, size_t body, size_t index, double t,
                               imp_model model[3], imp_status *status, tree_growth *growth,
                               imp_error *error)
{
    const surface *whole = scene_surface(s->plan.scene, body, index);
    double lo[3], hi[3];
    surface_domain(whole, lo, hi);
    const tree_plan plan = {.kind = TREE_MODELS,
                            .t_start = lo[2] > s->plan.from ? lo[2] : s->plan.from,
                            .t_end = hi[2] < s->plan.to ? hi[2] : s->plan.to};
    tree *found;
    imp_code code = scene_tree(s->plan.scene, body, index, &plan, true, &found, growth, error);
    if (code == IMP_SUCCESS) code = tree_make_root(found, growth, error);
    if (code != IMP_SUCCESS) return code;
    const imp_region region = region_make((double[3]){-1, 0, t}, (double[3]){1, 0, t});
    cluster_models(tree_root(found)->many, &region, model);
    *status = surface_include_image(whole, &region, model);
    return IMP_SUCCESS;
}

static imp_code include_surface(const inside_search *s, size_t body, size_t index, double t,
                                imp_model model[3], tree_growth *growth, imp_error *error)
{
    const surface *whole = scene_surface(s->plan.scene, body, index);
    const surface *one = surface_piece_count(whole) == 1 ? surface_piece(whole, 0) : whole;
    imp_status status = IMP_STATUS_OK;
    double lo[3], hi[3];
    surface_domain(one, lo, hi);
    lo[2] = hi[2] = t;
    for (int i = 0; i < 3; ++i) model[i].lo = -INFINITY, model[i].hi = INFINITY;
    if (!(hi[0] - lo[0] < INFINITY && hi[1] - lo[1] < INFINITY)) return IMP_SUCCESS;
    if (surface_piece_count(whole) > 1) {
        const imp_code code = include_pieces(s, body, index, t, model, &status, growth, error);
        if (code != IMP_SUCCESS) return code;
    } else {
        const imp_region region = region_make(lo, hi);
        status = surface_include(one, &region, model);
    }
    if (status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    surface_fault(whole, error, "at t = %.17g: %s", t, surface_status_message(whole, status).text);
    return surface_set_code(status, error);
}

/* Bounds the surfaces of a body that exist at time t; an inverted box: there are none. */
static imp_code box_of(const inside_search *s, size_t body, double t, solid_box *box,
                       tree_growth *growth, imp_error *error)
{
    *box = solid_box_none();
    for (size_t k = 0; k < scene_surface_count(s->plan.scene, body); ++k) {
        double from, to;
        imp_model model[3];
        solid_box one;
        surface_existence(scene_surface(s->plan.scene, body, k), &from, &to);
        if (!(from <= t && t <= to)) continue;
        const imp_code code = include_surface(s, body, k, t, model, growth, error);
        if (code != IMP_SUCCESS) return code;
        solid_box_around(model, &one);
        solid_box_add(box, &one);
    }
    return IMP_SUCCESS;
}

/* --- One body in the other -------------------------------------------------------------------- */

typedef struct holding {
    inside_search *search;
    size_t solid, inner; /* bodies */
    double t;
    const patches *patches; /* of the inner body */
    const components *parts;
    imp_error *error;
} holding;

static imp_code make_solid(const holding *h, solid **made)
{
    inside_search *s = h->search;
    if (!(s->t == h->t)) forget_solids(s);
    s->t = h->t;
    solid **slot = &s->solids[h->solid];
    const double passed = 2 * s->plan.gamma_clear;
    const double most = s->plan.seam < passed ? s->plan.seam : passed;
    const double slack = s->plan.gamma < most ? s->plan.gamma : most;
    imp_code code = IMP_SUCCESS;
    if (*slot == NULL)
        code = solid_new(s->plan.scene, h->solid, h->t, slack, s->plan.watch, slot, h->error);
    *made = *slot;
    return code;
}

/* Tests samples of a patch until one decides on which side of the solid its component is. */
static imp_code judge_patch(const holding *h, size_t index, inside_answer *answer)
{
    const patch_samples *s = &h->parts->samples[index];
    const patch *p = &h->patches->patch[index];
    solid_side side = SOLID_TOO_NEAR;
    solid *around;
    imp_code code = make_solid(h, &around);
    if (code != IMP_SUCCESS || around == NULL) return code;
    int k = 0;
    for (; k < PATCH_SAMPLES && side == SOLID_TOO_NEAR; ++k) {
        bool stopped;
        code = solid_side_of(around, s->x[k], s->off[k], &side, &stopped, h->error);
        if (stopped) answer->state = INSIDE_STOPPED;
        if (code != IMP_SUCCESS || stopped) return code;
    }
    if (side == SOLID_TOO_NEAR) answer->state = INSIDE_UNKNOWN;
    if (side != SOLID_INSIDE) return IMP_SUCCESS;
    k -= 1;
    answer->state = INSIDE_FOUND;
    imp_side *inner = &answer->side[0], *outer = &answer->side[1];
    *inner = (imp_side){p->place.body, p->place.surface, p->place.piece,
                        s->uv[k][0],   s->uv[k][1],      {0, 0, 0}};
    memcpy(inner->point, s->x[k].x, sizeof inner->point);
    *outer = (imp_side){h->solid, 0, 0, NAN, NAN, {0, 0, 0}};
    memcpy(outer->point, inner->point, sizeof outer->point);
    return IMP_SUCCESS;
}

/* Judges each component of which no sample is out of the solid's box: one that has such a sample is
 * outside, by the lemma. */
static imp_code judge_components(const holding *h, const solid_box *box, inside_answer *answer)
{
    const components *c = h->parts;
    bool *done = calloc(c->count + 1, sizeof *done);
    if (done == NULL) return error_set_memory(h->error);
    for (size_t i = 0; i < h->patches->count; ++i)
        for (int k = 0; k < PATCH_SAMPLES && !done[c->of[i]]; ++k)
            done[c->of[i]] = solid_box_excludes(box, c->samples[i].x[k], c->samples[i].off[k]);
    imp_code code = IMP_SUCCESS;
    bool unknown = false;
    for (size_t i = 0; i < h->patches->count && code == IMP_SUCCESS; ++i) {
        if (done[c->of[i]]) continue;
        done[c->of[i]] = true;
        answer->state = INSIDE_NOBODY;
        code = judge_patch(h, i, answer);
        unknown = unknown || answer->state == INSIDE_UNKNOWN;
        if (answer->state == INSIDE_FOUND || answer->state == INSIDE_STOPPED) break;
        answer->state = unknown ? INSIDE_UNKNOWN : INSIDE_NOBODY;
    }
    free(done);
    return code;
}

/* Finds out whether parts of `inner` are in the solid body `outer`, whose box is given. */
static imp_code look_into(inside_search *s, size_t outer, size_t inner, double t,
                          const solid_box *box, inside_answer *answer, imp_error *error)
{
    patches p;
    components parts = {0};
    imp_code code = solid_patches_read(&p, s->plan.scene, inner, t, error);
    if (code == IMP_SUCCESS) code = components_find(&parts, &p, s->plan.gamma_clear, error);
    const holding h = {s, outer, inner, t, &p, &parts, error};
    if (code == IMP_SUCCESS) code = judge_components(&h, box, answer);
    components_free(&parts);
    solid_patches_free(&p);
    return code;
}

/* Counts the memory that looking into a solid may take: that of all solids that were made, of the
 * reading of this one, and of the inner body's parts. False: that is much more than was counted. */
static bool count_bytes(inside_search *s, size_t outer, size_t inner, tree_growth *growth)
{
    enum { MUCH = 1 << 16 };
    const size_t of_outer = solid_patches_most(s->plan.scene, outer);
    const size_t of_inner = solid_patches_most(s->plan.scene, inner);
    if (!s->is_counted[outer]) s->kept += solid_bytes(of_outer);
    s->is_counted[outer] = true;
    const size_t bytes = s->kept + solid_shells_bytes(of_outer) + of_inner * sizeof(patch) +
                         components_bytes(of_inner);
    if (bytes <= s->counted) return true;
    const size_t more = bytes - s->counted;
    s->counted = bytes;
    growth->bytes += more;
    return more < MUCH;
}

imp_code inside_find(inside_search *s, const size_t body[2], double t, inside_answer *answer,
                     tree_growth *growth, imp_error *error)
{
    solid_box box[2];
    bool unknown = false;
    *answer = (inside_answer){.state = INSIDE_NOBODY};
    if (!scene_is_solid(s->plan.scene, body[0]) && !scene_is_solid(s->plan.scene, body[1]))
        return IMP_SUCCESS;
    for (int k = 0; k < 2; ++k) {
        const imp_code code = box_of(s, body[k], t, &box[k], growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    if (solid_boxes_apart(&box[0], &box[1])) return IMP_SUCCESS;
    for (int k = 0; k < 2; ++k) {
        if (!scene_is_solid(s->plan.scene, body[k])) continue;
        if (!count_bytes(s, body[k], body[1 - k], growth)) {
            answer->state = INSIDE_STOPPED;
            return IMP_SUCCESS;
        }
        const imp_code code = look_into(s, body[k], body[1 - k], t, &box[k], answer, error);
        if (code != IMP_SUCCESS || answer->state == INSIDE_STOPPED) return code;
        if (answer->state == INSIDE_FOUND) {
            const imp_side inner = answer->side[0];
            if (k == 0) answer->side[0] = answer->side[1], answer->side[1] = inner;
            return IMP_SUCCESS;
        }
        unknown = unknown || answer->state == INSIDE_UNKNOWN;
    }
    answer->state = unknown ? INSIDE_UNKNOWN : INSIDE_NOBODY;
    return IMP_SUCCESS;
}
