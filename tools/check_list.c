/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "check_list.h"

#include <stdio.h>
#include <string.h>

#include "check_cost.h"
#include "check_file.h"
#include "check_inclusions.h"
#include "check_points.h"
#include "check_proof.h"
#include "check_purity.h"
#include "check_rates.h"
#include "check_said.h"
#include "check_table.h"

/* One of the three is set. */
typedef struct check {
    const char *name;
    void (*of_file)(const char *file, check_answer *answer);
    void (*of_stage)(imp_registry *registry, const imp_type_info *type, const char *stage,
                     check_answer *answer);
    void (*of_subject)(const subject *s, uint64_t *random, double effort);
    bool of_bounds;
} check;

/* Add a check: a row here, its name below. */
static const check all[] = {
    {.name = "exports", .of_file = exports_check},
    {.name = "factories", .of_file = factories_check},
    {.name = "parameters", .of_stage = parameters_check},
    {.name = "memory", .of_stage = memory_check},
    {.name = "finite", .of_subject = finite_check},
    {.name = "determinism", .of_subject = determinism_check},
    {.name = "environment", .of_subject = environment_check},
    {.name = "buffers", .of_subject = buffers_check},
    {.name = "errors", .of_subject = errors_check, .of_bounds = true},
    {.name = "rates", .of_subject = rates_check, .of_bounds = true},
    {.name = "inclusions", .of_subject = inclusions_check, .of_bounds = true},
    {.name = "proof", .of_subject = proof_check, .of_bounds = true},
    {.name = "tightness", .of_subject = tightness_check},
    {.name = "cost", .of_subject = cost_check},
};
const char *const check_names[] = {"exports",     "factories",   "parameters", "memory", "finite",
                                   "determinism", "environment", "buffers",    "errors", "rates",
                                   "inclusions",  "proof",       "tightness",  "cost",   NULL};

_Static_assert(sizeof all / sizeof *all + 1 == sizeof check_names / sizeof *check_names,
               "a name for each");

bool check_is_of_file(size_t check) { return all[check].of_file != NULL; }

bool check_is_of_bounds(size_t check) { return all[check].of_bounds; }

/* --- In the child ------------------------------------------------------------------------- */

static bool find_type(const imp_registry *registry, const check_task *task, imp_type_info *info)
{
    for (size_t i = 0; imp_registry_type(registry, i, info); ++i)
        if (info->sort == task->sort && strcmp(info->name, task->type) == 0) return true;
    return false;
}

static void check_instances(const check *c, const check_task *task, const imp_type_info *info,
                            const char *stage, const imp_instance *one, const imp_instance *twin,
                            check_answer *answer)
{
    subject s;
    uint64_t random = draw_stream(task->seed, c->name, stage);
    if (!subject_make(&s, one, twin, answer)) return;
    s.type = info;
    s.stage = stage;
    s.formula = task->formula;
    c->of_subject(&s, &random, task->effort);
}

static void check_stage(const check *c, const check_task *task, const char *stage,
                        imp_registry *registry, const imp_type_info *info, check_answer *answer)
{
    imp_instance one = {NULL, NULL, NULL}, twin = one;
    imp_error error;
    if (c->of_stage != NULL) {
        c->of_stage(registry, info, stage, answer);
    } else if (imp_instance_from_text(registry, task->sort, stage, &one, &error) != IMP_SUCCESS ||
               imp_instance_from_text(registry, task->sort, stage, &twin, &error) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
    } else {
        check_instances(c, task, info, stage, &one, &twin, answer);
    }
    imp_instance_free(&one);
    imp_instance_free(&twin);
}

/* Puts in front which stage it was that failed. */
static void name_stage(check_answer *answer, const char *stage)
{
    char text[sizeof answer->text];
    memcpy(text, answer->text, sizeof text);
    snprintf(answer->text, sizeof answer->text, "%.200s: %.1390s", stage, text);
}

static void check_type(const check *c, const check_task *task, check_answer *answer)
{
    imp_type_info info;
    imp_registry *registry = imp_registry_from_file(task->file);
    if (registry == NULL || !find_type(registry, task, &info)) {
        answer_fail(answer, "the type is not found again");
        return;
    }
    for (int k = 0; k < CHECK_STAGES && task->stage[k] != NULL; ++k) {
        check_stage(c, task, task->stage[k], registry, &info, answer);
        if (answer->verdict == CHECK_FAIL) {
            name_stage(answer, task->stage[k]);
            return;
        }
    }
    imp_registry_free(registry);
}

