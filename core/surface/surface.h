/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SURFACE_H
#define CORE_SURFACE_SURFACE_H

#include "core/surface/instance.h"

/* A surface under its maps, composed once
 * =======================================
 * g = phi_K( ... phi_1(f(u,v,t), t) ..., t). The rest of core sees only this: a
 * domain, points, rates, inclusions. Immutable once built, so safe from many threads. */

typedef struct surface surface;

/* A surface of one instance, which it holds. NULL: no memory. */
surface *surface_new_of(shared_instance *type);

/* Puts a map on top of those already there, and holds it. */
imp_code surface_add_instance(surface *s, shared_instance *map);

/* The surface under its first `maps` maps alone, divided into pieces where `s` is. It has the times
 * of `s`, which must outlive it. NULL: no memory. */
surface *surface_new_inner(const surface *s, size_t maps);

void surface_free(surface *s);

/* Where its type's instance consists of pieces: makes a surface of each, under the same maps. No
 * map may be added after that. What is asked of the whole is then answered for its first piece. */
imp_code surface_divide(surface *s);

/* 0: it is one surface. */
size_t surface_piece_count(const surface *s);
const surface *surface_piece(const surface *s, size_t k); /* k < surface_piece_count */

/* Its number among the pieces of a surface; 0 for what is none. */
size_t surface_piece_index(const surface *s);

/* What it holds, about: its pieces, and its share of what it has in common with other surfaces. */
size_t surface_bytes(const surface *s);

/* Tells messages whose it is; the text must outlive the surface. */
void surface_set_body(surface *s, const char *body, size_t index);

/* Sets IMP_ERROR_PLUGIN and answers it: "body 'b', surface 0: type 'sphere radius=2' <format>". */
imp_code surface_fault(const surface *s, imp_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Domain; time is what the type and all maps have in common: lo[2] > hi[2] if nothing. */
void surface_domain(const surface *s, double lo[3], double hi[3]);

/* The type or one of the maps: the times it is defined for, and those it is made for. */
typedef struct surface_instance {
    const char *name;
    double lo, hi;
    double span[2]; /* -INFINITY, INFINITY: none before others */
    bool absent;    /* at other times it does not exist (IMP_FLAG_ABSENT_OUTSIDE_TIMES) */
} surface_instance;

/* Instance 0 is the type, instance k the map k - 1; false past the last. */
bool surface_instance_at(const surface *s, size_t k, surface_instance *found);

/* The times at which the surface exists: all that no instance excludes
 * (IMP_FLAG_ABSENT_OUTSIDE_TIMES). lo > hi: none. */
void surface_existence(const surface *s, double *lo, double *hi);

/* The first instance that leaves open what happens at some time from lo to hi; false: there is
 * none. */
bool surface_undefined_instance(const surface *s, double lo, double hi, surface_instance *found);

/* Beside the statuses of the ABI. A callback left another floating-point mode behind; it is put
 * back. Or the process of an isolated instance ended, or was ended because it did not answer. Or
 * what a callback gave breaks the ABI. */
#define SURFACE_CHANGED_MODE 1000
#define SURFACE_CRASHED 1001
#define SURFACE_HUNG 1002
#define SURFACE_BAD_DOMAIN 1003
#define SURFACE_BAD_RATES 1004
#define SURFACE_BAD_MODEL 1005
#define SURFACE_KILLED 1006     /* the process of an isolated instance was killed from outside */
#define SURFACE_LOST 1007       /* ... was ended because of another instance */
#define SURFACE_FORKED 1008     /* ... belongs to another process than this one */
#define SURFACE_NO_PROCESS 1009 /* ... could not be made */
#define SURFACE_BAD_NET 1010
#define SURFACE_PIECE_COUNT 1011
#define SURFACE_NULL_PIECE 1012
#define SURFACE_PIECE_TIMES 1013
#define SURFACE_BAD_POSE 1014
#define SURFACE_BAD_DISTANCE 1015
#define SURFACE_BAD_SYMMETRY 1016
#define SURFACE_BAD_SPAN 1017

/* What a status other than IMP_STATUS_OK means here, as the end of "type 'x' ...: ". */
const char *surface_status_text(imp_status status);

/* The text for what a callback of this thread answered last. Where surface_status_text leaves open
 * which callback it was, the text ends with its name: "... (rate of 'twist')". Ask before any other
 * callback is called. */
typedef struct surface_told {
    char text[400];
} surface_told;
surface_told surface_status_of_last(imp_status status);

/* The text for a status that a surface answered, maps included, since its label names them all. */
surface_told surface_status_told(const surface *s, imp_status status);

/* Replaces the code of an error by that of the status that caused it, and answers it:
 * IMP_ERROR_USAGE for SURFACE_FORKED, IMP_ERROR_MEMORY for SURFACE_NO_PROCESS, else
 * IMP_ERROR_PLUGIN. */
imp_code surface_set_code(imp_status status, imp_error *error);

/* Evaluates n points, maps applied, with the contract of imp_surface_type.eval. error may be
 * NULL. */
imp_status surface_eval(const surface *s, size_t n, const double *p, double *x, double *error);

/* Rate matrix of the composition (paper, section 5). */
imp_status surface_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates);

/* The inclusion function of the composition, Taylor models of order 2; boxes from eval and rate
 * where an instance has no better. */
imp_status surface_include(const surface *s, const imp_region *region, imp_model model[3]);

/* The control net of the composition over a region (imp_net). IMP_STATUS_UNBOUNDED: it has none
 * there, as where the type or a map has none. */
