/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SURFACE_H
#define CORE_SURFACE_SURFACE_H

#include "core/base/arena_store.h"
#include "core/surface/instance.h"

/* A surface under its maps, composed once
 * =======================================
 * g = phi_K( ... phi_1(f(u,v,t), t) ..., t). The rest of core sees only this: a
 * domain, points, rates, inclusions. Immutable once built, so safe from many threads. */

typedef struct surface surface;

/* Makes a surface of one instance, which it holds. NULL: no memory. */
surface *surface_new_of(shared_instance *type);

/* Likewise, in memory of a store, which must outlive it. */
surface *surface_new_in(arena_store *store, shared_instance *type);

/* Puts a map on top of those already there, and holds it. */
imp_code surface_add_instance(surface *s, shared_instance *map);

/* Makes the surface under its first `maps` maps alone, divided into pieces if `s` is. It has the
 * times of `s`, which must outlive it. NULL: no memory. */
surface *surface_new_inner(const surface *s, size_t maps);

void surface_free(surface *s);

/* Makes room for a surface of each piece, under the same maps, if the type's instance consists of
 * pieces; surface_piece makes them. No map may be added after that. Functions of the whole then
 * apply to the first piece. */
imp_code surface_divide(surface *s);

/* Returns the number of pieces; 0: it is one surface. */
size_t surface_piece_count(const surface *s);
const surface *surface_piece(const surface *s, size_t k); /* k < surface_piece_count; any thread */

/* The pieces of a surface, or itself if it is one surface: their number, and number k. */
static inline size_t surface_part_count(const surface *s)
{
    return surface_piece_count(s) > 0 ? surface_piece_count(s) : 1;
}

static inline const surface *surface_part(const surface *s, size_t k)
{
    return surface_piece_count(s) > 0 ? surface_piece(s, k) : s;
}

/* Whether the region has all u and v of the surface, which is none of many pieces. */
bool surface_is_whole(const surface *s, const imp_region *region);

/* Returns the piece's number among the pieces of its surface; 0 if s is no piece. */
size_t surface_piece_index(const surface *s);

/* Estimates the bytes it holds, its pieces included. Its instances are not counted: other surfaces,
 * and other scenes, may share them (instance_bytes). */
size_t surface_bytes(const surface *s);

/* Sets the body and number that error messages name; the text must outlive the surface. */
void surface_set_body(surface *s, const char *body, size_t index);

