/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/job.h"

#include <stdio.h>
#include <string.h>

#include "tools/check/badge.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/progress.h"
#include "tools/cli/verbs.h"

/* The operand, if it has more than a type's name; else NULL. */
static const char *given_stage(const job *j)
{
    const char *type = j->type.name;
    return type[0] != '\0' && strcmp(j->operand, type) != 0 ? j->operand : NULL;
}

static const char *text_or_null(const option_value *value)
{
    return value != NULL ? value->text : NULL;
}

static bool is_wanted(const job *j, size_t check)
{
    return j->only == NULL || strcmp(check_names[check], check_names[j->only->choice]) == 0;
}

/* --- Running ---------------------------------------------------------------------------------- */

/* False after a hang, or a crash in create or destroy: every further check would fail too. */
static bool run_check(job *j, check_task *task, size_t check)
{
    task->check = check;
    progress_show("%s: %s", task->type != NULL ? task->type : j->file->file, check_names[check]);
    const child_fate fate = check_run(task, j->seconds, j->answer);
    progress_wipe();
    report_add(&j->report, check_names[check], check_is_of_bounds(check), j->answer);
    return fate.end == CHILD_DONE || (fate.end != CHILD_LATE && j->answer->call.stage[0] == '\0');
}

static void run_checks(job *j, check_task *task, bool of_file)
{
    bool go_on = true;
    for (size_t k = 0; go_on && check_names[k] != NULL; ++k) {
        if (check_is_of_file(k) != of_file || !is_wanted(j, k)) continue;
        go_on = run_check(j, task, k);
    }
}

static check_task task_of(const job *j)
{
    return (check_task){.file = j->file->file,
                        .search = text_or_null(arguments_option(j->args, "plugin-path")),
                        .seed = j->seed,
                        .effort = j->effort,
                        .in_process = j->in_process,
                        .stop_at = j->stop_at};
}

/* The example in the type's own table does not work: told once, not by every check. */
static void tell_example(job *j, const content_type *t)
{
    *j->answer = (check_answer){.verdict = CHECK_PASS};
    answer_fail(j->answer, "the type's example does not work: %s", t->example_fault);
    report_add(&j->report, "example", false, j->answer);
}

static void run_type(job *j, const content_type *t)
{
    check_task task = task_of(j);
    task.kind = t->kind;
    task.type = t->name;
    task.formula = text_or_null(j->formula);
    task.domain = text_or_null(j->domain);
    for (int k = 0; k < CHECK_STAGES; ++k) task.stage[k] = t->stage[k][0] ? t->stage[k] : NULL;
    if (given_stage(j) != NULL) {
        task.stage[0] = given_stage(j);
        task.stage[1] = NULL;
    }
    report_type(&j->report, t->kind, t->name, task.stage);
    if (t->example_fault[0] != '\0' && given_stage(j) == NULL) tell_example(j, t);
    if (task.stage[0] != NULL) run_checks(j, &task, false);
    report_type_end(&j->report);
}

static bool load(job *j)
{
    const child_fate fate = content_list(j->file->file, j->seconds, j->content);
    const content *c = j->content;
    *j->answer = (check_answer){.verdict = CHECK_PASS};
    if (fate.end != CHILD_DONE)
        answer_fail(j->answer, "the plugin %s when it was loaded or its types were tried",
                    fate_text_of(fate, j->seconds).text);
    else if (!c->is_taken)
        answer_fail(j->answer, "the host rejects it: %s", c->reason);
    else
        answer_pass(j->answer, "%s: %zu type%s", c->plugin, c->count, c->count == 1 ? "" : "s");
    report_add(&j->report, "load", false, j->answer);
    return j->answer->verdict == CHECK_PASS;
}

/* Parameters and formula of the user are read first, so that their errors are not reported as the
 * plugin's. */
static exit_status read_asked(job *j)
{
    const char *speaker = j->args->verb->name, *type = j->type.name;
    const check_task task = {.file = j->file->file,
                             .type = type[0] != '\0' ? type : NULL,
                             .stage = {given_stage(j)},
                             .formula = text_or_null(j->formula),
                             .domain = text_or_null(j->domain)};
    if (task.stage[0] == NULL && task.formula == NULL && task.domain == NULL) return EXIT_ANSWERED;
    check_try(&task, j->seconds, j->misreading);
    if (j->misreading->stage[0] != '\0')
        return complain(EXIT_DATA, speaker, "'%s': %s", j->operand, j->misreading->stage);
    if (j->misreading->formula[0] != '\0')
        return complain(EXIT_USAGE, speaker, "--formula cannot be read: %s",
                        j->misreading->formula);
    if (j->misreading->domain[0] != '\0')
        return complain(EXIT_USAGE, speaker, "--domain cannot be read: %s", j->misreading->domain);
    return EXIT_ANSWERED;
}

/* Writes the badge, and holds the label against the one that is required. */
static exit_status publish(const job *j)
{
    const char *speaker = j->args->verb->name;
    const option_value *badge = arguments_option(j->args, "badge");
    const option_value *required = arguments_option(j->args, "require");
    const badge_facts facts = {j->content->name, j->content->version, text_or_null(j->formula)};
    const char *label = badge_label(j->report.root);
    exit_status status = output_spares_operands(j->args, "badge");
    if (badge != NULL && status == EXIT_ANSWERED)
        status = badge_write(badge->text, j->report.root, &facts, speaker);
    if (status != EXIT_ANSWERED || required == NULL || strcmp(label, "proved") == 0) return status;
    if (required->choice == REQUIRE_TESTED && strcmp(label, "tested") == 0) return status;
    return complain(
        EXIT_CONFORMANCE, speaker, "--require %s: the plugin is %s%s", required->text, label,
        strcmp(label, "tested") == 0 ? ", not proved; state its formula with --formula 'X; Y; Z'"
                                     : "");
}

static exit_status run_all(job *j)
{
    if (!report_begin(&j->report, j->file->file, j->effort))
        return complain_of_memory(j->args->verb->name);
    if (load(j)) {
        check_task task = task_of(j);
        run_checks(j, &task, true);
        for (size_t k = 0; k < j->content->count; ++k)
            if (j->type.name[0] == '\0' || strcmp(j->type.name, j->content->type[k].name) == 0)
                run_type(j, &j->content->type[k]);
    }
    const exit_status found = report_end(&j->report, j->args->verb->name);
    const exit_status published = publish(j);
    report_free(&j->report);
    return found > published ? found : published;
}

exit_status job_run(job *j)
{
    const size_t name = strcspn(j->operand, OPERAND_BLANKS);
    exit_status status;
    if (operand_is_path(j->operand)) {
        status = operand_find_file(j->args, j->operand, j->file);
    } else {
        snprintf(j->type.name, sizeof j->type.name, "%.*s", name < 79 ? (int)name : 79, j->operand);
        status = operand_find_type(j->args, &j->type, j->seconds, j->file);
    }
    if (status == EXIT_ANSWERED) status = read_asked(j);
    return status == EXIT_ANSWERED ? run_all(j) : status;
}
