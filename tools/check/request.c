/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/request.h"

#include <stdio.h>
#include <string.h>

#include "tools/check/domain.h"
#include "tools/check/stated_formula.h"

static void try_type(const check_task *task, imp_registry *registry, const imp_type_info *info,
                     check_misreading *m)
{
    const char *stage = task->stage[0] != NULL ? task->stage[0] : info->example;
    imp_instance made = {NULL, NULL, NULL};
    imp_error error;
    const imp_code code = imp_instance_from_text(registry, info->kind, stage, &made, &error);
    if (code == IMP_ERROR_SCENE && task->stage[0] != NULL)
        snprintf(m->stage, sizeof m->stage, "%s", error.text);
    else if (task->formula != NULL)
        formula_free(
            stated_formula(registry, info, stage, task->formula, m->formula, sizeof m->formula));
    said_domain d;
    if (m->stage[0] == '\0' && task->domain != NULL)
        said_domain_read(&d, registry, info, stage, task->domain, m->domain, sizeof m->domain);
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
    child_run(try_work, shared, task, seconds); /* if the plugin fails here, its checks report it */
}
