/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/status.h"
#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/kept_instances.h"
#include "core/plugin/registry_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Finding ---------------------------------------------------------------------------------- */

/* Most names differ in their first letter, which is read without a call. */
const found_type *registry_find(const imp_registry *r, imp_type_kind kind, const char *name)
{
    for (size_t i = 0; i < r->type_count; ++i) {
        const found_type *one = &r->type[i];
        if (one->kind != kind || one->view.name[0] != name[0]) continue;
        if (strcmp(one->view.name, name) == 0) return one;
    }
    return NULL;
}

arena_store *registry_store(const imp_registry *registry) { return registry->store; }

struct kept_instances *registry_kept(const imp_registry *registry) { return registry->kept; }

const imp_surface_type *registry_find_surface(const imp_registry *registry, const char *name)
{
    const found_type *found = registry_find(registry, IMP_TYPE_SURFACE, name);
    return found != NULL ? found->type : NULL;
}

const imp_map_type *registry_find_map(const imp_registry *registry, const char *name)
{
    const found_type *found = registry_find(registry, IMP_TYPE_MAP, name);
    return found != NULL ? found->type : NULL;
}

const char *registry_find_file(const imp_registry *registry, imp_type_kind kind, const char *name)
{
    const found_type *found = registry_find(registry, kind, name);
    return found != NULL ? found->from->path : NULL;
}

const char *registry_nearest(const imp_registry *registry, imp_type_kind kind, const char *name)
{
    spelling_search search = {.wanted = name};
    for (size_t i = 0; i < registry->type_count; ++i)
        if (registry->type[i].kind == kind) spelling_offer(&search, registry->type[i].view.name);
    return search.best;
}

/* Whether a file is called NAME.so. */
static bool is_file_of(const char *file, const char *name)
{
    const char *slash = strrchr(file, '/'), *base = slash != NULL ? slash + 1 : file;
    const size_t length = strlen(name);
    return strncmp(base, name, length) == 0 && strcmp(base + length, ".so") == 0;
}

registry_text registry_left_out(const imp_registry *registry, const char *name)
{
    registry_text left_out = {""};
    const remarks *all = &registry->refusals;
    if (all->count == 0) return left_out;
    const remark *one = &all->all[0];
    for (size_t i = 0; i < all->count; ++i)
        if (is_file_of(all->all[i].file, name)) one = &all->all[i];
    if (all->count == 1)
        snprintf(left_out.text, sizeof left_out.text, "; '%.250s' was left out: %.380s", one->file,
                 one->text);
    else
        snprintf(left_out.text, sizeof left_out.text,
                 "; %zu files were left out, such as '%.250s': %.350s", all->count, one->file,
                 one->text);
    return left_out;
}

static bool isolates(const imp_registry *registry, const char *name)
{
    if (registry->isolated == NULL || registry->isolated[0] == '\0')
        return registry->isolated != NULL;
    char wanted[TEXT_NAME_MAX + 3];
    snprintf(wanted, sizeof wanted, ",%s,", name);
    return strstr(registry->isolated, wanted) != NULL;
}

worker_pool *registry_isolation(const imp_registry *registry, const char *name)
{
    return isolates(registry, name) ? registry->workers : NULL;
}

bool registry_has_isolated(const imp_registry *registry) { return registry->workers != NULL; }

/* The first name of a list ",a,b," that is not the name of a type, copied to `name`; false: all
 * are. */
static bool unknown_name(const imp_registry *r, const char *list, char name[TEXT_NAME_MAX + 1])
{
    for (const char *c = list + 1; *c != '\0'; c += strcspn(c, ",") + 1) {
        snprintf(name, TEXT_NAME_MAX + 1, "%.*s", (int)strcspn(c, ","), c);
        if (registry_find(r, IMP_TYPE_SURFACE, name) == NULL &&
            registry_find(r, IMP_TYPE_MAP, name) == NULL)
            return true;
    }
    return false;
}

static imp_code refuse_isolation(const imp_registry *r, const char *name, imp_error *error)
{
    spelling_search search = {.wanted = name};
    for (size_t i = 0; i < r->type_count; ++i) spelling_offer(&search, r->type[i].view.name);
    const char *near = search.best;
    return error_set(error, IMP_ERROR_USAGE,
                     "unknown type '%s' to isolate%s%s%s `impinge list` shows what there is", name,
                     near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
                     near != NULL ? "'?" : ";");
}

