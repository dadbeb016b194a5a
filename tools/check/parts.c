/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/parts.h"

#include <libgen.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/capabilities.h"
#include "tools/check/values.h"
#include "tools/cli/query.h"

enum { POINTS = 16, TIMES = 8, DRAWS = 40, CLOCKS_MAX = 64, NAME_MAX_LENGTH = 63 };

/* Points under the parts of a map, in a scene. */
typedef struct parted {
    const subject *s; /* the map as one, of the same parameters */
    const char *stage;
    imp_scene *scene;
    double point[POINTS][3];
    size_t clocks;
    double lo[CLOCKS_MAX], hi[CLOCKS_MAX];
} parted;

/* --- The scene -------------------------------------------------------------------------------- */

/* Returns all types: those beside the plugin first. NULL: no memory. */
static imp_registry *all_types(const subject *s)
{
    char *file = strdup(s->type->file), *path = NULL;
    imp_registry *registry = NULL;
    const bool given = s->search != NULL;
    if (file != NULL &&
        asprintf(&path, "%s%s%s", dirname(file), given ? ":" : "", given ? s->search : "") >= 0) {
        registry = query_registry_first(path, 0, "check");
        free(path);
    }
    free(file);
    return registry;
}

/* Returns a body of points under the map. Free it. NULL: no memory. */
static char *scene_text(const parted *p)
{
    char *text = NULL, *map = imp_stage_to_json(p->s->registry, IMP_TYPE_MAP, p->stage, NULL);
    size_t size = 0;
    FILE *out = map != NULL ? open_memstream(&text, &size) : NULL;
    if (out != NULL) {
        fputs("{\"bodies\":[{\"surfaces\":[", out);
        for (int k = 0; k < POINTS; ++k)
            fprintf(out, "%s{\"type\":\"point\",\"position\":[%.17g,%.17g,%.17g]}",
                    k > 0 ? "," : "", p->point[k][0], p->point[k][1], p->point[k][2]);
        fprintf(out, "],\"maps\":[%s]}]}", map);
        if (fclose(out) != 0) {
            free(text);
            text = NULL;
        }
    }
    free(map);
    return text;
}

/* The scene is to be freed in any case. */
static bool make_scene(parted *p, imp_registry *types, uint64_t *random)
{
    imp_error error = {.code = IMP_ERROR_MEMORY, .text = "memory ran out"};
    imp_scene_parameter_info info;
    for (int k = 0; k < POINTS; ++k)
        for (int i = 0; i < 3; ++i)
            p->point[k][i] = random_between(random, p->s->domain.lo[i], p->s->domain.hi[i]);
    char *text = scene_text(p);
    if (text != NULL)
        p->scene = imp_scene_from_json(types, text, strlen(text), "a scene of its parts", &error);
    free(text);
    if (p->scene == NULL)
        return answer_fail(p->s->answer, "'%.200s' cannot be used in a scene: %s", p->stage,
                           error.text);
    while (p->clocks < CLOCKS_MAX && imp_scene_parameter(p->scene, p->clocks, &info)) {
        p->lo[p->clocks] = info.lo;
        p->hi[p->clocks++] = info.hi;
    }
    return true;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* "tolerance#1 = 0.5, ..." */
static subject_text values_text(const parted *p, const double *values)
{
    subject_text to = {.text = "no values"};
    imp_scene_parameter_info info;
    size_t used = 0;
    for (size_t k = 0; k < p->clocks && used < sizeof to.text; ++k)
        if (imp_scene_parameter(p->scene, k, &info))
            used += (size_t)snprintf(to.text + used, sizeof to.text - used, "%s%s = %.17g",
                                     k > 0 ? ", " : "", info.name, values[k]);
    return to;
}

/* Evaluates point k in a scene at some values. */
static bool point_at(const parted *p, imp_scene *at, const double *values, size_t k, double t,
                     double x[3], double inexact[3])
{
    const double place[3] = {0, 0, t};
    imp_error error = {.code = IMP_SUCCESS};
    const imp_code code = imp_scene_eval(at, 0, k, 1, place, x, inexact, &error);
    ++p->s->answer->tests;
    if (code == IMP_SUCCESS && isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2])) return true;
    return answer_fail(
        p->s->answer, "a point cannot be evaluated under the parts of '%.200s' at %s: %s", p->stage,
        values_text(p, values).text, code == IMP_SUCCESS ? "it is not finite" : error.text);
}

/* Rounding of the clocks' middles moves points by less than this part of their coordinates. */
#define MIDDLE_SLACK 1e-12

static bool judge_point(const parted *p, imp_scene *at, const double *values, size_t k, double t)
{
    const double *from = p->point[k], place[4] = {from[0], from[1], from[2], t};
    double x[3], y[3], inexact[3], error[3];
    if (!point_at(p, at, values, k, t, x, inexact)) return false;
    if (!subject_eval_sane(p->s, 1, place, y, error)) return false;
    for (int i = 0; i < 3; ++i) {
        const double slack =
            inexact[i] + error[i] + MIDDLE_SLACK * (1 + fabs(x[i]) + fabs(from[i]));
        if (fabs(x[i] - y[i]) <= slack) continue;
        return answer_fail(p->s->answer,
                           "the parts of '%.200s', with each clock in the middle of its range and "
                           "those left out that stay at 0, move %s to %c = %.9g, eval to %.9g",
                           p->stage, subject_point_text(4, place).text, "xyz"[i], x[i], y[i]);
    }
    return true;
}

