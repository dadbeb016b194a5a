/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/posing.h"

#include <string.h>

#include "core/base/status.h"
#include "core/tree/tree_internal.h"

typedef struct shape {
    bool moves;    /* moves by itself: has no halves */
    bool is_known; /* the model is filled */
    shape_model model;
    _Atomic(struct shape *) child[2][2]; /* along u and v */
    _Atomic(struct shape *) tube;        /* of the same points */
} shape;

typedef struct span {
    bool is_known;   /* the pose is filled */
    bool is_uniform; /* it neither turns nor accelerates */
    pose_lanes pose;
    _Atomic(struct span *) child[2];
} span;

/* --- Memory ----------------------------------------------------------------------------------- */

/* The first block holds what the root's first halves begin with: most trees of large scenes are
 * small. The next hold one shape or one span each, until a twentieth of all is more than a span: of
 * a block that is a part of a span larger than a shape, that part is left unused. */
static const arena_growth posing_growth = {sizeof(span) + sizeof(shape), sizeof(double), 5, 8192};

/* --- Shapes ----------------------------------------------------------------------------------- */

/* The line in the middle of a tube, and its radius. False: there is none over the region. */
static bool line_of(const surface *s, const imp_region *region, imp_model line[3], double *ball)
{
    imp_tube tube;
    if (surface_tube(s, region, &tube) != IMP_STATUS_OK) return false;
    memcpy(line, tube.line, sizeof tube.line);
    *ball = tube.radius;
    return true;
}

/* Fills a shape over the u and v of a node, at all times of the root. If there is no model, the
 * node's inclusion through all maps will report the error. */
static void shape_fill(shape *s, const node *n, const node *root)
{
    imp_region region = n->region;
    imp_model model[3];
    region.lo[2] = root->region.lo[2];
    region.hi[2] = root->region.hi[2];
    region.c[2] = root->region.c[2];
    region.d[2] = root->region.d[2];
    double ball = 0;
    memset(s, 0, sizeof *s);
    const bool is_tube = node_is_to_be_tube(n);
    if (is_tube && !line_of(n->surface, &region, model, &ball)) return;
    if (n->many != NULL)
        cluster_models(n->many, &region, model);
    else if (!is_tube && surface_include_bare(n->surface, &region, model) != IMP_STATUS_OK)
        return;
    for (int i = 0; i < 3; ++i)
        if (!(model[i].e < INFINITY)) return;
    s->moves = !shape_model_take(&s->model, model);
    s->model.ball = ball;
    s->is_known = !s->moves;
}

static shape *shape_publish(tree *t, const shape *filled, _Atomic(shape *) *slot,
                            tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    shape *s = atomic_load_explicit(slot, memory_order_relaxed);
    if (s == NULL) {
        s = arena_take(&t->posing.memory, &posing_growth, sizeof *s, &growth->bytes, t->plan.store);
        if (s != NULL) {
            memcpy(s, filled, sizeof *s);
            atomic_store_explicit(slot, s, memory_order_release);
        }
    }
    pthread_mutex_unlock(&t->lock);
    return s;
}

/* Returns the shape in the slot, made now for n if there is none. NULL: no memory. */
static shape *shape_in(tree *t, _Atomic(shape *) *slot, const node *n, tree_growth *growth)
{
    shape *s = atomic_load_explicit(slot, memory_order_acquire);
    if (s != NULL) return s;
    shape filled;
    shape_fill(&filled, n, tree_root(t));
    return shape_publish(t, &filled, slot, growth);
}

/* --- Spans ------------------------------------------------------------------------------------ */

static bool is_uniform(const imp_pose *pose)
{
    for (int i = 0; i < 3; ++i) {
        if (pose->shift[i].q[IMP_TT] != 0) return false;
        for (int j = 0; j < 3; ++j)
            if (pose->turn[i][j].depends) return false;
    }
    return true;
}