imp_code imp_registry_isolate(imp_registry *registry, const char *names, imp_error *error)
{
    if (registry == NULL) return error_set_missing(error, "imp_registry_isolate");
    const size_t size = names != NULL ? strlen(names) + 3 : 1;
    char *list = malloc(size), unknown[TEXT_NAME_MAX + 1];
    if (list == NULL) return error_set_memory(error);
    snprintf(list, size, names != NULL ? ",%s," : "%s", names != NULL ? names : "");
    if (names != NULL && unknown_name(registry, list, unknown)) {
        free(list);
        return refuse_isolation(registry, unknown, error);
    }
    if (registry->workers == NULL) registry->workers = worker_pool_new();
    if (registry->workers == NULL) {
        free(list);
        return error_set_memory(error);
    }
    free(registry->isolated);
    registry->isolated = list;
    return IMP_SUCCESS;
}

imp_code imp_registry_limit_reading(imp_registry *registry, double seconds, uint64_t bytes,
                                    imp_error *error)
{
    if (registry == NULL) return error_set_missing(error, "imp_registry_limit_reading");
    if (!(seconds >= 0))
        return error_set(error, IMP_ERROR_USAGE,
                         "imp_registry_limit_reading: got %g seconds, must be 0 or more", seconds);
    registry->reading = (reading_limits){seconds, bytes};
    return IMP_SUCCESS;
}

reading_limits registry_reading_limits(const imp_registry *registry) { return registry->reading; }

bool imp_registry_type(const imp_registry *registry, size_t index, imp_type_info *info)
{
    if (registry == NULL || info == NULL || index >= registry->type_count) return false;
    const found_type *found = &registry->type[index];
    const imp_plugin *entry = found->from->file.entry;
    *info = (imp_type_info){
        .kind = found->kind,
        .name = found->view.name,
        .summary = found->view.summary,
        .equation = found->view.equation,
        .source = found->view.source,
        .example = found->view.example,
        .file = found->from->path,
        .plugin = entry->name,
        .version = entry->version,
        .license = entry->license,
        .author = entry->author,
        .shadowed_by = found->shadowed_by != NULL ? found->shadowed_by->path : NULL,
        .parameters = found->view.table.rows,
        .parameter_count = found->view.table.count,
        .parameter_size = found->view.table.stride,
        .capabilities = found->capabilities,
        .formula = found->view.formula,
    };
    return true;
}

static bool tell(const remarks *list, size_t index, imp_plugin_refusal *out)
{
    if (out == NULL || index >= list->count) return false;
    *out = (imp_plugin_refusal){list->all[index].file, list->all[index].text};
    return true;
}

bool imp_registry_refusal(const imp_registry *registry, size_t index, imp_plugin_refusal *refusal)
{
    return registry != NULL && tell(&registry->refusals, index, refusal);
}

bool imp_registry_warning(const imp_registry *registry, size_t index, imp_plugin_refusal *warning)
{
    return registry != NULL && tell(&registry->warnings, index, warning);
}

/* The file that the type comes from. */
static const char *file_of(const imp_registry *r, worker_type type)
{
    const void *wanted = type.surface != NULL ? (const void *)type.surface : type.map;
    size_t i = 0;
    while (r->type[i].type != wanted) ++i;
    return r->type[i].from->path;
}

bool imp_registry_fault(const imp_registry *registry, size_t index, imp_plugin_refusal *fault)
{
    worker_type type;
    const char *text;
    if (registry == NULL || fault == NULL || registry->workers == NULL ||
        !worker_pool_fault(registry->workers, index, &type, &text))
        return false;
    *fault = (imp_plugin_refusal){file_of(registry, type), text};
    return true;
}

/* --- Creation and destruction ----------------------------------------------------------------- */

static void free_plugin(loaded_plugin *plugin)
{
    plugin_file_close(&plugin->file, plugin->path);
    free(plugin->path);
    free(plugin);
}

static void free_remarks(remarks *list)
{
    for (size_t i = 0; i < list->count; ++i) {
        free(list->all[i].file);
        free(list->all[i].text);
    }
    free(list->all);
}

void imp_registry_free(imp_registry *r)
{
    if (r == NULL) return;
    kept_instances_free(r->kept);
    worker_pool_free(r->workers);
    arena_store_free(r->store);
    free_remarks(&r->refusals);
    free_remarks(&r->warnings);
    for (size_t i = r->plugin_count; i > 0; --i) free_plugin(r->plugin[i - 1]);
    free(r->isolated);
    free(r->plugin);
    free(r->seen);
    free(r->type);
    free(r);
}
