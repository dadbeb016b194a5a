/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/scene_info.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/common/clock.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

bool scene_info_is_asked(const char *operand)
{
    static const char ending[] = ".json";
    const size_t length = strlen(operand), tail = sizeof ending - 1;
    return strcmp(operand, "-") == 0 ||
           (length > tail && strcmp(operand + length - tail, ending) == 0);
}

/* --- One body --------------------------------------------------------------------------------- */

size_t scene_info_pieces(const imp_scene *scene, size_t body)
{
    size_t count = 0;
    for (size_t k = 0; k < imp_scene_surface_count(scene, body); ++k)
        count += imp_scene_piece_count(scene, body, k);
    return count;
}

/* `context`: when to end, a double on clock_seconds' clock. */
static bool goes_on(void *context)
{
    return !interrupt_came() && clock_seconds() < *(const double *)context;
}

static bool has_place(const imp_closure *c)
{
    return c->verdict == IMP_CLOSURE_OPEN || c->verdict == IMP_CLOSURE_ONE_SIDED;
}

static const char *verdict_name(imp_closure_verdict verdict)
{
    static const char *const names[] = {
        [IMP_CLOSURE_CLOSED] = "closed",       [IMP_CLOSURE_OPEN] = "open",
        [IMP_CLOSURE_ONE_SIDED] = "one-sided", [IMP_CLOSURE_UNBOUNDED] = "unbounded",
        [IMP_CLOSURE_EMPTY] = "empty",         [IMP_CLOSURE_STOPPED] = "cancelled"};
    return names[verdict];
}

static json_t *body_json(const imp_scene *scene, size_t body, const imp_closure *c)
{
    return json_pack("{s:o, s:I, s:I, s:b, s:s, s:I, s:o*, s:o*, s:o*}", "name",
                     output_json_text(imp_scene_body_name(scene, body)), "surfaces",
                     (json_int_t)imp_scene_surface_count(scene, body), "pieces",
                     (json_int_t)scene_info_pieces(scene, body), "solid",
                     imp_scene_is_solid(scene, body), "closure", verdict_name(c->verdict), "shells",
                     (json_int_t)c->shells, "surface",
                     has_place(c) ? json_integer((json_int_t)c->at.surface) : NULL, "piece",
                     has_place(c) ? json_integer((json_int_t)c->at.piece) : NULL, "where",
                     has_place(c) ? result_vector_json(c->where) : NULL);
}

static void print_body(const imp_scene *scene, size_t body, const imp_closure *c)
{
    const size_t surfaces = imp_scene_surface_count(scene, body);
    const size_t pieces = scene_info_pieces(scene, body);
    printf("%s: %zu surface%s", imp_scene_body_name(scene, body), surfaces,
           surfaces == 1 ? "" : "s");
    if (pieces != surfaces) printf(" of %zu pieces", pieces);
    printf(", %s%s", imp_scene_is_solid(scene, body) ? "solid, " : "", verdict_name(c->verdict));
    if (c->verdict == IMP_CLOSURE_UNBOUNDED) printf(": it reaches farther than 1e50");
    if (c->shells > 1) printf(" (%zu shells)", c->shells);
    if (has_place(c))
        printf(" at (%g, %g, %g), an edge of surface %zu, piece %zu", c->where[0], c->where[1],
               c->where[2], c->at.surface, c->at.piece);
    putchar('\n');
}

/* --- Parameters ------------------------------------------------------------------------------- */

/* Returns the names of the bodies that follow it. NULL: no memory. */
static json_t *followers_json(const imp_scene *scene, size_t parameter)
{
    json_t *names = json_array();
    for (size_t body = 0; names != NULL && body < imp_scene_body_count(scene); ++body)
        if (imp_scene_follows(scene, body, parameter))
            json_array_append_new(names, output_json_text(imp_scene_body_name(scene, body)));
    return names;
}

static json_t *parameters_json(const imp_scene *scene)
{
    imp_scene_parameter_info info;
    json_t *list = json_array();
    for (size_t k = 0; list != NULL && imp_scene_parameter(scene, k, &info); ++k)
        json_array_append_new(list,
                              json_pack("{s:o, s:o, s:o}", "name", output_json_text(info.name),
                                        "range", result_times_json(info.lo, info.hi), "followed_by",
                                        followers_json(scene, k)));
    return list;
}

static void print_parameters(const imp_scene *scene)
{
    imp_scene_parameter_info info;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k) {
        const char *before = "followed by ";
        printf("parameter %s: from %.10g to %.10g, ", message_shown(info.name).text, info.lo,
               info.hi);
        for (size_t body = 0; body < imp_scene_body_count(scene); ++body) {
            if (!imp_scene_follows(scene, body, k)) continue;
            printf("%s%s", before, imp_scene_body_name(scene, body));
            before = ", ";
        }
        puts(before[0] == 'f' ? "followed by no surface" : "");
    }
}

/* --- All -------------------------------------------------------------------------------------- */

static exit_status print_bodies(const imp_scene *scene, const arguments *args, json_t *list)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_options options = {.struct_size = (uint32_t)sizeof options};
    if (imp_options_get_default(scene, &options, &error) != IMP_SUCCESS)
        return complain_of(&error, args->verb->name);
    const double limit = query_options(scene, args).max_seconds;
    double until = limit > 0 ? clock_seconds() + limit : INFINITY;
    for (size_t body = 0; body < imp_scene_body_count(scene); ++body) {
        imp_closure c = {.struct_size = (uint32_t)sizeof c};
        if (imp_scene_get_closure(scene, body, options.t_start, options.gamma, NULL, goes_on,
                                  &until, &c, &error) != IMP_SUCCESS)
            return complain_of(&error, args->verb->name);
        if (c.verdict == IMP_CLOSURE_STOPPED && !interrupt_came())
            return complain(EXIT_UNDECIDED, args->verb->name,
                            "--max-seconds was over before it was known whether '%s' is closed; "
                            "allow more (0: no limit)",
                            imp_scene_body_name(scene, body));
        if (list == NULL)
            print_body(scene, body, &c);
        else if (json_array_append_new(list, body_json(scene, body, &c)) != 0)
            return complain_of_memory(args->verb->name);
    }
    return EXIT_ANSWERED;
}

exit_status scene_info_print(imp_registry *registry, const arguments *args)
{
    imp_error error = {IMP_SUCCESS, ""};
    bool complained = false;
    imp_scene *scene = query_scene(registry, args, &complained, &error);
    if (scene == NULL) return complained ? EXIT_DATA : complain_of(&error, args->verb->name);
    query_warn(scene, args);
    json_t *list = arguments_option(args, "json") != NULL ? json_array() : NULL;
    exit_status status = print_bodies(scene, args, list);
    json_t *parameters = NULL;
    if (list == NULL)
        print_parameters(scene);
    else if (imp_scene_parameter_count(scene) > 0)
        parameters = parameters_json(scene);
    imp_scene_free(scene);
    if (list != NULL && status == EXIT_ANSWERED)
        return output_json(json_pack("{s:o, s:o*}", "bodies", list, "parameters", parameters),
                           args->verb->name);
    json_decref(parameters);
    json_decref(list);
    return status;
}
