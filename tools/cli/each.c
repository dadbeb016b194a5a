/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/each.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

/* --- Solving ---------------------------------------------------------------------------------- */

static void take(void *context, size_t index, imp_query *part)
{
    const each *e = context;
    e->answers[index] = imp_query_result(part);
}

exit_status each_begin(each *e, imp_scene *scene, const arguments *args)
{
    imp_error error = {0};
    const imp_options options = query_options(scene, args);
    json_object_seed(0); /* before there are threads */
    *e = (each){.args = args, .scene = scene};
    e->plan = (parts_plan){.whole = imp_query_new(scene, &options, &error),
                           .threads = query_threads(args),
                           .take = take,
                           .context = e};
    if (e->plan.whole == NULL ||
        imp_query_divide(e->plan.whole, &e->plan.count, &error) != IMP_SUCCESS)
        return complain_of(&error, args->verb->name);
    e->answers = calloc(e->plan.count + 1, sizeof *e->answers);
    return e->answers != NULL ? EXIT_ANSWERED : complain_of_memory(args->verb->name);
}

void each_end(each *e)
{
    imp_query_free(e->plan.whole);
    free(e->answers);
}

/* --- Lines ------------------------------------------------------------------------------------ */

/* While lines are printed. What stays clear without a search has the same line for any two bodies but
 * for their names: it is made once, in two halves. */
typedef struct printing {
    const each *e;
    bool json;
    imp_result rest; /* of the divided query */
    char **names;    /* of bodies, as JSON */
    char *head, *tail;
    size_t lines;
    exit_status worst;
} printing;

static json_t *line_json(const each *e, const imp_result *r, json_t *names)
{
    json_t *object = result_json(e->scene, r);
    int failed = json_object_set_new(object, "scene", query_scene_json(e->args));
    failed |= json_object_set_new(object, "bodies", names);
    failed |= json_object_set_new(object, "at_rest", json_boolean(r->at_rest));
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

static exit_status print_json(const printing *p, const imp_result *r, size_t a, size_t b)
{
    const each *e = p->e;
    json_t *names = json_pack("[o,o]", output_json_text(imp_scene_body_name(e->scene, a)),
                              output_json_text(imp_scene_body_name(e->scene, b)));
    char *line = output_json_line(line_json(e, r, names));
    if (line == NULL) return complain_of_memory(e->args->verb->name);
    puts(line);
    free(line);
    return EXIT_ANSWERED;
}

static void print_text(const imp_scene *scene, const imp_result *r, size_t a, size_t b)
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
    printf(": %s, %s\n", imp_scene_body_name(scene, a), imp_scene_body_name(scene, b));
}

static exit_status print_line(printing *p, const imp_result *r, size_t a, size_t b)
{
    enum { LINES_TO_FLUSH = 256 };
    exit_status status = query_status(r, p->e->args);
    if (status > p->worst) p->worst = status;
    status = EXIT_ANSWERED;
    if (!p->json)
        print_text(p->e->scene, r, a, b);
    else if (r == &p->rest)
        printf("%s[%s,%s]%s\n", p->head, p->names[a], p->names[b], p->tail);
    else
        status = print_json(p, r, a, b);
    if (status == EXIT_ANSWERED && ++p->lines % LINES_TO_FLUSH == 0)
        status = output_flush(p->e->args->verb->name);
    return status;
}

/* --- Their order ------------------------------------------------------------------------------ */

typedef struct timed {
    double t;
    size_t part;
} timed;

static int by_time(const void *p, const void *q)
{
    const timed *x = p, *y = q;
    if (x->t != y->t) return x->t < y->t ? -1 : 1;
    return x->part < y->part ? -1 : 1;
}

static exit_status print_timed(printing *p, timed *order)
{
    const each *e = p->e;
    size_t count = 0;
    for (size_t k = 0; k < e->plan.count; ++k)
        if (e->answers[k].verdict != IMP_CLEAR) order[count++] = (timed){e->answers[k].t_lower, k};
    qsort(order, count, sizeof *order, by_time);
    exit_status status = EXIT_ANSWERED;
    for (size_t k = 0; k < count && status == EXIT_ANSWERED; ++k) {
        size_t body[2];
        imp_query_part_bodies(e->plan.whole, order[k].part, body);
        status = print_line(p, &e->answers[order[k].part], body[0], body[1]);
    }
    return status;
}

/* Parts are in the order of the scene. */
static exit_status print_clear(printing *p)
{
    const each *e = p->e;
    const size_t bodies = imp_scene_body_count(e->scene);
    size_t part = 0, of[2];
    exit_status status = EXIT_ANSWERED;
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies && status == EXIT_ANSWERED; ++b) {
            const bool is_part =
                imp_query_part_bodies(e->plan.whole, part, of) && of[0] == a && of[1] == b;
            const imp_result *r = is_part ? &e->answers[part] : &p->rest;
            part += is_part;
            if (is_part ? r->verdict == IMP_CLEAR : !imp_scene_ignores(e->scene, a, b))
                status = print_line(p, r, a, b);
        }
    return status;
}

/* --- All -------------------------------------------------------------------------------------- */

/* The line of the rest in two halves, and the names that go between. */
static bool prepare_json(printing *p)
{
    static const char key[] = "\"bodies\":[]";
    const size_t bodies = imp_scene_body_count(p->e->scene);
    p->names = calloc(bodies + 1, sizeof *p->names);
    p->head = output_json_line(line_json(p->e, &p->rest, json_array()));
    if (p->names == NULL || p->head == NULL) return false;
    p->tail = strstr(p->head, key) + strlen(key); /* in a string its quotes would be escaped */
    p->tail[-2] = '\0';
    for (size_t k = 0; k < bodies; ++k) {
        p->names[k] = output_json_line(output_json_text(imp_scene_body_name(p->e->scene, k)));
        if (p->names[k] == NULL) return false;
    }
    return true;
}

exit_status each_print(const each *e)
{
    const char *speaker = e->args->verb->name;
    printing p = {.e = e,
                  .json = arguments_option(e->args, "json") != NULL,
                  .rest = imp_query_result(e->plan.whole)};
    timed *order = calloc(e->plan.count + 1, sizeof *order);
    exit_status status = order == NULL || (p.json && !prepare_json(&p))
                             ? complain_of_memory(speaker)
                             : EXIT_ANSWERED;
    if (status == EXIT_ANSWERED) status = print_timed(&p, order);
    if (status == EXIT_ANSWERED) status = print_clear(&p);
    if (status == EXIT_ANSWERED) status = output_flush(speaker);
    for (size_t k = 0; p.names != NULL && k < imp_scene_body_count(e->scene); ++k) free(p.names[k]);
    free(p.names);
    free(p.head);
    free(order);
    return status != EXIT_ANSWERED ? status : p.worst;
}

exit_status each_answer(imp_scene *scene, const arguments *args)
{
    each e;
    imp_error error = {0};
    exit_status status = each_begin(&e, scene, args);
    if (status == EXIT_ANSWERED && parts_run(&e.plan, &error) != IMP_SUCCESS)
        status = complain_of(&error, args->verb->name);
    if (status == EXIT_ANSWERED) status = each_print(&e);
    each_end(&e);
    return status;
}
