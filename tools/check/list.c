/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/list.h"

#include <math.h>
#include <string.h>

#include "tools/check/allocations.h"
#include "tools/check/arguments.h"
#include "tools/check/buffers.h"
#include "tools/check/cost.h"
#include "tools/check/distances.h"
#include "tools/check/domain.h"
#include "tools/check/environment.h"
#include "tools/check/file.h"
#include "tools/check/formulas.h"
#include "tools/check/inclusions.h"
#include "tools/check/nets.h"
#include "tools/check/parts.h"
#include "tools/check/pieces.h"
#include "tools/check/points.h"
#include "tools/check/poses.h"
#include "tools/check/proof.h"
#include "tools/check/purity.h"
#include "tools/check/rates.h"
#include "tools/check/renewal.h"
#include "tools/check/state.h"
#include "tools/check/table.h"
#include "tools/check/tubes.h"

/* One of the three is set. */
typedef struct check {
    const char *name;
    void (*of_file)(const char *file, check_answer *answer);
    void (*of_stage)(imp_registry *registry, const imp_type_info *type, const char *stage,
                     check_answer *answer);
    void (*of_subject)(const subject *s, uint64_t *random, double effort);
    bool of_bounds;
    bool is_repeated_late; /* run again over late and early times, where a type has no end */
} check;

/* To add a check, add a row here and its name below. */
static const check all[] = {
    {.name = "exports", .of_file = exports_check},
    {.name = "factories", .of_file = factories_check},
    {.name = "build", .of_file = build_check},
    {.name = "parameters", .of_stage = parameters_check},
    {.name = "arguments", .of_stage = arguments_check},
    {.name = "renewal", .of_stage = renewal_check},
    {.name = "memory", .of_stage = memory_check},
    {.name = "finite", .of_subject = finite_check},
    {.name = "domain", .of_subject = domain_check},
    {.name = "determinism", .of_subject = determinism_check},
    {.name = "state", .of_stage = state_check},
    {.name = "allocations", .of_subject = allocations_check},
    {.name = "environment", .of_stage = environment_check},
    {.name = "buffers", .of_subject = buffers_check},
    {.name = "pieces", .of_stage = pieces_check},
    {.name = "rates", .of_subject = rates_check, .of_bounds = true, .is_repeated_late = true},
    {.name = "errors", .of_subject = errors_check, .of_bounds = true, .is_repeated_late = true},
    {.name = "inclusions",
     .of_subject = inclusions_check,
     .of_bounds = true,
     .is_repeated_late = true},
    {.name = "nets", .of_subject = nets_check, .of_bounds = true, .is_repeated_late = true},
    {.name = "poses", .of_subject = poses_check, .of_bounds = true, .is_repeated_late = true},
    {.name = "parts", .of_subject = parts_check},
    {.name = "distances", .of_subject = distances_check, .of_bounds = true},
    {.name = "tubes", .of_subject = tubes_check, .of_bounds = true, .is_repeated_late = true},
    {.name = "formula", .of_stage = formula_check},
    {.name = "proof", .of_subject = proof_check, .of_bounds = true},
    {.name = "tightness", .of_subject = tightness_check},
    {.name = "cost", .of_subject = cost_check},
};
const char *const check_names[] = {
    "exports",   "factories", "build",       "parameters", "arguments",   "renewal",     "memory",
    "finite",    "domain",    "determinism", "state",      "allocations", "environment", "buffers",
    "pieces",    "rates",     "errors",      "inclusions", "nets",        "poses",       "parts",
    "distances", "tubes",     "formula",     "proof",      "tightness",   "cost",        NULL};

_Static_assert(sizeof all / sizeof *all + 1 == sizeof check_names / sizeof *check_names,
               "a name for each");

bool check_is_of_file(size_t index) { return all[index].of_file != NULL; }

bool check_is_of_bounds(size_t index) { return all[index].of_bounds; }

#define LATE_EFFORT 0.125

/* --- In the child ----------------------------------------------------------------------------- */

static bool find_type(const imp_registry *registry, const check_task *task, imp_type_info *info)
{
    for (size_t i = 0; imp_registry_type(registry, i, info); ++i)
        if (info->kind == task->kind && strcmp(info->name, task->type) == 0) return true;
    return false;
}

/* Over four units of time, 64 to 1024 after the time 0, or before it. A type whose numbers overflow
 * there is not blamed for that. */
