/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/world.h"

#include <math.h>
#include <string.h>

#include "core/surface/aside.h"
#include "core/surface/held.h"

static const surface *piece_of(const imp_scene *scene, const imp_side *at)
{
    const surface *s = scene_surface(scene, at->body, at->surface);
    return surface_part(s, at->piece);
}

static imp_code fault(const surface *s, imp_status status, double t, imp_error *error)
{
    surface_fault(s, error, "at t = %.17g: %s", t, surface_status_message(s, status).text);
    return surface_set_code(status, error);
}

/* Returns the length of the arrow whose image gives the normal: a power of two against which the
 * rounding of the points' coordinates is small. */
static double arrow_length(const vec3 *from, const double to[3])
{
    const vec3 image = {{to[0], to[1], to[2]}};
    const double largest = fmax(vec3_norm1(*from), vec3_norm1(image));
    int exponent;
    frexp(largest > 0 && largest < 0x1p500 ? largest : 1, &exponent);
    return ldexp(1, exponent);
}

/* Maps both ends of an arrow along the normal. */
static imp_code turn_normal(const surface *s, const candidate *of, const witness *found, double t,
                            world_witness *in_world, imp_error *error)
{
    const size_t maps = surface_map_count(s) - of->left_out;
    vec3 from = found->point[0];
    const double length = arrow_length(&from, in_world->side[0].point);
    vec3 to = vec3_sub(from, vec3_scale(found->normal, -length));
    imp_status status = surface_move_from_aside(s, maps, of->aside, t, from.x);
    if (status == IMP_STATUS_OK) status = surface_move_from_aside(s, maps, of->aside, t, to.x);
    if (status != IMP_STATUS_OK) return fault(s, status, t, error);
    const vec3 image = vec3_sub(to, from);
    memcpy(in_world->normal, vec3_scale(image, 1 / vec3_norm(image)).x, sizeof in_world->normal);
    return IMP_SUCCESS;
}

/* Computes one side of a witness in world space: the search's point or, if maps were left out or
 * held, the point under all maps. */
static imp_code place_side(const imp_scene *scene, const candidate *of, const witness *found,
                           int side, double t, imp_side *at, imp_error *error)
{
    *at = (imp_side){of->body,       of->surface,    found->piece[side],
                     found->u[side], found->v[side], {0, 0, 0}};
    memcpy(at->point, found->point[side].x, sizeof at->point);
    if (of->left_out == 0 && of->held.count == 0 && of->aside.which == 0) return IMP_SUCCESS;
    const surface *s = piece_of(scene, at);
    const size_t maps = surface_map_count(s) - of->left_out;
    imp_status status = IMP_STATUS_OK;
    if (of->held.count > 0)
        status = surface_held_place(s, of->held, maps, t, found->point[side].x, &at->u, &at->v);
    if (status == IMP_STATUS_OK)
        status = surface_eval(s, 1, (double[3]){at->u, at->v, t}, at->point, NULL);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : fault(s, status, t, error);
}

static double distance_of(const imp_side side[2])
{
    vec3 apart;
    for (int i = 0; i < 3; ++i) apart.x[i] = side[1].point[i] - side[0].point[i];
    return vec3_norm(apart);
}

imp_code world_witness_of(const imp_scene *scene, const candidate_pair *both, const witness *found,
                          double t, double most, world_witness *in_world, imp_error *error)
{
    for (int side = 0; side < 2; ++side) {
        const imp_code code =
            place_side(scene, both->side[side], found, side, t, &in_world->side[side], error);
        if (code != IMP_SUCCESS) return code;
    }
    in_world->gap = found->gap;
    memcpy(in_world->normal, found->normal.x, sizeof in_world->normal);
    const candidate *const *of = (const candidate *const *)both->side;
    const bool is_moved = of[0]->left_out > 0 || of[0]->aside.which != 0;
    const bool is_held = of[0]->held.count + of[1]->held.count > 0;
    if (!is_moved && !is_held && of[1]->aside.which == 0) return IMP_SUCCESS;
    const double gap = distance_of(in_world->side);
    in_world->gap = gap <= most ? gap : found->gap_upper;
    if (!found->has_normal || !is_moved) return IMP_SUCCESS;
    const surface *s = piece_of(scene, &in_world->side[0]);
    return turn_normal(s, of[0], found, t, in_world, error);
}
