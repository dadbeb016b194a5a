/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/survey/survey_internal.h"

/* Returns the greater; INFINITY if `one` is NaN. `most` is no NaN. */
static double greater(double most, double one)
{
    return one <= most ? most : isnan(one) ? INFINITY : one;
}

static void join_image(surface_image *all, const surface_image *one)
{
    for (int i = 0; i < 3; ++i) {
        all->lo[i] = -greater(-all->lo[i], -one->lo[i]);
        all->hi[i] = greater(all->hi[i], one->hi[i]);
    }
    all->follows_time = all->follows_time || one->follows_time;
    all->drift = greater(all->drift, one->drift);
    all->slip = greater(all->slip, one->slip);
}

/* Returns a lower bound of the distance of two boxes: the widest gap along a coordinate. */
static double apart_lower(const surface_image *a, const surface_image *b)
{
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = difference_lower(b->lo[i], a->hi[i]);
        const double below = difference_lower(a->lo[i], b->hi[i]);
        if (above > most) most = above;
        if (below > most) most = below;
    }
    return most;
}

/* Adds what parameters shift one body of the pair by, at most: of its surfaces the one that moves
 * most. s->box.shift[2] is scratch. */
static imp_code measure_body(imp_survey *s, size_t body, size_t left_out, const value_box *values,
                             double *most, surface_image *all, imp_error *error)
{
    double *one = s->box.shift[2];
    for (size_t j = 0; j < s->parameters; ++j) most[j] = 0;
    all->follows_time = false;
    all->drift = all->slip = 0;
    for (int i = 0; i < 3; ++i) all->lo[i] = INFINITY, all->hi[i] = -INFINITY;
    for (size_t k = 0; k < scene_surface_count(s->scene, body); ++k) {
        const surface *of = scene_surface(s->scene, body, k);
        surface_image image;
        const imp_status status = surface_shift_upper(
            of, &s->extents.of[s->extents.first[body] + k], left_out, values, one, &image);
        if (status != IMP_STATUS_OK) {
            surface_fault(of, error, ": %s", surface_status_message(of, status).text);
            return surface_set_code(status, error);
        }
        join_image(all, &image);
        for (size_t j = 0; j < s->parameters; ++j) most[j] = greater(most[j], one[j]);
    }
    return IMP_SUCCESS;
}

/* Roundings of the total: the sum over two bodies 1, over the parameters SCENE_PARAMETERS_MAX, the
 * drift 1, slips 2. */
PAD_COVERS(64, 1 + SCENE_PARAMETERS_MAX + 3);

/* s->box.shift[0][k] becomes what parameter k shifts both bodies by; 0 for one that is swept. */
imp_code survey_measure(imp_survey *s, const survey_box *box, size_t left_out, double t_start,
                        double t_end, box_bounds *bounds, imp_error *error)
{
    const survey_pair *pair = &s->pairs.at[box->pair];
    double *lo = s->box.middle + s->parameters, *hi = lo + s->parameters; /* behind the middle */
    surface_image image[2];
    for (size_t j = 0; j < s->parameters; ++j) {
        lo[j] = box->range[2 * j], hi[j] = box->range[2 * j + 1];
        s->box.middle[j] = scene_parameter_middle(lo[j], hi[j]);
        s->box.shift[0][j] = 0;
    }
    *bounds = (box_bounds){.lo = lo, .hi = hi, .t_start = t_start, .t_end = t_end};
    if (pair->body[0] == SURVEY_ALL_BODIES) return IMP_SUCCESS;
    const value_box values = {s->parameters, lo, hi, s->box.middle, t_start, t_end};
    for (int side = 0; side < 2; ++side) {
        const imp_code code = measure_body(s, pair->body[side], left_out, &values,
                                           s->box.shift[side], &image[side], error);
        if (code != IMP_SUCCESS) return code;
    }
    for (size_t j = 0; j < s->parameters; ++j) {
        s->box.shift[0][j] = j == pair->swept ? 0 : s->box.shift[0][j] + s->box.shift[1][j];
        bounds->total += s->box.shift[0][j];
    }
    if (pair->swept != SIZE_MAX) bounds->total += pair->drift;
    bounds->shifts = bounds->total;
    bounds->total = padded_upper(bounds->total + (image[0].slip + image[1].slip), 64);
    bounds->follows_time = image[0].follows_time || image[1].follows_time;
    bounds->drift = sum_upper(image[0].drift, image[1].drift);
    bounds->apart = apart_lower(&image[0], &image[1]);
    return IMP_SUCCESS;
}
