/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Scenes whose numbers change, as in the loop of a simulation: a change, a query, its answer. */

/* --- Numbers and scenes ----------------------------------------------------------------------- */

enum { POINTS = 16, BALLS_SIDE = 5, BALLS = BALLS_SIDE * BALLS_SIDE * BALLS_SIDE };

typedef enum what {
    CHANGE_POINTS,
    CHANGE_MOTION,
    CHANGE_BALL,
    CHANGE_VERTEX,          /* over a face that moves uniformly */
    CHANGE_VERTEX_OF_CLOTH, /* over one that deforms */
    CHANGE_EDGE,
    CHANGES
} what;
_Static_assert((int)CHANGES <= (int)BENCH_FINDINGS_MAX, "each case has a finding");

/* What changes with each step: the points of a patch and its velocity, or that of a ball, or a
 * vertex or an edge (ends_of). */
typedef struct numbers {
    double points[POINTS][3], velocity[3];
} numbers;

static numbers draw(uint64_t *state)
{
    numbers x;
    for (int k = 0; k < POINTS; ++k) {
        x.points[k][0] = k / 4 / 3.0;
        x.points[k][1] = k % 4 / 3.0;
        x.points[k][2] = random_between(state, -0.1, 0.1);
    }
    for (int i = 0; i < 3; ++i) x.velocity[i] = random_between(state, -0.2, 0.2);
    return x;
}

/* Two ends that fall by 2 in a unit of time, and by random numbers; a vertex is the first. */
typedef struct ends {
    double at[2][3], moves[2][3];
} ends;

static ends ends_of(const numbers *x, what which)
{
    ends e;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 3; ++i) {
            e.at[k][i] = x->points[6 * k + i][2] + (i == 2);
            e.moves[k][i] = x->points[6 * k + 3 + i][2] - 2 * (i == 2);
        }
    if (which == CHANGE_EDGE) e.at[0][0] -= 1, e.at[1][0] += 1;
    return e;
}

static void end_arguments(const ends *e, what which, imp_argument to[2])
{
    const bool is_edge = which == CHANGE_EDGE;
    to[0] = is_edge ? imp_argument_rows("points", e->at[0], 2, 3)
                    : imp_argument_list("position", e->at[0], 3);
    to[1] = is_edge ? imp_argument_rows("velocities", e->moves[0], 2, 3)
                    : imp_argument_list("velocity", e->moves[0], 3);
}

static imp_code add_body(imp_builder *b, const char *type, const imp_argument *arguments,
                         size_t count, const double velocity[3], imp_error *error)
{
    size_t body = 0;
    const imp_argument moves = imp_argument_list("velocity", velocity, 3);
    imp_code code = imp_builder_body(b, NULL, &body, error);
    if (code == IMP_SUCCESS) code = imp_builder_surface(b, body, type, arguments, count, error);
    if (code != IMP_SUCCESS || velocity == NULL) return code;
    return imp_builder_map(b, body, "translate", &moves, 1, error);
}

static size_t patch_arguments(const numbers *x, imp_argument to[2])
{
    static const double degree[2] = {3, 3};
    to[0] = imp_argument_list("degree", degree, 2);
    to[1] = imp_argument_rows("points", x->points[0], POINTS, 3);
    return 2;
}

/* One patch that changes, and one like it, 0.5 above, that comes down. */
static imp_code add_patches(imp_builder *b, const numbers *x, imp_error *error)
{
    static const double down[3] = {0.1, 0, -0.3};
    numbers other = *x;
    imp_argument arguments[2];
    for (int k = 0; k < POINTS; ++k) other.points[k][2] = 0.5 + (k % 5) * 0.01;
    const imp_code code =
        add_body(b, "bezier", arguments, patch_arguments(x, arguments), x->velocity, error);
    if (code != IMP_SUCCESS) return code;
    return add_body(b, "bezier", arguments, patch_arguments(&other, arguments), down, error);
}

/* Balls in a grid, of which the first changes. */
static imp_code add_balls(imp_builder *b, const numbers *x, imp_error *error)
{
    uint64_t state = 25;
    imp_code code = IMP_SUCCESS;
    for (int k = 0; k < BALLS && code == IMP_SUCCESS; ++k) {
        const numbers own = draw(&state);
        const double center[3] = {2 * (k % BALLS_SIDE), 2 * (k / BALLS_SIDE % BALLS_SIDE),
                                  2 * (k / BALLS_SIDE / BALLS_SIDE)};
        const imp_argument arguments[] = {imp_argument_number("radius", 0.5),
                                          imp_argument_list("center", center, 3)};
        code = add_body(b, "sphere", arguments, 2, k == 0 ? x->velocity : own.velocity, error);
    }
    return code;
}