/* Makes the scene at values; NULL: the check has failed. */
static imp_scene *pose(const parted *p, const double *values)
{
    imp_error error;
    imp_scene *at = imp_scene_at(p->scene, values, &error);
    if (at == NULL)
        answer_fail(p->s->answer, "'%.200s' has no parts at %s: %s", p->stage,
                    values_text(p, values).text, error.text);
    return at;
}

static bool judge_middle(const parted *p, uint64_t *random)
{
    double values[CLOCKS_MAX];
    bool good = true;
    for (size_t k = 0; k < p->clocks; ++k) values[k] = 0.5 * p->lo[k] + 0.5 * p->hi[k];
    imp_scene *at = pose(p, values);
    for (int n = 0; n < TIMES && at != NULL && good; ++n) {
        const double t = random_between(random, p->s->domain.lo[3], p->s->domain.hi[3]);
        for (size_t k = 0; k < POINTS && good; ++k) good = judge_point(p, at, values, k, t);
    }
    imp_scene_free(at);
    return at != NULL && good;
}

/* Evaluates points at ends of the ranges and between them. */
static bool judge_ranges(const parted *p, uint64_t *random, int draws)
{
    bool good = true;
    for (int n = 0; n < draws && good; ++n) {
        double values[CLOCKS_MAX], x[3], inexact[3];
        for (size_t k = 0; k < p->clocks; ++k) {
            const uint64_t kind = random_bits(random) % 3;
            values[k] = kind == 0   ? p->lo[k]
                        : kind == 1 ? p->hi[k]
                                    : random_between(random, p->lo[k], p->hi[k]);
        }
        imp_scene *at = pose(p, values);
        if (at == NULL) return false;
        const double t = random_between(random, p->s->domain.lo[3], p->s->domain.hi[3]);
        for (size_t k = 0; k < POINTS && good; ++k)
            good = point_at(p, at, values, k, t, x, inexact);
        imp_scene_free(at);
    }
    return good;
}

/* --- Parameters that are 0 -------------------------------------------------------------------- */

static bool judge(const subject *s, const char *stage, imp_registry *types, uint64_t *random,
                  double effort)
{
    parted p = {.s = s, .stage = stage};
    const int draws = effort > 1 ? (int)(effort * DRAWS) : DRAWS;
    const bool good = make_scene(&p, types, random) && judge_middle(&p, random) &&
                      judge_ranges(&p, random, draws);
    imp_scene_free(p.scene);
    return good;
}

/* Judges a stage of other values, unless create refuses them; *taken: it does not. */
static bool judge_stage(const subject *s, const char *stage, imp_registry *types, uint64_t *random,
                        double effort, bool *taken)
{
    imp_instance made;
    imp_error error;
    imp_registry *own = imp_registry_from_file(s->type->file);
    bool good = true;
    *taken = own != NULL &&
             subject_create(own, IMP_TYPE_MAP, stage, &made, &error, s->answer) == IMP_SUCCESS;
    if (*taken) {
        subject with = *s;
        with.instance = with.twin = &made;
        good = judge(&with, stage, types, random, effort);
        subject_destroy(&made, stage, s->answer);
    }
    imp_registry_free(own);
    return good;
}

/* Reads the next $NAME; NULL: there is none. */
static const char *next_name(const char *text, char name[NAME_MAX_LENGTH + 1])
{
    const char *at = strchr(text, '$');
    if (at == NULL) return NULL;
    const size_t length = strspn(at + 1, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789_");
    snprintf(name, NAME_MAX_LENGTH + 1, "%.*s", (int)length, at + 1);
    return at + 1 + length;
}

/* With each parameter 0 that the parts name, and with all of them 0 that may be. */
static bool judge_zeros(const subject *s, imp_registry *types, uint64_t *random, double effort)
{
    char name[NAME_MAX_LENGTH + 1];
    char *all = strdup(s->stage);
    bool good = true, taken;
    for (const char *at = next_name(s->instance->map->parts, name);
         at != NULL && good && all != NULL; at = next_name(at, name)) {
        char *one = stage_with(s->registry, IMP_TYPE_MAP, s->stage, name, "0");
        char *more = stage_with(s->registry, IMP_TYPE_MAP, all, name, "0");
        if (one != NULL && more != NULL)
            good = judge_stage(s, one, types, random, effort, &taken) &&
                   judge_stage(s, more, types, random, effort, &taken);
        if (good && more != NULL && taken) {
            free(all);
            all = more;
            more = NULL;
        }
        free(one);
        free(more);
    }
    free(all);
    return good;
}

void parts_check(const subject *s, uint64_t *random, double effort)
{
    if (!map_type_offers(s->instance->map, CAPABILITY_PARTS)) {
        answer_skip(s->answer, "the type has no parts");
        return;
    }
    imp_registry *types = all_types(s);
    if (types == NULL) {
        answer_skip(s->answer, "no memory for a registry");
        return;
    }
    if (judge(s, s->stage, types, random, effort)) judge_zeros(s, types, random, effort);
    imp_registry_free(types);
}
