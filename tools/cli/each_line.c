/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/each_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

/* Returns the advice about the part that has this answer, or NULL. */
static const char *advice_of(const each *e, const imp_result *r)
{
    const printing *p = e->printing;
    return r != &p->rest && r != &p->unknown ? e->advice[r - e->answers] : NULL;
}

/* Whether a survey has answered it. */
static bool has_values(const each *e, const imp_result *r)
{
    const printing *p = e->printing;
    return e->survey != NULL && r != &p->rest && r != &p->unknown;
}

static json_t *line_json(const each *e, const imp_result *r, json_t *names)
{
    json_t *object = result_json(e->scene, r);
    int failed = json_object_set_new(object, "scene", query_scene_json(e->args));
    failed |= json_object_set_new(object, "bodies", names);
    failed |= json_object_set_new(object, "at_rest", json_boolean(r->at_rest));
    failed |= object == NULL || !result_set_advice(object, advice_of(e, r));
    if (has_values(e, r))
        failed |= survey_parts_set_json(object, e->survey, (size_t)(r - e->answers));
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

static void print_text(const each *e, const imp_result *r, size_t a, size_t b)
{
    const imp_scene *scene = e->scene;
    if (r->verdict == IMP_VERDICT_CONTACT && r->at_rest)
        printf("overlap at rest, all the time");
    else if (r->verdict == IMP_VERDICT_CONTACT)
        printf("contact at t = %s", output_number_lower(r->t).text);
    else if (r->verdict == IMP_VERDICT_CLEAR)
        printf("clear from t = %.10g to %.10g", r->t_start, r->t_end);
    else
        printf("undecided from t = %s (%s)", output_number_lower(r->t_lower).text,
               result_excuse(r->reason).why);
    printf(": %s, %s", imp_scene_body_name(scene, a), imp_scene_body_name(scene, b));
    if (has_values(e, r)) survey_parts_print_values(e->survey, (size_t)(r - e->answers));
    putchar('\n');
}

/* Prints advice under its line, once where lines that follow each other have the same. */
static void print_advice(printing *p, const char *advice)
{
    if (advice == NULL || (p->advised != NULL && strcmp(p->advised, advice) == 0)) return;
    result_print_label("advice");
    puts(advice);
    p->advised = advice;
}

exit_status each_print_line(printing *p, const imp_result *r, size_t a, size_t b)
{
    enum { LINES_TO_FLUSH = 256 };
    exit_status status = query_status(r, p->e->args);
    if (status > p->worst) p->worst = status;
    status = EXIT_ANSWERED;
    if (!p->json) {
        print_text(p->e, r, a, b);
        print_advice(p, advice_of(p->e, r));
    } else if (r == &p->rest) {
        printf("%s[%s,%s]%s\n", p->head, p->names[a], p->names[b], p->tail);
    } else {
        status = print_json(p, r, a, b);
    }
    if (status == EXIT_ANSWERED && ++p->lines % LINES_TO_FLUSH == 0)
        status = output_flush(p->e->args->verb->name);
    return status;
}

bool each_prepare_lines(printing *p)
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