/* A vertex that falls on a face, or an edge on another: they touch after half a unit of time. */
static imp_code add_falling(imp_builder *b, what which, const numbers *x, imp_error *error)
{
    static const double corners[3][3] = {{-1.1, -1.2, 0.03}, {1.3, -0.9, -0.04}, {0.1, 1.4, 0.07}};
    static const double moving[3][3] = {{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}};
    static const double bending[3][3] = {{0.1, 0.2, 0.3}, {-0.1, 0.2, 0.3}, {0.1, 0.3, 0.1}};
    static const double across[2][3] = {{0.1, -1.2, 0.03}, {-0.05, 1.1, -0.04}};
    const bool is_edge = which == CHANGE_EDGE;
    const ends e = ends_of(x, which);
    imp_argument arguments[2];
    end_arguments(&e, which, arguments);
    const imp_code code = add_body(b, is_edge ? "segment" : "point", arguments, 2, NULL, error);
    if (code != IMP_SUCCESS) return code;
    const double *by = which == CHANGE_VERTEX ? moving[0] : bending[0];
    arguments[0] =
        imp_argument_rows("points", is_edge ? across[0] : corners[0], is_edge ? 2 : 3, 3);
    arguments[1] = imp_argument_rows("velocities", by, is_edge ? 2 : 3, 3);
    return add_body(b, is_edge ? "segment" : "triangle", arguments, 2, NULL, error);
}

static imp_code add_bodies(imp_builder *b, what which, const numbers *x, imp_error *error)
{
    if (which >= CHANGE_VERTEX) return add_falling(b, which, x, error);
    return which == CHANGE_BALL ? add_balls(b, x, error) : add_patches(b, x, error);
}

/* NULL: *error says why. */
static imp_scene *build_scene(imp_registry *registry, what which, const numbers *x,
                              imp_error *error)
{
    imp_builder *b = imp_builder_new(registry);
    if (b == NULL) return error->code = IMP_ERROR_MEMORY, NULL;
    imp_code code = imp_builder_time(b, 0, 1, error);
    if (code == IMP_SUCCESS) code = add_bodies(b, which, x, error);
    imp_scene *scene = code == IMP_SUCCESS ? imp_builder_finish(b, error) : NULL;
    imp_builder_free(b);
    return scene;
}

static imp_code change_scene(imp_scene *scene, what which, const numbers *x, imp_error *error)
{
    imp_argument arguments[2];
    if (which == CHANGE_POINTS)
        return imp_scene_set_values(scene, 0, 0, SIZE_MAX, arguments, patch_arguments(x, arguments),
                                    error);
    if (which >= CHANGE_VERTEX) {
        const ends e = ends_of(x, which);
        end_arguments(&e, which, arguments);
        return imp_scene_set_values(scene, 0, 0, SIZE_MAX, arguments, 2, error);
    }
    arguments[0] = imp_argument_list("velocity", x->velocity, 3);
    return imp_scene_set_values(scene, 0, SIZE_MAX, 0, arguments, 1, error);
}

/* --- Steps ------------------------------------------------------------------------------------ */

typedef struct loop {
    imp_registry *registry;
    const bench_case *of;
    bool is_rebuilt;
    what which;
    numbers begun; /* what does not change stays so */
    imp_scene *scene;
} loop;

/* Makes step number k in *scene, which was changed or is new. */
static imp_code make_step(loop *l, uint64_t *state, imp_result *result, imp_error *error)
{
    numbers x = draw(state);
    if (l->which == CHANGE_POINTS) memcpy(x.velocity, l->begun.velocity, sizeof x.velocity);
    if (l->which == CHANGE_MOTION) memcpy(x.points, l->begun.points, sizeof x.points);
    imp_code code = IMP_SUCCESS;
    if (l->is_rebuilt) {
        imp_scene_free(l->scene);
        l->scene = build_scene(l->registry, l->which, &x, error);
        if (l->scene == NULL) code = error->code;
    } else {
        code = change_scene(l->scene, l->which, &x, error);
    }
    if (code != IMP_SUCCESS) return code;
    imp_options options = imp_options_default(l->scene);
    options.gamma = l->of->gamma;
    options.gamma_clear = l->of->gamma_clear;
    result->struct_size = sizeof *result;
    return imp_scene_solve(l->scene, &options, result, error);
}

