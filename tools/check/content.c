/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/content.h"

#include <impinge/examine.h>
#include <stdio.h>
#include <string.h>

static void list_work(void *result, const void *data)
{
    content *c = result;
    imp_type_info info;
    imp_plugin_refusal refusal = {NULL, "memory ran out"};
    imp_registry *registry = imp_registry_from_file(data);
    if (registry == NULL || imp_registry_refusal(registry, 0, &refusal)) {
        snprintf(c->reason, sizeof c->reason, "%s", refusal.reason);
        return;
    }
    for (size_t i = 0; c->count < CONTENT_TYPES && imp_registry_type(registry, i, &info); ++i) {
        content_type *t = &c->type[c->count++];
        t->kind = info.kind;
        snprintf(t->name, sizeof t->name, "%s", info.name);
        snprintf(t->stage[0], sizeof t->stage[0], "%s", info.example);
    }
    if (c->count > 0)
        snprintf(c->plugin, sizeof c->plugin, "%s %s, %s", info.plugin, info.version, info.license);
    snprintf(c->name, sizeof c->name, "%s", info.plugin);
    snprintf(c->version, sizeof c->version, "%s", info.version);
    c->is_taken = true;
    imp_registry_free(registry);
}

typedef struct defaults {
    const char *file;
    size_t type; /* index in the content */
} defaults;

/* Returns whether create takes the stage; else *fault says why. Without memory or a registry it is
 * left to the checks. */
static bool works(const defaults *d, imp_type_kind kind, const char *stage, imp_error *fault)
{
    imp_instance made = {NULL, NULL, NULL};
    imp_registry *registry = imp_registry_from_file(d->file);
    const bool made_one = registry == NULL || imp_instance_from_text(registry, kind, stage, &made,
                                                                     fault) == IMP_SUCCESS;
    imp_instance_free(&made);
    imp_registry_free(registry);
    return made_one;
}

/* Removes the stages that create rejects: the type's name alone, if parameters are required; its
 * example, if that is wrong. */
static void defaults_work(void *result, const void *data)
{
    const defaults *d = data;
    content_type *t = &((content *)result)->type[d->type];
    imp_error error;
    if (t->stage[1][0] != '\0' && !works(d, t->kind, t->stage[1], &error)) t->stage[1][0] = '\0';
    if (works(d, t->kind, t->stage[0], &error)) return;
    char stage[sizeof t->stage[0]];
    memcpy(stage, t->stage[0], sizeof stage);
    snprintf(t->example_fault, sizeof t->example_fault, "'%.300s': %.600s", stage, error.text);
    memcpy(t->stage[0], t->stage[1], sizeof t->stage[0]);
    t->stage[1][0] = '\0';
}

/* If create crashes, its checks report it. */
static void try_stages(const char *file, double seconds, content *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        content_type *t = &c->type[k];
        const defaults d = {file, k};
        if (strcmp(t->stage[0], t->name) != 0) memcpy(t->stage[1], t->name, sizeof t->name);
        child_run(defaults_work, c, &d, seconds);
    }
}

child_fate content_list(const char *file, double seconds, content *shared)
{
    memset(shared, 0, sizeof *shared);
    const child_fate fate = child_run(list_work, shared, file, seconds);
    if (fate.end == CHILD_DONE) try_stages(file, seconds, shared);
    return fate;
}
