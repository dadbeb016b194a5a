/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_POSE_DESCENT_H
#define TESTS_SUPPORT_POSE_DESCENT_H

#include "tests/support/survey_scenes.h"
#include "tests/support/told_boxes.h"

/* An adversary that looks for near poses of a scene with parameters: it samples values, a time and
 * both surfaces, and improves what it finds by descent in all of them at once. */

enum { COARSE = 5, PIECES_MAX = 8, STEPS = 90, POLISH = 600 };

/* Two points at some values: what the descent moves. */
typedef struct placed {
    double value[VALUES_MAX], t;
    imp_place at[2];
    double uv[2][2];
} placed;

/* --- Two points ----------------------------------------------------------------------------- */

static inline imp_scene *pose(const imp_scene *scene, const double *values)
{
    imp_error error;
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    return at;
}

/* Evaluates a point; its error is added to *inexact. */
static inline void point_of(const imp_scene *posed, imp_place at, const double uv[2], double t,
                            double x[3], double *inexact)
{
    const double p[3] = {uv[0], uv[1], t};
    double error[3];
    ck_assert_int_eq(imp_piece_eval(posed, at, 1, p, x, error, NULL), IMP_SUCCESS);
    *inexact += error[0] + error[1] + error[2];
}

/* Returns a distance that the two points certainly do not exceed. */
static inline double distance_upper(const imp_scene *posed, const placed *p)
{
    double x[2][3], inexact = 0;
    for (int k = 0; k < 2; ++k) point_of(posed, p->at[k], p->uv[k], p->t, x[k], &inexact);
    return (query_distance(x[0], x[1]) + inexact) * (1 + 1e-15);
}

/* --- Samples -------------------------------------------------------------------------------- */

typedef struct sample {
    double x[3], uv[2];
    size_t piece;
} sample;

static inline int sample_body(const imp_scene *posed, size_t body, double t, sample *to)
{
    int count = 0;
    for (size_t k = 0; k < imp_scene_piece_count(posed, body, 0) && k < PIECES_MAX; ++k) {
        double lo[3], hi[3], inexact = 0;
        imp_piece_domain(posed, (imp_place){body, 0, k}, lo, hi);
        for (int i = 0; i < COARSE * COARSE; ++i) {
            sample *s = &to[count++];
            s->piece = k;
            s->uv[0] = lo[0] + (hi[0] - lo[0]) * (i / COARSE) / (COARSE - 1);
            s->uv[1] = lo[1] + (hi[1] - lo[1]) * (i % COARSE) / (COARSE - 1);
            point_of(posed, (imp_place){body, 0, k}, s->uv, t, s->x, &inexact);
        }
    }
    return count;
}

/* Places two points where grids over both bodies are nearest. */
static inline void place_points(const imp_scene *posed, const size_t body[2], placed *p)
{
    static sample all[2][COARSE * COARSE * PIECES_MAX];
    double least = INFINITY;
    const int count[2] = {sample_body(posed, body[0], p->t, all[0]),
                          sample_body(posed, body[1], p->t, all[1])};
    for (int i = 0; i < count[0]; ++i)
        for (int j = 0; j < count[1]; ++j) {
            const sample *of[2] = {&all[0][i], &all[1][j]};
            const double d = query_distance(of[0]->x, of[1]->x);
            if (!(d < least)) continue;
            least = d;
            for (int k = 0; k < 2; ++k) {
                p->at[k] = (imp_place){body[k], 0, of[k]->piece};
                memcpy(p->uv[k], of[k]->uv, sizeof p->uv[k]);
            }
        }
}

/* --- Descent -------------------------------------------------------------------------------- */

static inline double moved(uint64_t *r, double x, double lo, double hi, double step)
{
    const double to = x + step * (hi - lo) * within(r, 1);
    return to < lo ? lo : to > hi ? hi : to;
}