/* One round of the same steps; *seconds is the mean time of one. */
static imp_code run_round(loop *l, columns *x, bench_tally *tally, double *seconds,
                          imp_error *error)
{
    uint64_t state = 26;
    imp_code code = IMP_SUCCESS;
    const double start = bench_seconds_computed();
    for (size_t k = 0; k < l->of->steps && code == IMP_SUCCESS; ++k) {
        imp_result result = {.struct_size = 0};
        code = make_step(l, &state, &result, error);
        if (code != IMP_SUCCESS || x == NULL) continue;
        columns_add(x, &result.stats, 0);
        tally->verdicts[result.verdict] += 1;
    }
    *seconds = (bench_seconds_computed() - start) / (double)l->of->steps;
    return code;
}

/* The first round counts, and lets memory grow as far as it will; the others are timed. */
static imp_code run_rounds(loop *l, size_t rounds, columns *x, bench_tally *tally, imp_error *error)
{
    enum { ROUNDS_MAX = 101 };
    double seconds[ROUNDS_MAX];
    const size_t count = rounds < ROUNDS_MAX ? rounds : ROUNDS_MAX;
    imp_code code = run_round(l, x, tally, seconds, error);
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k)
        code = run_round(l, NULL, NULL, &seconds[k], error);
    if (code != IMP_SUCCESS) return code;
    const double median = columns_median(seconds, count);
    for (size_t k = 0; k < x->count; ++k) x->of[SECONDS][k] = median;
    return code;
}

imp_code bench_measure_changes(imp_registry *registry, const bench_case *c, const bench_method *m,
                               const bench_request *request, bench_tally *tally, imp_error *error)
{
    uint64_t state = 25;
    columns x;
    loop l = {registry, c, m->is_rebuilt, (what)c->change, draw(&state), NULL};
    *tally = (bench_tally){.scenes = c->steps, .earliest = NAN, .latest = NAN};
    *error = (imp_error){.code = IMP_ERROR_MEMORY};
    imp_code code = IMP_ERROR_MEMORY;
    if (columns_make(&x, c->steps)) {
        l.scene = build_scene(registry, l.which, &l.begun, error);
        code = l.scene != NULL ? run_rounds(&l, request->repeats, &x, tally, error) : error->code;
    }
    if (code == IMP_SUCCESS) columns_tally(&x, tally);
    imp_scene_free(l.scene);
    columns_free(&x);
    return code;
}

/* --- The set ---------------------------------------------------------------------------------- */

static const bench_method changed = {.name = "set_values", .question = BENCH_CHANGES};
static const bench_method rebuilt = {
    .name = "built anew", .question = BENCH_CHANGES, .is_rebuilt = true};
static const bench_method *const methods[] = {&changed, &rebuilt, NULL};

static exit_status build(bench_cases *list, const bench_request *request)
{
    static const char *const names[] = {[CHANGE_POINTS] = "16 points of a patch",
                                        [CHANGE_MOTION] = "motion of a patch",
                                        [CHANGE_BALL] = "motion of one of 125 balls",
                                        [CHANGE_VERTEX] = "vertex that meets a face",
                                        [CHANGE_VERTEX_OF_CLOTH] = "vertex, face that deforms",
                                        [CHANGE_EDGE] = "edge that meets an edge"};
    for (int k = 0; k < CHANGES; ++k) {
        bench_begin(list, 1e-6, -1, "%s", names[k]);
        if (list->no_memory) break;
        list->cases[list->count - 1].change = k;
        list->cases[list->count - 1].steps = 200;
    }
    return bench_built(list, request);
}

static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    static const char *const keys[] = {[CHANGE_POINTS] = "points_over_built",
                                       [CHANGE_MOTION] = "motion_over_built",
                                       [CHANGE_BALL] = "ball_over_built",
                                       [CHANGE_VERTEX] = "vertex_over_built",
                                       [CHANGE_VERTEX_OF_CLOTH] = "vertex_of_cloth_over_built",
                                       [CHANGE_EDGE] = "edge_over_built"};
    for (size_t k = 0; k < count; ++k) {
        const bench_row *rows = results[k].rows;
        const double ratio = rows[0].tally.seconds.mean / rows[1].tally.seconds.mean;
        findings[k] = (bench_finding){.key = keys[results[k].about->change], .value = ratio};
        snprintf(findings[k].text, sizeof findings[k].text,
                 "%s: changed, asked and answered in %.2f of the time of a scene built anew",
                 results[k].about->name, ratio);
    }
    return count;
}

const bench_set bench_changes = {
    "changes",
    "A scene whose numbers change with each step, by imp_scene_set_values, or built anew by\n"
    "imp_builder, which ratios are against. Times are those of a step: the change, the query and "
    "its answer.",
    methods, build, find};
