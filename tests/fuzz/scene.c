/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/registry.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <string.h>

/* Whatever bytes a scene or a pipeline is made of, it is read or refused. What is read is solved
 * with --audit under small limits, and the answer is judged: the witness is where it is said to be,
 * and no sampled points of two bodies come nearer than gamma_clear before t_lower. */

const char fuzz_target[] = "scene";

enum { PAIRS = 500, SAMPLES = 64, SURFACES = 8 };

/* Plugins of the build; with those of the tests, some of which lie, for reading only. */
static imp_registry *make_registry(bool with_tests)
{
    char list[8192], ours[4096], tests[4096];
    fuzz_path(ours, sizeof ours, "top_builddir", "plugins/.libs");
    fuzz_path(tests, sizeof tests, "top_builddir", "tests/plugins/.libs");
    snprintf(list, sizeof list, "%s%s%s", ours, with_tests ? ":" : "", with_tests ? tests : "");
    search_path path = {.count = 0};
    imp_registry *registry = search_path_add(&path, list, false) ? registry_scan(&path, 0) : NULL;
    search_path_clear(&path);
    if (registry == NULL ||
        registry_find_surface(registry, with_tests ? "kit" : "sphere") == NULL) {
        fprintf(stderr, "no plugins in %s\n", list);
        exit(EXIT_FAILURE);
    }
    return registry;
}

/* --- Judging an answer ---------------------------------------------------------------------- */

typedef struct point {
    double x[3], error; /* the exact point is no farther from x than error */
} point;

static bool evaluate(const imp_scene *scene, size_t body, size_t surface, const double p[3],
                     point *out)
{
    double e[3];
    if (imp_scene_eval(scene, body, surface, 1, p, out->x, e, NULL) != IMP_SUCCESS) return false;
    out->error = e[0] + e[1] + e[2];
    return true;
}

/* A lower bound of the exact points' distance: 2^-48 covers the rounding of five operations. */
static double distance_lower(const point *a, const point *b)
{
    const double d = hypot(hypot(a->x[0] - b->x[0], a->x[1] - b->x[1]), a->x[2] - b->x[2]);
    return d - 0x1p-48 * d - a->error - b->error;
}

static void judge_witness(const imp_scene *scene, const imp_result *r)
{
    point at[2];
    const imp_side *sides[2] = {&r->a, &r->b};
    FUZZ_REQUIRE(r->t == r->t_lower && r->a.body < r->b.body && r->gap <= r->gamma);
    for (int k = 0; k < 2; ++k)
        FUZZ_REQUIRE(evaluate(scene, sides[k]->body, sides[k]->surface,
                              (double[3]){sides[k]->u, sides[k]->v, r->t}, &at[k]));
    FUZZ_REQUIRE(distance_lower(&at[0], &at[1]) <= r->gamma);
}

static uint64_t random_state;

static double draw(double lo, double hi)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    const double s = (double)(random_state >> 11) * 0x1p-53, x = lo + s * (hi - lo);
    return x >= lo && x <= hi ? x : lo; /* also for infinite widths */
}

static bool sample(const imp_scene *scene, size_t body, double t, point *out)
{
    double lo[3], hi[3];
    const size_t count = imp_scene_surface_count(scene, body);
    if (count == 0) return false;
    const size_t k = (size_t)draw(0, (double)count) % count;
    imp_scene_domain(scene, body, k, lo, hi);
    if (!(lo[2] <= t && t <= hi[2])) return false;
    return evaluate(scene, body, k, (double[3]){draw(lo[0], hi[0]), draw(lo[1], hi[1]), t}, out);
}

static void judge_samples(const imp_scene *scene, const imp_options *options, const imp_result *r)
{
    if (!(r->t_lower > options->t_start)) return;
    for (int k = 0; k < SAMPLES; ++k) {
        const double t = draw(options->t_start, r->t_lower);
        point a, b;
        if (t < r->t_lower && sample(scene, 0, t, &a) && sample(scene, 1, t, &b))
            FUZZ_REQUIRE(!(hypot(hypot(a.x[0] - b.x[0], a.x[1] - b.x[1]), a.x[2] - b.x[2]) +
                               a.error + b.error <
                           r->gamma_clear * (1 - 0x1p-40)));
    }
}

static bool is_small(const imp_scene *scene)
{
    size_t count = 0;
    for (size_t b = 0; b < imp_scene_body_count(scene); ++b)
        count += imp_scene_surface_count(scene, b);
    return imp_scene_body_count(scene) == 2 && count <= SURFACES;
}

static void solve_and_judge(imp_scene *scene)
{
    if (scene == NULL || !is_small(scene)) return;
    imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = (uint32_t)sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    options.max_pairs = PAIRS;
    options.max_bytes = 1 << 26;
    options.audit = true;
    const imp_code code = imp_scene_solve(scene, &options, &r, &error);
    FUZZ_REQUIRE(code == IMP_SUCCESS || error.text[0] != '\0');
    if (code == IMP_ERROR_PLUGIN) fprintf(stderr, "accused: %s\n", error.text);
    FUZZ_REQUIRE(code != IMP_ERROR_PLUGIN); /* our own types keep their promises */
    if (code != IMP_SUCCESS) return;
    FUZZ_REQUIRE(r.t_lower >= options.t_start && r.t_lower <= options.t_end);
    if (r.verdict == IMP_CONTACT) judge_witness(scene, &r);
    judge_samples(scene, &options, &r);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static imp_registry *ours, *with_tests;
    if (ours == NULL) ours = make_registry(false);
    if (with_tests == NULL) with_tests = make_registry(true);
    random_state = length;
    imp_error error;
    const char *text = (const char *)bytes;
    imp_scene_free(imp_scene_from_json(with_tests, text, length, "input", &error));
    imp_scene *scene = imp_scene_from_json(ours, text, length, "input", &error);
    solve_and_judge(scene);
    imp_scene_free(scene);
    char *line = strndup(text, length), *second = line != NULL ? strchr(line, '\n') : NULL;
    if (line == NULL) return 0;
    if (second != NULL) *second++ = '\0'; /* two lines: the pipelines of two bodies */
    imp_scene_free(imp_scene_from_pair(with_tests, line, line, &error));
    scene = imp_scene_from_pair(ours, line, second != NULL ? second : line, &error);
    solve_and_judge(scene);
    imp_scene_free(scene);
    free(line);
    return 0;
}