imp_status surface_net(const surface *s, const imp_region *region, imp_net *net);

/* Whether the type and all maps can be asked for one; else it has none anywhere. */
bool surface_offers_net(const surface *s);

/* Whether all of its maps, of which there is one at least, are rigid, so that it may have a
 * pose. */
bool surface_is_rigid(const surface *s);

/* The pose that all maps together have over the region's times (imp_pose), but that turn and turn^T
 * turn are off those of a rotation by as much for each map as is allowed for one.
 * IMP_STATUS_UNBOUNDED: there is none. Precondition: surface_is_rigid. */
imp_status surface_pose(const surface *s, const imp_region *region, imp_pose *pose);

/* What imp_piece_motion answers. Times are in the surface's domain. */
bool surface_motion(const surface *s, double from, double to, imp_rigid_motion *motion);

/* At least |x'| / |x| for what such a pose makes of a vector x; 1 but for that slack. */
double surface_pose_norm_upper(const surface *s);

/* Whether distances from the surface may be known: its type knows them, and all of its maps are
 * rigid. */
bool surface_has_distance(const surface *s);

/* Whether it may be possible, too, to move it within itself. */
bool surface_has_symmetry(const surface *s);

/* Precondition: surface_has_distance. The distance, as in imp_surface_type, of a point with these
 * models over the region, whose rates are not used, from the whole surface under its first `maps`
 * maps; or less, where the maps after these bring both nearer to each other. IMP_STATUS_UNBOUNDED:
 * nothing is known, as at times at which the surface does not exist. */
imp_status surface_distance(const surface *s, const imp_region *region, size_t maps,
                            const imp_model point[3], imp_model *distance);

/* Like surface_distance, for points within `slip` of these models, which are of one moment and do
 * not depend on time; the moment is as in surface_slip. */
imp_status surface_distance_within(const surface *s, const imp_region *region, size_t maps,
                                   const imp_model point[3], double moment, double slip,
                                   imp_model *distance);

/* How far a slides along b, other than within itself. *slip: where b is moved by its first maps
 * alone, but for those that both end with, what its type claims of the distance
 * (surface_distance_within) of all points within *slip of where a point of a is at the moment holds
 * for that point of a at all times of the region, too. INFINITY: nothing is known. The moment is
 * one of these times; `bare` are models of a before its maps, of which the ranges are used; it does
 * not move by itself. */
imp_status surface_slip(const surface *a, const surface *b, const imp_model bare[3],
                        const imp_region *times, double moment, double *slip);

/* A plane, and how far at most points of a part of a surface are from it, before its maps. */
typedef struct surface_plane {
    double center[3]; /* length */
    double axis[3];   /* unit, but for rounding; 0: the part has no plane */
    double off;       /* length */
} surface_plane;

/* The plane along which the surface lies in the middle of the region. */
imp_status surface_plane_of(const surface *s, const imp_region *region, surface_plane *plane);

/* How far a slides along a plane that b's maps carry, other than in the plane: as surface_slip,
 * whose symmetry is that of the plane. The two have no maps in common. */
imp_status surface_slip_along(const surface *a, const surface *b, const surface_plane *plane,
                              const imp_model bare[3], const imp_region *times, double moment,
                              double *slip);

/* Like surface_distance_within under all maps of s, for the distance from the part of s that lies
 * along the plane. */
imp_status surface_height_within(const surface *s, const surface_plane *plane,
                                 const imp_region *region, const imp_model point[3], double moment,
                                 double slip, imp_model *height);

/* How much the distance of two surfaces may differ at other times from what it is at the moment,
 * which is one of the times; INFINITY: nothing is known. It is mere rounding where both turn only
 * within themselves, or as one of them can be turned within itself: rollers, a shaft in its bore.
 * `bare` holds models of all points of each before its maps, of which the ranges are used; neither
 * moves by itself. *asked: whose symmetry was asked for last. */
imp_status surface_pair_slip(const surface *const s[2], const imp_model bare[2][3],
                             const imp_region *times, double moment, double *slip, int *asked);

/* How many maps, counted from the last, are the same instances on both. */
size_t surface_common_maps(const surface *a, const surface *b);

/* How many of these, counted from the last, are rigid in exact arithmetic (IMP_FLAG_TURNS_EXACTLY):
 * the distance of two points is the same before and after them. */
size_t surface_common_motion(const surface *a, const surface *b);

/* What the maps after the first `maps` make of a point at time t, in place. */
imp_status surface_move_outward(const surface *s, size_t maps, double t, double x[3]);

size_t surface_map_count(const surface *s);

/* What the surface is composed of: its type's instance (0), then its maps'. k <=
 * surface_map_count. */
const shared_instance *surface_origin(const surface *s, size_t k);

/* Precondition: surface_has_distance. How many of its maps, counted from the first, do not turn it
 * further during the region's times. */
imp_status surface_still_maps(const surface *s, const imp_region *region, size_t *count);

/* The inclusion under the first `maps` maps alone. */
imp_status surface_include_inner(const surface *s, const imp_region *region, size_t maps,
                                 imp_model model[3]);

/* The inclusion of the type alone, under none of the maps. */
imp_status surface_include_bare(const surface *s, const imp_region *region, imp_model model[3]);

/* What the maps make of anything whose coordinates have the models `model` over the region,
 * replaced by those of its image. Where u or v number the points of a set, a rate is how far apart
 * they may be: 1 counts as the distance of any two. */
imp_status surface_include_image(const surface *s, const imp_region *region, imp_model model[3]);

#endif