/* Sets and returns IMP_ERROR_PLUGIN: "body 'b', surface 0: type 'sphere radius=2' <format>". */
imp_code surface_fault(const surface *s, imp_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Returns the domain. Its times are those at which the type and all maps are defined: lo[2] > hi[2]
 * if there are none. */
void surface_domain(const surface *s, double lo[3], double hi[3]);

/* The type or one of the maps: the times it is defined for, and those it is made for. */
typedef struct surface_instance {
    const char *name;
    double lo, hi;
    double span[2];   /* -INFINITY, INFINITY: not stated */
    bool absent;      /* at other times it does not exist (IMP_FLAG_ABSENT_OUTSIDE_TIMES) */
    bool has_order_2; /* include of a type; apply or rigid of a map */
} surface_instance;

/* Instance 0 is the type, instance k the map k - 1; false past the last. */
bool surface_instance_at(const surface *s, size_t k, surface_instance *found);

/* Returns the times at which the surface exists: those that no instance excludes
 * (IMP_FLAG_ABSENT_OUTSIDE_TIMES). lo > hi: there are none. */
void surface_existence(const surface *s, double *lo, double *hi);

/* Finds the first instance that is not known to be defined at all times from lo to hi. False: there
 * is none. */
bool surface_undefined_instance(const surface *s, double lo, double hi, surface_instance *found);

/* Statuses in addition to those of the ABI: a callback changed the floating-point mode, which was
 * restored; the process of an isolated instance ended, or was ended because it did not respond; a
 * callback's result breaks the ABI. */
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
#define SURFACE_NO_MEMORY 1020  /* for a text of the host's own */
#define SURFACE_BAD_NET 1010
#define SURFACE_PIECE_COUNT 1011
#define SURFACE_NULL_PIECE 1012
#define SURFACE_PIECE_TIMES 1013
#define SURFACE_BAD_POSE 1014
#define SURFACE_BAD_DISTANCE 1015
#define SURFACE_BAD_SYMMETRY 1016
#define SURFACE_NOT_CLOSED 1021
#define SURFACE_BAD_SPAN 1017
#define SURFACE_BAD_FORMULA 1018
#define SURFACE_BAD_TUBE 1022
#define SURFACE_LATE 1019 /* an isolated instance had not answered when the time of all was over */

/* Returns the text for a status other than IMP_STATUS_OK, to follow "type 'x' ...: ". */
const char *surface_status_text(imp_status status);

/* The text for the status that a callback of this thread returned last. If surface_status_text does
 * not say which callback it was, the text ends with its name: "... (rate of 'twist')". Get it
 * before any other callback is called. */
typedef struct surface_message {
    char text[400];
} surface_message;
surface_message surface_status_of_last(imp_status status);

/* Returns the text for a status that a function of this surface returned. */
surface_message surface_status_message(const surface *s, imp_status status);

/* Replaces the code of an error by that of the status that caused it, and returns it:
 * IMP_ERROR_USAGE for SURFACE_FORKED, IMP_ERROR_MEMORY for SURFACE_NO_PROCESS and
 * SURFACE_NO_MEMORY, else IMP_ERROR_PLUGIN. */
imp_code surface_set_code(imp_status status, imp_error *error);

/* Evaluates n points, maps applied, with the contract of imp_surface_type.eval. error may be
 * NULL. */
imp_status surface_eval(const surface *s, size_t n, const double *p, double *x, double *error);

/* Computes the rate matrix of the composition (paper, section 5). */
imp_status surface_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates);

/* Computes the inclusion of the composition, Taylor models of order 2; boxes from eval and rate
 * where an instance has no include or apply. */
imp_status surface_include(const surface *s, const imp_region *region, imp_model model[3]);

/* Computes the control net of the composition over a region (imp_net). IMP_STATUS_UNBOUNDED: there
 * is none, for instance because the type or a map has none. */
imp_status surface_net(const surface *s, const imp_region *region, imp_net *net);

/* Whether the type and all maps offer nets. If not, there is no net over any region. */
bool surface_offers_net(const surface *s);

/* Whether it has maps and all of them are rigid, so that it may have a pose. */
bool surface_is_rigid(const surface *s);

/* Computes the pose of all maps together over the region's times (imp_pose). Its turn differs from
 * a rotation by up to IMP_RIGID_SLACK for each map. IMP_STATUS_UNBOUNDED: there is none.
 * Precondition: surface_is_rigid. */
imp_status surface_pose(const surface *s, const imp_region *region, imp_pose *pose);

/* Implements imp_piece_motion. Times are in the surface's domain. */
bool surface_motion(const surface *s, double from, double to, imp_rigid_motion *motion);

/* Returns an upper bound of the factor by which surface_pose lengthens vectors: 1 plus slack. */
double surface_pose_norm_upper(const surface *s);

/* Whether surface_distance can be called: the type offers distances, and all maps are rigid. */
bool surface_has_distance(const surface *s);

/* Whether surface_has_distance, and the type offers a symmetry. */
bool surface_has_symmetry(const surface *s);

/* *has: one point of it may stand for others (surface_orbit_slip). A status other than OK is a
 * fault of its symmetry. */
imp_status surface_has_orbits(const surface *s, bool *has);

/* Bounds the distance, as in imp_surface_type, of a point with these models over the region from
 * the whole surface under its first `maps` maps. The models' rates are not used. The bound also
 * holds under all maps, which may bring both nearer to each other. IMP_STATUS_UNBOUNDED: there is
 * no bound, for instance at times at which the surface does not exist. Precondition:
 * surface_has_distance. */
imp_status surface_distance(const surface *s, const imp_region *region, size_t maps,
                            const imp_model point[3], imp_model *distance);

/* Like surface_distance, for points within `slip` of these models, which are of one moment and do
 * not depend on time (surface_slip), or have b's motion undone (surface_carry_way). */
