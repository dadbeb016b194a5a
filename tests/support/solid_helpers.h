/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SOLID_HELPERS_H
#define TESTS_SUPPORT_SOLID_HELPERS_H

#include <math.h>
#include <stdarg.h>

#include "core/solid/winding.h"
#include "tests/support/query_helpers.h"

/* Scenes of solids, and whether one is found inside of another. */

static imp_registry *registry;

static inline void open_registry(void) { registry = query_registry(); }

static inline void close_registry(void) { imp_registry_free(registry); }

typedef struct scene_words {
    char text[65536];
} scene_words;

/* A scene of these bodies, as in a scene file. */
__attribute__((format(printf, 1, 2))) static inline scene_words words(const char *format, ...)
{
    scene_words w;
    va_list rest;
    va_start(rest, format);
    const int n = vsnprintf(w.text, sizeof w.text, format, rest);
    va_end(rest);
    ck_assert_int_lt(n, (int)sizeof w.text);
    return w;
}

static inline imp_scene *scene_of(const char *bodies)
{
    imp_error error = {IMP_SUCCESS, ""};
    const scene_words w = words("{\"time\": [0, 1], \"bodies\": [%s]}", bodies);
    imp_scene *scene = imp_scene_from_json(registry, w.text, strlen(w.text), "test", &error);
    ck_assert_msg(scene != NULL, "%s: %s", w.text, error.text);
    return scene;
}

static inline imp_result solve(const char *bodies)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = scene_of(bodies);
    const imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = sizeof r};
    const imp_code code = imp_scene_solve(scene, &options, &r, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s: %s", bodies, error.text);
    imp_scene_free(scene);
    return r;
}

static inline bool is_inside(const imp_result *r)
{
    return r->verdict == IMP_VERDICT_CONTACT && r->kind == IMP_CONTACT_INSIDE;
}

static inline void check_inside(const char *bodies)
{
    const imp_result r = solve(bodies);
    ck_assert_msg(is_inside(&r) && r.t == 0 && r.t_lower == 0 && r.gap == 0 && !r.has_normal,
                  "%s: verdict %d, kind %d", bodies, (int)r.verdict, (int)r.kind);
    ck_assert(isnan(r.a.u) != isnan(r.b.u));
    for (int i = 0; i < 3; ++i) ck_assert(r.a.point[i] == r.b.point[i]);
}

static inline void check_clear(const char *bodies)
{
    const imp_result r = solve(bodies);
    ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR, "%s: verdict %d, kind %d at %g", bodies,
                  (int)r.verdict, (int)r.kind, r.t);
}

/* Two bodies: a solid one of these surfaces, and a small ball. */
static inline scene_words with_ball(const char *surfaces, const double at[3], double radius)
{
    return words(
        "{\"name\": \"a\", \"solid\": true, \"surfaces\": [%s]}, {\"surfaces\": [{\"type\": "
        "\"sphere\", \"radius\": %.17g, \"center\": [%.17g, %.17g, %.17g]}]}",
        surfaces, radius, at[0], at[1], at[2]);
}

#define SPHERE(R, X) "{\"type\": \"sphere\", \"radius\": " R ", \"center\": [" X ", 0, 0]}"
#define CORNERS                                                                                    \
    "\"points\": [[-0.75,-0.5,-0.625], [0.25,-0.5,-0.375], [-0.25,0.5,-0.625], "                   \
    "[0.75,0.5,-0.375], [-0.75,-0.5,0.375], [0.25,-0.5,0.625], [-0.25,0.5,0.375], "                \
    "[0.75,0.5,0.625]]"
/* A face of the parallelepiped, as a bilinear patch from four of its corners. */
#define PATCH(A, B, C, D)                                                                          \
    "{\"type\": \"bezier\", \"degree\": [1, 1], \"points\": [" A ", " B ", " C ", " D "]}"
#define P0 "[-0.75,-0.5,-0.625]"
#define P1 "[0.25,-0.5,-0.375]"
#define P2 "[-0.25,0.5,-0.625]"
#define P3 "[0.75,0.5,-0.375]"
#define P4 "[-0.75,-0.5,0.375]"
#define P5 "[0.25,-0.5,0.625]"
#define P6 "[-0.25,0.5,0.375]"
#define P7 "[0.75,0.5,0.625]"

#endif
