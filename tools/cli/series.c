/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

const option options_series[] = {
    {.name = "each", .help = "print the first contact of each two bodies, in order of time"},
    {.name = "refine",
     .kind = OPTION_TEXT,
     .argument = "G1,G2,...",
     .help = "answer at each of these ever smaller gammas, from one search"},
    {.name = NULL}};

/* --- Gammas --------------------------------------------------------------------------------- */

/* The number at *text, which is moved behind it and a comma; NAN: there is none that is allowed. */
static double next_gamma(const char **text, double before)
{
    char *end;
    const double gamma = strtod(*text, &end);
    const bool ends = *end == '\0' || (*end == ',' && end[1] != '\0');
    if (end == *text || !ends || !(gamma > 0 && gamma < before)) return NAN;
    *text = *end == ',' ? end + 1 : end;
    return gamma;
}

exit_status series_check(const arguments *args, bool *asked)
{
    const char *speaker = args->verb->name;
    const option_value *refine = arguments_option(args, "refine");
    const bool each = arguments_option(args, "each") != NULL;
    *asked = each || refine != NULL;
    if (refine == NULL) return EXIT_ANSWERED;
    if (each) return complain(EXIT_USAGE, speaker, "--each and --refine exclude each other");
    const char *const excluded[] = {"gamma", "clearance"};
    for (int k = 0; k < 2; ++k)
        if (arguments_option(args, excluded[k]) != NULL)
            return complain(EXIT_USAGE, speaker, "--refine and --%s exclude each other",
                            excluded[k]);
    double gamma = INFINITY;
    const char *text = refine->text;
    do {
        gamma = next_gamma(&text, gamma);
        if (isnan(gamma))
            return complain(EXIT_USAGE, speaker,
                            "--refine must be numbers above 0 with commas between, each smaller "
                            "than the one before, not '%s'",
                            refine->text);
    } while (*text != '\0');
    return EXIT_ANSWERED;
}

/* --- Each two bodies ------------------------------------------------------------------------ */

typedef struct series {
    const arguments *args;
    const imp_scene *scene;
    imp_query *query;
    bool json;
    bool *told; /* body a, body b: at a * bodies + b */
    size_t bodies;
    exit_status worst; /* that answers have earned */
} series;

static void earn(series *s, const imp_result *r)
{
    const exit_status status = query_status(r, s->args);
    if (status > s->worst) s->worst = status;
}

static json_t *pair_json(const series *s, const imp_result *r, size_t a, size_t b)
{
    json_t *object = result_json(s->scene, r);
    json_t *names = json_pack("[o,o]", output_json_text(imp_scene_body_name(s->scene, a)),
                              output_json_text(imp_scene_body_name(s->scene, b)));
    int failed = json_object_set_new(object, "scene", query_scene_json(s->args));
    failed |= json_object_set_new(object, "bodies", names);
    failed |= json_object_set_new(object, "at_rest", json_boolean(r->at_rest));
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

static void print_pair(const series *s, const imp_result *r, size_t a, size_t b)
{
    if (r->verdict == IMP_CONTACT && r->at_rest)
        printf("overlap at rest, all the time");
    else if (r->verdict == IMP_CONTACT)
        printf("contact at t = %s", output_number_lower(r->t).text);
    else if (r->verdict == IMP_CLEAR)
        printf("clear");
    else
        printf("undecided from t = %s (%s)", output_number_lower(r->t_lower).text,
               result_excuse(r->reason).why);
    printf(": %s, %s\n", imp_scene_body_name(s->scene, a), imp_scene_body_name(s->scene, b));
}

static exit_status tell_pair(series *s, const imp_result *r, size_t a, size_t b)
{
    earn(s, r);
    s->told[a * s->bodies + b] = true;
    if (s->json) return output_json(pair_json(s, r, a, b), s->args->verb->name);
    print_pair(s, r, a, b);
    return output_flush(s->args->verb->name);
}

/* The last result holds for all that is left. */
static exit_status tell_rest(series *s, const imp_result *r)
{
    exit_status status = EXIT_ANSWERED;
    for (size_t a = 0; a < s->bodies; ++a)
        for (size_t b = a + 1; b < s->bodies && status == EXIT_ANSWERED; ++b)
            if (!s->told[a * s->bodies + b] && !imp_scene_ignores(s->scene, a, b))
                status = tell_pair(s, r, a, b);
    return status;
}

static exit_status answer_each(series *s)
{
    imp_error error = {0};
    imp_result r;
    for (;;) {
        if (query_run(s->query, &r, &error) != IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
        if (r.verdict != IMP_CONTACT && r.reason != IMP_REASON_RESOLUTION) break;
        const exit_status status = tell_pair(s, &r, r.a.body, r.b.body);
        if (status != EXIT_ANSWERED) return status;
        if (imp_query_pass(s->query, &error) != IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
    }
    return tell_rest(s, &r);
}

/* --- Finer and finer -------------------------------------------------------------------------- */

static exit_status answer_refined(series *s)
{
    imp_error error = {0};
    const char *text = arguments_option(s->args, "refine")->text;
    next_gamma(&text, INFINITY);
    for (;;) {
        imp_result r;
        if (query_run(s->query, &r, &error) != IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
        const exit_status status = query_print(s->scene, &r, s->args);
        if (status != EXIT_ANSWERED) return status;
        s->worst = query_status(&r, s->args);
        if (r.verdict == IMP_UNDECIDED || *text == '\0') return EXIT_ANSWERED;
        if (imp_query_refine(s->query, next_gamma(&text, INFINITY), -1, &error) != IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
    }
}

/* --- Either ------------------------------------------------------------------------------------ */

exit_status series_answer(imp_scene *scene, const arguments *args)
{
    imp_error error = {0};
    const option_value *refine = arguments_option(args, "refine");
    imp_options options = query_options(scene, args);
    if (refine != NULL) {
        const char *text = refine->text;
        options.gamma = next_gamma(&text, INFINITY);
        options.clearance = -1;
    }
    series s = {.args = args,
                .scene = scene,
                .json = arguments_option(args, "json") != NULL,
                .bodies = imp_scene_body_count(scene)};
    s.told = calloc(s.bodies * s.bodies + 1, sizeof *s.told);
    if (s.told == NULL) return complain_of_memory(args->verb->name);
    s.query = imp_query_new(scene, &options, &error);
    exit_status status = EXIT_ANSWERED;
    if (s.query == NULL)
        status = complain_of(&error, args->verb->name);
    else
        status = refine != NULL ? answer_refined(&s) : answer_each(&s);
    imp_query_free(s.query);
    free(s.told);
    return status != EXIT_ANSWERED ? status : s.worst;
}