imp_status surface_distance_within(const surface *s, const imp_region *region, size_t maps,
                                   const imp_model point[3], double moment, double slip,
                                   imp_model *distance);

/* Bounds the motion of a relative to b, modulo b's symmetry, where b is under its own maps without
 * those that both surfaces end with. A distance that b's type claims for all points within *slip of
 * a point of a at `moment` (surface_distance_within) then holds for that point of a at all times of
 * the region. INFINITY: no bound. `moment` is one of these times. `bare` holds models of a before
 * its maps, of which only the ranges are used; a does not move by itself. Where b's symmetry is a
 * screw, refinement, which costs much, ends at `enough`, and no greater slip is known: none at all
 * if that is 0. */
imp_status surface_slip(const surface *a, const surface *b, const imp_model bare[3],
                        const imp_region *times, double moment, double enough, double *slip);

/* Where motion is counted from: from where all maps take the surface at a moment, or from where it
 * is before them. */
typedef struct carry_base {
    double moment;
    bool is_bare;
} carry_base;

/* Bounds how far b's axis is turned from where it is at the base, at points of the box: b then
 * moves as its center does, and what its type claims of all points within *slip of x -
 * surface_carry_way, taken back by the maps of the base (surface_distance_within, of no maps if it
 * is bare), holds for x. INFINITY: nothing is known. The moment is one of the times. */
imp_status surface_carry_slip(const surface *b, const double lo[3], const double hi[3],
                              const imp_region *times, const carry_base *base, double *slip);

/* Does that from where b is before its maps, if the slip is then at most `mere` (*is_bare), else
 * from where it is at the moment. */
imp_status surface_carry_slip_least(const surface *b, const double lo[3], const double hi[3],
                                    const imp_region *times, double moment, double mere,
                                    bool *is_bare, double *slip);

/* Whether surface_slip may find a bound for points of a. */
bool surface_may_slip(const surface *a);

/* Computes how the center of b's symmetry moves from where it is at the base: models of t over the
 * region. Precondition: surface_carry_slip knows b. */
imp_status surface_carry_way(const surface *b, const imp_region *region, const carry_base *base,
                             imp_model way[3]);

/* Tells which of a's parameters need not vary: bit 0 of *held for u, bit 1 for v. What b's type
 * claims, at any of the times, of all points within *slip of a's point at some u (or v) then holds
 * for its points at all others. The box holds the points of a at these times; a and b have no maps
 * in common. INFINITY: nothing is known. */
imp_status surface_orbit_slip(const surface *a, const surface *b, const double lo[3],
                              const double hi[3], const imp_region *times, unsigned *held,
                              double *slip);

/* Computes models, over the region's times, of the center of a ball that holds all points of s at
 * these times. *radius INFINITY: s is not known to be part of a ball. */
imp_status surface_ball(const surface *s, const imp_region *region, imp_model center[3],
                        double *radius);

/* Like surface_ball, before the maps, whatever these are. */
imp_status surface_bare_ball(const surface *s, const imp_region *region, double center[3],
                             double *radius);

/* Like surface_slip, of the center of the ball. Precondition: surface_ball knows a. */
imp_status surface_ball_slip(const surface *a, const surface *b, const imp_region *times,
                             double moment, double enough, double *slip);

/* The first `count` maps of a surface that are held at one moment (held.h). Its points are then
 * within `slip`, a power of two or 0, of what they stand for; length. */
typedef struct held_maps {
    size_t count;
    double slip;
} held_maps;

static inline bool held_maps_are_equal(held_maps x, held_maps y)
{
    return x.count == y.count && x.slip == y.slip;
}

/* Maps of a surface that are left out although maps after them are not (aside.h): bit k for map k.
 * Distances from the surface that was asked about then differ by at most the slip; length. */
typedef struct maps_aside {
    uint32_t which;
    double slip;
} maps_aside;

static inline bool maps_aside_has(maps_aside x, size_t map)
{
    return map < 32 && (x.which >> map & 1u) != 0;
}

static inline bool maps_aside_are_equal(maps_aside x, maps_aside y)
{
    return x.which == y.which && x.slip == y.slip;
}

