/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/child.h"
#include "core/common/system_error.h"
#include "core/plugin/load_probe.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

enum { DEADLINE_SECONDS = 5 };

typedef struct probe_task {
    const char *path;
    load_attempt *attempt;
} probe_task;

void load_outcome_refuse(load_outcome *outcome, load_step step, const char *check,
                         const char *format, ...)
{
    outcome->code = IMP_ERROR_PLUGIN;
    outcome->step = step;
    snprintf(outcome->check, sizeof outcome->check, "%s", check);
    if (format == NULL) return;
    va_list arguments;
    va_start(arguments, format);
    error_set_v(&outcome->error, IMP_ERROR_PLUGIN, format, arguments);
    va_end(arguments);
}

static void work(void *result, const void *task)
{
    const probe_task *t = task;
    t->attempt(t->path, result);
}

static bool is_crash(int number)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
    for (size_t k = 0; k < sizeof crashes / sizeof *crashes; ++k)
        if (number == crashes[k]) return true;
    return false;
}

/* What was done to the process: LOAD_OPEN, since it says nothing about the file. */
static void refuse_for_now(load_outcome *outcome, child_fate fate)
{
    if (fate.end == CHILD_NOT_RUN)
        load_outcome_refuse(outcome, LOAD_OPEN, "trial",
                            "no process to load it in could be made: %s",
                            system_error_text(fate.number));
    else
        load_outcome_refuse(outcome, LOAD_OPEN, "trial",
                            "the process that loaded it was %s from outside: signal %d (%s)",
                            fate.end == CHILD_STOPPED ? "stopped" : "ended", fate.number,
                            strsignal(fate.number));
}

static void refuse_by_fate(load_outcome *outcome, child_fate fate)
{
    const bool crashed = fate.end == CHILD_KILLED && is_crash(fate.number);
    if (fate.end == CHILD_LATE)
        load_outcome_refuse(outcome, LOAD_PROBE, "trial",
                            "loading it does not finish within %d s; look at its constructors and "
                            "get_factory, which run then",
                            DEADLINE_SECONDS);
    else if (crashed)
        load_outcome_refuse(outcome, LOAD_PROBE, "trial",
                            "loading it crashes: signal %d (%s); look at its constructors and "
                            "get_factory, which run then",
                            fate.number, strsignal(fate.number));
    else if (fate.end != CHILD_EXITED)
        refuse_for_now(outcome, fate);
    else if (fate.number >= 0)
        load_outcome_refuse(outcome, LOAD_PROBE, "trial",
                            "loading it ends the process with status %d; a plugin must not exit: "
                            "return IMP_STATUS_INTERNAL from create instead",
                            fate.number);
    else
        load_outcome_refuse(outcome, LOAD_OPEN, "trial",
                            "loading it ends the process; a plugin must not exit");
}

void load_probe_run(const char *path, load_attempt *attempt, load_outcome *outcome)
{
    const probe_task task = {path, attempt};
    *outcome = (load_outcome){.code = IMP_ERROR_MEMORY};
    load_outcome *shared = child_memory(sizeof *shared);
    if (shared == NULL) return;
    const child_fate fate = child_run(work, shared, &task, DEADLINE_SECONDS);
    if (fate.end == CHILD_DONE)
        *outcome = *shared;
    else
        refuse_by_fate(outcome, fate);
    child_memory_free(shared, sizeof *shared);
}
