/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_COLLECTION_H
#define CORE_BROAD_PHASE_COLLECTION_H

#include <stdatomic.h>

#include "core/broad_phase/broad_phase.h"
#include "core/broad_phase/candidates.h"
#include "core/broad_phase/later_pairs.h"
#include "core/broad_phase/parallel.h"
#include "core/broad_phase/strips.h"

/* Declarations shared by the files that make the list of candidates: candidates.c begins and sorts
 * it; candidates_part.c copies some of it, candidates_more.c adds to it; collect_surfaces.c,
 * collect_pairs.c and collect_roots.c fill it, each possibly with threads that work ahead. */

/* A surface whose tree is made ahead of its turn, and the memory that this added. */
typedef struct surface_ahead {
    size_t body, surface;
    tree_growth growth;
} surface_ahead;

/* Boxes whose pairs are found ahead of their turn, and the pairs. */
typedef struct sweep_ahead {
    candidate_pair *pairs;
    size_t count, capacity;
    bool complete;
} sweep_ahead;

/* A surface of a pair that has no root yet, which is made ahead of its turn. */
typedef struct root_ahead {
    tree *tree;
    tree_growth growth;
} root_ahead;

enum {
    SURFACES_A_TASK = 16,
    BOXES_A_TASK = 128,
    TASKS_A_ROUND = 64,
    SURFACES_A_ROUND = SURFACES_A_TASK * TASKS_A_ROUND
};

/* While no limit is near, limits are checked after this many surfaces, bytes and boxes. */
enum { SURFACES_PER_CHECK = 8, BYTES_PER_CHECK = 1 << 15, BOXES_PER_CHECK = 32 };

enum { BOXES_AT_HAND = 4 }; /* boxes stored in the collection itself */

/* With more surfaces, a root is made only once its surface is in a pair, although its inclusion is
 * then computed twice: most surfaces of large scenes are in no pair. With more, too, pairs that are
 * farther than the nearest two boxes are left out where only the nearest pair is sought. */
enum { ROOTS_AT_ONCE = 512 };

/* Parts of time that a query looks at to find maps that do the same, of all its pairs: 5 to 40 us
 * each. Two turns at rate 2 take some 12,000 at gamma 1e-7. */
enum { SPANS_A_QUERY = 16384 };

typedef struct collection {
    imp_scene *scene;
    const imp_options *options;
    const candidate_limit *limit;
    imp_stats *stats;
    double gamma_clear;
    bool is_nearest;      /* of the candidate_search */
    bool may_wait;        /* of the candidate_search */
    size_t common_motion; /* number of last maps of all surfaces that all trees leave out */
    double slip_most;     /* of the list; < 0: nothing that slips may replace a surface; length */
    bool in_slices;       /* of the candidate_search */
    double slip_useful;   /* of the candidate_search */
    bool may_halve;       /* half planes are used; not without slip_most */
    size_t spans;         /* of time that may still be looked at for maps to set aside */
    swept_box *boxes, at_hand[BOXES_AT_HAND];
    candidate_list *list;
    uint64_t bytes_checked; /* stats->bytes when limits were last checked */
    size_t boxes_swept;
    bool out_of_memory;
    bool tree_ended; /* by collection_watch */
    bool with_roots; /* all trees are made with roots */
    bool any_lacks_root;
    root_ahead *roots; /* the missing roots */
    size_t first_root, root_count;
    /* filled by threads that work ahead: */
    surface_ahead *surfaces; /* the first `used` of `ahead` have had their turn; NULL: no threads */
    size_t used, ahead;
    sweep_ahead *sweep; /* TASKS_A_ROUND of them; NULL: no threads */
    size_t first_box;
    int axis; /* along which the boxes are sorted */
    strips strips;
    atomic_uint_least64_t bytes_ahead;
} collection;

/* collection_must_end returns whether a limit ends the collection now; collection_may_end, whether
 * a limit is so near that threads that work ahead stop, with bytes_ahead of trees (pair_size 0) or
 * of pairs of this size. [collection_may_end: any thread] */
static inline bool collection_must_end(const collection *all)
{
    return all->limit->is_reached(all->limit->context, candidates_bytes(all->list),
                                  candidates_pairs_in_all(all->list));
}

static inline bool collection_may_end(collection *all, size_t pair_size)
{
    const uint64_t bytes = atomic_load(&all->bytes_ahead);
    return all->limit->is_near(all->limit->context, bytes, pair_size > 0 ? bytes / pair_size : 0);
}

/* Ends the making of a tree that takes long, in any thread, where collection_must_end is true. */
limit_watch collection_watch(collection *all);

static inline void collection_count(collection *all, const tree_growth *growth)
{
    all->stats->nodes += growth->nodes;
    all->stats->bytes += growth->bytes;
}

/* Makes the list's pairs of those found, `later`, where these are few; else they stay there. */
imp_code collection_sort_later(collection *all, bool *done, imp_error *error);

/* Adds all surfaces. *done false: a limit was reached first. */
imp_code collection_add_surfaces(collection *all, bool *done, imp_error *error);

/* Counts the trees that were made ahead but not used: the scene keeps them. */
void collection_count_rest(collection *all);

/* Adds all pairs. False: no memory (all->out_of_memory), or a limit was reached first. */
bool collection_add_pairs(collection *all);

/* Makes gamma_clear no larger than it needs to be where only the nearest pairs are sought. */
void collection_limit_distance(collection *all);

/* Adds a pair of surfaces for each solid body and each body whose boxes have a point in common with
 * its boxes, where no surfaces of the two come near each other: one may be inside the other. *done
 * as above. */
imp_code collection_add_solids(collection *all, bool *done, imp_error *error);

/* Counts the last maps that all surfaces have in common, as surface_common_motion does for two. */
size_t collection_common_motion(const imp_scene *scene);

/* Returns the largest slip that is small against gamma_clear and against gamma - gamma_clear; < 0:
 * nothing that slips may replace a surface. */
double collection_slip_most(const imp_options *options, const candidate_search *search);

/* Gives the surfaces of each pair trees without the motion that both have in common. *done false: a
 * limit was reached first. */
imp_code collection_use_frames(collection *all, bool *done, imp_error *error);

/* The maps and times for which a tree represents a surface. */
typedef struct surface_view {
    size_t body, surface;
    size_t left_out;  /* number of last maps left out */
    held_maps held;   /* first maps held at one moment */
    maps_aside aside; /* further maps left out */
    double moment;    /* the only time, or NAN: all of the query's times */
} surface_view;

/* Makes a tree of this view. *exists false: the surface exists at none of the query's times, and
 * *made is unchanged. */
imp_code collection_make_tree(collection *all, const surface_view *view, candidate *made,
                              bool *exists, imp_error *error);

/* Makes the missing roots of surfaces in pairs. *done false: a limit was reached first. */
imp_code collection_make_roots(collection *all, bool *done, imp_error *error);

#endif
