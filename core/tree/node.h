/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NODE_H
#define CORE_TREE_NODE_H

#include <stdatomic.h>

#include "core/base/arena_store.h"
#include "core/base/limit_watch.h"
#include "core/surface/region.h"
#include "core/surface/surface.h"
#include "core/tree/hierarchy.h"
#include "core/tree/net.h"
#include "core/tree/vec.h"

/* Nodes: regions of one surface with Taylor models
 * ================================================
 * The nodes of a surface form a k-d tree that is made lazily: the halves of a node along a
 * parameter are made on first use, and then serve every pair and every later query. Where the
 * surface consists of pieces, the nodes above them are clusters of pieces (hierarchy.h): u of such
 * a node runs over the pieces, from -1 to 1, and halving it along u gives its two halves. A node
 * may be halved along any of its parameters.
 *
 * Trees may be used from several threads at once. The first caller that needs a node fills it; it
 * is published once and never changes. Two threads that need it at the same moment fill one each:
 * as both are the same to the last bit, the first that is published serves both, the other is
 * dropped. A node's net is made later, at the first call of node_net, and published in the same
 * way; a node that follows its net is filled with it. */

/* What a node's inclusion is made from. */
typedef enum tree_kind {
    TREE_MODELS,         /* order-2 inclusions (boxes from rates where a type or map has none) */
    TREE_RATES_FULL,     /* the rate matrix: half-widths M d (paper, eqs. 12, 19-22) */
    TREE_RATES_COLUMN,   /* one bound a parameter: L_j = norm of M's column j (paper, eq. 11) */
    TREE_RATES_CONSTANT, /* one Lipschitz constant: L = Frobenius norm of M (paper, eq. 4) */
    TREE_KINDS
} tree_kind;

/* What models of a node are made from. */
typedef enum node_source {
    FOLLOWS_SURFACE,
    FOLLOWS_NET, /* its net, if that is bicubic (net_series.h) */
    FOLLOWS_LINE /* the line in its middle, where it has all v (tree_internal.h) */
} node_source;

/* Coefficients of the three coordinates' polynomials in s = (p - c) / d. Vector instructions take
 * x, y, z at once (triple.h). */
typedef struct quadratic3 {
    double a[3], bu[3], bv[3], bt[3];
    double quu[3], quv[3], qut[3], qvv[3], qvt[3], qtt[3];
} quadratic3;

/* Marks a node that is known to have no net. Its fields are never read. */
extern const net net_none;

typedef struct node {
    imp_region region;
    quadratic3 f;               /* with e, encloses the surface over the region; length */
    double e[3];                /* remainder; length */
    double lo[3], hi[3];        /* axis-aligned box; length, world space */
    double radius;              /* of a ball around a that holds the surface; rate trees only */
    double extent[3];           /* how much u, v, t move a point across the region, about; length */
    double nonlinear_extent[3]; /* the nonlinear part of that; length */
    double time_remainder;      /* time's share in e where its rate is known, about; length */
    bool bounded;               /* f, e, lo, hi are all finite */
    bool is_bare;               /* only the region and `bounded`, which is true, are set above */
    unsigned char follows;      /* node_source: what its models are made from, where they can be */
    unsigned char along, side;  /* which half of the parent it is: a parameter, 0 or 1 */
    const surface *surface;     /* whose points are bounded: a piece, or the whole */
    const cluster *many;        /* the pieces it bounds; NULL: no cluster */
    struct node *parent;        /* NULL: it is the root */
    struct node *sibling;       /* another half of the parent, or NULL */
    _Atomic(const net *) net;   /* NULL: not made yet; &net_none: it has none */
    struct shape *shape;        /* the shape that is moved rigidly, and */
    struct span *span;          /* its poses (posing.h); NULL: not known */
    const struct shape_model *still; /* model of the shape; the node is its image under */
    const struct pose_lanes *pose;   /* the pose (posed_terms.h); NULL: use e, always valid */
    double posed_e[3];               /* the rest of e beside posed terms and the ball; of a tube
                                        without a pose, beside the ball; length */
    /* > 0: f follows a line, and all points are within its remainder and a ball of this radius,
     * which e, lo and hi include; length */
    double ball;
    _Atomic(struct node *) halves; /* the last one made; NULL: there is none */
} node;

typedef struct tree tree;

/* Called with each node made, before it is used; IMP_ERROR_PLUGIN refuses it. */
typedef imp_code (*node_audit)(const surface *s, const node *n, imp_error *error);

/* The choices in which trees of one surface differ. */
typedef struct tree_plan {
    tree_kind kind;
    double t_start, t_end; /* within the surface's domain */
    node_audit audit;      /* may be NULL */
    size_t left_out;       /* number of the surface's last maps that are not applied */
    held_maps held;        /* its first maps that are held at one moment */
    maps_aside aside;      /* further maps that are not applied; none if some are held */
    arena_store *store;    /* of blocks for its nodes; NULL: the heap; no difference otherwise */
} tree_plan;

/* Counts of what calls have made; `watch`, which any thread may ask, ends those that take long. */
typedef struct tree_growth {
    uint64_t nodes;
    size_t bytes;
    limit_watch watch;
    bool ended; /* the call fails because of `watch` */
} tree_growth;

/* Makes a tree over the surface's whole (u, v) and [t_start, t_end], with its root. `s` must
 * outlive it. */
imp_code tree_new(const surface *s, const tree_plan *plan, tree **made, tree_growth *growth,
                  imp_error *error);