/* Moves points, or values and time as well, or one value alone. */
static inline placed move_some(uint64_t *r, const imp_scene *posed, const placed *from,
                               size_t count, const region_box *in, double step, bool *turns)
{
    placed to = *from;
    const int kind = one_of(r, 4);
    const size_t alone = (size_t)one_of(r, (int)count + 1);
    *turns = kind < 2;
    for (size_t j = 0; *turns && j < count; ++j)
        if (kind == 0 || j == alone)
            to.value[j] = moved(r, to.value[j], in->lo[j], in->hi[j], step);
    if (*turns && (kind == 0 || alone == count))
        to.t = moved(r, to.t, in->time[0], in->time[1], step);
    for (int k = 0; k < 2 && kind != 1; ++k) {
        double lo[3], hi[3];
        imp_piece_domain(posed, to.at[k], lo, hi);
        for (int i = 0; i < 2; ++i) to.uv[k][i] = moved(r, to.uv[k][i], lo[i], hi[i], 0.5 * step);
    }
    return to;
}

/* Improves the points by random steps, which grow where they help and shrink where they do not. */
static inline double descend(uint64_t *r, const imp_scene *scene, placed *p, const region_box *in,
                             int steps)
{
    const size_t count = imp_scene_parameter_count(scene);
    imp_scene *posed = pose(scene, p->value);
    double least = distance_upper(posed, p), step = 0.5;
    for (int k = 0; k < steps; ++k) {
        bool turns;
        const placed to = move_some(r, posed, p, count, in, step, &turns);
        imp_scene *at = turns ? pose(scene, to.value) : posed;
        const double d = distance_upper(at, &to);
        const bool better = d < least;
        if (turns) imp_scene_free(better ? posed : at);
        step *= better ? 1.6 : 0.9;
        if (step < 1e-9) step = 0.1;
        if (!better) continue;
        least = d;
        *p = to;
        posed = at;
    }
    imp_scene_free(posed);
    return least;
}

/* Returns the nearest found from one random start; the worst values of a box are mostly at a
 * corner. */
static inline double attack(uint64_t *r, const imp_scene *scene, const size_t body[2],
                            const region_box *in, placed *p)
{
    const bool at_corner = random_fraction(r) < 0.5;
    for (size_t j = 0; j < imp_scene_parameter_count(scene); ++j)
        p->value[j] = at_corner ? (random_fraction(r) < 0.5 ? in->lo[j] : in->hi[j])
                                : random_between(r, in->lo[j], in->hi[j]);
    p->t = random_between(r, in->time[0], in->time[1]);
    imp_scene *posed = pose(scene, p->value);
    place_points(posed, body, p);
    imp_scene_free(posed);
    return descend(r, scene, p, in, STEPS);
}

/* --- All pairs of bodies -------------------------------------------------------------------- */

static inline bool follows_any(const imp_scene *scene, size_t body)
{
    for (size_t j = 0; j < imp_scene_parameter_count(scene); ++j)
        if (imp_scene_follows(scene, body, j)) return true;
    return false;
}

/* Whether a box of these bodies is about a and b. */
static inline bool is_about(const imp_scene *scene, const size_t body[2], size_t a, size_t b)
{
    if (imp_scene_surface_count(scene, a) == 0 || imp_scene_surface_count(scene, b) == 0)
        return false;
    if (body[0] != SIZE_MAX) return body[0] == a && body[1] == b;
    return !follows_any(scene, a) && !follows_any(scene, b);
}

static inline region_box whole_of(const imp_scene *scene)
{
    region_box all = {.time = {0, 1}};
    imp_scene_parameter_info info;
    for (size_t j = 0; imp_scene_parameter(scene, j, &info); ++j)
        all.lo[j] = info.lo, all.hi[j] = info.hi;
    return all;
}

/* Returns the nearest found of the bodies that a box is about; `all`: of all bodies. */
static inline double nearest_found(uint64_t *r, const imp_scene *scene, const size_t *body,
                                   const region_box *in, int starts)
{
    double least = INFINITY;
    placed best;
    for (size_t a = 0; a < imp_scene_body_count(scene); ++a)
        for (size_t b = a + 1; b < imp_scene_body_count(scene); ++b) {
            const size_t both[2] = {a, b};
            if (!is_about(scene, body != NULL ? body : both, a, b)) continue;
            for (int k = 0; k < starts; ++k) {
                placed p;
                const double d = attack(r, scene, both, in, &p);
                if (d < least) least = d, best = p;
            }
        }
    return starts > 1 && least < INFINITY ? descend(r, scene, &best, in, POLISH) : least;
}

#endif