static imp_code span_fill(span *s, const node *n, imp_error *error)
{
    imp_pose given;
    memset(s, 0, sizeof *s);
    const imp_status status = surface_pose(n->surface, &n->region, &given);
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) {
        surface_fault(n->surface, error, "over t [%.17g, %.17g]: %s", n->region.lo[2],
                      n->region.hi[2], surface_status_message(n->surface, status).text);
        return surface_set_code(status, error);
    }
    s->is_known = status == IMP_STATUS_OK;
    s->is_uniform = s->is_known && is_uniform(&given);
    if (s->is_known) pose_take(&s->pose, &given, surface_pose_norm_upper(n->surface));
    return IMP_SUCCESS;
}

static span *span_publish(tree *t, const span *filled, _Atomic(span *) *slot, tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    span *s = atomic_load_explicit(slot, memory_order_relaxed);
    if (s == NULL) {
        s = arena_take(&t->posing.memory, &posing_growth, sizeof *s, &growth->bytes, t->plan.store);
        if (s != NULL) {
            memcpy(s, filled, sizeof *s);
            atomic_store_explicit(slot, s, memory_order_release);
        }
    }
    pthread_mutex_unlock(&t->lock);
    return s;
}

/* Returns in *found the span in the slot, made now for n if there is none. */
static imp_code span_in(tree *t, _Atomic(span *) *slot, const node *n, span **found,
                        tree_growth *growth, imp_error *error)
{
    span filled;
    *found = atomic_load_explicit(slot, memory_order_acquire);
    if (*found != NULL) return IMP_SUCCESS;
    const imp_code code = span_fill(&filled, n, error);
    if (code != IMP_SUCCESS) return code;
    *found = span_publish(t, &filled, slot, growth);
    return *found != NULL ? IMP_SUCCESS : error_set_memory(error);
}

/* --- Nodes ------------------------------------------------------------------------------------ */

/* Makes shape and span of the tree's root. *s stays NULL if it does not move rigidly, or moves by
 * itself, or moves uniformly without turning: then the inclusion through the maps is as cheap, and
 * needs no memory beside the node. */
static imp_code begin_at_root(tree *t, shape **s, span **times, tree_growth *growth,
                              imp_error *error)
{
    shape whole = {.moves = true};
    span all = {.is_known = false};
    posing *g = &t->posing;
    const node *root = tree_root(t);
    if (atomic_load_explicit(&g->is_idle, memory_order_relaxed)) return IMP_SUCCESS;
    *s = atomic_load_explicit(&g->shape, memory_order_acquire);
    *times = atomic_load_explicit(&g->span, memory_order_acquire);
    if (*s != NULL && *times != NULL) return IMP_SUCCESS;
    const bool is_rigid = surface_is_rigid(root->surface);
    const imp_code code = is_rigid ? span_fill(&all, root, error) : IMP_SUCCESS;
    if (code != IMP_SUCCESS) return code;
    if (is_rigid && !all.is_uniform) shape_fill(&whole, root, root);
    if (all.is_uniform || whole.moves) {
        *s = NULL;
        atomic_store_explicit(&g->is_idle, true, memory_order_relaxed);
        return IMP_SUCCESS;
    }
    *times = span_publish(t, &all, &g->span, growth);
    *s = shape_publish(t, &whole, &g->shape, growth);
    return *s != NULL && *times != NULL ? IMP_SUCCESS : error_set_memory(error);
}

imp_code posing_begin(tree *t, node *n, tree_growth *growth, imp_error *error)
{
    shape *s = n->parent->shape;
    span *times = n->parent->span;
    imp_code code = IMP_SUCCESS;
    if (n->parent == tree_root(t)) code = begin_at_root(t, &s, &times, growth, error);
    if (code != IMP_SUCCESS || s == NULL || s->moves) return code;
    if (n->along == NODE_AS_TUBE)
        s = shape_in(t, &s->tube, n, growth);
    else if (n->along == PARAMETER_T)
        code = span_in(t, &times->child[n->side], n, &times, growth, error);
    else
        s = shape_in(t, &s->child[n->along][n->side], n, growth);
    if (s == NULL) return error_set_memory(error);
    if (code != IMP_SUCCESS || s->moves) return code;
    n->shape = s;
    n->span = times;
    return IMP_SUCCESS;
}

bool posing_fill(node *n)
{
    return n->shape != NULL && n->shape->is_known && n->span->is_known &&
           node_take_posed(n, &n->shape->model, &n->span->pose);
}
