/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SURFACE_INTERNAL_H
#define CORE_SURFACE_SURFACE_INTERNAL_H

#include <pthread.h>
#include <stdatomic.h>

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"
#include "core/surface/surface.h"

/* The structure of a surface
 * ==========================
 * Shared by surface.c (composition, names), surface_rate.c (points and rates), surface_include.c
 * (inclusions), surface_net.c, surface_pose.c and surface_distance.c. Every result of a callback is
 * checked before anything is computed with it: after a product or a sum a breach might not show. */

typedef struct mapping {
    const imp_map_type *type;
    void *self;
    shared_instance *origin; /* held */
} mapping;

typedef struct piece_table piece_table;

struct surface {
    arena_store *store; /* of its memory; NULL: the heap */
    const imp_surface_type *type;
    const void *self;
    shared_instance *origin; /* held */
    size_t map_count, map_capacity;
    mapping *maps;
    double lo[3], hi[3]; /* the domain */
    const char *body;    /* name of the body it belongs to, or NULL */
    size_t index;        /* its number in the body */
    piece_table *pieces; /* piece_count of them, which share origin and maps; or NULL */
    size_t piece_count;
    const surface *whole; /* the surface that it is a piece of, or NULL */
    const surface *outer; /* its type and first maps belong to this surface, or NULL */
    double held_slip;     /* of a surface whose first maps are held: added to errors of points */
};

/* Surfaces of the pieces of one surface, each made when it is first asked for: a scene of a large
 * mesh asks for few, and the others' memory is not touched. */
struct piece_table {
    pthread_mutex_t lock;   /* guards the making */
    _Atomic(bool) *is_made; /* for each piece; behind the last */
    surface at[];
};

/* 0 for a finite x, else NaN: a sum of these is 0 only if all are finite, and costs no branches. */
static inline double zero_if_finite(double x) { return x - x; }

/* Every callback is called between these two. If it changed the floating-point mode, the mode is
 * restored at once and its result is discarded: an exception that it unmasked would otherwise trap
 * in the next callback, or in the host. */
typedef struct surface_call {
    imp_call *of_thread;
    fp_mode before;
} surface_call;

static inline surface_call surface_call_begin(const char *type, const char *callback)
{
    return (surface_call){active_callback_begin(type, callback), fp_mode_read()};
}

static inline imp_status surface_call_end(surface_call call, imp_status status)
{
    const bool kept = fp_mode_kept(call.before);
    active_callback_end(call.of_thread);
    return kept ? status : SURFACE_CHANGED_MODE;
}

/* Compute rates by a callback, and check them. */
imp_status surface_type_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates);
imp_status surface_map_rate(const mapping *map, const imp_box4 *box, imp_map_rates *rates);

/* Returns the model of t over the region: c + d s, exact except for d, which region_make rounded
 * up. */
imp_model surface_time(const imp_region *region);

/* A box around a point f(c), whose half-widths are `reach`. */
typedef struct centred_box {
    double centre[3], reach[3];
} centred_box;

/* Computes a box around the surface under its first `maps` maps over the region: f(c) with its
 * error, plus and minus M d, where M bounds the rates there. */
imp_status surface_box_around(const surface *s, const imp_region *region,
                              const imp_rate_matrix *rates, size_t maps, centred_box *box);

/* Makes the box of [lo, hi] in space and the region's times. False: it is not finite. */
bool surface_box4_from(const double lo[3], const double hi[3], const imp_region *region,
                       imp_box4 *box);

/* Whether the map's pose encloses an exact rotation. */
static inline bool map_turns_exactly(const mapping *map)
{
    return (map->type->flags & IMP_FLAG_TURNS_EXACTLY) != 0;
}

/* Whether the pose's rotation depends on time. */
bool pose_turns(const imp_pose *pose);

/* Gives a surface that was made of some maps of s the domain, the pieces and the place of s, and
 * its points' slip. `ok`: its maps are there. NULL: no memory, and what was made is freed. */
surface *surface_finish(surface *made, bool ok, const surface *s, double slip);

/* Whether it is exactly 1 at all times of the pose. */
bool pose_turn_is_identity(const imp_pose *pose);

/* Returns an upper bound of |(R^T R - 1) x| / |x| for the turn R of one map, at all times of the
 * pose. */
double surface_pose_deviation_upper(const imp_pose *pose);

/* Like surface_pose, for the maps from `first` to the one before `end`. Preconditions: first < end
 * <= map_count; all of them are rigid. */
imp_status surface_pose_of_maps(const surface *s, size_t first, size_t end,
                                const imp_region *region, imp_pose *pose);

/* Makes one step of the chain rule (paper, section 5): M_g[:,j] = P M_f[:,j], + p_t for j = t.
 * IMP_STATUS_UNBOUNDED: a product of finite rates is too large for a double. */
imp_status surface_chain_rule(const imp_map_rates *p, const imp_rate_matrix *in,
                              imp_rate_matrix *out);

#endif
