/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/survey/survey_internal.h"

/* What is made of one body: a spread of each of its surfaces, with room for their maps. */
typedef struct body_spread {
    surface_spread *of;
    spread_map *maps;
    bool *known;
} body_spread;

static bool make_room(const imp_survey *s, size_t body, body_spread *to)
{
    const size_t surfaces = scene_surface_count(s->scene, body);
    size_t maps = 0;
    for (size_t k = 0; k < surfaces; ++k)
        maps += surface_map_count(scene_surface(s->scene, body, k));
    to->of = malloc(surfaces * sizeof *to->of);
    to->maps = malloc((maps + 1) * sizeof *to->maps);
    to->known = malloc(surfaces * sizeof *to->known);
    return to->of != NULL && to->maps != NULL && to->known != NULL;
}

static imp_code fill_body(imp_survey *s, const survey_pair *pair, size_t body,
                          const value_box *values, body_spread *to, imp_error *error)
{
    spread_map *maps = to->maps;
    for (size_t k = 0; k < scene_surface_count(s->scene, body); ++k) {
        const surface *of = scene_surface(s->scene, body, k);
        const surface_extent *extent = &s->extents.of[s->extents.first[body] + k];
        const size_t count = surface_map_count(of);
        surface_image image;
        to->known[k] = false;
        to->of[k] = (surface_spread){.maps = maps};
        maps += count;
        map_reach reaches[SPREAD_MAPS_MAX];
        if (count > SPREAD_MAPS_MAX) continue;
        const imp_status status = surface_shift_trace(of, extent, pair->left_out, values,
                                                      s->box.shift[2], &image, reaches);
        if (status != IMP_STATUS_OK) {
            surface_fault(of, error, ": %s", surface_status_message(of, status).text);
            return surface_set_code(status, error);
        }
        if (image.lo[0] > -INFINITY)
            to->known[k] = surface_spread_make(of, extent, pair->left_out, values, pair->swept,
                                               reaches, &to->of[k]);
    }
    return IMP_SUCCESS;
}

static bool knows_any(const imp_survey *s, size_t body, const bool *known)
{
    for (size_t k = 0; k < scene_surface_count(s->scene, body); ++k)
        if (known[k]) return true;
    return false;
}

imp_code survey_spread_make(imp_survey *s, const survey_box *box, const box_bounds *bounds,
                            const double gamma[2], query_spread *to, imp_error *error)
{
    const survey_pair *pair = &s->pairs.at[box->pair];
    const value_box values = {s->parameters, bounds->lo,      bounds->hi,
                              s->box.middle, bounds->t_start, bounds->t_end};
    imp_code code = IMP_SUCCESS;
    *to = (query_spread){.scene = s->scene,
                         .body = {pair->body[0], pair->body[1]},
                         .left_out = pair->left_out,
                         .parameters = s->parameters,
                         .gamma = gamma[0],
                         .gamma_clear = gamma[1]};
    if (pair->drift > 0) to->gamma_clear = sum_upper(to->gamma_clear, pair->drift);
    for (int side = 0; side < 2; ++side) {
        body_spread made;
        const bool room = make_room(s, pair->body[side], &made);
        if (code == IMP_SUCCESS)
            code = room ? fill_body(s, pair, pair->body[side], &values, &made, error)
                        : error_set_memory(error);
        to->of[side] = made.of;
        to->maps[side] = made.maps;
        to->known[side] = made.known;
    }
    to->is_known = code == IMP_SUCCESS && knows_any(s, pair->body[0], to->known[0]) &&
                   knows_any(s, pair->body[1], to->known[1]);
    return code;
}

void survey_spread_clear(query_spread *spread)
{
    for (int side = 0; side < 2; ++side) {
        free(spread->of[side]);
        free(spread->maps[side]);
        free(spread->known[side]);
    }
}