/* A plane, and an upper bound of the distance from it of the points of a part of a surface, before
 * its maps. */
typedef struct surface_plane {
    double center[3]; /* length */
    double axis[3];   /* unit, up to rounding; 0: the part has no plane */
    double off;       /* length */
} surface_plane;

/* Finds the tangent plane in the middle of the region, and how far the part of the surface over the
 * region is from it, before the maps. IMP_STATUS_UNBOUNDED: there is none. */
imp_status surface_plane_of(const surface *s, const imp_region *region, surface_plane *plane);

/* Like surface_slip, with the symmetry of a plane that b's maps carry. The two surfaces have no
 * maps in common. */
imp_status surface_slip_along(const surface *a, const surface *b, const surface_plane *plane,
                              const imp_model bare[3], const imp_region *times, double moment,
                              double enough, double *slip);

/* Like surface_distance_within under all maps of s, for the distance from the part of s that lies
 * along the plane. */
imp_status surface_height_within(const surface *s, const surface_plane *plane,
                                 const imp_region *region, const imp_model point[3], double moment,
                                 double slip, imp_model *height);

/* Bounds how much the distance of two surfaces at any time differs from that at `moment`, one of
 * the times. INFINITY: no bound. *slip is mere rounding where both turn only within themselves, or
 * by a symmetry of one of them: rollers, a shaft in its bore. `bare` holds models of all points of
 * each surface before its maps, of which only the ranges are used; neither moves by itself.
 * of_pieces: a surface of several pieces may turn within itself, too. *asked
 * becomes the side whose symmetry callback was called last, for error messages. */
imp_status surface_pair_slip(const surface *const s[2], bool of_pieces, const imp_model bare[2][3],
                             const imp_region *times, double moment, double *slip, int *asked);

/* Counts the maps, from the last one back, that are the same instances on both surfaces. */
size_t surface_common_maps(const surface *a, const surface *b);

/* Counts the common maps, from the last one back, that are rigid in exact arithmetic
 * (IMP_FLAG_TURNS_EXACTLY) and so preserve distances. */
size_t surface_common_motion(const surface *a, const surface *b);

/* Applies the maps after the first `maps` to n <= 16 points at time t, in place. */
imp_status surface_move_outward(const surface *s, size_t maps, double t, size_t n, double *x);

/* Holds the instance of its type for the caller, who puts it into a surface of another scene. */
shared_instance *surface_share(const surface *s);

size_t surface_map_count(const surface *s);

/* Returns an instance that the surface is composed of: its type's (k = 0), then its maps'. k <=
 * surface_map_count. */
const shared_instance *surface_origin(const surface *s, size_t k);

/* Like surface_origin, to be held by other surfaces. */
shared_instance *surface_stage(const surface *s, size_t k);

/* Counts the maps, from the first one on, whose rotation is constant during the region's times.
 * Precondition: surface_has_distance. */
imp_status surface_still_maps(const surface *s, const imp_region *region, size_t *count);

/* Computes the inclusion under the first `maps` maps alone. */
imp_status surface_include_inner(const surface *s, const imp_region *region, size_t maps,
                                 imp_model model[3]);

/* Computes the inclusion of the type alone, under none of the maps. */
imp_status surface_include_bare(const surface *s, const imp_region *region, imp_model model[3]);

/* Whether surface_tube can be called: the type offers tubes, and all maps are rigid in exact
 * arithmetic, so that they keep the distances of a line's image from that of the surface. */
bool surface_offers_tube(const surface *s);

/* Finds the line in the middle of the type alone, under none of the maps (imp_surface_type.tube).
 * IMP_STATUS_UNBOUNDED: there is none over the region. */
imp_status surface_tube(const surface *s, const imp_region *region, imp_tube *tube);

/* Applies the maps to a set of points whose coordinates have the models `model` over the region,
 * and replaces these by the models of its image. If u or v only numbers the points of a set, any
 * two count as 1 apart, so that a rate bounds the distance of two points. */
imp_status surface_include_image(const surface *s, const imp_region *region, imp_model model[3]);

#endif