/* Makes a tree that keeps only its root's box until tree_make_root: most surfaces of a large scene
 * come near no other. */
imp_code tree_new_without_root(const surface *s, const tree_plan *plan, tree **made,
                               tree_growth *growth, imp_error *error);
bool tree_has_root(const tree *t);
/* Makes the root, unless the tree has one. */
imp_code tree_make_root(tree *t, tree_growth *growth, imp_error *error);

/* Makes another tree of t's surface and plan, whose root is a copy that is not counted: for
 * searches whose counts must not depend on other threads. */
imp_code tree_new_from_root(const tree *t, tree **made, tree_growth *growth, imp_error *error);

/* Makes another tree of t's surface at one moment of its times, with its root. */
imp_code tree_new_at(const tree *t, double moment, tree **made, tree_growth *growth,
                     imp_error *error);

/* Computes a box of all points of t's surface at its times from `from` to `to`, and keeps nothing.
 * *exists false: it has none of these times. Precondition: t has its root or the root's box. Any
 * thread. */
imp_code tree_box_within(const tree *t, double from, double to, bool *exists, double lo[3],
                         double hi[3], imp_error *error);

size_t tree_own_bytes(const tree *t); /* with its nodes, without its hierarchy of pieces */
void tree_free(tree *t);

/* Trees form lists: returns the tree after t, or NULL. */
tree *tree_next(const tree *t);
void tree_set_next(tree *t, tree *next);

node *tree_root(const tree *t);                           /* precondition: it has one */
void tree_box(const tree *t, double lo[3], double hi[3]); /* the root's */
const surface *tree_surface(const tree *t);
bool tree_is_of(const tree *t, const tree_plan *plan);
bool tree_is_audited(const tree *t);
arena_store *tree_store(const tree *t); /* of the plan */

/* Returns in *child the half of `parent` below (side 0) or above (1) its centre along j, made now
 * if it does not exist. What this call makes is added to *growth. IMP_ERROR_PLUGIN names the type,
 * the region and what is wrong. Precondition: region_can_split. */
imp_code node_child(tree *t, node *parent, parameter j, int side, node **child, tree_growth *growth,
                    imp_error *error);

/* `along` of a tube that is no half of its parent, but all of it. */
#define NODE_AS_TUBE ((parameter)3)

/* Returns in *tube a node of all that the root holds, made now if it does not exist, that follows
 * the line in the middle of its surface (imp_surface_type.tube) with a ball around that: it is
 * bounded as a line, whatever v. Its halves along u and t are tubes, too, those along v are not.
 * Where there is no line over the region, it is like any other node, and has no ball. Errors are
 * those of node_child. Preconditions: `root` is one, of no cluster; surface_offers_tube. */
imp_code node_tube(tree *t, node *root, node **tube, tree_growth *growth, imp_error *error);

/* Like node_child along u or v, for a node whose halves only are needed: unless the node exists
 * already it is made bare, without models, and is not counted. Precondition: `parent` is no
 * cluster. */
imp_code node_child_bare(tree *t, node *parent, parameter j, int side, node **child,
                         tree_growth *growth, imp_error *error);

/* Returns in *found the control net of the node, made by the first call; NULL: it has none. What
 * this call makes is added to *growth. Errors are those of node_child. */
imp_code node_net(tree *t, node *n, const net **found, tree_growth *growth, imp_error *error);

/* Whether node_net was called for the node. */
static inline bool node_net_is_asked(const node *n)
{
    return atomic_load_explicit(&n->net, memory_order_acquire) != NULL;
}

/* Returns the control net if node_net has made it, else NULL. */
static inline const net *node_net_made(const node *n)
{
    const net *made = atomic_load_explicit(&n->net, memory_order_acquire);
    return made != &net_none ? made : NULL;
}

/* Returns bu x bv, of any length; 0 where the node has no normal. */
static inline vec3 node_normal(const node *n)
{
    return n->bounded ? vec3_cross(vec3_from(n->f.bu), vec3_from(n->f.bv)) : (vec3){{0, 0, 0}};
}

static inline bool node_has_normal(const node *n) { return vec3_norm1(node_normal(n)) > 0; }

/* Whether its quadratic bends along u or v. */
static inline bool node_bends(const node *n)
{
    bool bends = false;
    for (int i = 0; i < 3; ++i) bends = bends || n->f.quu[i] != 0 || n->f.qvv[i] != 0;
    return bends;
}

/* Its remainder along a coordinate, without the ball. */
static inline double node_blur(const node *n, int i) { return n->e[i] - n->ball; }

static inline double node_blurs_sum(const node *n)
{
    return node_blur(n, 0) + node_blur(n, 1) + node_blur(n, 2);
}

/* Whether its remainder is more than this part of the distance that u and v move a point. */
static inline bool node_blurs(const node *n, double part)
{
    const double least = part * (n->extent[PARAMETER_U] + n->extent[PARAMETER_V]);
    const double most = least + n->ball;
    return least > 0 && (n->e[0] > most || n->e[1] > most || n->e[2] > most);
}

/* Returns models of all points of the node before any map. False: it moves by itself, or has no
 * bounds. */
bool node_bare_models(const node *n, imp_model bare[3]);

/* Sets the error for a node without bounds that cannot be halved: IMP_ERROR_PLUGIN names the type,
 * and the place where it is undefined or the region over which it has no bounds. */
imp_code node_unbounded_fault(const tree *t, const node *n, imp_error *error);

#endif
