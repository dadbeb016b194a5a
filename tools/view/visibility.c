/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/visibility.h"

#include <stdlib.h>
#include <string.h>

#include "tools/view/camera.h"

/* Triangles within this part of the scene's size in front of the spot do not hide it. */
static const double slack_share = 0.02;

double visibility_slack(const stage *s) { return slack_share * stage_size(s); }

/* --- Rays ------------------------------------------------------------------------------------- */

/* Rays from one point; each body that one meets beyond the slack is noted. */
typedef struct rays {
    vec from;
    double slack;
    const vec *toward; /* of each ray; unit length */
    size_t count;
    bool *met; /* [ray * bodies + body] */
    size_t bodies;
} rays;

/* The triangle a, b, c as seen from the ray's beginning: the ray meets it where all three of a, b,
 * c lie on the same side of the planes through the ray and the others. */
static bool meets(vec toward, double slack, vec a, vec b, vec c)
{
    const double ab = vec_dot(toward, vec_cross(a, b)), bc = vec_dot(toward, vec_cross(b, c));
    const double ca = vec_dot(toward, vec_cross(c, a)), sum = ab + bc + ca;
    const bool inside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    if (!inside || !(sum != 0)) return false;
    const double along =
        (bc * vec_dot(toward, a) + ca * vec_dot(toward, b) + ab * vec_dot(toward, c)) / sum;
    return along > slack;
}

static void cast(void *context, const mesh *m, const size_t corner[3], size_t cell)
{
    const rays *r = context;
    const vec a = vec_sub(m->point[corner[0]], r->from), b = vec_sub(m->point[corner[1]], r->from);
    const vec c = vec_sub(m->point[corner[2]], r->from);
    (void)cell;
    for (size_t k = 0; k < r->count; ++k)
        if (!r->met[k * r->bodies + m->body] && meets(r->toward[k], r->slack, a, b, c))
            r->met[k * r->bodies + m->body] = true;
}

static imp_code cast_all(const stage *s, rays *r, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < s->count && code == IMP_SUCCESS; ++k) {
        if (stage_is_there(s, &s->meshes[k])) mesh_triangles(&s->meshes[k], cast, r);
        code = allowance_check(s->allowance, "a direction to look from was chosen", error);
    }
    return code;
}

imp_code visibility_hiding(const stage *s, vec toward, bool *hides, imp_error *error)
{
    rays r = {stage_spot_point(s), visibility_slack(s), &toward, 1, hides, s->body_count};
    memset(hides, 0, s->body_count * sizeof *hides);
    return s->spot.is_known ? cast_all(s, &r, error) : IMP_SUCCESS;
}

/* --- The visible part of the two bodies ------------------------------------------------------- */

enum { SAMPLES = 12 }; /* points of each of the two bodies, at most */

typedef struct samples {
    vec point[2][SAMPLES];
    size_t count[2];
} samples;

static double body_size(const stage *s, size_t body)
{
    vec_box box = vec_box_empty();
    for (size_t k = 0; k < s->count; ++k)
        for (size_t i = 0; i < s->meshes[k].point_count && s->meshes[k].body == body; ++i)
            vec_box_add(&box, s->meshes[k].point[i]);
    return vec_length(vec_sub(box.hi, box.lo));
}

/* Takes every stride-th of the body's points within the radius around the spot. */
static size_t take_samples(const stage *s, size_t body, double radius, size_t stride, vec *taken,
                           size_t *found)
{
    const vec spot = stage_spot_point(s);
    size_t count = 0;
    *found = 0;
    for (size_t k = 0; k < s->count; ++k) {
        const mesh *m = &s->meshes[k];
        for (size_t i = 0; i < m->point_count && m->body == body; ++i) {
            if (vec_length(vec_sub(m->point[i], spot)) > radius) continue;
            if ((*found)++ % stride == 0 && count < SAMPLES) taken[count++] = m->point[i];
        }
    }
    return count;
}

static samples choose_samples(const stage *s)
{
    samples all = {.count = {0, 0}};
    const double sizes[2] = {body_size(s, s->spot.body[0]), body_size(s, s->spot.body[1])};
    const double apart = vec_length(vec_sub(s->spot.point[1], s->spot.point[0]));
    const double radius = apart + 0.5 * (sizes[0] < sizes[1] ? sizes[0] : sizes[1]);
    for (int k = 0; k < 2; ++k) {
        size_t found;
        const size_t body = s->spot.body[k];
        take_samples(s, body, radius, 1, all.point[k], &found);
        all.count[k] = take_samples(s, body, radius, found / SAMPLES + 1, all.point[k], &found);
        if (all.count[k] == 0) all.point[k][all.count[k]++] = s->spot.point[k];
    }
    return all;
}

/* Rays from samples, which bodies other than their own may meet. */
typedef struct glances {
    const samples *from;
    const size_t *body; /* the samples' body */
    const vec *toward;
    size_t count;
    double slack;
    bool (*blocked)[2][SAMPLES]; /* one for each of toward */
} glances;