static void check_late(const check *c, const subject *as_usual, uint64_t *random, double effort,
                       bool is_before)
{
    subject s = *as_usual;
    const double time = floor(random_power(random, 6, 10));
    if (s.ends[is_before ? 0 : 1] != (is_before ? -INFINITY : INFINITY)) return;
    s.domain.lo[s.n - 1] = is_before ? -time - 4 : time;
    s.domain.hi[s.n - 1] = is_before ? -time : time + 4;
    const check_answer before = *s.answer;
    c->of_subject(&s, random, LATE_EFFORT * effort);
    if (s.answer->verdict == CHECK_FAIL &&
        (s.answer->faults & (FAULT_VALUE | FAULT_UNBOUNDED)) != 0)
        *s.answer = before;
}

static void check_piece(const check *c, const check_task *task, const imp_registry *registry,
                        const imp_type_info *info, const char *stage, const imp_instance *one,
                        const imp_instance *twin, size_t k, check_answer *answer)
{
    subject s;
    uint64_t random = draw_stream(task->seed, c->name, stage);
    if (!subject_make(&s, one, twin, k, answer)) return;
    s.registry = registry;
    s.type = info;
    s.stage = stage;
    s.formula = task->formula;
    s.said_domain = task->domain;
    s.search = task->search;
    c->of_subject(&s, &random, task->effort);
    for (int is_before = 0; is_before < 2; ++is_before)
        if (c->is_repeated_late && answer->verdict == CHECK_PASS)
            check_late(c, &s, &random, task->effort, is_before);
}

/* Checks the instance itself, or the first, middle and last of its pieces. */
static void check_instances(const check *c, const check_task *task, const imp_registry *registry,
                            const imp_type_info *info, const char *stage, const imp_instance *one,
                            const imp_instance *twin, check_answer *answer)
{
    const size_t count = subject_piece_count(one, answer);
    const size_t piece[3] = {0, count / 2, count > 0 ? count - 1 : 0};
    for (int k = 0; k < 3 && answer->verdict != CHECK_FAIL; ++k)
        if (k == 0 || piece[k] != piece[k - 1])
            check_piece(c, task, registry, info, stage, one, twin, piece[k], answer);
}

static void check_stage(const check *c, const check_task *task, const char *stage,
                        imp_registry *registry, const imp_type_info *info, check_answer *answer)
{
    imp_instance one = {NULL, NULL, NULL}, twin = one;
    const imp_type_kind kind = task->kind;
    imp_error error;
    if (c->of_stage != NULL) {
        c->of_stage(registry, info, stage, answer);
    } else if (subject_create(registry, kind, stage, &one, &error, answer) != IMP_SUCCESS ||
               subject_create(registry, kind, stage, &twin, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
    } else {
        check_instances(c, task, registry, info, stage, &one, &twin, answer);
    }
    subject_destroy(&one, stage, answer);
    subject_destroy(&twin, stage, answer);
}

static void check_type(const check *c, const check_task *task, check_answer *answer)
{
    imp_type_info info;
    imp_registry *registry = imp_registry_from_file(task->file);
    if (registry == NULL || !find_type(registry, task, &info)) {
        answer_fail(answer, "the type is missing when the plugin is loaded again");
        return;
    }
    for (int k = 0; k < CHECK_STAGES && task->stage[k] != NULL; ++k) {
        check_stage(c, task, task->stage[k], registry, &info, answer);
        if (answer->verdict == CHECK_FAIL) {
            answer_prefix(answer, task->stage[k]);
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
    if (c->of_bounds && answer->verdict == CHECK_PASS && answer->tests == 0)
        answer_fail_for(answer, FAULT_UNBOUNDED, "no bound was given that could be compared");
    if (answer->text[0] == '\0')
        answer_pass(answer, "%llu comparisons", (unsigned long long)answer->tests);
}

/* --- Outside ---------------------------------------------------------------------------------- */

child_fate check_run(const check_task *task, double seconds, check_answer *shared)
{
    static char said[sizeof shared->said];
    *shared = (check_answer){.verdict = CHECK_PASS, .stop_at = task->stop_at};
    said[0] = '\0';
    if (task->in_process) work(shared, task);
    const child_fate fate = task->in_process
                                ? (child_fate){CHILD_DONE, 0}
                                : child_run_heard(work, shared, task, seconds, said, sizeof said);
    memcpy(shared->said, said, sizeof said);
    if (fate.end == CHILD_DONE) return fate;
    const char *type = task->type != NULL ? task->type : "the plugin";
    answer_forget(shared);
    shared->blamed = shared->calls;
    answer_fail_for(shared, FAULT_CRASH, "%s %s %s", type, fate_text_of(fate, seconds).text,
                    subject_call_text(&shared->call).text);
    return fate;
}