static void work(void *result, const void *data)
{
    const check_task *task = data;
    const check *c = &all[task->check];
    check_answer *answer = result;
    if (c->of_file != NULL)
        c->of_file(task->file, answer);
    else
        check_type(c, task, answer);
    if (answer->text[0] == '\0')
        answer_pass(answer, "%llu comparisons", (unsigned long long)answer->tests);
}

/* --- Outside -------------------------------------------------------------------------------- */

void check_run(const check_task *task, double seconds, check_answer *shared)
{
    *shared = (check_answer){.verdict = CHECK_PASS};
    const child_fate fate = child_run(work, shared, task, seconds);
    if (fate.end == CHILD_DONE) return;
    const char *type = task->type != NULL ? task->type : "the plugin";
    shared->verdict = CHECK_PASS;
    answer_fail(shared, "%s %s %s", type, child_fate_text(fate, seconds).text,
                subject_call_text(&shared->call).text);
}

/* --- What was asked for --------------------------------------------------------------------------
 */

static void try_type(const check_task *task, imp_registry *registry, const imp_type_info *info,
                     check_misreading *m)
{
    const char *stage = task->stage[0] != NULL ? task->stage[0] : info->example;
    imp_instance made = {NULL, NULL, NULL};
    imp_error error;
    const imp_code code = imp_instance_from_text(registry, info->sort, stage, &made, &error);
    if (code == IMP_ERROR_SCENE && task->stage[0] != NULL)
        snprintf(m->stage, sizeof m->stage, "%s", error.text);
    else if (task->formula != NULL)
        formula_free(said_formula(info, stage, task->formula, m->formula, sizeof m->formula));
    imp_instance_free(&made);
}

static void try_work(void *result, const void *data)
{
    const check_task *task = data;
    imp_type_info info;
    imp_registry *registry = imp_registry_from_file(task->file);
    for (size_t i = 0; registry != NULL && imp_registry_type(registry, i, &info); ++i)
        if (task->type == NULL || strcmp(info.name, task->type) == 0)
            try_type(task, registry, &info, result);
    imp_registry_free(registry);
}

void check_try(const check_task *task, double seconds, check_misreading *shared)
{
    memset(shared, 0, sizeof *shared);
    child_run(try_work, shared, task, seconds); /* if the plugin fails here, its checks tell */
}

/* --- Survey --------------------------------------------------------------------------------- */

static bool works(imp_registry *registry, imp_type_sort sort, const char *stage)
{
    imp_instance made = {NULL, NULL, NULL};
    imp_error error;
    if (imp_instance_from_text(registry, sort, stage, &made, &error) != IMP_SUCCESS) return false;
    imp_instance_free(&made);
    return true;
}

/* The example, whether it works or not, and the type's name alone if that does. */
static void survey_one(imp_registry *registry, const imp_type_info *info, survey_type *t)
{
    t->sort = info->sort;
    snprintf(t->name, sizeof t->name, "%s", info->name);
    snprintf(t->stage[0], sizeof t->stage[0], "%s", info->example);
    if (strcmp(info->example, info->name) != 0 && works(registry, info->sort, info->name))
        snprintf(t->stage[1], sizeof t->stage[1], "%s", info->name);
}

static void survey_work(void *result, const void *data)
{
    survey *s = result;
    imp_type_info info;
    imp_plugin_refusal refusal = {NULL, "memory ran out"};
    imp_registry *registry = imp_registry_from_file(data);
    if (registry == NULL || imp_registry_refusal(registry, 0, &refusal)) {
        snprintf(s->reason, sizeof s->reason, "%s", refusal.reason);
        return;
    }
    for (size_t i = 0; i < SURVEY_TYPES && imp_registry_type(registry, i, &info); ++i)
        survey_one(registry, &info, &s->type[s->count++]);
    if (s->count > 0)
        snprintf(s->plugin, sizeof s->plugin, "%s %s, %s", info.plugin, info.version, info.license);
    s->is_taken = true;
    imp_registry_free(registry);
}

child_fate check_survey(const char *file, double seconds, survey *shared)
{
    memset(shared, 0, sizeof *shared);
    return child_run(survey_work, shared, file, seconds);
}