static void block(void *context, const mesh *m, const size_t corner[3], size_t cell)
{
    const glances *g = context;
    (void)cell;
    for (int side = 0; side < 2; ++side)
        for (size_t i = 0; i < g->from->count[side] && m->body != g->body[side]; ++i) {
            const vec from = g->from->point[side][i];
            const vec a = vec_sub(m->point[corner[0]], from),
                      b = vec_sub(m->point[corner[1]], from);
            const vec c = vec_sub(m->point[corner[2]], from);
            for (size_t k = 0; k < g->count; ++k)
                g->blocked[k][side][i] |= meets(g->toward[k], g->slack, a, b, c);
        }
}

/* Returns the share of visible samples, of the body that is less visible. */
static double share_seen(const samples *from, bool blocked[2][SAMPLES])
{
    double least = 1;
    for (int side = 0; side < 2; ++side) {
        double seen = 0;
        for (size_t i = 0; i < from->count[side]; ++i) seen += !blocked[side][i];
        least = fmin(least, seen / (double)from->count[side]);
    }
    return least;
}

/* --- Directions ------------------------------------------------------------------------------- */

static const direction usual = {-55, 25};

enum { TURNS = 12 }; /* azimuths, 30 degrees apart */
static const double elevations[] = {25, 50, 10, 75, -20, -50};
enum {
    HEIGHTS = sizeof elevations / sizeof elevations[0],
    TRIALS = TURNS * HEIGHTS,
    BEST = 2, /* azimuths of each elevation that are looked at more closely */
    FINALISTS = BEST * HEIGHTS
};

static direction trial(size_t k)
{
    return (direction){usual.azimuth + 360 / TURNS * (double)(k % TURNS), elevations[k / TURNS]};
}

/* Returns the merit of a direction: a third body in front of the spot costs most; the two bodies
 * often hide their own contact. */
static double merit(const stage *s, direction d, vec toward, const bool *met)
{
    double hiding = 0;
    for (size_t b = 0; b < s->body_count; ++b)
        if (met[b]) hiding += b == s->spot.body[0] || b == s->spot.body[1] ? 0.25 : 1;
    const double side = s->spot.has_normal ? 1 - fabs(vec_dot(s->spot.normal, toward)) : 0.5;
    const double turned = d.azimuth - usual.azimuth;
    return side - 2 * hiding - (turned > 180 ? 360 - turned : turned) / 400 -
           fabs(d.elevation - usual.elevation) / 200;
}

/* Takes the azimuths of one elevation from which the spot is least hidden. */
static void take_best(const double *merits, size_t height, size_t best[BEST])
{
    for (size_t n = 0; n < BEST; ++n) {
        best[n] = SIZE_MAX;
        for (size_t k = height * TURNS; k < (height + 1) * TURNS; ++k)
            if ((n == 0 || k != best[0]) && (best[n] == SIZE_MAX || merits[k] > merits[best[n]]))
                best[n] = k;
    }
}

/* Chooses the finalist that also shows most of both bodies. */
static imp_code choose_last(const stage *s, const vec *toward, const double *merits,
                            direction *chosen, imp_error *error)
{
    size_t finalist[FINALISTS];
    vec way[FINALISTS];
    bool blocked[FINALISTS][2][SAMPLES] = {0};
    double best = -INFINITY;
    const samples from = choose_samples(s);
    for (size_t h = 0; h < HEIGHTS; ++h) take_best(merits, h, finalist + BEST * h);
    for (size_t k = 0; k < FINALISTS; ++k) way[k] = toward[finalist[k]];
    glances g = {&from, s->spot.body, way, FINALISTS, 1e-6 * stage_size(s), blocked};
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < s->count && code == IMP_SUCCESS; ++k) {
        if (stage_is_there(s, &s->meshes[k])) mesh_triangles(&s->meshes[k], block, &g);
        code = allowance_check(s->allowance, "a direction to look from was chosen", error);
    }
    for (size_t k = 0; k < FINALISTS; ++k) {
        const double found = merits[finalist[k]] + 2 * share_seen(&from, blocked[k]);
        if (found > best) best = found, *chosen = trial(finalist[k]);
    }
    return code;
}

imp_code visibility_choose(const stage *s, direction *chosen, imp_error *error)
{
    vec toward[TRIALS];
    double merits[TRIALS];
    *chosen = usual;
    if (!s->spot.is_known) return IMP_SUCCESS;
    for (size_t k = 0; k < TRIALS; ++k)
        toward[k] = camera_toward(trial(k).azimuth, trial(k).elevation).toward;
    bool *met = calloc(TRIALS * s->body_count + 1, sizeof *met);
    if (met == NULL) return mesh_no_memory(error);
    rays r = {stage_spot_point(s), visibility_slack(s), toward, TRIALS, met, s->body_count};
    const imp_code code = cast_all(s, &r, error);
    for (size_t k = 0; k < TRIALS; ++k)
        merits[k] = merit(s, trial(k), toward[k], met + k * s->body_count);
    free(met);
    return code == IMP_SUCCESS ? choose_last(s, toward, merits, chosen, error) : code;
}
